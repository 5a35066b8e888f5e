// SPDX-License-Identifier: BSD-3-Clause
// The program: runs recorded logs and simulated worlds through the library and says how well it did.
#include <cairn/cairn.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/option_table.hpp"
#include "io/log.hpp"

namespace {

using namespace cairn;

constexpr int kSuccess = 0;
constexpr int kFailure = 1;  // the library refused something on the way
constexpr int kUsage = 2;    // a bad command line, or a bad file

int dispatch(const std::vector<std::string>& arguments) {
  if (arguments.empty()) throw cli::UsageError("no command given (usage: cairn run LOG [options])");
  const std::string& command = arguments[0];
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (command == "--help" || command == "-h") {
    cli::write_stdout(cli::kHelp);
  } else if (command == "--version") {
    cli::write_stdout("cairn " + std::string(cairn_version()) + " (" + cairn_build() + ")\n");
  } else if (command == "run") {
    cli::run_command(rest);
  } else if (command == "simulate") {
    cli::simulate_command(rest);
  } else {
    const char* kind = command[0] == '-' ? "option" : "command";
    throw cli::UsageError("unknown " + std::string(kind) + " '" + command + "' (see cairn --help)");
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
  } catch (const cli::UsageError& error) {
    return fail(error.what(), kUsage);
  } catch (const io::LogError& error) {
    return fail(error.what(), kUsage);
  } catch (const std::exception& error) {
    return fail(error.what(), kFailure);
  }
}
