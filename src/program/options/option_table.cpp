// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/option_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

namespace cairn::program {

void reject(const char* name, const std::string& value, const std::string& expected) {
  throw UsageError("option " + std::string(name) + ": '" + value + "' is not " + expected);
}

std::uint64_t parse_whole(const char* name, const std::string& value, std::uint64_t low, std::uint64_t high) {
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

double parse_number(const char* name, const std::string& value, Range range) {
  double number = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, number);
  const bool low_enough = range == Range::kAny || (range == Range::kNotNegative ? number >= 0 : number > 0);
  const bool high_enough = range == Range::kProbability ? number <= 1 : std::isfinite(number);
  if (error != std::errc() || stop != end || !low_enough || !high_enough) {
    static constexpr const char* kExpected[] = {"a number above 0", "a number of 0 or more",
                                                "a probability above 0, up to 1", "a finite number"};
    reject(name, value, kExpected[static_cast<int>(range)]);
  }
  return number;
}

Option flag(const char* name, bool& target) {
  return {name, false, [&target](const std::string&) { target = true; }};
}

Option number(const char* name, Range range, double& target) {
  return {name, true, [=, &target](const std::string& v) { target = parse_number(name, v, range); }};
}

Option number(const char* name, Range range, std::optional<double>& target) {
  return {name, true, [=, &target](const std::string& v) { target = parse_number(name, v, range); }};
}

Option whole(const char* name, std::uint32_t low, std::uint32_t high, std::uint32_t& target) {
  return {name, true,
          [=, &target](const std::string& v) { target = static_cast<std::uint32_t>(parse_whole(name, v, low, high)); }};
}

Option whole(const char* name, std::uint32_t low, std::uint32_t high, std::optional<std::uint32_t>& target) {
  return {name, true,
          [=, &target](const std::string& v) { target = static_cast<std::uint32_t>(parse_whole(name, v, low, high)); }};
}

Option choice(const char* name, const std::vector<const char*>& words, std::int32_t& target) {
  return {name, true, [=, &target](const std::string& v) {
            const auto word = std::find(words.begin(), words.end(), v);
            if (word == words.end()) {
              std::string all = words.front();
              for (std::size_t i = 1; i < words.size(); ++i)
                all += (i + 1 == words.size() ? " or " : ", ") + std::string(words[i]);
              reject(name, v, all);
            }
            target = static_cast<std::int32_t>(word - words.begin());
          }};
}

void add_common_options(OptionTable& table, CommonChoices& o) {
  table.push_back(flag("--help", o.help));
  table.push_back(flag("--quiet", o.quiet));
  table.push_back({"--summary", true, [&o](const std::string& v) {
                     if (v != "json") reject("--summary", v, "json");
                     o.json = true;
                   }});
  table.push_back({"--output", true, [&o](const std::string& v) {
                     if (v.empty()) reject("--output", v, "a folder");
                     o.output = v;
                   }});
  table.push_back({"--seed", true, [&o](const std::string& v) {
                     o.seed = parse_whole("--seed", v, 0, std::numeric_limits<std::uint64_t>::max());
                   }});
}

void add_filter_options(OptionTable& table, FilterChoices& o) {
  constexpr std::uint32_t kLargestSubmap = 4096, kLargestMap = 10000000;
  static_assert(CAIRN_ERROR_INVARIANT == 0 && CAIRN_ERROR_STANDARD == 1);
  static_assert(CAIRN_JOIN_AUTO == 0 && CAIRN_JOIN_DENSE == 1 && CAIRN_JOIN_SPARSE == 2);
  static_assert(CAIRN_ASSOCIATION_KNOWN == 0 && CAIRN_ASSOCIATION_NEAREST == 1 && CAIRN_ASSOCIATION_JOINT == 2);
  table.push_back(choice("--error", {"invariant", "standard"}, o.error));
  table.push_back({"--single-map", false, [&o](const std::string&) { o.submap_landmarks = 0; }});
  table.push_back(whole("--submap-landmarks", 0, kLargestSubmap, o.submap_landmarks));
  table.push_back(number("--submap-distance", Range::kNotNegative, o.submap_distance));
  table.push_back(number("--submap-extent", Range::kNotNegative, o.submap_extent));
  table.push_back(number("--submap-sigma", Range::kNotNegative, o.submap_sigma));
  table.push_back(choice("--join", {"auto", "dense", "sparse"}, o.join));
  table.push_back(choice("--association", {"known", "nearest", "joint"}, o.association));
  static_assert(CAIRN_DISTANCE_MAHALANOBIS == 0 && CAIRN_DISTANCE_LIKELIHOOD == 1);
  table.push_back(choice("--association-distance", {"mahalanobis", "likelihood"}, o.association_distance));
  table.push_back(whole("--deferred-sightings", 1, 1000, o.deferred_sightings));
  table.push_back(whole("--deferred-frames", 1, 1000000, o.deferred_frames));
  table.push_back({"--forget-after", true, [&o](const std::string& v) {
                     o.forget_after = parse_whole("--forget-after", v, 0, std::numeric_limits<std::uint64_t>::max());
                   }});
  table.push_back({"--error-persistence", true, [&o](const std::string& v) {
                     o.error_persistence = parse_number("--error-persistence", v, Range::kPositive);
                     if (!(*o.error_persistence >= 1)) reject("--error-persistence", v, "a number of 1 or more");
                   }});
  table.push_back(number("--gate", Range::kProbability, o.gate));
  table.push_back(number("--batch-gate", Range::kProbability, o.batch_gate));
  table.push_back(whole("--iterations", 1, 50, o.iterations));
  table.push_back(whole("--max-landmarks", 1, kLargestMap, o.max_landmarks));
}

void parse(const std::vector<std::string>& arguments, const OptionTable& table, const std::string& command,
           const std::function<void(const std::string&)>& positional, const char* first) {
  std::vector<std::pair<const Option*, std::string>> given;
  bool only_words = false;  // after --
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (!only_words && argument == "--") {
      only_words = true;
      continue;
    }
    if (only_words || argument.size() < 2 || argument[0] != '-') {
      positional(argument);
      continue;
    }
    const std::size_t equals = argument.find('=');
    const std::string name = argument == "-h" ? "--help" : argument.substr(0, equals);
    const auto option = std::find_if(table.begin(), table.end(), [&](const Option& o) { return name == o.name; });
    if (option == table.end()) throw UsageError("unknown option '" + name + "' (see cairn " + command + " --help)");
    std::string value;
    if (!option->takes_value) {
      if (equals != std::string::npos) throw UsageError("option " + name + " takes no value");
    } else if (equals != std::string::npos) {
      value = argument.substr(equals + 1);
    } else {
      if (i + 1 == arguments.size()) throw UsageError("option " + name + " needs a value");
      value = arguments[++i];
    }
    given.emplace_back(&*option, value);
  }
  if (first != nullptr) {
    std::stable_partition(given.begin(), given.end(),
                          [&](const auto& entry) { return entry.first->name == std::string(first); });
  }
  for (const auto& [option, value] : given) option->set(value);
}

}  // namespace cairn::program
