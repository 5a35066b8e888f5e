// SPDX-License-Identifier: BSD-3-Clause
#include "program/logs/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "program/logs/log.hpp"
#include "program/read_number.hpp"

namespace cairn::program::logs {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

}  // namespace

std::string read_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw LogError(path + ": " + std::strerror(errno));
  std::string content;
  char buffer[1 << 16];
  for (std::size_t count; (count = std::fread(buffer, 1, sizeof buffer, file.get())) > 0;)
    content.append(buffer, count);
  if (std::ferror(file.get())) throw LogError(path + ": " + std::strerror(errno));
  return content;
}

TextLines::TextLines(std::string path, std::string text) : path_(std::move(path)), text_(std::move(text)) {
  const std::string_view start = std::string_view(text_).substr(0, 2);
  if (start == "\xff\xfe" || start == "\xfe\xff") fail("the text is encoded as UTF-16; convert it to UTF-8");
  if (text_.compare(0, kByteOrderMark.size(), kByteOrderMark) == 0) begin_ = kByteOrderMark.size();
}

void TextLines::note_missing_end(std::vector<std::string>& notes) const {
  if (text_.empty() || text_.back() == '\n') return;
  notes.push_back(path_ + ": the last line has no end; it was read as a whole line");
}

bool TextLines::next() {
  constexpr std::string_view kBlanks = " \t\r";
  while (begin_ < text_.size()) {
    ++line_;
    const std::size_t end = std::min(text_.find('\n', begin_), text_.size());
    const std::string_view line = std::string_view(text_).substr(begin_, end - begin_);
    fields_.clear();
    for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos && line[begin] != '#';) {
      const std::size_t stop = std::min(line.find_first_of(kBlanks, begin), line.size());
      fields_.push_back(line.substr(begin, stop - begin));
      begin = line.find_first_not_of(kBlanks, stop);
    }
    begin_ = end + 1;
    if (!fields_.empty()) return true;
  }
  return false;
}

double TextLines::number(std::size_t index, const char* name) const {
  std::string_view field = fields_[index];
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);  // from_chars refuses a plus
  const std::optional<double> value = read_number(field);
  if (!value || !std::isfinite(*value)) refuse(index, name, "is not a finite number");
  return *value;
}

std::uint64_t TextLines::whole(std::size_t index, const char* name) const {
  const std::string_view field = fields_[index];
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size())
    refuse(index, name, "is not a whole number of 0 or more");
  return value;
}

std::uint64_t TextLines::identity(std::size_t index, const char* name) const {
  const std::uint64_t id = whole(index, name);
  if (id == CAIRN_ID_NONE) refuse(index, name, "is reserved");
  return id;
}

void TextLines::refuse(std::size_t index, const char* name, const char* why) const {
  fail(std::string(name) + " " + quoted(fields_[index]) + " " + why);
}

void TextLines::fail(const std::string& cause) const {
  throw LogError(path_ + ":" + std::to_string(std::max<std::size_t>(line_, 1)) + ": " + cause);
}

std::string TextLines::quoted(std::string_view field) {
  std::string out = "'";
  for (const char c : field.substr(0, 20)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (field.size() > 20 ? "...'" : "'");
}

}  // namespace cairn::program::logs
