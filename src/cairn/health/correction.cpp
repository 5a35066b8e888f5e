// SPDX-License-Identifier: BSD-3-Clause
#include "health/correction.hpp"

#include "health/body_axes.hpp"
#include "health/semidefinite.hpp"

namespace cairn {

template <class Pose>
Correction<Pose>::Correction(const Pose& before, const Square& P_before, const Pose& after, const Square& P_after)
    : covariance(P_before - P_after) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn;
  const typename Pose::Rotation to_body = after.rotation().inverse();
  const Tangent error = pose_error(after, before);
  value << to_body.matrix() * error.template head<kDim>(), to_body.adjoint() * error.template tail<kTurn>();
  turn_axes<Pose>(to_body, covariance);
  prior.template head<kDim>().setConstant(P_before.diagonal().template head<kDim>().sum());
  prior.template tail<kTurn>().setConstant(P_before.diagonal().template tail<kTurn>().sum());
}

template <class Pose>
bool Correction<Pose>::whiten(Tangent& white) const {
  // A direction that hardly varies would be told from the others only by what the linearisation neglects.
  constexpr double kSlight = 0.01;
  if (!value.allFinite() || !covariance.allFinite() || !(covariance.diagonal().maxCoeff() > 0.0)) return false;
  Square S = covariance;
  S.diagonal() += kSlight * S.diagonal() + rounding();
  const Square L = semidefinite_factor(S);
  for (int i = 0; i < Pose::kDof; ++i) {
    double rest = value(i);
    for (int k = 0; k < i; ++k) rest -= L(i, k) * white(k);
    white(i) = L(i, i) > 0.0 ? rest / L(i, i) : 0.0;
  }
  return true;
}

template struct Correction<SE2>;
template struct Correction<SE3>;

}  // namespace cairn
