// SPDX-License-Identifier: BSD-3-Clause
// Opens a log. Its content decides its kind, never its name.
#include <filesystem>
#include <system_error>

#include "program/logs/log.hpp"
#include "program/logs/text_file.hpp"

namespace cairn::program::logs {
namespace {

// MATLAB's binary files begin with a text that says so. The reader checks the rest of the header.
bool is_mat_file(const std::string& content) {
  return content.compare(0, 7, "MATLAB ") == 0;
}

// The first record of iSAM's text form is of a planar graph. A TORO file has the same records and others; the reader
// says so.
bool is_isam_log(const std::string& path, const std::string& content) {
  TextLines lines(path, content);
  if (!lines.next()) return false;
  const std::string_view name = lines.field(0);
  return name == "EDGE2" || name == "LANDMARK" || name == "VERTEX2";
}

}  // namespace

Log read_log(const std::string& path, const NoiseOverride& noise) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw LogError(path + ": a folder, and no MRCLAM one: it holds no Barcodes.dat");
  const std::string content = read_file(path);
  if (content.empty()) throw LogError(path + ":1: the file is empty");
  if (is_mat_file(content)) return read_stars_log(path, content, noise);
  if (is_isam_log(path, content)) return read_isam_log(path, content);
  return read_neutral_log(path, content);
}

}  // namespace cairn::program::logs
