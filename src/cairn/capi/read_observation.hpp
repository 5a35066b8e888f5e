// SPDX-License-Identifier: BSD-3-Clause
// Conversion of observations and matches at the C boundary.
#pragma once

#include "capi/guard.hpp"

namespace cairn {
namespace capi {

// Reads observation `number` of `array` and checks every field. The id is read only if `named`.
void read_observation(const cairn_observation& from, const char* array, std::size_t number, std::size_t rows,
                      bool named, Observation& to);
void write_match(const Match& match, cairn_match* out);

}  // namespace capi
}  // namespace cairn
