// SPDX-License-Identifier: BSD-3-Clause
// The covariance of a state between and around updates: motion held back, marginals, pivots, and refusals that must
// change nothing.
#include "ekf/state.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "core/error.hpp"
#include "reference_scenario.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

constexpr ErrorKind kBoth[] = {ErrorKind::invariant, ErrorKind::standard};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::unique_ptr<Arena> arena_for(ErrorKind error, const State<SE3>::Capacity& capacity) {
  Arena measure;
  const State<SE3> unused(measure, error, capacity);
  return std::make_unique<Arena>(measure.used());
}

// A State and a reference that place and remove the same landmarks, without a Filter between.
struct Bare {
  explicit Bare(ErrorKind error, const SE3& pose, const Matrix6& covariance)
      : invariant(error == ErrorKind::invariant),
        origin(pose.translation()),
        arena(arena_for(error, capacity)),
        state(*arena, error, capacity),
        reference({error == ErrorKind::invariant, 1}, pose, covariance) {
    state.start(pose, covariance);
  }

  bool move(const Increment<SE3>& step) {
    reference.predict_increment(step.T_before_after, step.covariance);
    return state.propagate(step);
  }
  void place(const Vector3& z) {
    Placement<SE3> p;
    sensor.place(state.pose(), z, Vector2::Zero(), p);
    REQUIRE(state.augment(p.landmark, p.J_landmark_pose, p.J_landmark_z * sensor.noise() * p.J_landmark_z.transpose(),
                          true));
    reference.update_frame(sensor, {{next_id++, z, sensor.noise()}});
  }
  // The whole covariance, in the filter's own coordinates; slots in their order.
  Dynamic covariance() const {
    Dynamic P(state.states(), state.states());
    std::vector<Index> all;
    for (Index i = 0; i < state.size(); ++i) all.push_back(i);
    state.gather(all.data(), state.size(), P.data(), P.rows());
    return P;
  }
  // The covariance of the reference, whose coordinates count from the map's origin and not from the start: xi_x +
  // G(start) xi_R.
  Dynamic expected_covariance() const {
    const Dynamic& P = reference.covariance();
    Dynamic shift = Dynamic::Identity(P.rows(), P.rows());
    for (Index row = 0; invariant && row < P.rows(); row += row == 0 ? 6 : 3)
      shift.block<3, 3>(row, 3) += SO3::turn(origin);
    return shift * P * shift.transpose();
  }
  double difference() const {
    const Dynamic expected = expected_covariance();
    const Dynamic scale = expected.diagonal().cwiseSqrt() * expected.diagonal().cwiseSqrt().transpose();
    return (covariance() - expected).cwiseQuotient(scale).cwiseAbs().maxCoeff();
  }

  static constexpr State<SE3>::Capacity capacity{12, 6};
  Cartesian<SE3> sensor = scenario_points();
  bool invariant;
  Vector3 origin;
  std::unique_ptr<Arena> arena;
  State<SE3> state;
  ReferenceFilter reference;
  std::uint64_t next_id = 0;
};

Increment<SE3> random_step(Random& random) {
  Vector6 tau;
  tau << 0.5 * random.normal_vector<3>(), 0.2 * random.normal_vector<3>();
  return {SE3::exp(tau), random_covariance(random, 0.05, 0.02)};
}

SE3 random_pose(Random& random) {
  return SE3{SO3::exp(random.normal_vector<3>()), 10 * random.normal_vector<3>()};
}

}  // namespace

TEST_CASE("state: motion that is held back equals motion applied at every step") {
  for (ErrorKind error : kBoth) {
    CAPTURE(static_cast<int>(error));
    Random random(1);
    Bare bare{error, random_pose(random), random_covariance(random, 0.5, 0.1)};
    for (int i = 0; i < 40; ++i) {
      CAPTURE(i);
      REQUIRE(bare.move(random_step(random)));
      CHECK(bare.difference() < 1e-10);
      if (i % 7 == 2) bare.place(5 * random.normal_vector<3>());  // with motion pending
      if (i % 7 == 4) {
        CHECK(bare.state.smallest_pivot() > 0);  // applies the motion, changes nothing else
        CHECK(bare.difference() < 1e-10);
      }
      if (i == 24) {
        bare.state.remove(bare.state.size() - 1);  // with motion pending
        bare.reference.remove(bare.next_id - 1);
        CHECK(bare.difference() < 1e-10);
      }
    }
    CHECK(bare.state.size() == 5);
  }
}

