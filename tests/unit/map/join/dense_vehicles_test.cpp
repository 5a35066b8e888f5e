// SPDX-License-Identifier: BSD-3-Clause
// Submaps of several vehicles in one dense map: what a closing of one vehicle may not change of the others.
#include <doctest/doctest.h>

#include "core/error.hpp"
#include "ekf/ekf_update.hpp"
#include "map/join/dense/dense_map.hpp"
#include "numerical.hpp"

using namespace cairn;
using cairn::test::Random;

namespace {

template <class Pose>
typename Pose::Square random_noise(Random& random, double sigma) {
  typename Pose::Square A = Pose::Square::Identity();
  for (int i = 0; i < Pose::kDof; ++i) A.col(i) += 0.3 * random.normal_vector<Pose::kDof>();
  return sigma * sigma * A * A.transpose();
}

template <class Pose>
Pose random_pose(Random& random) {
  return Pose(Pose::Rotation::exp(random.normal_vector<Pose::kTurn>()),
              typename Pose::Point(10 * random.normal_vector<Pose::kDim>()));
}

template <class Pose>
StateCapacity<Pose> room() {
  return {12, 6, 3};
}

template <class Pose>
std::size_t bytes() {
  Arena measure;
  const State<Pose> unused(measure, ErrorKind::standard, room<Pose>());
  return measure.used();
}

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / (1e-300 + b.norm());
}

constexpr ErrorKind kBothErrors[] = {ErrorKind::invariant, ErrorKind::standard};

}  // namespace

// A submap is composed with the map: its ordinary errors depend on the base and on the fused landmarks. The ordinary
// errors of everything else stay what they were.
TEST_CASE_TEMPLATE("dense map: a composition changes no other vehicle", Pose, SE3, SE2) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  for (const ErrorKind error : kBothErrors)
    for (unsigned seed = 1; seed <= 10; ++seed) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(seed);
      Random random(seed);
      Arena arena(bytes<Pose>());
      State<Pose> state(arena, error, room<Pose>());
      state.start(random_pose<Pose>(random), random_noise<Pose>(random, 0.1));
      const auto place = [&] {
        const typename Pose::Point at = 10 * random.normal_vector<kDim>();
        typename State<Pose>::PointByPose J;
        J.template leftCols<kDim>().setIdentity();
        J.template rightCols<kTurn>() = Pose::Rotation::turn(at - state.pose().translation());
        REQUIRE(state.augment(at, J, 0.01 * State<Pose>::PointSquare::Identity(), true));
      };
      place();
      typename Pose::Square J = Pose::Square::Identity();
      REQUIRE(state.add_companion(random_pose<Pose>(random), J, random_noise<Pose>(random, 0.2)));
      REQUIRE(state.add_companion(random_pose<Pose>(random), Pose::Square::Zero(), random_noise<Pose>(random, 0.2)));
      state.activate(0);
      place();
      state.activate(1);
      place();

      const Index fused[] = {2, 4};
      typename State<Pose>::Handover handover;
      handover.T_base_end = random_pose<Pose>(random);
      handover.fused = fused;
      handover.fused_count = 2;
      const typename Pose::Point fresh[] = {typename Pose::Point(random.normal_vector<kDim>())};
      handover.fresh = fresh;
      handover.fresh_count = 1;
      constexpr Index kRest = kDof + kDim;
      handover.K = Eigen::MatrixXd::NullaryExpr(kRest, 2 * kDim, [&] { return random.uniform(-0.3, 0.3); });
      const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(kRest, kRest, [&] { return random.uniform(-0.1, 0.1); });
      handover.W = A * A.transpose() + 1e-3 * Eigen::MatrixXd::Identity(kRest, kRest);
      const typename Pose::Square first = state.companion_covariance(0), second = state.companion_covariance(1);
      const typename State<Pose>::PointSquare landmark = state.landmark_covariance(3);
      state.compose(handover);
      CHECK(difference(state.companion_covariance(0), first) < 1e-10);
      CHECK(difference(state.companion_covariance(1), second) < 1e-10);
      CHECK(difference(state.landmark_covariance(3), landmark) < 1e-10);
      CHECK(state.smallest_pivot() > 0);
    }
}

// Vehicles whose start is known exactly: the covariance of their positions is zero for each of them, whichever of them
// is the active one.
TEST_CASE_TEMPLATE("dense map: vehicles that are known exactly stay so", Pose, SE3, SE2) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Arena arena(bytes<Pose>());
    State<Pose> state(arena, ErrorKind::invariant, room<Pose>());
    state.start(random_pose<Pose>(random), Pose::Square::Zero());
    for (int k = 0; k < 3; ++k)
      REQUIRE(state.add_companion(random_pose<Pose>(random), Pose::Square::Zero(), Pose::Square::Zero()));
    REQUIRE(state.propagate({random_pose<Pose>(random), random_noise<Pose>(random, 0.3)}));
    state.activate(0);  // companion 0 is the vehicle that moved from now on
    CHECK(state.pose_covariance().isZero(0.0));
    for (Index k = 1; k < 3; ++k) CHECK(state.companion_covariance(k).isZero(0.0));
    CHECK(state.smallest_pivot() > 0);
  }
}

TEST_CASE("dense map: each vehicle is added once") {
  MapOptions<SE2> options;
  options.max_companions = 3;
  DenseMap<SE2> map(options);
  map.name_vehicle(7);
  map.add_vehicle(8, SE2(), Matrix3::Identity());
  for (const std::uint64_t number : {7u, 8u}) CHECK_THROWS_AS(map.add_vehicle(number, SE2(), Matrix3::Zero()), Error);
  CHECK(map.vehicle_base_covariance(8) == Matrix3::Identity());
  map.add_vehicle(9, SE2(), Matrix3::Zero());
}
