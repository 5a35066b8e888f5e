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
void Witness<Pose>::move_to(const typename Pose::Point& where) {
  // A turn about `where` moves a point at `position` by turn(position - where) dtheta.
  J.template rightCols<Pose::kTurn>() += J.template leftCols<Pose::kDim>() * Pose::Rotation::turn(position - where);
  position = where;
}

namespace {

template <class Pose>
class Ballot {
 public:
  static constexpr int kDof = Pose::kDof;
  using Tangent = typename Pose::Tangent;
  using Square = typename Pose::Square;

  Ballot(const Witness<Pose>* witnesses, Index count, const BoundsByRows& bounds)
      : witnesses_(witnesses), count_(count), bounds_(bounds) {
    // A direction that the chosen witnesses do not see gets no motion: a weak prior, scaled by what all of them know.
    constexpr double kWeak = 1e-6;
    prior_.setZero();
    for (Index a = 0; a < count; ++a) prior_ += witnesses[a].J.colwise().squaredNorm().transpose();
    prior_ = (kWeak / static_cast<double>(count) * prior_).cwiseMax(1e-300).eval();
  }

  // The least-squares motion of the witnesses that `chosen` accepts.
  template <class Chosen>
  Tangent motion(Chosen&& chosen) const {
    Square A = prior_.asDiagonal();
    Tangent b = Tangent::Zero();
    for (Index a = 0; a < count_; ++a) {
      if (!chosen(a)) continue;
      A += witnesses_[a].J.transpose() * witnesses_[a].J;
      b += witnesses_[a].J.transpose() * witnesses_[a].r;
    }
    return A.ldlt().solve(b);
  }
  bool agrees(Index a, const Tangent& motion) const {
    return witnesses_[a].distance(motion) <= bounds_[static_cast<std::size_t>(witnesses_[a].rows)];
  }
  void judge(const Tangent& motion) {
    if (!motion.allFinite()) return;
    Index agreeing = 0;
    for (Index a = 0; a < count_; ++a) agreeing += agrees(a, motion) ? 1 : 0;
    if (agreeing > best_.agreeing) best_ = {motion, agreeing};
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
    ballot.judge(ballot.motion([&](Index a) { return ballot.agrees(a, motion); }));
  }
  return ballot.best();
}

template struct Witness<SE2>;
template struct Witness<SE3>;
template MotionVote<SE2> vote_motion(const Witness<SE2>*, Index, const BoundsByRows&);
template MotionVote<SE3> vote_motion(const Witness<SE3>*, Index, const BoundsByRows&);

}  // namespace cairn
