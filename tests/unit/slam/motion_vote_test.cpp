// SPDX-License-Identifier: BSD-3-Clause
// The motion on which most observations agree, in the plane and in space.
#include "slam/motion_vote.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "numerical.hpp"

using namespace cairn;
using cairn::test::Random;

namespace {

template <class Pose>
typename Witness<Pose>::ByPose point_jacobian(const Pose& pose, const typename Pose::Point& point) {
  typename Witness<Pose>::ByPose J = Witness<Pose>::ByPose::Zero();
  J.template topRows<Pose::kDim>() = cairn::test::pose_jacobian(
      [&](const Pose& at) { return typename Pose::Point(at.rotation().inverse() * (point - at.translation())); }, pose);
  return J;
}

// Witnesses of a vehicle at `pose` whose true pose is `motion` away; noise 0.05.
template <class Pose>
struct Scene {
  static constexpr int kDim = Pose::kDim;

  Scene(unsigned seed, Index count, double outliers, const typename Pose::Tangent& motion) : random(seed) {
    const double sigma = 0.05;
    Matrix3 S = Matrix3::Zero();
    S.diagonal().setConstant(sigma * sigma);
    for (Index a = 0; a < count; ++a) {
      const typename Pose::Point point = 8.0 * random.normal_vector<kDim>();
      const typename Witness<Pose>::ByPose J = point_jacobian(pose, point);
      typename Pose::Point residual = J.template topRows<kDim>() * motion + sigma * random.normal_vector<kDim>();
      if (static_cast<double>(a) < outliers * static_cast<double>(count))
        for (int i = 0; i < kDim; ++i) residual[i] = random.uniform(-10, 10);
      Witness<Pose> witness = {};
      witness.rows = kDim;
      witness.source = static_cast<std::uint64_t>(a);
      witness.position = pose.translation();
      REQUIRE(witness.whiten(residual.data(), J, S.data(), 3));
      witnesses.push_back(witness);
    }
    bounds = {0, 10.8, 13.8, 16.3};
  }
  MotionVote<Pose> vote() const { return vote_motion(witnesses.data(), static_cast<Index>(witnesses.size()), bounds); }

  Random random;
  Pose pose;
  std::vector<Witness<Pose>> witnesses;
  BoundsByRows bounds;
};

template <class Pose>
typename Pose::Tangent some_motion() {
  typename Pose::Tangent motion = Pose::Tangent::Constant(0.05);
  motion[0] = 1.0, motion[1] = -0.7;
  return motion;
}

}  // namespace

TEST_CASE_TEMPLATE("motion vote: recovers a motion among 40 % outliers", Pose, SE2, SE3) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const Index count : {10, 40, 150}) {
      CAPTURE(seed);
      CAPTURE(count);
      const Scene<Pose> scene(seed, count, 0.4, some_motion<Pose>());
      const MotionVote<Pose> vote = scene.vote();
      CHECK(vote.agreeing >= count * 55 / 100);
      CHECK((vote.motion - some_motion<Pose>()).norm() < 0.15);
    }
}

TEST_CASE_TEMPLATE("motion vote: random outliers do not agree", Pose, SE2, SE3) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Scene<Pose> scene(seed, 30, 1.0, Pose::Tangent::Zero());
    CHECK(2 * scene.vote().agreeing <= 30);
  }
}

TEST_CASE_TEMPLATE("motion vote: no witness, and one witness", Pose, SE2, SE3) {
  CHECK(vote_motion<Pose>(nullptr, 0, {}).agreeing == 0);
  const Scene<Pose> scene(1, 1, 0.0, some_motion<Pose>());
  CHECK(scene.vote().agreeing == 1);
  CHECK(scene.vote().motion.allFinite());
}

TEST_CASE_TEMPLATE("motion vote: a direction that nobody sees gets no motion", Pose, SE2, SE3) {
  Scene<Pose> scene(3, 12, 0.0, some_motion<Pose>());
  for (Witness<Pose>& witness : scene.witnesses) {  // only the first row: x
    witness.rows = 1;
    witness.J.bottomRows(2).setZero();
    witness.J.rightCols(Pose::kTurn).setZero();
    witness.r.tail(2).setZero();
    witness.r[0] = witness.J.row(0) * some_motion<Pose>();
  }
  const MotionVote<Pose> vote = scene.vote();
  CHECK(vote.agreeing == 12);
  CHECK(vote.motion[0] == doctest::Approx(1.0).epsilon(1e-3));
  CHECK(vote.motion.tail(Pose::kDof - 1).norm() < 1e-3);
}

