// SPDX-License-Identifier: BSD-3-Clause
// An endless drive around a ring of landmarks, for benchmarks with filters of any size and any number of steps. The
// noise never repeats. A frame sees the landmarks ahead; on the first lap six of them are new.
#pragma once

#include <cmath>
#include <random>

#include "cairn_run.hpp"

namespace bench {

class Course {
 public:
  static constexpr int kSeen = 12, kAdvance = 6;

  // A little more than the first lap, which places all landmarks.
  explicit Course(int landmarks) : Course(landmarks, kRadius, 0, CAIRN_JOIN_AUTO) { drive(landmarks / kAdvance + 2); }
  // With submaps, around a ring of this radius (m). Nothing has been observed yet.
  Course(int landmarks, double radius, int submap_landmarks, int32_t join)
      : landmarks_(landmarks), radius_(radius), filter_(landmarks, kSeen, true_pose(0), submap_landmarks, join) {}

  void drive(int frames) {
    for (int frame = 0; frame < frames; ++frame) {
      advance();
      predict_and_update();
    }
  }

  Filter& filter() { return filter_; }
  cairn_filter* handle() { return filter_.get(); }
  int landmarks() const { return landmarks_; }
  cairn_pose estimate() {
    cairn_pose pose;
    check(cairn_filter_pose(handle(), &pose, nullptr, nullptr));
    return pose;
  }

  // Draws the next increment and the next frame.
  void advance() {
    ++frame_;
    const cairn_pose pose = true_pose(frame_);
    cairn_pose inverse;
    check(cairn_pose_inverse(&last_, &inverse, nullptr));
    check(cairn_pose_compose(&inverse, &pose, &increment_, nullptr));
    cairn_pose noise{};
    for (double& value : noise.position) value = Noise::kIncrementMetres * normal_(engine_);
    double turn[3];
    for (double& value : turn) value = Noise::kIncrementRadians * normal_(engine_);
    check(cairn_quaternion_exp(turn, noise.quaternion, nullptr));
    check(cairn_pose_compose(&increment_, &noise, &increment_, nullptr));
    last_ = pose;
    check(cairn_pose_inverse(&pose, &inverse, nullptr));
    observations_.clear();
    for (int i = 0; i < kSeen; ++i) {
      const int landmark = static_cast<int>((kAdvance * frame_ + i) % landmarks_);
      observations_.push_back(observe(landmark, inverse));
    }
  }

  const std::vector<cairn_observation>& observations() const { return observations_; }
  void predict() { filter_.predict(increment_); }
  void predict_and_update() {
    predict();
    filter_.update(observations_);
  }

 private:
  static constexpr double kRadius = 80.0,
                          kBehind = 4.0;  // m; kBehind: from the vehicle back to the first landmark that it sees

  double angle(double landmark) const { return 2.0 * 3.141592653589793 * landmark / landmarks_; }

  cairn_pose true_pose(long frame) const {
    const double a = angle(static_cast<double>(kAdvance * (frame % landmarks_))) - kBehind / radius_;
    return pose_of({radius_ * std::cos(a), radius_ * std::sin(a), std::sin(3.0 * a), 0.05 * std::sin(5.0 * a),
                    0.05 * std::cos(4.0 * a), a + 1.5707963267948966});
  }

  cairn_observation observe(int landmark, const cairn_pose& T_body_map) {
    const double a = angle(landmark), radius = radius_ + 15.0 * std::sin(2.4 * landmark);
    const double point[3] = {radius * std::cos(a), radius * std::sin(a), 2.0 + std::sin(1.7 * landmark)};
    double b[3];
    check(cairn_pose_apply(&T_body_map, point, b, nullptr));
    const double planar = std::hypot(b[0], b[1]);
    cairn_observation observation{};
    observation.id = static_cast<uint64_t>(landmark);
    observation.z[0] = std::hypot(planar, b[2]) + Noise::kRange * normal_(engine_);
    observation.z[1] = std::atan2(b[1], b[0]) + Noise::kAngle * normal_(engine_);
    observation.z[2] = std::atan2(b[2], planar) + Noise::kAngle * normal_(engine_);
    return observation;
  }

  int landmarks_;
  double radius_;
  long frame_ = 0;
  cairn_pose last_ = true_pose(0);
  cairn_pose increment_{};
  std::vector<cairn_observation> observations_;
  std::mt19937_64 engine_{20240229};
  std::normal_distribution<double> normal_;
  Filter filter_;
};

}  // namespace bench
