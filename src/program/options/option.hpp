// SPDX-License-Identifier: BSD-3-Clause
// One option of a command line: its name, its texts, and the variable that it sets. The constructors below read the
// kinds of values that the program knows.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "options/bounds.hpp"

namespace cairn::program {

// The texts of an option. `Word` is printed bold if the output has bold type; {default}, {default_degrees}, {lower} and
// {upper} stand for values of the option.
struct OptionText {
  const char* name;   // "--gate"
  const char* value;  // the word for its value in texts, "P"; "": the option takes no value
  const char* text;   // printed by --help and on the manual page
  const char* more;   // printed on the manual page only
};

struct Option {
  std::string name, value, text, more;  // as in OptionText, without braces
  std::function<void(const std::string& value)> set;
  std::string alias = {};  // "-h"; empty: none

  bool takes_value() const { return !value.empty(); }
  bool is(const std::string& word) const { return word == name || (!alias.empty() && word == alias); }
};

// Options under one heading.
struct OptionGroup {
  std::string key;    // names the group's part of docs/cairn.1
  std::string title;  // heads it in --help
  std::vector<Option> options;
};

// The words between commas; an empty one where nothing stands.
std::vector<std::string> split(const std::string& list);

// Throw UsageError.
[[noreturn]] void reject(const std::string& name, const std::string& value, const std::string& expected);
std::uint64_t parse_whole(const std::string& name, const std::string& value, std::uint64_t low, std::uint64_t high);
double parse_number(const std::string& name, const std::string& value, const options::Bounds& bounds);

// Options of common kinds. `target` has to live as long as the option. Its value now is the {default} of the texts,
// unless `initial` tells it.
Option flag(const OptionText& text, bool& target);
Option number(const OptionText& text, const options::Bounds& bounds, double& target);
Option number(const OptionText& text, const options::Bounds& bounds, double initial, std::optional<double>& target);
Option whole(const OptionText& text, std::uint32_t low, std::uint32_t high, std::uint32_t& target);
Option whole(const OptionText& text, std::uint32_t low, std::uint32_t high, std::uint32_t initial,
             std::optional<std::uint32_t>& target);
// One of `words`, which stand for 0, 1, 2, ... or for `constants`, in their order.
Option choice(const OptionText& text, const std::vector<const char*>& words, std::int32_t& target);
Option choice(const OptionText& text, const std::vector<const char*>& words, const std::vector<std::int32_t>& constants,
              std::optional<std::int32_t>& target);
// Any other kind.
Option custom(const OptionText& text, std::function<void(const std::string& value)> set);

}  // namespace cairn::program
