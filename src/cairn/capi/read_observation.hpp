// SPDX-License-Identifier: BSD-3-Clause
// Observations and matches that cross the C boundary.
#pragma once

#include "capi/guard.hpp"

namespace cairn {
namespace capi {

// Checks every field. `named`: the observation brings an id.
void read_observation(const cairn_observation& from, const char* array, std::size_t number, std::size_t rows,
                      bool named, Observation& to);
void write_match(const Match& match, cairn_match* out);

}  // namespace capi
}  // namespace cairn
