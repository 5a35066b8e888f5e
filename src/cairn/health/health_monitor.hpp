// SPDX-License-Identifier: BSD-3-Clause
// Watches a filter: learns the noise, and judges how far to trust the estimate (docs/trust.md). The filter tells it
// each motion and each update; the monitor changes nothing of the filter. O(observations) an update, no allocation.
#pragma once

#include "health/chained_motion.hpp"
#include "health/drift_test.hpp"
#include "health/motion_noise_test.hpp"
#include "health/noise_regression.hpp"
#include "health/paired_frame.hpp"
#include "health/sensor_noise_test.hpp"
#include "health/sighting_memory.hpp"
#include "health/verdict.hpp"

namespace cairn {

struct HealthOptions {
  Index max_sensors, max_observations;
  double gate_probability;
  bool apply_noise;  // scale the noise by what was learned
};

// An observation of a landmark that the filter knows, at the estimate before the update.
template <class Pose>
struct Sighted {
  std::uint64_t landmark;
  const Sensor<Pose>* sensor;
  Vector3 z;
  Vector3 innovation;
  Matrix3 noise;  // as stated, with that of the mount
  typename Prediction<Pose>::ByLandmark J_z_y;
  typename Pose::Point y;  // in the body frame
};

// What an update left of an observation, whether it was used or refused.
template <class Pose>
using Left = typename SightingMemory<Pose>::Anchor;

struct SensorHealth {
  double compared, refused;  // observations so far
  NisWindow nis;
  Persistence persistence;
};

template <class Pose>
class HealthMonitor {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Square = typename Pose::Square;

  HealthMonitor(Arena& arena, const HealthOptions& options);

  // --- what happens, as the filter tells it ---
  void moved(const Increment<Pose>& increment);  // with the stated noise
  void interrupt();                              // another vehicle moves and sees from now on
  void widened(double amount) { verdict_.widened(amount); }
  // `worst`: squared distance of the refused landmark that contradicts the map most.
  void closed(std::size_t refused, std::size_t known, double worst);
  void fixed(Index rows, double distance, bool refused);

  // --- a frame --- start, compare each sighting, correct, finish; then remember what it leaves
  // `relative`: the sensor's values depend only on the landmark's place in the body frame.
  void start(Index sensor, Index rows, bool relative);
  void compare(const Sighted<Pose>& sighted, double distance, bool refused);
  void correct(const Pose& before, const Square& P_before, const Pose& after, const Square& P_after);
  void finish(double nis, Index rows);
  void remember(std::uint64_t landmark, Left<Pose> left);  // its sensor and frame are filled in

  // --- what it found ---
  const Verdict& verdict() const { return verdict_; }
  const SensorHealth& sensor(Index sensor) const { return places_[sensor].health; }
  NoiseFactor sensor_noise(Index sensor) const { return noise_.sensor(sensor); }
  NoiseFactor motion_noise() const { return noise_.motion(); }
  const UpdateEvidence& evidence() const { return evidence_; }  // of the last update
  // Factors of the stated variances that the filter has to use: 1 unless the noise is scaled.
  double applied_to_sensor(Index sensor) const { return apply_ ? applied(noise_.sensor(sensor)) : 1.0; }
  double applied_to_motion() const { return apply_ ? applied(noise_.motion()) : 1.0; }

 private:
  // A sensor, and the motion since its last frame.
  struct Place {
    SensorHealth health;
    SensorNoiseTest noise_test;
    std::uint64_t frame;  // number of its frame
    struct Chain {        // the motion since the anchor of a stride
      bool unbroken;
      bool begins;          // at the last frame of any sensor: the motion is zero
      std::uint64_t frame;  // of the anchor
      ChainedMotion<Pose> motion;
      Pose back;  // the inverse of the motion, in the frame at hand
      typename Pose::Rotation::Matrix R_back;
    } chains[kStrides];
  };
  static double applied(const NoiseFactor& factor);
  void move_all();
  bool due(Index stride) const { return places_[now_].frame % kStride[stride] == 0; }
  bool pair(const Sighted<Pose>& sighted, bool refused, const Left<Pose>& last, Index stride);
  FrameParts split(Index stride);
  void learn();
  void judge_jump(const FrameParts& parts);
  void judge_steps();

  bool apply_;
  Index sensors_;
  Place* places_;
  ChainedMotion<Pose> since_;  // the last frame of any sensor
  bool moved_ = false;         // since then
  SightingMemory<Pose> memory_;
  PairedFrame<Pose> paired_[kStrides];
  typename SightingMemory<Pose>::Sighting** steps_;  // landmarks of the differences to the frame before
  NoiseRegression noise_;
  Correction<Pose> correction_;  // by the update at hand
  DriftTest<Pose> drift_;
  MotionNoiseTest<Pose> motion_test_;
  Verdict verdict_;
  UpdateEvidence evidence_;
  Square information_ = Square::Zero();
  double informed_ = 0.0;
  Index now_ = 0, rows_ = 0;  // the frame at hand: its sensor, rows of an observation
  bool relative_ = true;
};

extern template class HealthMonitor<SE2>;
extern template class HealthMonitor<SE3>;

}  // namespace cairn
