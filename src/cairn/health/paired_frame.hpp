// SPDX-License-Identifier: BSD-3-Clause
// The differences between two sightings of the same landmarks, one frame apart (docs/trust.md, "Two frames").
//
// The residual of a landmark after the last frame, subtracted from its innovation in this frame, leaves the noise of
// both observations and the error of the motion between them. The errors of pose and map cancel. Therefore the noise of
// sensor and motion can be read from these differences although both are stated wrongly.
#pragma once

#include "core/arena.hpp"
#include "health/frame_parts.hpp"
#include "sensor/sensor.hpp"

namespace cairn {

template <class Pose>
class PairedFrame {
 public:
  static constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  using Square = typename Pose::Square;
  using ByMotion = Eigen::Matrix<double, kMostRows, kDof>;

  PairedFrame(Arena& arena, Index max_observations);

  void start(Index rows);  // of an observation
  // A difference, the covariance of its noise as stated, and its Jacobian by the motion's error. Returns false, with
  // nothing added, if a value is not finite or the noise not positive definite.
  bool add(const Vector3& difference, const Matrix3& noise, const ByMotion& J_motion);
  Index count() const { return count_; }
  // After split(): whether the observations of one difference agree, or a gross error or a moved landmark lies between.
  enum class Step { agrees, unclear, jumped };
  Step step(Index difference) const;

  // Splits the frame. `motion` is the stated covariance of the motion's error, alpha and beta are the present factors
  // of the stated variances; they only decide which observations are gross errors.
  FrameParts split(const Square& motion, double alpha, double beta);
  const Square& information() const { return information_; }  // about the motion, of the last split, for stated noise

 private:
  struct Block {
    Vector3 difference;  // whitened by the stated noise; rows that the sensor does not have are zero
    ByMotion J;          // whitened
    double distance;
  };
  static double distance(const Block& block, const Square& L, double alpha, double beta);
  double largest_distance();

  static constexpr double kKeep = 0.995;  // of honest observations
  double keep_[kMostRows + 1] = {}, median_[kMostRows + 1] = {}, shrink_[kMostRows + 1] = {};
  Block* blocks_;
  double* sorted_;  // distances
  Square information_ = Square::Zero();
  Index rows_ = 0, count_ = 0;
  double largest_ = 0.0;  // distance that counts
};

extern template class PairedFrame<SE2>;
extern template class PairedFrame<SE3>;

}  // namespace cairn
