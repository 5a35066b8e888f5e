// SPDX-License-Identifier: BSD-3-Clause
// A second filter to hold the first one against: slow, dense and without a single Jacobian written out. Every
// derivative is a difference, taken through the filter's own retraction; every prediction goes through the whole
// covariance; the common error of a mount is a state like any other for as long as a frame lasts.
//
// It shares the geometry and the sensors' values with the library, nothing of src/ekf and src/slam.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/se3.hpp"
#include "motion/motion.hpp"
#include "sensor/sensor.hpp"

namespace cairn::test {

using Dynamic = Eigen::MatrixXd;
using DynamicVector = Eigen::VectorXd;

// Errors of a state stand as [position; attitude; landmarks...; mount angles], the last only where there are any.
struct ReferenceState {
  SE3 pose;
  std::vector<Vector3> landmarks;
  std::vector<double> mount;

  Eigen::Index size() const { return static_cast<Eigen::Index>(6 + 3 * landmarks.size() + mount.size()); }
};

struct Seen {
  std::uint64_t id;
  Vector3 z;
  Matrix3 noise;  // of the observation itself
};

// What the reference made of one frame; `distance` has an entry a observation, -1 where there was nothing to compare.
struct FrameResult {
  std::vector<double> distance;
  std::vector<bool> taken;  // matched or placed
  int iterations = 0;
  double nis = 0;
};

class ReferenceFilter {
 public:
  struct Options {
    bool invariant = true;
    int iterations = 3;
    double tolerance = 0.1;
    double gate = 1, batch_gate = 1;  // probabilities; 1 lets all pass
  };

  ReferenceFilter(const Options& options, const SE3& pose, const Matrix6& ordinary_covariance);

  // --- motion --- the pose after a step, given the one before and the step's noise
  using Motion = std::function<SE3(const SE3&, const DynamicVector& noise)>;
  void predict(const Motion& motion, const Dynamic& noise_covariance);
  void predict_twist(const Vector3& v, const Vector3& w, double dt, const TwistNoise& noise);
  void predict_wheels(const Wheels& wheels, double left, double right, double dt);
  void predict_increment(const SE3& T_before_after, const Matrix6& covariance);

  // --- updates --- a residual z - h(state), false where there is none; its noise may depend on the state
  using Residual = std::function<bool(const ReferenceState&, DynamicVector& out)>;
  using Noise = std::function<Dynamic(const ReferenceState&)>;
  // `least`: linearisations before the residual may end it, as far as `iterations` allow.
  FrameResult update(const Residual& residual, const Noise& noise, int least, int iterations);
  FrameResult update_frame(const Sensor<SE3>& sensor, const std::vector<Seen>& frame);
  FrameResult update_position(const Vector3& position, const Matrix3& covariance, const Vector3& lever_arm);
  FrameResult update_attitude(const SO3& attitude, const Matrix3& covariance);
  FrameResult update_heading(double heading, double sigma);
  // Jacobians by ordinary errors; those of the landmarks side by side, in the order of `ids`.
  FrameResult update_linear(const DynamicVector& residual, const Dynamic& covariance, const Dynamic& J_pose,
                            const std::vector<std::uint64_t>& ids, const Dynamic& J_landmarks);

  void remove(std::uint64_t id);

  // --- results ---
  const ReferenceState& state() const { return state_; }
  const std::vector<std::uint64_t>& ids() const { return ids_; }
  int find(std::uint64_t id) const;                 // -1: absent
  const Dynamic& covariance() const { return P_; }  // in the filter's own error coordinates
  Dynamic ordinary_covariance() const;

 private:
  ReferenceState retract(const ReferenceState& state, const DynamicVector& error) const;
  DynamicVector local(const ReferenceState& from,
                      const ReferenceState& to) const;  // retract(from, local(from, to)) is `to`
  Dynamic ordinary_by_own() const;
  bool compare(const Sensor<SE3>& sensor, const Seen& seen, const ReferenceState& state, Vector3& residual) const;
  Residual frame_residual(const Sensor<SE3>& sensor, const std::vector<Seen>& frame) const;
  Dynamic frame_noise(const Sensor<SE3>& sensor, const std::vector<Seen>& frame, const ReferenceState& state) const;
  // Numbers of the known observations that pass, and each one's own squared distance.
  void gate(const Sensor<SE3>& sensor, const std::vector<Seen>& known, std::vector<std::size_t>& kept,
            std::vector<double>& distance) const;
  bool place(const Sensor<SE3>& sensor, const Seen& seen);

  Options options_;
  ReferenceState state_;
  std::vector<std::uint64_t> ids_;
  Dynamic P_;
};

// df / dx at zero by nine points: the error is step^8 / 630 times the ninth derivative, below rounding for everything
// here, which changes over metres and radians. The step is a power of two, so that adding it to a coordinate is exact.
Dynamic differentiate(const std::function<DynamicVector(const DynamicVector&)>& f, Eigen::Index inputs);

}  // namespace cairn::test
