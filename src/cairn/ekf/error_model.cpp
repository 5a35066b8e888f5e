// SPDX-License-Identifier: BSD-3-Clause
#include "ekf/error_model.hpp"

namespace cairn {

template <class Pose>
void ErrorModel<Pose>::retract(const Tangent& error, Pose& pose) const {
  if (invariant()) {
    pose = Pose::exp(error) * pose;
  } else {
    const typename Rotation::Tangent turn = error.template tail<kTurn>();
    pose = Pose(Rotation::exp(turn) * pose.rotation(), pose.translation() + error.template head<kDim>());
  }
}

template <class Pose>
ErrorModel<Pose>::PointRetraction::PointRetraction(const ErrorModel& model, const typename Rotation::Tangent& turn)
    : invariant_(model.invariant()) {
  if (!invariant_) return;
  R_ = Rotation::exp(turn).matrix();
  V_ = Rotation::translation_jacobian(turn);
}

template class ErrorModel<SE2>;
template class ErrorModel<SE3>;

}  // namespace cairn
