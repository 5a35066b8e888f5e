// SPDX-License-Identifier: BSD-3-Clause
// Text files of records, one a line, their fields separated by blanks. Lines end with LF or CR LF; the last one may
// have no end. A byte order mark of UTF-8 is skipped. All errors are LogError and name file and line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cairn::program::logs {

std::string read_file(const std::string& path);

class TextLines {
 public:
  TextLines(std::string path, std::string text);

  // Goes to the next record; false if there is none. Skips empty lines. A field that begins with # begins a comment.
  bool next();

  // Adds a note if the last line has no end: only its reader can know whether the file is whole.
  void note_missing_end(std::vector<std::string>& notes) const;

  // --- of this record ---
  std::size_t size() const { return fields_.size(); }
  std::string_view field(std::size_t index) const { return fields_[index]; }
  // `name` is for the message.
  double number(std::size_t index, const char* name) const;  // finite
  std::uint64_t whole(std::size_t index, const char* name) const;
  std::uint64_t identity(std::size_t index, const char* name) const;  // whole, and not CAIRN_ID_NONE

  // Throw a LogError that names the line that was read last.
  [[noreturn]] void fail(const std::string& cause) const;
  [[noreturn]] void refuse(std::size_t index, const char* name, const char* why) const;

  // For messages: a file of another kind may contain bytes that must not reach a terminal.
  static std::string quoted(std::string_view field);

 private:
  std::string path_, text_;
  std::vector<std::string_view> fields_;
  std::size_t begin_ = 0, line_ = 0;
};

}  // namespace cairn::program::logs
