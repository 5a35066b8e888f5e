// SPDX-License-Identifier: BSD-3-Clause
// What the command line asks for.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/log.hpp"

namespace cairn::cli {

// A command line that makes no sense, or a place that can't be written. One line.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What is not set stays as the library has it.
struct RunOptions {
  std::string log;
  bool help = false;
  bool json = false;
  bool quiet = false;
  std::string output;  // folder; empty: none
  std::int32_t error = CAIRN_ERROR_INVARIANT;
  std::uint64_t forget_after = 0;  // frames; 0: never
  std::optional<double> gate;
  std::optional<double> batch_gate;
  std::optional<std::uint32_t> iterations;
  std::optional<std::uint32_t> max_landmarks;
  std::optional<double> min_disparity;         // pixels
  std::optional<double> min_disparity_sigmas;  // standard deviations of the disparity
  io::NoiseOverride noise;
};

// `arguments` are what follows the word `run`. Throws UsageError.
RunOptions parse_run_options(const std::vector<std::string>& arguments);

}  // namespace cairn::cli
