// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/figures.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

namespace cairn::program {
namespace {

std::string format(const Figure& figure) {
  if (!figure.word.empty()) return "\"" + figure.word + "\"";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, figure.whole ? "%.0f" : "%.9g", figure.value);
  return buffer;
}

}  // namespace

double value_of(const std::vector<Figure>& figures, const std::string& key) {
  for (const Figure& figure : figures) {
    if (figure.key == key) return figure.value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<Figure> means(const std::vector<std::vector<Figure>>& runs) {
  std::vector<Figure> all;
  const auto count = static_cast<double>(runs.size());
  for (const Figure& first : runs.front()) {
    if (!first.word.empty()) continue;
    double sum = 0, square = 0;
    for (const std::vector<Figure>& run : runs) sum += value_of(run, first.key);
    const double mean = sum / count;
    if (!std::isfinite(mean)) continue;
    for (const std::vector<Figure>& run : runs) square += std::pow(value_of(run, first.key) - mean, 2);
    all.push_back({first.key, mean, false});
    all.push_back({first.key + "_std", runs.size() > 1 ? std::sqrt(square / (count - 1)) : 0, false});
  }
  return all;
}

std::string json(const std::vector<Figure>& figures) {
  std::string out = "{";
  for (const Figure& figure : figures) {
    if (out.size() > 1) out += ", ";
    out += "\"" + figure.key + "\": " + format(figure);
  }
  return out + "}";
}

std::string text(const std::vector<Figure>& figures) {
  std::string out;
  char buffer[128];
  for (const Figure& figure : figures) {
    if (!figure.word.empty()) {
      std::snprintf(buffer, sizeof buffer, "%-24s %12s\n", figure.key.c_str(), figure.word.c_str());
      out += buffer;
      continue;
    }
    std::snprintf(buffer, sizeof buffer, figure.whole ? "%-24s %12.0f\n" : "%-24s %12.6g\n", figure.key.c_str(),
                  figure.value);
    out += buffer;
  }
  return out;
}

}  // namespace cairn::program
