// SPDX-License-Identifier: BSD-3-Clause
// One run: from a drive to figures and files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "program/drives/drive.hpp"
#include "program/options/filter_choices.hpp"
#include "program/output/figures.hpp"
#include "program/output/output_place.hpp"

namespace cairn::program {

struct Session {
  OutputPlace output;
  double seconds_before = 0;  // time that the run took before
  std::function<void()> on_step;
};

// Throws LibraryError, UsageError.
std::vector<Figure> run_drive(Drive& drive, const FilterChoices& choices, const Session& session);

}  // namespace cairn::program
