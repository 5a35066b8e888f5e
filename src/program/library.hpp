// SPDX-License-Identifier: BSD-3-Clause
// Calls of the libraries that must succeed.
#pragma once

#include <cairn/cairn.h>
#include <cairn/sim.h>

#include <stdexcept>
#include <string>
#include <vector>

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

// Reads a whole array of libcairn_sim. `query(buffer, capacity, &needed)` is the call; it is asked for the size first.
template <class Element, class Query>
void read_sim_array(std::vector<Element>& out, Query&& query) {
  std::size_t needed = 0;
  check_sim(query(static_cast<Element*>(nullptr), std::size_t{0}, &needed));
  out.resize(needed);
  if (needed > 0) check_sim(query(out.data(), needed, &needed));
}

}  // namespace cairn::program
