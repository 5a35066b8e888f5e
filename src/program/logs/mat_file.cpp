// SPDX-License-Identifier: BSD-3-Clause
#include "program/logs/mat_file.hpp"

#include <matio.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "program/logs/log.hpp"

namespace cairn::program::logs {
namespace {

constexpr std::size_t kHeaderBytes = 128;
constexpr std::size_t kMostDeflated = 1032;  // deflate shrinks by no larger factor
constexpr std::uint32_t kMatrixElement = 14;
constexpr std::uint32_t kCompressedElement = 15;

std::uint32_t read_word(const std::string& content, std::size_t offset, bool little_endian) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto byte = static_cast<unsigned char>(content[offset + (little_endian ? 3 - i : i)]);
    word = word << 8 | byte;
  }
  return word;
}

// The file is a chain of elements, each with its type and size in front. Walk it to the end, because libmatio reads a
// truncated file up to its end without an error.
void check_chain(const std::string& path, const std::string& content) {
  if (content.size() < kHeaderBytes) throw LogError(path + ": the MATLAB file is cut short within its header");
  const std::string order = content.substr(126, 2);  // how the writer's machine stores the letters MI
  const bool little_endian = order == "IM";
  if (!little_endian && order != "MI") throw LogError(path + ": a MATLAB header, but no byte order at its end");
  const std::uint32_t version = read_word(content, 124, little_endian) >> (little_endian ? 0 : 16) & 0xffff;
  if (version != 0x0100) throw LogError(path + ": not MATLAB version 5 (save it with the option -v7)");
  for (std::size_t offset = kHeaderBytes; offset < content.size();) {
    const std::string place = " at byte " + std::to_string(offset);
    if (content.size() - offset < 8) throw LogError(path + ": the MATLAB file is cut short" + place);
    const std::uint32_t type = read_word(content, offset, little_endian);
    const std::uint32_t size = read_word(content, offset + 4, little_endian);
    if (type != kMatrixElement && type != kCompressedElement) {
      throw LogError(path + ": the MATLAB file holds no variable" + place);
    }
    if (content.size() - offset - 8 < size) {
      throw LogError(path + ": the MATLAB file is cut short: the variable" + place + " takes " + std::to_string(size) +
                     " bytes, " + std::to_string(content.size() - offset - 8) + " are left");
    }
    offset += 8 + std::size_t{size};
  }
}

void drop_message(int, char*) {}  // libmatio would print it; the reader makes its own message

template <typename Number>
bool copy_values(const matvar_t& variable, std::vector<double>& values) {
  if (variable.nbytes != values.size() * sizeof(Number)) return false;
  const auto* data = static_cast<const Number*>(variable.data);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(data[i]);
  return true;
}

bool copy_numbers(const matvar_t& variable, std::vector<double>& values) {
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return copy_values<double>(variable, values);
    case MAT_C_SINGLE:
      return copy_values<float>(variable, values);
    case MAT_C_INT8:
      return copy_values<std::int8_t>(variable, values);
    case MAT_C_UINT8:
      return copy_values<std::uint8_t>(variable, values);
    case MAT_C_INT16:
      return copy_values<std::int16_t>(variable, values);
    case MAT_C_UINT16:
      return copy_values<std::uint16_t>(variable, values);
    case MAT_C_INT32:
      return copy_values<std::int32_t>(variable, values);
    case MAT_C_UINT32:
      return copy_values<std::uint32_t>(variable, values);
    case MAT_C_INT64:
      return copy_values<std::int64_t>(variable, values);
    case MAT_C_UINT64:
      return copy_values<std::uint64_t>(variable, values);
    default:
      return false;
  }
}

}  // namespace

MatFile::MatFile(const std::string& path, const std::string& content) : path_(path), content_size_(content.size()) {
  check_chain(path, content);
  Mat_LogInitFunc("cairn", &drop_message);
  file_ = Mat_Open(path.c_str(), MAT_ACC_RDONLY);
  if (file_ == nullptr) throw LogError(path + ": libmatio cannot open the MATLAB file");
}

MatFile::~MatFile() {
  Mat_Close(file_);
}

void MatFile::fail(const char* variable, const std::string& cause) const {
  throw LogError(path_ + ": variable " + variable + ": " + cause);
}

std::optional<MatArray> MatFile::find(const char* name) const {
  const std::unique_ptr<matvar_t, void (*)(matvar_t*)> info(Mat_VarReadInfo(file_, name), &Mat_VarFree);
  if (!info) return std::nullopt;
  if (info->isComplex != 0 || info->rank < 2) fail(name, "not a real array of numbers");
  MatArray array;
  array.dimensions.assign(info->dims, info->dims + info->rank);
  const std::size_t size = checked_size(name, array.dimensions, info->compression != MAT_COMPRESSION_NONE);
  const std::unique_ptr<matvar_t, void (*)(matvar_t*)> variable(Mat_VarRead(file_, name), &Mat_VarFree);
  if (!variable) fail(name, "its data cannot be read");
  array.values.resize(size);
  if (size > 0 && (variable->data == nullptr || !copy_numbers(*variable, array.values))) {
    fail(name, "not a full array of real numbers");
  }
  return array;
}

// libmatio allocates by the dimensions before it looks for the data. Refuse a forged size before that.
std::size_t MatFile::checked_size(const char* name, const std::vector<std::size_t>& dimensions, bool compressed) const {
  const std::size_t most = compressed ? content_size_ * kMostDeflated : content_size_;
  std::size_t size = 1;
  for (const std::size_t dimension : dimensions) {
    if (dimension != 0 && size > most / dimension) fail(name, "its size is more than the file can hold");
    size *= dimension;
  }
  return size;
}

MatArray MatFile::require(const char* name) const {
  std::optional<MatArray> array = find(name);
  if (!array) fail(name, "missing; this MATLAB file is no STARS log, or not a whole one");
  return *std::move(array);
}

MatArray MatFile::require(const char* name, std::size_t rows) const {
  MatArray array = require(name);
  expect_rows(name, array, rows);
  return array;
}

std::optional<MatArray> MatFile::find(const char* name, std::size_t rows) const {
  std::optional<MatArray> array = find(name);
  if (array) expect_rows(name, *array, rows);
  return array;
}

void MatFile::expect_rows(const char* name, const MatArray& array, std::size_t rows) const {
  if (array.rows() != rows) {
    fail(name, "has " + std::to_string(array.rows()) + " rows, expected " + std::to_string(rows));
  }
}

double MatFile::require_scalar(const char* name) const {
  const MatArray array = require(name);
  if (array.values.size() != 1) fail(name, "has " + std::to_string(array.values.size()) + " values, expected 1");
  if (!std::isfinite(array.values[0])) fail(name, "not finite");
  return array.values[0];
}

}  // namespace cairn::program::logs
