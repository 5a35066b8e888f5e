// SPDX-License-Identifier: BSD-3-Clause
// The handle behind cairn/team.h: a team, and its comparison with the truth and with a filter of this vehicle only.
#pragma once

#include <optional>

#include "capi/guard.hpp"
#include "team/score.hpp"
#include "team/team.hpp"

struct cairn_team {
  cairn_team(const cairn::TeamOptions& options, bool with_baseline)
      : team(options), number(cairn::capi::next_filter_number()), map{&team.landmarks(), number, nullptr} {
    if (with_baseline) baseline.emplace(options);
  }
  cairn::Team team;
  std::optional<cairn::Baseline> baseline;
  cairn::Score score;
  std::uint64_t number;
  cairn_map map;
};

namespace cairn {
namespace capi {

// The caller's options over the defaults. The team's options follow from them, from the filter's and from the radar's;
// each is checked.
cairn_team_options read_team_options(const cairn_team_options* user);
TeamOptions team_options(const cairn_team_options& options, const cairn_filter_options* filter,
                         const cairn_range_bearing* radar);

}  // namespace capi
}  // namespace cairn
