// SPDX-License-Identifier: BSD-3-Clause
// The options of a team.
#pragma once

#include "sensor/range_bearing.hpp"
#include "slam/filter_options.hpp"
#include "team/mailbox_options.hpp"

namespace cairn {

enum class TeamMode { mono, eo_diagonal, eo_full, joint, submaps };

struct TeamOptions {
  TeamMode mode = TeamMode::joint;
  MailboxOptions mail;        // `listens` and `named` follow from the other options
  FilterOptions<SE2> filter;  // its start is that of this vehicle
  RangeBearingParameters radar;
};

}  // namespace cairn
