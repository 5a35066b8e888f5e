// SPDX-License-Identifier: BSD-3-Clause
// Timing samples, and sums of squared errors.
#pragma once

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace bench {

// Processor time of the calling thread. Everything that is timed runs in one thread and does not wait; a wall clock
// would also measure other programs on a shared machine.
class Stopwatch {
 public:
  double milliseconds() const { return 1e3 * (now() - start_); }

 private:
  static double now() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double start_ = now();
};

class Samples {
 public:
  void reserve(std::size_t count) { values_.reserve(count); }
  void add(double value) { values_.push_back(value); }
  std::size_t size() const { return values_.size(); }

  double mean() const {
    double sum = 0.0;
    for (double value : values_) sum += value;
    return sum / static_cast<double>(values_.size());  // NaN if there are no samples
  }

  double quantile(double share) const {
    if (values_.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::vector<double> sorted = values_;
    std::sort(sorted.begin(), sorted.end());
    const double position = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
  }

  double median() const { return quantile(0.5); }

 private:
  std::vector<double> values_;
};

class SquaredError {
 public:
  template <class A, class B>
  void add(const A& a, const B& b) {  // points
    for (int i = 0; i < 3; ++i) sum_ += (a[i] - b[i]) * (a[i] - b[i]);
    ++count_;
  }
  double rms() const { return std::sqrt(sum_ / static_cast<double>(count_)); }

 private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace bench
