// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/catalogue.hpp"

#include "program/logs/mrclam_log.hpp"
#include "program/options/parse.hpp"

namespace cairn::program {

Catalogue::Catalogue() : mars_(default_simulate_options()), boats_(default_usv_options()) {
  groups_ = {common_options(run_.common), filter_options(run_.filter), log_options(run_)};
  for (OptionGroup& group : world_options(mars_)) groups_.push_back(group);
  groups_.push_back(team_options(boats_.team));
  groups_.push_back(boat_options(boats_));
  groups_.push_back(robot_options(robots_));
}

bool asks_for_usv(const std::vector<std::string>& arguments) {
  const std::vector<std::string> words = words_of(arguments, Catalogue().groups());
  return !words.empty() && words[0] == "usv";
}

std::string mrclam_folder(const std::vector<std::string>& arguments) {
  for (const std::string& word : words_of(arguments, Catalogue().groups()))
    if (logs::is_mrclam(word)) return word;
  return "";
}

}  // namespace cairn::program
