// SPDX-License-Identifier: BSD-3-Clause
// The file systematic.csv: the systematic errors that the filter estimates, after each step.
#pragma once

#include <cairn/systematic.h>

#include <optional>
#include <string>
#include <vector>

#include "program/drives/drive.hpp"
#include "program/output/output_file.hpp"

namespace cairn::program {

class SystematicCsv {
 public:
  // Removes the file of an earlier run: it comes back only if the filter estimates such errors.
  explicit SystematicCsv(const std::string& folder);

  // Throws UsageError and LibraryError.
  void add(const cairn_filter* filter, const DriveStep& step);
  void finish();

 private:
  std::string folder_;
  std::vector<cairn_systematic_error> errors_;
  std::optional<OutputFile> file_;
};

}  // namespace cairn::program
