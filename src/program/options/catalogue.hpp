// SPDX-License-Identifier: BSD-3-Clause
// All options of the program, for its texts and to tell words from values before it is known which command is meant.
#pragma once

#include <string>
#include <vector>

#include "program/options/run_options.hpp"
#include "program/options/team_options.hpp"
#include "program/options/world_options.hpp"

namespace cairn::program {

class Catalogue {
 public:
  Catalogue();
  Catalogue(const Catalogue&) = delete;
  Catalogue& operator=(const Catalogue&) = delete;

  const std::vector<OptionGroup>& groups() const { return groups_; }

 private:
  RunOptions run_;  // the options set these, and nobody reads them
  SimulateOptions mars_;
  UsvOptions boats_;
  MrclamOptions robots_;
  std::vector<OptionGroup> groups_;
};

// `arguments` are the words after the command.
bool asks_for_usv(const std::vector<std::string>& arguments);
// The MRCLAM folder among the arguments of `run`; empty where there is none.
std::string mrclam_folder(const std::vector<std::string>& arguments);

}  // namespace cairn::program