TEST_CASE("state: marginals are blocks of the whole, in any order") {
  for (ErrorKind error : kBoth) {
    Random random(2);
    Bare bare{error, random_pose(random), random_covariance(random, 0.5, 0.1)};
    for (int i = 0; i < 6; ++i) {
      bare.place(5 * random.normal_vector<3>());
      bare.move(random_step(random));
    }
    const Dynamic whole = bare.covariance(), ordinary = bare.reference.ordinary_covariance();
    const std::vector<Index> slots = {4, 0, 3};
    Dynamic part(15, 15), part_ordinary(15, 15);
    bare.state.gather(slots.data(), 3, part.data(), 15);
    bare.state.gather_ordinary(slots.data(), 3, part_ordinary.data(), 15);
    const auto place_of = [&](Index i) {
      return i < 6 ? i : 6 + 3 * slots[static_cast<std::size_t>(i / 3 - 2)] + i % 3;
    };
    for (Index c = 0; c < 15; ++c)
      for (Index r = 0; r < 15; ++r) {
        CHECK(part(r, c) == doctest::Approx(whole(place_of(r), place_of(c))).epsilon(1e-12));
        CHECK(part(r, c) == part(c, r));
        CHECK(part_ordinary(r, c) == doctest::Approx(ordinary(place_of(r), place_of(c))).epsilon(1e-9));
        CHECK(part_ordinary(r, c) == part_ordinary(c, r));
      }
    CHECK((bare.state.pose_covariance() - part_ordinary.topLeftCorner<6, 6>()).norm() == 0);
    CHECK((bare.state.landmark_covariance(3) - ordinary.block<3, 3>(15, 15)).norm() < 1e-9 * ordinary.norm());
  }
}

TEST_CASE("state: NEES of the pose in the filter's own coordinates") {
  for (ErrorKind error : kBoth) {
    Random random(3);
    const SE3 start = random_pose(random);
    Bare bare(error, start, random_covariance(random, 0.5, 0.1));
    bare.move(random_step(random));
    const SE3& estimate = bare.state.pose();
    Vector6 xi;
    xi << 0.3, -0.2, 0.4, 0.1, -0.05, 0.2;
    const Vector3 turn = xi.tail<3>(), shift = xi.head<3>();
    // X X_hat^-1 = Exp(xi), or its parts one by one.
    const SE3 truth = error == ErrorKind::invariant
                          ? SE3::exp(xi) * estimate
                          : SE3(SO3::exp(turn) * estimate.rotation(), estimate.translation() + shift);
    const Matrix6 P = bare.reference.covariance();
    CHECK(bare.state.pose_nees(truth) == doctest::Approx(xi.dot(P.llt().solve(xi))).epsilon(1e-9));
    CHECK(bare.state.pose_nees(estimate) == doctest::Approx(0).scale(1e-9));
    Matrix6 singular = Matrix6::Identity();
    singular(4, 4) = 0;
    bare.state.start(start, singular);
    CHECK(bare.state.pose_nees(truth) < 0);
  }
}

