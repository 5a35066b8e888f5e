// SPDX-License-Identifier: BSD-3-Clause
// The folder of --output: what happened, in files of comma-separated values.
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "program/options/options.hpp"
#include "program/output/summary.hpp"
#include "program/runners/runner.hpp"

namespace cairn::program {

// A file that is being written. Every failure is a UsageError that names the file.
class OutputFile {
 public:
  OutputFile(const std::string& folder, const char* name);

  void text(const std::string& text);
  // The fields of a row, from the left; `end` ends it.
  void field(const std::string& value);
  void field(const char* value) { field(std::string(value)); }
  void field(std::uint64_t value) { field(std::to_string(value)); }
  void field(double value);  // empty where it is NaN
  void fields(const double* values, std::size_t count);
  void empty(std::size_t count);
  void end();
  void close();

 private:
  [[noreturn]] void fail() const;

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  bool row_begun_ = false;
};

// Creates a folder where there is none. Throws UsageError.
void create_folder(const std::string& folder);

class CsvOutput {
 public:
  // Creates the folder where there is none, and the files. Throws UsageError.
  CsvOutput(const Drive& drive, const std::string& folder);

  void add(const DriveStep& step, const StepResult& result, const std::optional<PoseScore>& score);
  // After the summary's own `finish`.
  void finish(const cairn_filter* filter, const std::optional<cairn_closing_report>& last_closing,
              const Summary& summary);

 private:
  // What is known of a submap when it is closed; where it lies, the end of the run knows best.
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
  std::uint64_t last_step_ = 0;
  std::vector<Closed> closed_;
};

}  // namespace cairn::program
