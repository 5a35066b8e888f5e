// SPDX-License-Identifier: BSD-3-Clause
// Drives one filter through one drive.
#pragma once

#include <cairn/cairn.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "program/drives/drive.hpp"
#include "program/options/filter_choices.hpp"

namespace cairn::program {

// A landmark's id, and the step of its last accepted observation.
using LastSeen = std::map<std::uint64_t, std::size_t>;

// The result of one step. Its arrays are valid until the next step.
struct StepResult {
  double seconds = 0;  // prediction, update with any closing of a submap, and forgetting; nothing else
  cairn_pose pose{};
  double covariance[36] = {};                   // of [dp; dtheta]
  double local_covariance[36] = {};             // the same of the pose in the open submap
  std::size_t landmarks = 0;                    // in the map after the step
  std::size_t filter_landmarks = 0;             // in the filter that processed the frame, before any closing
  std::vector<cairn_match> matches;             // one for each observation
  cairn_update_report report{};                 // zeros if the step had no observations
  std::optional<cairn_closing_report> closing;  // of the submap that was closed after it
  cairn_health health{};                        // after the step
  cairn_sensor_health sensor_health{};
};

class Runner {
 public:
  // `drive` and `choices` have to live as long as the runner. Throws LibraryError.
  Runner(Drive& drive, const FilterChoices& choices);

  // Runs the whole drive; `observe` gets the filter and the result after each step. Throws LibraryError.
  using Observer = std::function<void(const cairn_filter*, const DriveStep&, const StepResult&)>;
  void run(const Observer& observe);

  // Closes the open submap, so that the map is complete. Empty if no submap is open.
  std::optional<cairn_closing_report> finish();

  const cairn_filter* filter() const { return filter_.get(); }

 private:
  void create();
  void predict();
  void update();
  void forget();
  void report();
  std::optional<cairn_closing_report> new_closing();
  void check(cairn_status status) const;

  Drive& drive_;
  const FilterChoices& choices_;
  std::unique_ptr<cairn_filter, void (*)(cairn_filter*)> filter_{nullptr, &cairn_filter_destroy};
  std::int32_t sensor_ = -1;
  DriveStep step_;
  StepResult result_;
  LastSeen last_seen_;
  std::size_t closings_ = 0;
  bool started_ = false;
  bool has_submaps_ = false;
};

}  // namespace cairn::program
