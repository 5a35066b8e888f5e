// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/parse.hpp"

#include <algorithm>
#include <utility>

#include "program/usage_error.hpp"

namespace cairn::program {
namespace {

const Option* find(const std::vector<OptionGroup>& groups, const std::string& name) {
  for (const OptionGroup& group : groups) {
    for (const Option& option : group.options) {
      if (option.is(name)) return &option;
    }
  }
  return nullptr;
}

bool is_word(const std::string& argument) {
  return argument.size() < 2 || argument[0] != '-';
}

}  // namespace

void parse(const std::vector<std::string>& arguments, const std::vector<OptionGroup>& groups,
           const std::string& command, const std::function<void(const std::string&)>& positional, const char* first) {
  std::vector<std::pair<const Option*, std::string>> given;
  bool only_words = false;  // after --
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (!only_words && argument == "--") {
      only_words = true;
      continue;
    }
    if (only_words || is_word(argument)) {
      positional(argument);
      continue;
    }
    const std::size_t equals = argument.find('=');
    const std::string name = argument.substr(0, equals);
    const Option* option = find(groups, name);
    if (option == nullptr) throw UsageError("unknown option '" + name + "' (see cairn " + command + " --help)");
    std::string value;
    if (!option->takes_value()) {
      if (equals != std::string::npos) throw UsageError("option " + name + " takes no value");
    } else if (equals != std::string::npos) {
      value = argument.substr(equals + 1);
    } else {
      if (i + 1 == arguments.size()) throw UsageError("option " + name + " needs a value");
      value = arguments[++i];
    }
    given.emplace_back(option, value);
  }
  if (first != nullptr)
    std::stable_partition(given.begin(), given.end(), [&](const auto& entry) { return entry.first->is(first); });
  for (const auto& [option, value] : given) option->set(value);
}

std::vector<std::string> words_of(const std::vector<std::string>& arguments, const std::vector<OptionGroup>& groups) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (is_word(argument)) {
      words.push_back(argument);
    } else if (argument.find('=') == std::string::npos && argument != "--") {
      const Option* option = find(groups, argument);
      if (option == nullptr || option->takes_value()) ++i;
    }
  }
  return words;
}

}  // namespace cairn::program
