// SPDX-License-Identifier: BSD-3-Clause
// One run from its drive to its figures and files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "program/drive.hpp"
#include "program/figures.hpp"
#include "program/filter_choices.hpp"

namespace cairn::program {

struct Session {
  std::string output;         // folder; empty: none
  double seconds_before = 0;  // that the run had taken before
  std::function<void()> on_step;
};

// Throws LibraryError, UsageError.
std::vector<Figure> run_drive(Drive& drive, const FilterChoices& choices, const Session& session);

}  // namespace cairn::program
