// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include "program/output/process.hpp"

namespace cairn::program {
namespace {

constexpr std::chrono::milliseconds kBarPeriod(100);
constexpr std::chrono::seconds kLinePeriod(10);
constexpr std::size_t kBarWidth = 40;

}  // namespace

Progress::Progress(std::size_t steps, bool quiet)
    : steps_(steps), quiet_(quiet), terminal_(stderr_is_terminal()), last_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void Progress::show(std::size_t done) {
  if (quiet_) return;
  const auto now = std::chrono::steady_clock::now();
  if (terminal_) {
    if (now - last_ < kBarPeriod) return;
    const std::size_t filled = std::min(kBarWidth, kBarWidth * done / steps_);  // runs may differ in length
    std::fprintf(stderr, "\r[%s%s] %zu/%zu", std::string(filled, '#').c_str(),
                 std::string(kBarWidth - filled, ' ').c_str(), done, steps_);
    drawn_ = true;
  } else {
    if (now - last_ < kLinePeriod) return;
    std::fprintf(stderr, "cairn: step %zu of %zu\n", done, steps_);
  }
  last_ = now;
}

}  // namespace cairn::program
