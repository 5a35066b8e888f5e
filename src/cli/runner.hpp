// SPDX-License-Identifier: BSD-3-Clause
// Drives one filter through one log.
#pragma once

#include <cairn/cairn.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "cli/options.hpp"
#include "io/log.hpp"

namespace cairn::cli {

// The library refused a call.
class LibraryError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A landmark's name and when the filter last took in an observation of it.
using LastSeen = std::map<std::uint64_t, std::size_t>;

// What one step did. Its arrays are valid until the next step.
struct StepResult {
  std::size_t index = 0;  // in the log
  double seconds = 0;     // predict, update and forgetting; nothing else
  cairn_pose pose{};
  double covariance[36] = {};        // of [dp; dtheta]
  std::size_t landmarks = 0;         // in the map after the step
  std::vector<cairn_match> matches;  // one for each observation
  cairn_update_report report{};      // zeros where the step had no observations
};

class Runner {
 public:
  // `log` and `options` have to live as long as the runner. Throws LibraryError.
  Runner(const io::Log& log, const RunOptions& options);

  // Runs the whole log; `observe` gets the filter and the result after each step. Throws LibraryError.
  void run(const std::function<void(const cairn_filter*, const StepResult&)>& observe);

  const cairn_filter* filter() const { return filter_.get(); }

 private:
  void create();
  void add_sensor();
  void predict(const io::Step& step);
  void update(const io::Step& step);
  void forget();
  void check(cairn_status status) const;

  const io::Log& log_;
  const RunOptions& options_;
  std::unique_ptr<cairn_filter, void (*)(cairn_filter*)> filter_{nullptr, &cairn_filter_destroy};
  std::int32_t sensor_ = -1;
  StepResult result_;
  LastSeen last_seen_;
  bool created_ = false;
};

// Landmarks that the filter holds at once at most, when it forgets one that was not seen for `forget_after` frames
// (0: never).
std::size_t landmarks_at_once(const io::Log& log, std::uint64_t forget_after);

}  // namespace cairn::cli
