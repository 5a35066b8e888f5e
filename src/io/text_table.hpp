// SPDX-License-Identifier: BSD-3-Clause
// A text file of records, one a line: as many fields in each, separated by blanks. Empty lines and lines that begin
// with # are passed over. All errors are LogError and name file and line.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace cairn::io {

class TextTable {
 public:
  // Reads the whole file. `columns` name the fields of a record.
  TextTable(std::string path, std::vector<const char*> columns);

  // To the next record; false where there is none.
  bool next();

  // Fields of this record.
  double number(std::size_t column) const;  // finite
  double positive(std::size_t column) const;
  std::uint64_t whole(std::size_t column) const;
  std::uint64_t identity(std::size_t column) const;  // whole, and not CAIRN_ID_NONE
  // The first one, which may not be less than that of the record before.
  double time();

  // Throws, of the line that was read last.
  [[noreturn]] void fail(const std::string& cause) const;

 private:
  void split(std::string_view line);
  [[noreturn]] void refuse(std::size_t column, const char* why) const;

  std::string path_, text_;
  std::vector<const char*> columns_;
  std::vector<std::string_view> fields_;
  std::size_t begin_ = 0, line_ = 0;
  double last_time_ = -std::numeric_limits<double>::infinity();
};

}  // namespace cairn::io
