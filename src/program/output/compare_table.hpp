// SPDX-License-Identifier: BSD-3-Clause
// The Mars paper's Table 2, with what was measured beside what is printed there.
#pragma once

#include <string>
#include <vector>

#include "program/output/figures.hpp"

namespace cairn::program {

std::string compare_table(const std::vector<Figure>& standard, const std::vector<Figure>& submaps);

}  // namespace cairn::program
