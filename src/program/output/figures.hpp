// SPDX-License-Identifier: BSD-3-Clause
// Figures of a run, of several runs, and how they are printed.
#pragma once

#include <string>
#include <vector>

namespace cairn::program {

struct Figure {
  std::string key;
  double value;
  bool whole;          // a count
  std::string word{};  // stands for the value, if it is not empty
};

// NaN if no figure has the key.
double value_of(const std::vector<Figure>& figures, const std::string& key);

// Means over runs of the same kind, each followed by its standard deviation over the runs. A figure that some run lacks
// is left out, and so are words.
std::vector<Figure> means(const std::vector<std::vector<Figure>>& runs);

std::string json(const std::vector<Figure>& figures);  // one object, no line end
std::string text(const std::vector<Figure>& figures);  // for people, one a line

}  // namespace cairn::program
