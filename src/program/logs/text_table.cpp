// SPDX-License-Identifier: BSD-3-Clause
#include "program/logs/text_table.hpp"

namespace cairn::program::logs {

bool TextTable::next() {
  if (!lines_.next()) return false;
  if (lines_.size() == columns_.size()) return true;
  std::string names;
  for (const char* name : columns_) names += (names.empty() ? "" : ", ") + std::string(name);
  fail("the line has " + std::to_string(lines_.size()) + " fields, expected " + std::to_string(columns_.size()) + ": " +
       names);
}

double TextTable::positive(std::size_t column) const {
  const double value = number(column);
  if (!(value > 0)) lines_.refuse(column, columns_[column], "is not positive");
  return value;
}

double TextTable::time() {
  const double value = number(0);
  late_lines_ += value < last_time_;
  return last_time_ = value;
}

}  // namespace cairn::program::logs
