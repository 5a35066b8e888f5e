// SPDX-License-Identifier: BSD-3-Clause
// Reads a command line by groups of options.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "program/options/option.hpp"

namespace cairn::program {

// Sets the options in `arguments`; words that are no options go to `positional`. The option `first` (or NULL) is set
// before all others, at any position. A message about an unknown option names `command`. Throws UsageError.
void parse(const std::vector<std::string>& arguments, const std::vector<OptionGroup>& groups,
           const std::string& command, const std::function<void(const std::string&)>& positional,
           const char* first = nullptr);

// The words among `arguments` that are neither options nor values of options. An unknown option counts as one that
// takes a value.
std::vector<std::string> words_of(const std::vector<std::string>& arguments, const std::vector<OptionGroup>& groups);

}  // namespace cairn::program
