// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace cairn::program {

// A command line that makes no sense, or a place that cannot be written. One line.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace cairn::program
