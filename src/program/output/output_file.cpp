// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/output_file.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "program/usage_error.hpp"

namespace cairn::program {

void create_folder(const std::string& folder) {
  if (mkdir(folder.c_str(), 0777) == 0) return;
  const int cause = errno;
  struct stat status {};
  if (cause == EEXIST && stat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) return;
  throw UsageError("cannot create the folder " + folder + ": " + std::strerror(cause));
}

OutputFile::OutputFile(const std::string& folder, const std::string& name, char separator)
    : path_(folder + "/" + name), separator_(separator), file_(std::fopen(path_.c_str(), "w"), &std::fclose) {
  if (!file_) fail();
}

void OutputFile::fail() const {
  throw UsageError("cannot write " + path_ + ": " + std::strerror(errno));
}

void OutputFile::text(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail();
}

void OutputFile::field(const std::string& value) {
  text(row_begun_ ? separator_ + value : value);
  row_begun_ = true;
}

// The fewest digits that read back as the same number.
void OutputFile::field(double value) {
  char buffer[32];
  const char* end = std::isnan(value) ? buffer : std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  field(std::string(static_cast<const char*>(buffer), end));
}

void OutputFile::fields(const double* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) field(values[i]);
}

void OutputFile::empty(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) field("");
}

void OutputFile::end() {
  text("\n");
  row_begun_ = false;
}

void OutputFile::close() {
  if (std::fclose(file_.release()) != 0) fail();
}

}  // namespace cairn::program
