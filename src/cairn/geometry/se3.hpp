// SPDX-License-Identifier: BSD-3-Clause
// Poses in space.
#pragma once

#include "geometry/rigid.hpp"
#include "geometry/so3.hpp"

namespace cairn {

// Pose of a spatial vehicle.
using SE3 = Rigid<SO3>;

}  // namespace cairn
