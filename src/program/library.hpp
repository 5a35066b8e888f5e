// SPDX-License-Identifier: BSD-3-Clause
// Calls of the libraries that must succeed.
#pragma once

#include <cairn/cairn.h>
#include <cairn/sim.h>

#include <stdexcept>
#include <string>

namespace cairn::program {

// The library refused a call.
class LibraryError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws LibraryError with the library's message behind `about`.
inline void check(cairn_status status, const std::string& about = "") {
  if (status != CAIRN_OK) throw LibraryError(about + cairn_status_name(status) + ": " + cairn_last_message());
}

inline void check_sim(cairn_status status) {
  if (status != CAIRN_OK) throw LibraryError(std::string(cairn_status_name(status)) + ": " + cairn_sim_last_message());
}

}  // namespace cairn::program
