// SPDX-License-Identifier: BSD-3-Clause
// The progress of a long run, on stderr: a bar on a terminal, otherwise one line every ten seconds.
#pragma once

#include <chrono>
#include <cstddef>

namespace cairn::program {

class Progress {
 public:
  Progress(std::size_t steps, bool quiet);
  ~Progress();  // removes the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::size_t done);
  void advance() { show(++done_); }

 private:
  std::size_t steps_;
  std::size_t done_ = 0;
  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace cairn::program
