// SPDX-License-Identifier: BSD-3-Clause
// The folder of --output: the run in files of comma-separated values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "program/output/health_csv.hpp"
#include "program/output/output_file.hpp"
#include "program/output/summary.hpp"
#include "program/runners/runner.hpp"

namespace cairn::program {

class CsvOutput {
 public:
  // Creates the files, and the folder if it does not exist. Throws UsageError.
  CsvOutput(const Drive& drive, const std::string& folder);

  void add(const DriveStep& step, const StepResult& result, const std::optional<PoseScore>& score);
  // Call it after the summary's `finish`.
  void finish(const cairn_filter* filter, const std::optional<cairn_closing_report>& last_closing,
              const Summary& summary);

 private:
  // A submap as reported when it was closed. Its pose is read at the end of the run, when it is known best.
  struct Closed {
    std::uint64_t step;
    cairn_closing_report report;
  };

  void add_trajectory(const DriveStep& step, const StepResult& result, const std::optional<PoseScore>& score);
  void add_innovations(const DriveStep& step, const StepResult& result);
  void add_timing(const DriveStep& step, const StepResult& result);
  void write_landmarks(const cairn_filter* filter, const Summary& summary);
  void write_submaps(const cairn_filter* filter);
  void write_terrain(const cairn_world* world);

  const Drive& drive_;
  std::string folder_;
  OutputFile trajectory_;
  OutputFile innovations_;
  OutputFile timing_;
  HealthCsv health_;
  std::uint64_t last_step_ = 0;
  std::vector<Closed> closed_;
};

}  // namespace cairn::program
