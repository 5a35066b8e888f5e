// SPDX-License-Identifier: BSD-3-Clause
// Numeric arrays out of a MATLAB v5 file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

struct _mat_t;

namespace cairn::program::logs {

// A real array of numbers, column by column as the file has it.
struct MatArray {
  std::vector<std::size_t> dimensions;  // two or more
  std::vector<double> values;

  std::size_t rows() const { return dimensions[0]; }
  // Columns of what is left when the first dimension is taken off.
  std::size_t columns() const { return rows() == 0 ? 0 : values.size() / rows(); }
  const double* column(std::size_t index) const { return values.data() + index * rows(); }
};

class MatFile {
 public:
  // `content` is the whole file, to see that its pieces fit before libmatio reads it. Throws LogError.
  MatFile(const std::string& path, const std::string& content);
  ~MatFile();
  MatFile(const MatFile&) = delete;
  MatFile& operator=(const MatFile&) = delete;

  // Nothing where the file has no such variable. Throws LogError where it is no real array of numbers.
  std::optional<MatArray> find(const char* name) const;
  // The same, for one that has to be there.
  MatArray require(const char* name) const;
  // With its first dimension `rows`.
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
