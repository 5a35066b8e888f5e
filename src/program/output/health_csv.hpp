// SPDX-License-Identifier: BSD-3-Clause
// health.csv: the verdict after each step, and what supports it.
#pragma once

#include <string>

#include "program/output/output_file.hpp"
#include "program/runners/runner.hpp"

namespace cairn::program {

class HealthCsv {
 public:
  explicit HealthCsv(const std::string& folder);

  void add(const DriveStep& step, const StepResult& result);
  void close() { file_.close(); }

 private:
  void add_scale(double scale, double sigma);

  OutputFile file_;
  std::uint64_t widenings_ = 0;
};

}  // namespace cairn::program