// Rounding decides nothing: a covariance of low rank is singular wherever the vehicle stands, whatever its units.
template <class Pose>
void check_nees_of_low_rank(ErrorKind error) {
  constexpr int dof = Pose::kDof;
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  const auto random = [&](int columns) {
    Eigen::Matrix<double, dof, Eigen::Dynamic> m(dof, columns);
    for (Index i = 0; i < m.size(); ++i) m(i) = normal(engine);
    for (int i = 0; i < dof; ++i) m.row(i) *= (i < Pose::kDim ? 1.0 : 0.01) * std::pow(10.0, 0.5 * normal(engine));
    return m;
  };
  int accepted = 0;
  for (int n = 0; n < 2000; ++n) {
    typename Pose::Tangent at = random(1);
    at.template head<Pose::kDim>() *= std::pow(10.0, n % 5);
    const Pose estimate = Pose::exp(at);
    const Pose truth = Pose::exp(1e-3 * random(1)) * estimate;
    const typename Pose::Point origin = Pose::Point::Zero();
    const auto J = random(1 + n % (dof - 1));  // of rank 1 to dof - 1
    accepted += State<Pose>::nees(error, origin, truth, estimate, J * J.transpose()) >= 0;
    const auto full = random(2 * dof);
    const typename Pose::Square P = full * full.transpose();
    if (n % 5 > 2) continue;  // rounding of the comparison below
    const ErrorModel<Pose> model(error);
    const auto xi = model.error(truth, estimate);
    const auto own = model.own(P, estimate.translation());
    CHECK(State<Pose>::nees(error, origin, truth, estimate, P) ==
          doctest::Approx(xi.dot(own.ldlt().solve(xi))).epsilon(1e-3));
  }
  CHECK(accepted == 0);
}

TEST_CASE("state: NEES of a covariance of low rank") {
  for (ErrorKind error : kBoth) {
    check_nees_of_low_rank<SE2>(error);
    check_nees_of_low_rank<SE3>(error);
  }
}

TEST_CASE("state: the smallest pivot is that of the scaled covariance, and looking at it changes nothing") {
  for (ErrorKind error : kBoth) {
    Random random(4);
    Bare bare{error, random_pose(random), random_covariance(random, 0.5, 0.1)};
    for (int i = 0; i < 5; ++i) {
      bare.move(random_step(random));
      bare.place(5 * random.normal_vector<3>());
    }
    const double pivot = bare.state.smallest_pivot();
    const Dynamic P = bare.covariance();
    const DynamicVector scale = P.diagonal().cwiseSqrt().cwiseInverse();
    const Dynamic scaled = scale.asDiagonal() * P * scale.asDiagonal();
    const Dynamic L = scaled.llt().matrixL();
    CHECK(pivot == doctest::Approx(L.diagonal().cwiseAbs2().minCoeff()).epsilon(1e-8));
    CHECK(bare.state.smallest_pivot() == pivot);
    CHECK((bare.covariance() - P).norm() == 0);
  }
  Bare bare(ErrorKind::standard, SE3(), Matrix6::Zero());
  CHECK(bare.state.smallest_pivot() == 1);  // everything is exactly known
  Matrix6 indefinite = Matrix6::Identity();
  indefinite(1, 0) = indefinite(0, 1) = 2;
  bare.state.start(SE3(), indefinite);
  CHECK(bare.state.smallest_pivot() == doctest::Approx(-3));
}

TEST_CASE("state: rounding of a covariance of low rank is not taken for a negative pivot") {
  Random random(6);
  double smallest = 1;
  for (int n = 0; n < 20000; ++n) {
    const Eigen::Matrix<double, 6, Eigen::Dynamic> J =
        Eigen::Matrix<double, 6, Eigen::Dynamic>::NullaryExpr(6, 1 + n % 5, [&] { return random.normal(); });
    Bare bare(ErrorKind::standard, SE3(), J * J.transpose());
    smallest = std::min(smallest, bare.state.smallest_pivot());
  }
  CHECK(smallest > -1e-12);
  // A negative eigenvalue behind a pivot of zero is found all the same.
  Matrix6 indefinite = Matrix6::Identity();
  indefinite(0, 1) = indefinite(1, 0) = 1;
  indefinite(0, 2) = indefinite(2, 0) = 1e-4;
  Bare bare(ErrorKind::standard, SE3(), indefinite);
  CHECK(bare.state.smallest_pivot() < -1);
}

