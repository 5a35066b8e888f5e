// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/option.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <limits>
#include <system_error>
#include <utility>

#include "program/read_number.hpp"
#include "program/usage_error.hpp"

namespace cairn::program {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

std::string print(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.4g", value);
  return buffer;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

// An option whose texts have `values` instead of the words in braces.
Option make(const OptionText& text, std::function<void(const std::string&)> set,
            const std::vector<std::pair<std::string, std::string>>& values = {}) {
  Option option{text.name, text.value, text.text, text.more, std::move(set)};
  for (const auto& [word, value] : values) {
    replace_all(option.text, "{" + word + "}", value);
    replace_all(option.more, "{" + word + "}", value);
  }
  return option;
}

template <class Target>
Option make_number(const OptionText& text, const options::Bounds& bounds, double initial, Target& target) {
  const std::string name = text.name;
  return make(text, [=, &target](const std::string& v) { target = parse_number(name, v, bounds); },
              {{"default", print(initial)}, {"default_degrees", print(initial * kDegrees) + " degrees"}});
}

template <class Target>
Option make_whole(const OptionText& text, std::uint32_t low, std::uint32_t high, std::uint32_t initial,
                  Target& target) {
  const std::string name = text.name;
  return make(
      text,
      [=, &target](const std::string& v) { target = static_cast<std::uint32_t>(parse_whole(name, v, low, high)); },
      {{"default", std::to_string(initial)}, {"lower", std::to_string(low)}, {"upper", std::to_string(high)}});
}

template <class Target>
Option make_choice(const OptionText& text, const std::vector<const char*>& words,
                   const std::vector<std::int32_t>& constants, Target& target) {
  const std::string name = text.name;
  return make(text, [=, &target](const std::string& v) {
    const auto word = std::find(words.begin(), words.end(), v);
    if (word == words.end()) {
      std::string all = words.front();
      for (std::size_t i = 1; i < words.size(); ++i)
        all += (i + 1 == words.size() ? " or " : ", ") + std::string(words[i]);
      reject(name, v, all);
    }
    target = constants[static_cast<std::size_t>(word - words.begin())];
  });
}

std::string expected(const options::Bounds& bounds) {
  if (bounds.lower == -options::kInfinity) return "a finite number";
  const std::string lower = print(bounds.lower);
  if (bounds.unbounded()) return bounds.lower_open ? "a number above " + lower : "a number of " + lower + " or more";
  return (bounds.upper == 1 ? "a probability " : "a number ") + ("above " + lower + ", up to " + print(bounds.upper));
}

}  // namespace

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> words(1);
  for (const char letter : list) {
    if (letter == ',') {
      words.emplace_back();
    } else {
      words.back() += letter;
    }
  }
  return words;
}

void reject(const std::string& name, const std::string& value, const std::string& expected) {
  throw UsageError("option " + name + ": '" + value + "' is not " + expected);
}

std::uint64_t parse_whole(const std::string& name, const std::string& value, std::uint64_t low, std::uint64_t high) {
  std::uint64_t number = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, number);
  if (error != std::errc() || stop != end || number < low || number > high) {
    const bool bounded = high < std::numeric_limits<std::uint32_t>::max();
    reject(name, value,
           "a whole number " + (bounded ? "from " + std::to_string(low) + " to " + std::to_string(high)
                                        : "of " + std::to_string(low) + " or more"));
  }
  return number;
}

double parse_number(const std::string& name, const std::string& value, const options::Bounds& bounds) {
  const std::optional<double> number = read_number(value);
  if (!number || !bounds.contain(*number)) reject(name, value, expected(bounds));
  return *number;
}

Option custom(const OptionText& text, std::function<void(const std::string&)> set) {
  return make(text, std::move(set));
}

Option flag(const OptionText& text, bool& target) {
  return make(text, [&target](const std::string&) { target = true; });
}

Option number(const OptionText& text, const options::Bounds& bounds, double& target) {
  return make_number(text, bounds, target, target);
}

Option number(const OptionText& text, const options::Bounds& bounds, double initial, std::optional<double>& target) {
  return make_number(text, bounds, initial, target);
}

Option whole(const OptionText& text, std::uint32_t low, std::uint32_t high, std::uint32_t& target) {
  return make_whole(text, low, high, target, target);
}

Option whole(const OptionText& text, std::uint32_t low, std::uint32_t high, std::uint32_t initial,
             std::optional<std::uint32_t>& target) {
  return make_whole(text, low, high, initial, target);
}

Option choice(const OptionText& text, const std::vector<const char*>& words, std::int32_t& target) {
  std::vector<std::int32_t> constants;
  for (std::size_t i = 0; i < words.size(); ++i) constants.push_back(static_cast<std::int32_t>(i));
  return make_choice(text, words, constants, target);
}

Option choice(const OptionText& text, const std::vector<const char*>& words, const std::vector<std::int32_t>& constants,
              std::optional<std::int32_t>& target) {
  return make_choice(text, words, constants, target);
}

}  // namespace cairn::program
