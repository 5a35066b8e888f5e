// SPDX-License-Identifier: BSD-3-Clause
// Motion that is held back, against a dense covariance to which each motion is applied at once.
#include "ekf/pending_motion.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "ekf/sample_state.hpp"
#include "numerical.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

using Dynamic = Eigen::MatrixXd;
constexpr ErrorKind kBoth[] = {ErrorKind::invariant, ErrorKind::standard};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A covariance with two companions and four points, in memory whose upper half and padding hold NaN.
template <class Pose>
struct Held {
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  static constexpr Index kCompanions = 2, kPoints = 4;
  using Point = typename Pose::Point;
  using Square = typename Pose::Square;

  Held(ErrorKind error, unsigned seed)
      : model(error),
        n(StateLayout<Pose>::states(kCompanions, kPoints)),
        ld(n + 3),
        arena(bytes(error, ld)),
        motion(arena, model, ld),
        memory(static_cast<std::size_t>(ld * n), kNaN),
        P(memory.data(), ld),
        random(seed) {
    for (Index k = 0; k < kCompanions; ++k) layout.add_companion();
    layout.add_points(kPoints);
    Dynamic half(n, n);
    for (Index c = 0; c < n; ++c)
      for (Index r = 0; r < n; ++r) half(r, c) = random.normal();
    dense = half * half.transpose();
    for (Index c = 0; c < n; ++c)
      for (Index r = c; r < n; ++r) P(r, c) = dense(r, c);
    for (Index i = 0; i < kDim * kPoints; ++i) points.push_back(5 * random.normal());
    pose = Pose(Pose::Rotation::exp(random.normal_vector<kTurn>()), Point(3 * random.normal_vector<kDim>()));
  }
  static std::size_t bytes(ErrorKind error, Index ld) {
    Arena measure;
    const PendingMotion<Pose> unused(measure, ErrorModel<Pose>(error), ld);
    return measure.used();
  }

  Point point(Index slot) const { return Eigen::Map<const Point>(points.data() + kDim * slot); }
  Increment<Pose> random_increment() {
    Increment<Pose> increment;
    increment.T_before_after =
        Pose(Pose::Rotation::exp(0.4 * random.normal_vector<kTurn>()), Point(random.normal_vector<kDim>()));
    increment.covariance = random_square<kDof>(random, 0.3);
    return increment;
  }
  // Both the held motion and the dense covariance.
  void move() {
    const Increment<Pose> increment = random_increment();
    const Pose next = pose * increment.T_before_after;
    REQUIRE(motion.add(pose, next, increment));
    Dynamic F = Dynamic::Identity(n, n), L = Dynamic::Zero(n, kDof);
    L.topLeftCorner(kDim, kDim) = pose.rotation().matrix();
    const Eigen::Matrix<double, kTurn, kTurn> turn = pose.rotation().adjoint();
    L.block(kDim, kDim, kTurn, kTurn) = turn;
    if (model.invariant()) {  // xi_x = e_x - G(x) xi_R, for the vehicle and for every point
      L.block(0, kDim, kDim, kTurn) = -Pose::Rotation::turn(next.translation()) * turn;
      for (Index slot = 0; slot < kPoints; ++slot)
        L.block(layout.point(slot).offset, kDim, kDim, kTurn) = -Pose::Rotation::turn(point(slot)) * turn;
    } else {
      F.block(0, kDim, kDim, kTurn) = Pose::Rotation::turn(next.translation() - pose.translation());
    }
    dense = (F * dense * F.transpose() + L * increment.covariance * L.transpose()).eval();
    pose = next;
  }
  // P_now from the parts of the held motion, combined like in an update.
  Dynamic assembled() {
    motion.prepare(layout, points.data());
    std::vector<double> columns(static_cast<std::size_t>(ld * kDof), kNaN);
    motion.pose_columns(P, n, columns.data());
    std::vector<double> now = memory, workspace(update_triangle_workspace(n, kTurn));
    const TriangleTerm term = motion.term();
    update_triangle(now.data(), ld, n, &term, 1, workspace.data());
    Dynamic out(n, n);
    for (Index c = 0; c < n; ++c)
      for (Index r = c; r < n; ++r)
        out(r, c) = out(c, r) =
            c < kDof ? columns[static_cast<std::size_t>(c * ld + r)] : now[static_cast<std::size_t>(c * ld + r)];
    return out;
  }

