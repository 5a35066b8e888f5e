// SPDX-License-Identifier: BSD-3-Clause
// A text file whose records all have the same fields. All errors are LogError and name file and line.
#pragma once

#include <limits>

#include "program/logs/text_file.hpp"

namespace cairn::program::logs {

class TextTable {
 public:
  // Reads the whole file. `columns` name the fields of a record.
  TextTable(const std::string& path, std::vector<const char*> columns)
      : lines_(path, read_file(path)), columns_(std::move(columns)) {}

  // Goes to the next record; false if there is none.
  bool next();

  // Fields of this record.
  double number(std::size_t column) const { return lines_.number(column, columns_[column]); }  // finite
  double positive(std::size_t column) const;
  std::uint64_t whole(std::size_t column) const { return lines_.whole(column, columns_[column]); }
  std::uint64_t identity(std::size_t column) const { return lines_.identity(column, columns_[column]); }
  // The first field. Lines that are earlier than the line before them are counted.
  double time();
  std::size_t late_lines() const { return late_lines_; }

  void note_missing_end(std::vector<std::string>& notes) const { lines_.note_missing_end(notes); }
  // Throws a LogError that names the line that was read last.
  [[noreturn]] void fail(const std::string& cause) const { lines_.fail(cause); }

 private:
  TextLines lines_;
  std::vector<const char*> columns_;
  std::size_t late_lines_ = 0;
  double last_time_ = -std::numeric_limits<double>::infinity();
};

}  // namespace cairn::program::logs
