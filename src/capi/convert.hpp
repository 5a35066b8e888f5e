// SPDX-License-Identifier: BSD-3-Clause
// From the descriptions that cross the C boundary to those of the core, every field checked.
#pragma once

#include <cairn/cairn.h>

#include "slam/filter.hpp"

namespace cairn {
namespace capi {

Wheels read_wheels(const cairn_wheels* user);
TwistNoise read_twist_noise(const cairn_twist_noise* user);
StereoHead read_stereo_head(const cairn_stereo_head* user);
StereoCamera read_stereo_camera(const cairn_stereo_camera* user);
Cartesian read_cartesian(const cairn_cartesian* user);
CustomSensor read_custom(const cairn_custom* user);
FilterOptions read_filter_options(const cairn_filter_options* user);

}  // namespace capi
}  // namespace cairn
