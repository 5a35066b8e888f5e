// SPDX-License-Identifier: BSD-3-Clause
// conformance SCENARIOS OUTPUT API: replays the scenarios by the public interface of C++, and compares with what the C
// replayer wrote to OUTPUT, to the last bit. Fails too if a function of API is in no table.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

#include "replayer.hpp"

namespace conformance {
// The names of all constants, for the reader of tests/conformance.
const std::map<std::string, std::int64_t>& all_constants() {
  return replayer_constants();
}
}  // namespace conformance

namespace replayer {
namespace {

namespace fs = std::filesystem;

json parse(const fs::path& path) {
  std::ifstream from(path);
  if (!from) throw Failure("cannot read " + path.string());
  return json::parse(from);
}

/// Whether C++ has no way to write this wrong call: the map of a filter has no merge() (refused.cpp shows it).
bool refused_by_the_compiler(const Scenario& scenario, const json& entry, const json& expected) {
  return entry.at("call") == "cairn_map_merge" && expected.value("status", "") == "CAIRN_ERROR_STATE" &&
         scenario.handles.count(entry.at("with").at("map").get<std::string>()) == 0;
}

/// What a call does, in the form of the C replayer's output.
json replay(Scenario& scenario, const json& entry, const json& expected) {
  const std::string name = entry.at("call").get<std::string>();
  const auto function = functions().find(name);
  if (function == functions().end()) throw Failure("the table has no " + name);
  Call call(scenario, entry);
  json got = {{"call", name}};
  try {
    function->second(call);
    for (const auto& [input, value] : call.inputs.items())
      if (call.used.count(input) == 0) throw Failure("the function has no input " + input);
    if (!call.gives.empty()) got["gives"] = call.gives;
    const json named = entry.value("gives", json::object());
    for (const auto& [output, value] : named.items())
      if (value.is_string() && value.get_ref<const std::string&>().rfind('$', 0) == 0)
        scenario.names.set_name(value.get<std::string>(), call.gives.at(output));
  } catch (const cairn::Error& error) {
    got["status"] = cairn::constant_name(error.status());
    got["message"] = error.what();
  } catch (const Aborted&) {  // the callback's own exception stands for the error of C
    if (expected.value("status", "") != "CAIRN_ERROR_CALLBACK") throw Failure("a callback aborted");
    got["status"] = expected.at("status");
    got["message"] = expected.at("message");
  }
  if (!scenario.lines.empty()) got["log"] = std::exchange(scenario.lines, {});
  return got;
}

int replay_file(const fs::path& path, const fs::path& output, std::size_t& calls, std::size_t& refused) {
  const json file = parse(path);
  const json expected = parse(output / path.filename());
  std::vector<std::weak_ptr<conformance::Payload>> payloads;
  int failures = 0;
  {
    Scenario scenario;
    for (std::size_t i = 0; i < file.at("calls").size(); ++i, ++calls) {
      const json& entry = file["calls"][i];
      const json& wanted = expected.at("calls").at(i);
      if (refused_by_the_compiler(scenario, entry, wanted)) {
        ++refused;
        continue;
      }
      try {
        const json got = replay(scenario, entry, wanted);
        if (got == wanted) continue;
        throw Failure("C gave " + wanted.dump() + ", C++ gave " + got.dump());
      } catch (const std::exception& error) {
        std::fprintf(stderr, "%s, call %zu, %s: %s\n", path.filename().c_str(), i, entry["call"].dump().c_str(),
                     error.what());
        if (++failures == 3) break;
      }
    }
    payloads = scenario.payloads;
  }
  for (const auto& payload : payloads)
    if (!payload.expired())
      std::fprintf(stderr, "%s: a callback was not released\n", path.filename().c_str()), ++failures;
  return failures;
}

int run(const fs::path& folder, const fs::path& output, const fs::path& api) {
  std::size_t scenarios = 0, calls = 0, refused = 0;
  int failures = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    ++scenarios;
    failures += replay_file(entry.path(), output, calls, refused);
  }
  for (const json& function : parse(api).at("functions")) {
    const std::string name = function.at("name").get<std::string>();
    if (name.find("last_message") != std::string::npos || functions().count(name) != 0) continue;
    std::fprintf(stderr, "the table has no %s\n", name.c_str());
    ++failures;
  }
  if (scenarios == 0) throw Failure(folder.string() + " has no scenarios");
  std::printf("%zu scenarios, %zu calls, %d failures; %zu wrong calls do not compile\n", scenarios, calls, failures,
              refused);
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace replayer

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    return replayer::run(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "conformance: %s\n", error.what());
    return 2;
  }
}
