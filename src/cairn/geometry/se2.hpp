// SPDX-License-Identifier: BSD-3-Clause
// Poses in the plane.
#pragma once

#include "geometry/rigid.hpp"
#include "geometry/so2.hpp"

namespace cairn {

// Pose of a planar vehicle.
using SE2 = Rigid<SO2>;

}  // namespace cairn
