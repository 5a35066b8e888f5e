// SPDX-License-Identifier: BSD-3-Clause
// The options of a world: defaults, presets and checks.
#pragma once

#include <cairn/sim.h>

#include <cstdint>

namespace cairn::sim {

cairn_world_options default_world_options();
// Throws Error if there is no such preset.
cairn_world_options preset_world_options(std::int32_t preset, std::uint32_t& submap_landmarks);
// The caller's options over the defaults. Every field is checked. Throws Error.
cairn_world_options read_world_options(const cairn_world_options* user);

}  // namespace cairn::sim
