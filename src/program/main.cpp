// SPDX-License-Identifier: BSD-3-Clause
// The program: runs recorded logs and simulated worlds through the library, and prints how accurate it was.
#include <cairn/cairn.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "program/commands/commands.hpp"
#include "program/logs/log.hpp"
#include "program/usage_error.hpp"

namespace {

using namespace cairn;

constexpr int kSuccess = 0;
constexpr int kFailure = 1;  // the library refused a call
constexpr int kUsage = 2;    // a bad command line, or a bad file

int dispatch(const std::vector<std::string>& arguments) {
  if (arguments.empty()) throw program::UsageError("no command given (usage: cairn run LOG [options])");
  const std::string& command = arguments[0];
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (command == "--help" || command == "-h") {
    program::write_help();
  } else if (command == "--manual-options") {
    program::write_manual_options();
  } else if (command == "--version") {
    program::write_stdout("cairn " + std::string(cairn_version()) + " (" + cairn_build() + ")\n");
  } else if (command == "run") {
    program::run_command(rest);
  } else if (command == "simulate") {
    program::simulate_command(rest);
  } else {
    const char* kind = command[0] == '-' ? "option" : "command";
    throw program::UsageError("unknown " + std::string(kind) + " '" + command + "' (see cairn --help)");
  }
  return kSuccess;
}

int fail(const char* message, int status) {
  std::fprintf(stderr, "cairn: %s\n", message);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return dispatch({argv + 1, argv + argc});
  } catch (const program::UsageError& error) {
    return fail(error.what(), kUsage);
  } catch (const program::logs::LogError& error) {
    return fail(error.what(), kUsage);
  } catch (const std::exception& error) {
    return fail(error.what(), kFailure);
  }
}
