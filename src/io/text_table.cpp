// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_table.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "io/log.hpp"

namespace cairn::io {
namespace {

// What a file of another kind contains must not reach the terminal as it is.
std::string quoted(std::string_view field) {
  std::string out = "'";
  for (const char c : field.substr(0, 20)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (field.size() > 20 ? "...'" : "'");
}

// The whole field, or nothing of it.
template <class Number>
bool parse(std::string_view field, Number& value) {
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc() && end == field.data() + field.size();
}

}  // namespace

TextTable::TextTable(std::string path, std::vector<const char*> columns)
    : path_(std::move(path)), columns_(std::move(columns)) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path_.c_str(), "rb"), &std::fclose);
  if (!file) throw LogError(path_ + ": " + std::strerror(errno));
  char buffer[1 << 16];
  for (std::size_t count; (count = std::fread(buffer, 1, sizeof buffer, file.get())) > 0;) text_.append(buffer, count);
  if (std::ferror(file.get())) throw LogError(path_ + ": " + std::strerror(errno));
}

bool TextTable::next() {
  while (begin_ < text_.size()) {
    ++line_;
    const std::size_t end = text_.find('\n', begin_);
    if (end == std::string::npos) fail("the file is cut short: its last line has no end");
    split(std::string_view(text_).substr(begin_, end - begin_));
    begin_ = end + 1;
    if (fields_.empty() || fields_[0][0] == '#') continue;
    if (fields_.size() == columns_.size()) return true;
    std::string names;
    for (const char* name : columns_) names += (names.empty() ? "" : ", ") + std::string(name);
    fail("the line has " + std::to_string(fields_.size()) + " fields, expected " + std::to_string(columns_.size()) +
         ": " + names);
  }
  return false;
}

void TextTable::split(std::string_view line) {
  fields_.clear();
  constexpr std::string_view kBlanks = " \t\r";
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    fields_.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
}

double TextTable::number(std::size_t column) const {
  std::string_view field = fields_[column];
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);  // from_chars takes no plus
  double value = 0;
  if (!parse(field, value) || !std::isfinite(value)) refuse(column, "is not a finite number");
  return value;
}

double TextTable::positive(std::size_t column) const {
  const double value = number(column);
  if (!(value > 0)) refuse(column, "is not positive");
  return value;
}

std::uint64_t TextTable::whole(std::size_t column) const {
  std::uint64_t value = 0;
  if (!parse(fields_[column], value)) refuse(column, "is not a whole number of 0 or more");
  return value;
}

std::uint64_t TextTable::identity(std::size_t column) const {
  const std::uint64_t id = whole(column);
  if (id == CAIRN_ID_NONE) refuse(column, "is reserved");
  return id;
}

double TextTable::time() {
  const double value = number(0);
  if (value < last_time_) refuse(0, "is earlier than that of the line before");
  return last_time_ = value;
}

void TextTable::refuse(std::size_t column, const char* why) const {
  fail(std::string(columns_[column]) + " " + quoted(fields_[column]) + " " + why);
}

void TextTable::fail(const std::string& cause) const {
  throw LogError(path_ + ":" + std::to_string(std::max<std::size_t>(line_, 1)) + ": " + cause);
}

}  // namespace cairn::io
