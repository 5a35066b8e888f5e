// SPDX-License-Identifier: BSD-3-Clause
// Reads a number from a word, of a file or of the command line.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace cairn::program {

// The whole word as a number; empty if part of it is none. A number that is too small for a double, such as 1e-400, is
// read as the nearest one; a number that is too large is none.
inline std::optional<double> read_number(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc()) return value;
  value = std::strtod(std::string(word).c_str(), nullptr);  // from_chars does not tell the two apart
  if (!(std::abs(value) < 1)) return std::nullopt;
  return value;
}

}  // namespace cairn::program
