// SPDX-License-Identifier: BSD-3-Clause
// The commands of the program. `arguments` are what follows the command's word.
#pragma once

#include <string>
#include <vector>

namespace cairn::program {

extern const char* const kHelp;

void write_stdout(const std::string& text);  // throws UsageError

// Throw UsageError, logs::LogError, LibraryError.
void run_command(const std::vector<std::string>& arguments);
void simulate_command(const std::vector<std::string>& arguments);
void run_team_command(const std::vector<std::string>& arguments);       // of a MRCLAM folder
void simulate_team_command(const std::vector<std::string>& arguments);  // of boats

}  // namespace cairn::program
