// SPDX-License-Identifier: BSD-3-Clause
// Conversion of C structs to structs of the core. Every field is checked.
#pragma once

#include <cairn/cairn.h>

#include <variant>

#include "slam/filter.hpp"

namespace cairn {
namespace capi {

Wheels read_wheels(const cairn_wheels* user);
TwistNoise read_twist_noise(const cairn_twist_noise* user);
StereoHead read_stereo_head(const cairn_stereo_head* user);
StereoCamera read_stereo_camera(const cairn_stereo_camera* user);
RangeBearingParameters read_range_bearing(const cairn_range_bearing* user);
template <class Pose>
Cartesian<Pose> read_cartesian(const cairn_cartesian* user);
template <class Pose>
CustomSensor<Pose> read_custom(const cairn_custom* description, cairn_custom_predict_fn predict,
                               cairn_custom_place_fn place, void* user);
std::variant<FilterOptions<SE3>, FilterOptions<SE2>> read_filter_options(const cairn_filter_options* user);

// Reads a pose. For a planar Pose it must have z = 0 and a rotation about z only.
template <class Pose>
Pose read_pose_of(const cairn_pose* pose, const char* name);

}  // namespace capi
}  // namespace cairn
