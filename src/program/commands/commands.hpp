// SPDX-License-Identifier: BSD-3-Clause
// The commands of the program. `arguments` are the words after the command.
#pragma once

#include <string>
#include <vector>

namespace cairn::program {

// Throw UsageError.
void write_stdout(const std::string& text);
void write_notes(const std::vector<std::string>& notes);  // to standard error
void write_help();
void write_manual_options();  // the parts of docs/cairn.1 that come from the option tables

// Throw UsageError, logs::LogError, LibraryError.
void run_command(const std::vector<std::string>& arguments);
void simulate_command(const std::vector<std::string>& arguments);
void run_team_command(const std::vector<std::string>& arguments);       // of a MRCLAM folder
void simulate_team_command(const std::vector<std::string>& arguments);  // of boats

}  // namespace cairn::program
