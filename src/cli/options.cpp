// SPDX-License-Identifier: BSD-3-Clause
#include "cli/options.hpp"

#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <system_error>

namespace cairn::cli {
namespace {

struct Option {
  const char* name;
  bool takes_value;
  std::function<void(const std::string& value)> set;
};

[[noreturn]] void reject(const char* name, const std::string& value, const std::string& expected) {
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

enum class Range { kPositive, kNotNegative, kProbability };  // the last without 0

double parse_number(const char* name, const std::string& value, Range range) {
  double number = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, number);
  const bool low_enough = range == Range::kNotNegative ? number >= 0 : number > 0;
  const bool high_enough = range == Range::kProbability ? number <= 1 : std::isfinite(number);
  if (error != std::errc() || stop != end || !low_enough || !high_enough) {
    static constexpr const char* kExpected[] = {"a number above 0", "a number of 0 or more",
                                                "a probability above 0, up to 1"};
    reject(name, value, kExpected[static_cast<int>(range)]);
  }
  return number;
}

std::vector<Option> run_option_table(RunOptions& o) {
  const auto number = [](const char* name, Range range, std::optional<double>& target) {
    return Option{name, true, [=, &target](const std::string& v) { target = parse_number(name, v, range); }};
  };
  const auto whole = [](const char* name, std::uint32_t low, std::uint32_t high, std::optional<std::uint32_t>& target) {
    return Option{name, true, [=, &target](const std::string& v) {
                    target = static_cast<std::uint32_t>(parse_whole(name, v, low, high));
                  }};
  };
  constexpr std::uint64_t kAnyWhole = std::numeric_limits<std::uint64_t>::max();
  return {
      {"--help", false, [&o](const std::string&) { o.help = true; }},
      {"--quiet", false, [&o](const std::string&) { o.quiet = true; }},
      {"--single-map", false, [](const std::string&) {}},  // the only way there is: nothing to set
      {"--summary", true,
       [&o](const std::string& v) {
         if (v != "json") reject("--summary", v, "json");
         o.json = true;
       }},
      {"--output", true,
       [&o](const std::string& v) {
         if (v.empty()) reject("--output", v, "a folder");
         o.output = v;
       }},
      {"--error", true,
       [&o](const std::string& v) {
         if (v != "standard" && v != "invariant") reject("--error", v, "standard or invariant");
         o.error = v == "standard" ? CAIRN_ERROR_STANDARD : CAIRN_ERROR_INVARIANT;
       }},
      // A log is no game of chance: the seed is checked, so that a script may pass it everywhere, and not used.
      {"--seed", true, [](const std::string& v) { parse_whole("--seed", v, 0, kAnyWhole); }},
      {"--forget-after", true,
       [&o](const std::string& v) { o.forget_after = parse_whole("--forget-after", v, 0, kAnyWhole); }},
      number("--gate", Range::kProbability, o.gate),
      number("--batch-gate", Range::kProbability, o.batch_gate),
      whole("--iterations", 1, 50, o.iterations),
      whole("--max-landmarks", 1, 30000, o.max_landmarks),
      number("--min-disparity", Range::kPositive, o.min_disparity),
      number("--min-disparity-sigmas", Range::kNotNegative, o.min_disparity_sigmas),
      number("--pixel-noise", Range::kPositive, o.noise.pixel),
      number("--velocity-noise", Range::kPositive, o.noise.velocity),
      number("--rate-noise", Range::kPositive, o.noise.rate),
  };
}

}  // namespace

RunOptions parse_run_options(const std::vector<std::string>& arguments) {
  RunOptions options;
  const std::vector<Option> table = run_option_table(options);
  bool only_files = false;  // after --
  bool has_log = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (!only_files && argument == "--") {
      only_files = true;
      continue;
    }
    if (only_files || argument.size() < 2 || argument[0] != '-') {
      if (has_log) throw UsageError("one log at a time: '" + argument + "' is a second one");
      options.log = argument;
      has_log = true;
      continue;
    }
    const std::size_t equals = argument.find('=');
    const std::string name = argument == "-h" ? "--help" : argument.substr(0, equals);
    const Option* option = nullptr;
    for (const Option& candidate : table) {
      if (name == candidate.name) option = &candidate;
    }
    if (option == nullptr) throw UsageError("unknown option '" + name + "' (see cairn run --help)");
    if (!option->takes_value) {
      if (equals != std::string::npos) throw UsageError("option " + name + " takes no value");
      option->set("");
    } else if (equals != std::string::npos) {
      option->set(argument.substr(equals + 1));
    } else {
      if (i + 1 == arguments.size()) throw UsageError("option " + name + " needs a value");
      option->set(arguments[++i]);
    }
  }
  if (!options.help && options.log.empty()) throw UsageError("no log given (usage: cairn run LOG [options])");
  return options;
}

}  // namespace cairn::cli
