// SPDX-License-Identifier: BSD-3-Clause
// Options of a command line: a table of names and what each sets.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "program/options/filter_choices.hpp"

namespace cairn::program {

// A command line that makes no sense, or a place that can't be written. One line.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Option {
  const char* name;
  bool takes_value;
  std::function<void(const std::string& value)> set;
};
using OptionTable = std::vector<Option>;

enum class Range { kPositive, kNotNegative, kProbability, kAny };  // the third without 0

[[noreturn]] void reject(const char* name, const std::string& value, const std::string& expected);
std::uint64_t parse_whole(const char* name, const std::string& value, std::uint64_t low, std::uint64_t high);
double parse_number(const char* name, const std::string& value, Range range);

// Options of common kinds. `target` has to live as long as the table.
Option flag(const char* name, bool& target);
Option number(const char* name, Range range, double& target);
Option number(const char* name, Range range, std::optional<double>& target);
Option whole(const char* name, std::uint32_t low, std::uint32_t high, std::uint32_t& target);
Option whole(const char* name, std::uint32_t low, std::uint32_t high, std::optional<std::uint32_t>& target);
// One of the words, which stand for 0, 1, 2, ... in their order.
Option choice(const char* name, const std::vector<const char*>& words, std::int32_t& target);

// What every command has.
struct CommonChoices {
  bool help = false;
  bool json = false;
  bool quiet = false;
  std::string output;  // folder; empty: none
  std::uint64_t seed = 1;
};
void add_common_options(OptionTable& table, CommonChoices& choices);
void add_filter_options(OptionTable& table, FilterChoices& choices);

// Sets what `arguments` say; words that are no options go to `positional`. The option `first` (or NULL) is set before
// all others, wherever it stands. `command` is named where an option is unknown. Throws UsageError.
void parse(const std::vector<std::string>& arguments, const OptionTable& table, const std::string& command,
           const std::function<void(const std::string&)>& positional, const char* first = nullptr);

}  // namespace cairn::program
