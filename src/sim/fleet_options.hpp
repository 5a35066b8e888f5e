// SPDX-License-Identifier: BSD-3-Clause
// The options of a fleet: defaults and checks.
#pragma once

#include <cairn/fleet.h>

#include <cstddef>
#include <cstdint>

namespace cairn::sim {

// The indices of the random draws have room for this many.
constexpr std::uint32_t kMostBoats = 64, kMostFeatures = 100000;

cairn_fleet_options default_fleet_options();
// The caller's options over the defaults. Every field is checked. Throws Error.
cairn_fleet_options read_fleet_options(const cairn_fleet_options* user);
// Number of steps of a fleet with these options, the start included.
std::size_t steps_of(const cairn_fleet_options& options);

}  // namespace cairn::sim