TEST_CASE("state: what is not finite is refused, with nothing changed") {
  for (ErrorKind error : kBoth) {
    Random random(5);
    Bare bare{error, random_pose(random), random_covariance(random, 0.5, 0.1)};
    bare.place(Vector3(3, 1, -2));
    bare.move(random_step(random));
    const Dynamic before = bare.covariance();
    const SE3 pose = bare.state.pose();
    Increment<SE3> step = random_step(random);
    step.covariance(2, 2) = kNaN;
    CHECK_FALSE(bare.state.propagate(step));
    CHECK_FALSE(bare.state.propagate({SE3(SO3(), Vector3(0, kNaN, 0)), Matrix6::Zero()}));
    CHECK_FALSE(bare.state.augment(Vector3(kNaN, 0, 0), Matrix36::Zero(), Matrix3::Identity(), true));
    CHECK_FALSE(bare.state.augment(Vector3::Zero(), Matrix36::Zero(), Matrix3::Constant(kNaN), true));
    CHECK(bare.state.size() == 1);
    CHECK((bare.state.pose().translation() - pose.translation()).norm() == 0);
    CHECK((bare.state.pose().rotation().matrix() - pose.rotation().matrix()).norm() == 0);
    CHECK((bare.covariance() - before).norm() == 0);
  }
}

TEST_CASE("ekf: an update that would lose positive definiteness leaves everything bit for bit") {
  for (ErrorKind error : kBoth) {
    Random random(6);
    FilterOptions<SE3> options = random_options(error, random);
    Pair pair(options), twin(options);  // the twin never sees the bad update
    Drive drive(60, options), same(60, options);
    const StereoHead head = scenario_head(0.02, true);
    for (Pair* each : {&pair, &twin}) {
      Drive& own = each == &pair ? drive : same;
      each->add(head);
      for (int i = 0; i < 3; ++i) {
        own.move(*each);
        each->update(0, own.look(head, 5));
      }
      own.move(*each);  // motion is pending
    }
    const auto bits = [](Pair& each) {
      std::vector<double> all(4096, 0.0);
      const Filter<SE3>& f = each.filter();
      std::vector<std::size_t> indices(f.landmarks().size());
      for (std::size_t i = 0; i < f.landmarks().size(); ++i) indices[i] = i;
      double* at = all.data() + 3600;
      f.pose_joint_covariance(indices.data(), indices.size(), all.data());
      std::memcpy(at, f.pose().translation().data(), 24);
      std::memcpy(at + 3, f.pose().rotation().quaternion().coeffs().data(), 32);
      for (std::size_t i = 0; i < f.landmarks().size(); ++i) {
        std::memcpy(at + 7 + 3 * i, f.landmarks().position(i).data(), 24);
        at[100 + i] = static_cast<double>(f.landmarks().observations(i));
      }
      at[99] = f.report().nis;
      return all;
    };
    const auto equal = [&] {
      const std::vector<double> a = bits(pair), b = bits(twin);
      return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
    };
    REQUIRE(equal());
    // "Noise" of -P/2, which no caller can pass through the C interface, leaves S = P/2, and P - P S^-1 P = -P. Then
    // S that is negative itself, and a step to infinity.
    const std::uint64_t id = pair.reference().ids()[1];
    std::size_t index = 0;
    REQUIRE(pair.filter().landmarks().find(id, index));
    const Matrix3 P = pair.filter().landmarks().covariance(index), half = -0.5 * P, twice = -2 * P, usual = 0.01 * P;
    const double J[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, residual[3] = {0.1, 0, 0.2}, far[3] = {1e153, 0, 0};
    CHECK_THROWS_AS(pair.filter().update_linear({residual, 3, half.data(), nullptr, &id, 1, J}), Error);
    CHECK(equal());
    CHECK_THROWS_AS(pair.filter().update_linear({residual, 3, twice.data(), nullptr, &id, 1, J}), Error);
    CHECK(equal());
    const double steep[9] = {1e-160, 0, 0, 0, 1, 0, 0, 0, 1};
    CHECK_THROWS_AS(pair.filter().update_linear({far, 3, usual.data(), nullptr, &id, 1, steep}), Error);
    CHECK(equal());
    const Matrix3 pose_half = -0.5 * pair.filter().pose_covariance().topLeftCorner<3, 3>();
    CHECK_THROWS_AS(pair.filter().update_position(drive.truth().translation(), pose_half, Vector3::Zero()), Error);
    CHECK(equal());
    // The next steps are the same as without the refused calls.
    CHECK(pair.update(0, drive.look(head, 6)));
    CHECK(twin.update(0, same.look(head, 6)));
    CHECK(equal());
  }
}
