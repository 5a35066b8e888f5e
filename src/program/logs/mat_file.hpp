// SPDX-License-Identifier: BSD-3-Clause
// Reads numeric arrays from a MATLAB v5 file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

struct _mat_t;

namespace cairn::program::logs {

// A real array of numbers, column by column.
struct MatArray {
  std::vector<std::size_t> dimensions;  // two or more
  std::vector<double> values;

  std::size_t rows() const { return dimensions[0]; }
  // The product of all dimensions but the first.
  std::size_t columns() const { return rows() == 0 ? 0 : values.size() / rows(); }
  const double* column(std::size_t index) const { return values.data() + index * rows(); }
};

class MatFile {
 public:
  // `content` is the whole file; its structure is checked before libmatio reads it. Throws LogError.
  MatFile(const std::string& path, const std::string& content);
  ~MatFile();
  MatFile(const MatFile&) = delete;
  MatFile& operator=(const MatFile&) = delete;

  // Empty if the file has no such variable. Throws LogError if it is not a real array of numbers.
  std::optional<MatArray> find(const char* name) const;
  // The same for a variable that must exist.
  MatArray require(const char* name) const;
  // The same for a variable that must exist and have `rows` rows.
  MatArray require(const char* name, std::size_t rows) const;
  std::optional<MatArray> find(const char* name, std::size_t rows) const;
  double require_scalar(const char* name) const;

  [[noreturn]] void fail(const char* variable, const std::string& cause) const;

 private:
  std::size_t checked_size(const char* name, const std::vector<std::size_t>& dimensions, bool compressed) const;
  void expect_rows(const char* name, const MatArray& array, std::size_t rows) const;

  std::string path_;
  std::size_t content_size_;
  _mat_t* file_ = nullptr;
};

}  // namespace cairn::program::logs
