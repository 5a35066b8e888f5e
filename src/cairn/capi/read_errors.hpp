// SPDX-License-Identifier: BSD-3-Clause
// Reads and checks standard deviations and random walks of systematic errors.
#pragma once

#include "capi/boundary.hpp"

namespace cairn {
namespace capi {

// Which of three components a vehicle has.
enum class Axes { all, xy, z };

// `count` standard deviations at the start and random walks; `name` begins the names of the fields, before "_sigma" and
// "_walk".
void read_errors(const double* sigma, const double* walk, int count, const char* name, Axes axes, double* sigmas,
                 double* walks);

}  // namespace capi
}  // namespace cairn
