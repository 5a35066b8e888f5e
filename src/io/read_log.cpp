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

constexpr std::size_t kMatHeaderBytes = 128;

std::string read_file(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) throw LogError(path + ": " + std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw LogError(path + ": a folder; this version reads files only");
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

// The header of MATLAB's binary files: 116 bytes of text, 8 of offset, a version and the writer's byte order.
bool has_mat_header(const std::string& content) {
  if (content.compare(0, 7, "MATLAB ") != 0) return false;
  if (content.size() < kMatHeaderBytes) return true;  // one cut short: the reader says so
  const std::string order = content.substr(126, 2);
  return order == "IM" || order == "MI";
}

}  // namespace

Log read_log(const std::string& path, const NoiseOverride& noise) {
  const std::string content = read_file(path);
  if (content.empty()) throw LogError(path + ":1: the file is empty");
  if (has_mat_header(content)) return read_stars_log(path, content, noise);
  return read_neutral_log(path, content);
}

}  // namespace cairn::io
