// SPDX-License-Identifier: BSD-3-Clause
// A reference filter for comparison: slow, dense, and without any analytic Jacobian. Every derivative is a difference
// through the filter's own retraction. Every prediction uses the whole covariance. The common error of a mount is a
// state for the duration of a frame.
//
// It shares the geometry and the values of the sensors with the library, but nothing of src/cairn/ekf and
// src/cairn/slam.
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

// The error of a state is [position; attitude; landmarks...; mount angles]. The mount angles are present only during a
// frame.
struct ReferenceState {
  SE3 pose;
  std::vector<Vector3> landmarks;
  std::vector<double> mount;

  Eigen::Index size() const { return static_cast<Eigen::Index>(6 + 3 * landmarks.size() + mount.size()); }
};

struct Seen {
  std::uint64_t id;
  Vector3 z;
  Matrix3 noise;  // noise of the observation
};

// Result of the reference for one frame. `distance` has an entry for each observation; -1 if no distance was computed.
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
    double gate = 1, batch_gate = 1;  // probabilities; 1 accepts everything
  };

  ReferenceFilter(const Options& options, const SE3& pose, const Matrix6& ordinary_covariance);

  // --- motion --- The pose after a step, given the pose before it and the noise of the step.
  using Motion = std::function<SE3(const SE3&, const DynamicVector& noise)>;
  void predict(const Motion& motion, const Dynamic& noise_covariance);
  void predict_twist(const Vector3& v, const Vector3& w, double dt, const TwistNoise& noise);
  void predict_wheels(const Wheels& wheels, double left, double right, double dt);
  void predict_increment(const SE3& T_before_after, const Matrix6& covariance);

  // --- updates --- A residual z - h(state); false if there is none. Its noise may depend on the state.
  using Residual = std::function<bool(const ReferenceState&, DynamicVector& out)>;
  using Noise = std::function<Dynamic(const ReferenceState&)>;
  // `least`: number of linearisations before the residual may end the iteration, up to `iterations`.
  FrameResult update(const Residual& residual, const Noise& noise, int least, int iterations);
  FrameResult update_frame(const Sensor<SE3>& sensor, const std::vector<Seen>& frame);
  FrameResult update_position(const Vector3& position, const Matrix3& covariance, const Vector3& lever_arm);
  FrameResult update_attitude(const SO3& attitude, const Matrix3& covariance);
  FrameResult update_heading(double heading, double sigma);
  // Jacobians by ordinary errors. Those of the landmarks are side by side in the order of `ids`.
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
  // Numbers of the known observations that pass the gates, and the squared distance of each.
  void gate(const Sensor<SE3>& sensor, const std::vector<Seen>& known, std::vector<std::size_t>& kept,
            std::vector<double>& distance) const;
  bool place(const Sensor<SE3>& sensor, const Seen& seen);

  Options options_;
  ReferenceState state_;
  std::vector<std::uint64_t> ids_;
  Dynamic P_;
};

// df/dx at zero by nine points. The error is step^8 / 630 times the ninth derivative, which is below rounding for all
// functions here: they change over metres and radians. The step is a power of two, so that adding it to a coordinate is
// exact.
Dynamic differentiate(const std::function<DynamicVector(const DynamicVector&)>& f, Eigen::Index inputs);

}  // namespace cairn::test
