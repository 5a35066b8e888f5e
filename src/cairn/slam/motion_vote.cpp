// SPDX-License-Identifier: BSD-3-Clause
#include "slam/motion_vote.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "linear/joint_gate.hpp"

namespace cairn {

template <class Pose>
bool Witness<Pose>::whiten(const double* residual, const ByPose& J_pose, const double* S, Index ld) {
  r.setZero();
  J.setZero();
  std::copy_n(residual, rows, r.data());
  J.topRows(rows) = J_pose.topRows(rows);
  return whiten_block(S, ld, rows, r.data(), J.data(), Pose::kDof);
}

template <class Pose>
bool Witness<Pose>::place(const typename Pose::Point& difference, const typename Pose::Point& from_vehicle,
                          const Eigen::Matrix<double, Pose::kDim, Pose::kDim>& covariance) {
  rows = Pose::kDim;
  placed = true;
  arm = from_vehicle;
  ByPose J_pose = ByPose::Zero();
  J_pose.template topLeftCorner<Pose::kDim, Pose::kDim>().setIdentity();
  J_pose.template topRightCorner<Pose::kDim, Pose::kTurn>() = Pose::Rotation::turn(arm);
  return whiten(difference.data(), J_pose, covariance.data(), Pose::kDim);
}

template <class Pose>
void Witness<Pose>::move_to(const typename Pose::Point& where) {
  // A turn about `where` moves a point at `position` by turn(position - where) dtheta.
  J.template rightCols<Pose::kTurn>() += J.template leftCols<Pose::kDim>() * Pose::Rotation::turn(position - where);
  if (placed) arm += position - where;
  position = where;
}

template <class Pose>
typename Witness<Pose>::Rows Witness<Pose>::residual(const typename Pose::Tangent& motion) const {
  if (!placed) return r - J * motion;
  const typename Pose::Point moved =
      motion.template head<Pose::kDim>() + Pose::Rotation::exp(motion.template tail<Pose::kTurn>()) * arm - arm;
  return r - J.template leftCols<Pose::kDim>() * moved;
}

template <class Pose>
typename Witness<Pose>::ByPose Witness<Pose>::jacobian(const typename Pose::Tangent& motion) const {
  ByPose at = J;
  if (placed)
    at.template rightCols<Pose::kTurn>() =
        J.template leftCols<Pose::kDim>() *
        Pose::Rotation::turn(Pose::Rotation::exp(motion.template tail<Pose::kTurn>()) * arm);
  return at;
}

template <class Pose>
typename Pose::Tangent weak_prior(const Witness<Pose>* witnesses, Index count) {
  constexpr double kWeak = 1e-6;
  typename Pose::Tangent prior = Pose::Tangent::Zero();
  for (Index a = 0; a < count; ++a) prior += witnesses[a].J.colwise().squaredNorm().transpose();
  return (kWeak / static_cast<double>(count) * prior).cwiseMax(1e-300);
}

namespace {

template <class Pose>
class Ballot {
 public:
  static constexpr int kDof = Pose::kDof;
  using Tangent = typename Pose::Tangent;

  Ballot(const Witness<Pose>* witnesses, Index count, const BoundsByRows& bounds)
      : witnesses_(witnesses), count_(count), bounds_(bounds), prior_(weak_prior(witnesses, count)) {}

  template <class Chosen>
  Tangent motion(Chosen&& chosen) const {
    return fit_motion(witnesses_, count_, prior_, chosen);
  }
  bool agrees(Index a, const Tangent& motion) const {
    return witnesses_[a].distance(motion) <= bounds_[static_cast<std::size_t>(witnesses_[a].rows)];
  }
  // Keeps the motion if more witnesses agree with it than with the best one, or if it is `refined` and as many do.
  void judge(const Tangent& motion, bool refined = false) {
    if (!motion.allFinite()) return;
    Index agreeing = 0;
    for (Index a = 0; a < count_; ++a) agreeing += agrees(a, motion) ? 1 : 0;
    if (agreeing > best_.agreeing || (refined && agreeing == best_.agreeing)) best_ = {motion, agreeing};
  }
  const MotionVote<Pose>& best() const { return best_; }

 private:
  const Witness<Pose>* witnesses_;
  Index count_;
  const BoundsByRows& bounds_;
  Tangent prior_;
  MotionVote<Pose> best_;
};

}  // namespace

template <class Pose>
MotionVote<Pose> vote_motion(const Witness<Pose>* witnesses, Index count, const BoundsByRows& bounds) {
  constexpr Index kHypotheses = 64;
  constexpr int kRefinements = 3;
  if (count == 0) return {};
  Ballot<Pose> ballot(witnesses, count, bounds);
  // Single witnesses, then pairs that lie 1, 2, 3, ... places apart.
  const Index step = std::max<Index>(1, 4 * count / kHypotheses);
  Index hypotheses = 0;
  for (Index apart = 0; apart < count && hypotheses < kHypotheses; ++apart)
    for (Index a = 0; a + apart < count && hypotheses < kHypotheses; a += step, ++hypotheses)
      ballot.judge(ballot.motion([&](Index other) { return other == a || other == a + apart; }));
  for (int i = 0; ballot.best().agreeing > 0 && i < kRefinements; ++i) {
    const typename Pose::Tangent motion = ballot.best().motion;
    ballot.judge(ballot.motion([&](Index a) { return ballot.agrees(a, motion); }), true);
  }
  return ballot.best();
}

template struct Witness<SE2>;
template struct Witness<SE3>;
template SE2::Tangent weak_prior(const Witness<SE2>*, Index);
template SE3::Tangent weak_prior(const Witness<SE3>*, Index);
template MotionVote<SE2> vote_motion(const Witness<SE2>*, Index, const BoundsByRows&);
template MotionVote<SE3> vote_motion(const Witness<SE3>*, Index, const BoundsByRows&);

}  // namespace cairn
