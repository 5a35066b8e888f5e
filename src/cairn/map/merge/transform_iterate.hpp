// SPDX-License-Identifier: BSD-3-Clause
// The transform that the iterations of an alignment improve.
#pragma once

#include "geometry/se3.hpp"

namespace cairn {

// What is known about the transform before the points are used, independently of them. The covariance is that of the
// ordinary error [dp; dtheta]. It may be singular; it is zero if the transform is known exactly.
struct TransformPrior {
  SE3 T_a_b;
  Matrix6 covariance;
};

// Without a prior, the unknown is the transform itself. With a prior, the unknown is u in T = retract(prior, G u): u
// has the covariance I and G G^T is the covariance of the prior, so that a singular covariance needs no inverse.
class TransformIterate {
 public:
  // Begins at the prior if there is one.
  explicit TransformIterate(const TransformPrior* prior);

  // Without a prior: begins at this transform.
  void begin_at(const SE3& T) { T_ = T; }
  const SE3& T() const { return T_; }
  const Vector6& u() const { return u_; }  // zero without a prior
  // The derivative of the error [dq; dtheta] of T by the unknown; dq moves `centre`.
  Matrix6 chain(const Vector3& centre) const;
  TransformIterate moved(const Vector6& step, const Vector3& centre) const;

 private:
  const TransformPrior* prior_;
  Matrix6 G_ = Matrix6::Zero();
  SE3 T_;
  Vector6 u_ = Vector6::Zero();
};

}  // namespace cairn
