// SPDX-License-Identifier: BSD-3-Clause
// Opens a log and tells its kind by its content, never by its name.
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "io/log.hpp"

namespace cairn::io {
namespace {

std::string read_file(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) throw LogError(path + ": " + std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw LogError(path + ": a folder, and no MRCLAM one: it holds no Barcodes.dat");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw LogError(path + ": " + std::strerror(errno));
  std::string content;
  char buffer[1 << 16];
  for (std::size_t count; (count = std::fread(buffer, 1, sizeof buffer, file.get())) > 0;) {
    content.append(buffer, count);
  }
  if (std::ferror(file.get())) throw LogError(path + ": " + std::strerror(errno));
  return content;
}

// MATLAB's binary files begin with a text that says so; whether the rest of the header is whole, the reader finds out.
bool is_mat_file(const std::string& content) {
  return content.compare(0, 7, "MATLAB ") == 0;
}

}  // namespace

Log read_log(const std::string& path, const NoiseOverride& noise) {
  const std::string content = read_file(path);
  if (content.empty()) throw LogError(path + ":1: the file is empty");
  if (is_mat_file(content)) return read_stars_log(path, content, noise);
  return read_neutral_log(path, content);
}

}  // namespace cairn::io
