/* SPDX-License-Identifier: BSD-3-Clause */
/* The C replayer: cairn_conformance [--record] FOLDER OUTPUT
 * Replays the scenarios of FOLDER by the C interface, compares what it gets with what they say, and writes it to
 * OUTPUT. With --record it does not compare. README.md describes both forms. */
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "call.hpp"

namespace conformance {
namespace {

namespace fs = std::filesystem;

constexpr double kTolerance = 1e-9;

bool is_bits(const json& value) {
  return value.is_string() && value.get_ref<const std::string&>().size() == 17 &&
         value.get_ref<const std::string&>()[0] == 'x';
}

/* The double of a recorded value or of an output, or none. */
std::optional<double> double_of(const json& value) {
  if (value.is_number_float() || is_bits(value) || value == "inf" || value == "-inf" || value == "nan")
    return read_double(value);
  return std::nullopt;
}

/* The largest value of an array, at least 1: what the tolerance refers to. */
double scale_of(const json& list) {
  double scale = 1;
  for (const json& item : list)
    if (const auto value = double_of(item); value && std::isfinite(*value)) scale = std::max(scale, std::abs(*value));
  return scale;
}

void compare(const json& expected, const json& got, double tolerance, double scale, const std::string& where) {
  const auto e = double_of(expected), g = double_of(got);
  if (e && g) {
    const double bound = tolerance * std::max(scale, std::abs(*e));
    if (*e == *g || (std::isnan(*e) && std::isnan(*g)) || std::abs(*e - *g) <= bound) return;
    throw Failure(where + ": " + expected.dump() + " is expected, and " + json(*g).dump() + " came");
  }
  if (expected.is_structured() && got.is_structured() && expected.is_array() == got.is_array()) {
    if (expected.size() != got.size())
      throw Failure(where + ": " + expected.dump() + " is expected, and " + got.dump() + " came");
    const double inner = expected.is_array() ? scale_of(expected) : 1;
    if (expected.is_array()) {
      for (size_t i = 0; i < got.size(); ++i)
        compare(expected[i], got[i], tolerance, inner, where + '.' + std::to_string(i));
    } else {
      for (const auto& [key, value] : got.items())
        compare(expected.value(key, json()), value, tolerance, inner, where + '.' + key);
    }
    return;
  }
  if (expected != got) throw Failure(where + ": " + expected.dump() + " is expected, and " + got.dump() + " came");
}

/* Outputs that have a name are not in the scenario. */
void compare_call(const json& entry, const json& got) {
  if (entry.value("status", json()) != got.value("status", json())) throw Failure("not as expected: " + got.dump());
  for (const char* key : {"message", "log"}) compare(entry.value(key, json()), got.value(key, json()), 0, 1, key);
  const json expected = entry.value("gives", json::object());
  json values = got.value("gives", json::object());
  for (const auto& [name, value] : expected.items())
    if (value.is_string() && value.get_ref<const std::string&>().rfind('$', 0) == 0) values[name] = value;
  compare(expected, values, entry.value("tolerance", kTolerance), 1, "gives");
}

json replay_call(Scenario& scenario, const json& entry) {
  const std::string name = entry.at("call").get<std::string>();
  const auto function = functions().find(name);
  if (function == functions().end()) throw Failure("there is no function of this name");
  Call call(scenario, entry);
  function->second(call);
  call.end();
  json got = {{"call", name}};
  if (call.status != CAIRN_OK) got["status"] = status_text(call.status), got["message"] = call.error.message;
  if (!call.gives.empty()) got["gives"] = call.gives;
  const std::vector<std::string> lines = scenario.take_lines();
  if (!lines.empty()) got["log"] = lines;
  return got;
}

/* Replays one file. Returns the number of calls that did not do what the file says. */
int replay(const fs::path& path, const fs::path& output, bool record) {
  const json file = json::parse(std::ifstream(path));
  Scenario scenario;
  json calls = json::array();
  int failures = 0;
  const json& entries = file.at("calls");
  for (size_t i = 0; i < entries.size(); ++i) {
    try {
      calls.push_back(replay_call(scenario, entries[i]));
      if (!record) compare_call(entries[i], calls.back());
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s, call %zu, %s: %s\n", path.filename().c_str(), i, entries[i]["call"].dump().c_str(),
                   e.what());
      ++failures;
      if (calls.size() == i) break;  // the call has no outputs, and later calls may need them
    }
  }
  try {
    scenario.end();
  } catch (const Failure& e) {
    std::fprintf(stderr, "%s: %s\n", path.filename().c_str(), e.what());
    ++failures;
  }
  std::ofstream to(output / path.filename());
  to << json{{"name", file.at("name")}, {"calls", calls}}.dump(1) << '\n';
  if (!to.flush()) throw Failure("cannot write to " + output.string());
  return failures;
}

int run(const fs::path& folder, const fs::path& output, bool record) {
  fs::create_directories(output);
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") paths.push_back(entry.path());
  if (paths.empty()) throw Failure(folder.string() + " has no scenarios");
  std::sort(paths.begin(), paths.end());
  int failures = 0;
  for (const fs::path& path : paths) failures += replay(path, output, record);
  std::printf("%zu scenarios, %d failures, %s (%s)\n", paths.size(), failures, cairn_version(), cairn_build());
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace conformance

int main(int argc, char** argv) {
  const bool record = argc == 4 && std::string(argv[1]) == "--record";
  if (argc != 3 && !record) {
    std::fprintf(stderr, "usage: cairn_conformance [--record] FOLDER OUTPUT\n");
    return 2;
  }
  try {
    return conformance::run(argv[argc - 2], argv[argc - 1], record);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "cairn_conformance: %s\n", e.what());
    return 2;
  }
}
