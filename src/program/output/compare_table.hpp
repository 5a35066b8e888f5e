// SPDX-License-Identifier: BSD-3-Clause
// Table 2 of the Mars paper, with the measured figures beside the printed ones.
#pragma once

#include <string>
#include <vector>

#include "program/output/figures.hpp"

namespace cairn::program {

std::string compare_table(const std::vector<Figure>& standard, const std::vector<Figure>& submaps);

}  // namespace cairn::program
