// SPDX-License-Identifier: BSD-3-Clause
// Observations and decisions as they cross the boundary.
#pragma once

#include "capi/guard.hpp"

namespace cairn {
namespace capi {

// Every field checked; `named`: its id counts.
void read_observation(const cairn_observation& from, const char* array, std::size_t number, std::size_t rows,
                      bool named, Observation& to);
void write_match(const Match& match, cairn_match* out);

}  // namespace capi
}  // namespace cairn
