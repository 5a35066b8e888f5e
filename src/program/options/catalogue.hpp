// SPDX-License-Identifier: BSD-3-Clause
// All options of the program. They are needed for its texts, and to distinguish words from values before the command is
// known.
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
  RunOptions run_;  // the options write these values, which are never read
  SimulateOptions mars_;
  UsvOptions boats_;
  MrclamOptions robots_;
  std::vector<OptionGroup> groups_;
};

// `arguments` are the words after the command.
bool asks_for_usv(const std::vector<std::string>& arguments);
// The MRCLAM folder among the arguments of `run`; empty if there is none.
std::string mrclam_folder(const std::vector<std::string>& arguments);

}  // namespace cairn::program
