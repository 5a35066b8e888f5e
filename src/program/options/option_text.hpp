// SPDX-License-Identifier: BSD-3-Clause
// Prints a group of options.
#pragma once

#include <string>

#include "program/options/option.hpp"

namespace cairn::program {

std::string help_text(const OptionGroup& group);    // for a terminal
std::string manual_text(const OptionGroup& group);  // for docs/cairn.1, in the language of man(7)

}  // namespace cairn::program