  ErrorModel<Pose> model;
  Index n, ld;
  Arena arena;
  PendingMotion<Pose> motion;
  std::vector<double> memory, points;
  LowerTriangle P;
  StateLayout<Pose> layout;
  Random random;
  Dynamic dense;
  Pose pose;
};

}  // namespace

TEST_CASE_TEMPLATE("pending motion: P_now is the covariance that went through every motion", Pose, SE2, SE3) {
  constexpr int kDof = Pose::kDof;
  for (const ErrorKind error : kBoth)
    for (unsigned seed = 1; seed <= 5; ++seed) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(seed);
      Held<Pose> held(error, seed);
      CHECK_FALSE(held.motion.any());
      CHECK((held.assembled() - held.dense).norm() == 0);
      CHECK(held.motion.rank() == 0);
      for (int step = 0; step < 6; ++step) {
        held.move();
        CHECK(held.motion.any());
        CHECK(held.motion.reaches_points() == (error == ErrorKind::invariant));
        const Dynamic now = held.assembled();
        CHECK((now - held.dense).norm() < 1e-12 * held.dense.norm());
        CHECK(held.motion.rank() == (error == ErrorKind::invariant ? Pose::kTurn : 0));
        const Dynamic block = held.motion.pose_block(held.P), corner = held.dense.topLeftCorner(kDof, kDof);
        CHECK((block - corner).norm() < 1e-12 * corner.norm());
        CHECK(block == block.transpose());
      }
    }
}

TEST_CASE_TEMPLATE("pending motion: add_noise adds a column's part of U N U^T", Pose, SE2, SE3) {
  constexpr int kTurn = Pose::kTurn, kDof = Pose::kDof;
  for (const ErrorKind error : kBoth) {
    Held<Pose> held(error, 7);
    held.move();
    held.motion.prepare(held.layout, held.points.data());
    const Index n = held.n, ld = held.ld, stride = 2;
    std::vector<double> weights(static_cast<std::size_t>(stride * kTurn), kNaN), y(static_cast<std::size_t>(n), 1.0);
    for (int t = 0; t < kTurn; ++t) weights[static_cast<std::size_t>(stride * t)] = held.random.normal();
    held.motion.add_noise(held.motion.right(), weights.data(), stride, n, y.data());
    for (Index i = 0; i < n; ++i) {
      double expected = 1.0;
      for (int t = 0; t < kTurn && held.motion.rank() > 0 && i >= kDof; ++t)
        expected += weights[static_cast<std::size_t>(stride * t)] * held.motion.right()[t * ld + i];
      CHECK(y[static_cast<std::size_t>(i)] == doctest::Approx(expected).epsilon(1e-14));
    }
  }
}

TEST_CASE_TEMPLATE("pending motion: what is not finite is refused, and a snapshot brings everything back", Pose, SE2,
                   SE3) {
  for (const ErrorKind error : kBoth) {
    Held<Pose> held(error, 9);
    held.move();
    const Dynamic before = held.assembled();
    const auto snapshot = held.motion.snapshot();
    Increment<Pose> bad = held.random_increment();
    bad.covariance(1, 1) = kNaN;
    CHECK_FALSE(held.motion.add(held.pose, held.pose * bad.T_before_after, bad));
    const Increment<Pose> good = held.random_increment();
    const Pose nowhere(Pose().rotation(), Pose::Point::Constant(kNaN));
    CHECK_FALSE(held.motion.add(held.pose, nowhere, good));
    CHECK(held.assembled() == before);
    CHECK(held.motion.add(held.pose, held.pose * good.T_before_after, good));
    CHECK((held.assembled() - before).norm() > 0);
    held.motion.restore(snapshot);
    CHECK(held.assembled() == before);
    held.motion.clear();
    CHECK_FALSE(held.motion.any());
    CHECK(held.motion.F() == Pose::Square::Identity());
    CHECK(held.motion.N() == Pose::Square::Zero());
  }
}
