// SPDX-License-Identifier: BSD-3-Clause
// One kind of filter, run through many worlds, and its errors compared with its covariance.
#pragma once

#include <cairn/cairn.h>

#include <array>
#include <cstdint>
#include <vector>

#include "world.hpp"

namespace consistency {

// Chi-square quantile by Wilson and Hilferty, accurate to 1e-4 for a hundred degrees of freedom and more; z is the
// quantile of the normal distribution.
double quantile(double dof, double z);
constexpr double kTwoSided95 = 1.959963984540054;

// Ends the program if a call of the library failed.
void check(cairn_status status, const char* what);
#define CHECK(call) consistency::check(call, #call)

// A sum of chi-square variables over the runs, at one time.
struct Sum {
  double value = 0, dof = 0;
  bool inside() const { return value >= quantile(dof, -kTwoSided95) && value <= quantile(dof, kTwoSided95); }
};

// Which filter.
struct Kind {
  const char* name;
  int32_t error;              // CAIRN_ERROR_...
  uint32_t submap_landmarks;  // 0: a single map
  int32_t join;               // CAIRN_JOIN_...
  bool sees;                  // false: dead reckoning
};

// Options that all filters of a campaign share.
struct Setup {
  uint32_t iterations = 0;  // 0: the default of the library
  bool gated = false;       // the gates of the library instead of open gates
  int32_t loss = CAIRN_LOSS_NONE;
  double loss_width = 1.0;
};

class Tracker {
 public:
  explicit Tracker(const Kind& kind) : kind_(kind) {}

  void start(const Noise& noise, const cairn_pose& pose, const Setup& setup);
  void predict(const double velocity[3], const double rate[3]);
  // Processes a frame. After the last frame the open submap is closed, so that the frame is scored with all
  // information.
  void update(int frame, const std::vector<cairn_observation>& seen, const cairn_pose& truth);
  void finish(const cairn_pose& truth);

  const char* name() const { return kind_.name; }
  bool sees() const { return kind_.sees; }
  bool has_submaps() const { return kind_.submap_landmarks > 0; }
  double nees_share() const { return share(nees_); }
  double nis_share() const { return share(nis_); }
  double anees() const { return mean(nees_); }
  double nis_mean() const { return mean(nis_); }
  // Deviation of the mean NIS from 1, in standard deviations.
  double nis_deviation() const;
  double final_metres() const;
  double final_degrees() const;
  // Over all runs: closings, landmarks that the map and a submap had in common, and those of them that were left out.
  long closings() const { return closings_; }
  long fused() const { return fused_; }
  long refused() const { return refused_; }

 private:
  using Sums = std::array<Sum, World::kFrames>;
  static double share(const Sums& sums);  // share of the times at which the sum lies in its band
  static double mean(const Sums& sums);   // per degree of freedom
  void count_closing();

  Kind kind_;
  cairn_filter* filter_ = nullptr;
  int32_t sensor_ = -1;
  uint32_t submaps_ = 0;  // closed in this run
  Sums nees_, nis_;
  double position_ = 0, attitude_ = 0;
  int runs_ = 0;
  long closings_ = 0, fused_ = 0, refused_ = 0;
};

}  // namespace consistency