TEST_CASE_TEMPLATE("motion vote: whitening", Pose, SE2, SE3) {
  Witness<Pose> witness = {};
  witness.rows = 2;
  const double S[9] = {4, 2, 0, 0, 3, 0, 0, 0, 0}, residual[3] = {2, 3, 77};
  typename Witness<Pose>::ByPose J = Witness<Pose>::ByPose::Constant(1.0);
  REQUIRE(witness.whiten(residual, J, S, 3));
  CHECK(witness.r.squaredNorm() == doctest::Approx(3.0));  // r^T S^-1 r
  CHECK(witness.r[2] == 0.0);
  CHECK(witness.J.row(2).isZero(0.0));
  const double singular[9] = {1, 1, 0, 0, 1, 0, 0, 0, 0};
  CHECK(!witness.whiten(residual, J, singular, 3));
}

TEST_CASE_TEMPLATE("motion vote: a witness at another position, against numerical derivatives", Pose, SE2, SE3) {
  Random random(5);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const typename Pose::Point point = 5.0 * random.normal_vector<Pose::kDim>();
    const Pose before = Pose::exp(random.normal_vector<Pose::kDof>());
    const Pose move = Pose::exp(random.normal_vector<Pose::kDof>()), after = before * move;
    Witness<Pose> witness = {};
    witness.rows = Pose::kDim;
    witness.position = before.translation();
    witness.J = point_jacobian(before, point);
    witness.move_to(after.translation());
    // The error of the pose after the motion, in the observation that was made before it.
    const auto expected = cairn::test::pose_jacobian(
        [&](const Pose& at) {
          const Pose then = at * move.inverse();
          return typename Pose::Point(then.rotation().inverse() * (point - then.translation()));
        },
        after);
    CHECK((witness.J.template topRows<Pose::kDim>() - expected).norm() < 1e-8);
    CHECK(witness.position == after.translation());
  }
}

// A known point, seen from a vehicle whose pose is `motion` off; without noise.
template <class Pose>
Witness<Pose> placed_witness(const Pose& estimate, const typename Pose::Tangent& motion,
                             const typename Pose::Point& point) {
  const Pose truth = retract(estimate, motion);
  Witness<Pose> witness = {};
  witness.position = estimate.translation();
  const typename Pose::Point arm = estimate.rotation() * (truth.rotation().inverse() * (point - truth.translation()));
  const typename Pose::Point difference = point - estimate.translation() - arm;
  const double sigma = 0.05;
  REQUIRE(witness.place(difference, arm, sigma * sigma * Eigen::Matrix<double, Pose::kDim, Pose::kDim>::Identity()));
  return witness;
}

TEST_CASE_TEMPLATE("motion vote: placed points are exact for motions of any size", Pose, SE2, SE3) {
  Random random(11);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Pose estimate = Pose::exp(random.normal_vector<Pose::kDof>());
    typename Pose::Tangent motion = random.normal_vector<Pose::kDof>();
    motion.template tail<Pose::kTurn>() *= 0.4;
    std::vector<Witness<Pose>> placed, linear;
    for (int a = 0; a < 12; ++a) {
      placed.push_back(
          placed_witness(estimate, motion, typename Pose::Point(8.0 * random.normal_vector<Pose::kDim>())));
      linear.push_back(placed.back());
      linear.back().placed = false;
      CHECK(placed.back().distance(motion) < 1e-18 * 64 * 64 / (0.05 * 0.05));
    }
    const BoundsByRows bounds = {0, 10.8, 13.8, 16.3};
    const MotionVote<Pose> vote = vote_motion(placed.data(), 12, bounds);
    CHECK(vote.agreeing == 12);
    CHECK((vote.motion - motion).norm() < 1e-4);
    if (motion.template tail<Pose::kTurn>().norm() > 0.4) CHECK(vote_motion(linear.data(), 12, bounds).agreeing < 12);
  }
}

TEST_CASE_TEMPLATE("motion vote: a placed point at another position, and its Jacobian", Pose, SE2, SE3) {
  Random random(12);
  const Pose estimate = Pose::exp(random.normal_vector<Pose::kDof>());
  typename Pose::Tangent motion = 0.3 * random.normal_vector<Pose::kDof>();
  Witness<Pose> witness = placed_witness(estimate, motion, typename Pose::Point(random.normal_vector<Pose::kDim>()));
  for (int i = 0; i < Pose::kDof; ++i) {  // the Jacobian takes turns on the left
    const double h = 1e-6;
    typename Pose::Tangent step = Pose::Tangent::Zero();
    step[i] = h;
    const Pose at = retract(Pose(), motion);
    const auto plus = pose_error(retract(at, step), Pose());
    const auto minus = pose_error(retract(at, typename Pose::Tangent(-step)), Pose());
    const typename Witness<Pose>::Rows slope = (witness.residual(minus) - witness.residual(plus)) / (2 * h);
    CHECK((slope - witness.jacobian(motion).col(i)).norm() < 1e-6);
  }
  // The same error of a vehicle that has moved on by `move`: what it turns, it turns about the place of the sighting.
  const Pose move = Pose::exp(random.normal_vector<Pose::kDof>());
  const Pose after = estimate * move, truth_after = retract(estimate, motion) * move;
  witness.move_to(after.translation());
  CHECK(witness.distance(pose_error(truth_after, after)) < 1e-18 / (0.05 * 0.05));
}
