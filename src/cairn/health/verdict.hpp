// SPDX-License-Identifier: BSD-3-Clause
// The verdict on a filter: good, doubtful or lost, and the reasons (docs/trust.md). It sees one update at a time and
// keeps a few sums that fade.
#pragma once

#include <cstdint>

#include "health/cumulative_sum.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

enum class Trust { good, doubtful, lost };

// One bit each.
enum DoubtReason : std::uint32_t {
  kDoubtNis = 1,
  kDoubtRefusals = 2,
  kDoubtWidened = 4,
  kDoubtSensorNoise = 8,
  kDoubtMotionNoise = 16,
  kDoubtBias = 32,
  kDoubtJump = 64,
  kDoubtLandmarks = 128,
  kDoubtClosing = 256,
  kDoubtBlind = 512,
  kDoubtDefinite = 1024,
};

// What one update tells. What does not apply stays as it is here.
struct UpdateEvidence {
  Index compared = 0, refused = 0;  // observations of known landmarks, or fixes
  double nis = 0.0;
  Index rows = 0;  // of the batch
  double jump = 0.0;
  Index jump_dof = 0;         // of the jump's chi-square test; 0: there was none
  double drift = 0.0;         // DriftTest::sigmas()
  Index contradicting = 0;    // observed landmarks
  Index blind = 0;            // directions
  double pivot = 1.0;         // of the pose's correlation
  bool sensor_noise = false;  // more than what is stated
  bool motion_noise = false;  // the same
};

// A fading mean of sums, with what it takes to tell whether it is significant.
struct NisWindow {
  double nis = 0.0, rows = 0.0, squares = 0.0;
  void add(double value, double dof, double keep);
  double ratio() const { return rows > 0.0 ? nis / rows : 0.0; }
  double half_width(double sigmas) const;  // of the band about 1
};

class Verdict {
 public:
  explicit Verdict(double gate_probability);

  void add(const UpdateEvidence& evidence);
  void widened(double amount);
  // `worst`: squared distance, of `rows` values, of the refused landmark that contradicts the map most.
  void closing(double refused, double known, double worst, Index rows);

  Trust trust() const { return trust_; }
  std::uint32_t reasons() const { return reasons_; }
  double share(Trust trust) const;  // of the updates so far
  double updates() const { return updates_; }
  const NisWindow& nis() const { return nis_; }
  double refused_share() const { return compared_ > 0.0 ? refused_ / compared_ : 0.0; }
  double jump() const { return jump_; }  // of the last update, in standard deviations
  double widenings() const { return widenings_; }
  double last_widening() const { return last_widening_; }

 private:
  static constexpr Index kKinds = 11;
  static constexpr int kHold = 10;  // updates for which a reason stays
  void doubt(DoubtReason reason, int hold = kHold);
  void judge_refusals(const UpdateEvidence& evidence);
  void judge_jump(const UpdateEvidence& evidence);

  double honest_refusals_;  // share
  NisWindow nis_;
  double compared_ = 0.0, refused_ = 0.0;
  CumulativeSum excess_;  // of refusals
  double jump_ = 0.0, jump_bound_[7] = {};
  double moved_bound_[4] = {};
  double widenings_ = 0.0, last_widening_ = 0.0;
  int hold_[kKinds] = {};
  std::uint32_t reasons_ = 0;
  Trust trust_ = Trust::good;
  double updates_ = 0.0, count_[3] = {};
};

}  // namespace cairn
