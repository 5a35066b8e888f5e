// SPDX-License-Identifier: BSD-3-Clause
// A file of separated values that is being written, and its folder.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace cairn::program {

// A file that is being written. Every failure is a UsageError that names the file.
class OutputFile {
 public:
  OutputFile(const std::string& folder, const std::string& name, char separator = ',');

  void text(const std::string& text);
  // The fields of a row, from the left; `end` ends it.
  void field(const std::string& value);
  void field(const char* value) { field(std::string(value)); }
  void field(std::uint64_t value) { field(std::to_string(value)); }
  void field(double value);  // empty if it is NaN
  void fields(const double* values, std::size_t count);
  void empty(std::size_t count);
  void end();
  void close();

 private:
  [[noreturn]] void fail() const;

  std::string path_;
  char separator_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  bool row_begun_ = false;
};

// Creates a folder if it does not exist. Throws UsageError.
void create_folder(const std::string& folder);

}  // namespace cairn::program
