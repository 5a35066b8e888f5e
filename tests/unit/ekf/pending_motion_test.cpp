// SPDX-License-Identifier: BSD-3-Clause
// Motion that is held back, against a dense covariance to which each motion is applied at once.
#include "ekf/pending_motion.hpp"

#include <doctest/doctest.h>

#include <algorithm>
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

// A covariance with two companions and four points, in memory whose upper half and padding hold NaN. The motion depends
// on all but the last one of the systematic errors.
template <class Pose>
struct Held {
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  static constexpr Index kCompanions = 2, kPoints = 4;
  using Point = typename Pose::Point;
  using Square = typename Pose::Square;

  Held(ErrorKind error, unsigned seed, Index errors = 0)
      : model(error),
        systematic(errors),
        moving(kDof + errors),
        n(StateLayout<Pose>::states(kCompanions, kPoints, errors)),
        ld(n + 3),
        arena(bytes(error, ld, errors)),
        motion(arena, model, ld, errors),
        memory(static_cast<std::size_t>(ld * n), kNaN),
        P(memory.data(), ld),
        random(seed) {
    layout.clear(errors);
    for (Index i = 0; i < errors; ++i) walk.push_back(0.1 * static_cast<double>(i % 3));
    motion.set_systematic(errors, std::max<Index>(0, errors - 1), walk.data());
    motion.clear();
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
  static std::size_t bytes(ErrorKind error, Index ld, Index errors) {
    Arena measure;
    const PendingMotion<Pose> unused(measure, ErrorModel<Pose>(error), ld, errors);
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
    MotionCoupling<Pose> coupling;
    coupling.dt = 0.7;
    for (Index i = 0; i < motion.motion(); ++i) coupling.J.col(i) = random.normal_vector<kDof>();
    REQUIRE(motion.add(pose, next, increment, systematic > 0 ? &coupling : nullptr));
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
    // The systematic errors that motion depends on are errors of the increment, too (docs/systematic_errors.md, eq. 5).
    F.middleCols(kDof, motion.motion()) += L * coupling.J.leftCols(motion.motion());
    dense = (F * dense * F.transpose() + L * increment.covariance * L.transpose()).eval();
    for (Index i = 0; i < systematic; ++i) dense(kDof + i, kDof + i) += walk[static_cast<std::size_t>(i)] * coupling.dt;
    pose = next;
  }
  // P_now from the parts of the held motion, combined like in an update.
  Dynamic assembled() {
    motion.prepare(layout, points.data(), P);
    std::vector<double> columns(static_cast<std::size_t>(ld * moving), kNaN);
    motion.moving_columns(P, n, columns.data());
    std::vector<double> now = memory, workspace(update_triangle_workspace(n, 2 * kTurn));
    const TriangleTerm terms[] = {motion.term(), motion.second_term()};
    update_triangle(now.data(), ld, n, terms, motion.turns() ? 2 : 1, workspace.data());
    Dynamic out(n, n);
    for (Index c = 0; c < n; ++c)
      for (Index r = c; r < n; ++r)
        out(r, c) = out(c, r) =
            c < moving ? columns[static_cast<std::size_t>(c * ld + r)] : now[static_cast<std::size_t>(c * ld + r)];
    return out;
  }

  ErrorModel<Pose> model;
  Index systematic, moving, n, ld;
  std::vector<double> walk;
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
    held.motion.prepare(held.layout, held.points.data(), held.P);
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

TEST_CASE_TEMPLATE("pending motion: systematic errors move pose and points with all their correlations", Pose, SE2,
                   SE3) {
  constexpr int kDof = Pose::kDof, kTurn = Pose::kTurn;
  for (const ErrorKind error : kBoth)
    for (unsigned seed = 1; seed <= 5; ++seed) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(seed);
      Held<Pose> held(error, seed, 4);
      CHECK((held.assembled() - held.dense).norm() == 0);
      for (int step = 0; step < 6; ++step) {
        held.move();
        CHECK(held.motion.turns() == (error == ErrorKind::invariant));
        const Dynamic now = held.assembled();
        CHECK((now - held.dense).norm() < 1e-12 * held.dense.norm());
        const Dynamic block = held.motion.pose_block(held.P), corner = held.dense.topLeftCorner(kDof, kDof);
        CHECK((block - corner).norm() < 1e-12 * corner.norm());
        std::vector<double> row(static_cast<std::size_t>(held.moving));
        for (Index i = 0; i < held.systematic; ++i) {
          held.motion.systematic_row(held.P, i, row.data());
          const Eigen::Map<const Eigen::VectorXd> as_vector(row.data(), held.moving);
          const Eigen::VectorXd expected = held.dense.row(kDof + i).head(held.moving).transpose();
          CHECK((as_vector - expected).norm() < 1e-12 * held.dense.norm());
        }
        // What add_change() adds to a point's column is the change of the covariance.
        const Index from = held.layout.point(1).offset;
        std::vector<double> column(static_cast<std::size_t>(held.n), 0.0);
        held.motion.add_change(from, held.n, column.data());
        for (Index r = held.moving; r < held.n; ++r)
          CHECK(column[static_cast<std::size_t>(r)] ==
                doctest::Approx(now(r, from) - held.P.symmetric(r, from)).epsilon(1e-9).scale(held.dense.norm()));
      }
      CHECK(held.motion.rank() == (error == ErrorKind::invariant ? kTurn : 0));
    }
}

TEST_CASE_TEMPLATE("pending motion: a snapshot brings the systematic errors back", Pose, SE2, SE3) {
  for (const ErrorKind error : kBoth) {
    Held<Pose> held(error, 9, 4);
    held.move();
    const Dynamic before = held.assembled();
    const auto snapshot = held.motion.snapshot();
    held.move();
    CHECK((held.assembled() - before).norm() > 0);
    held.motion.restore(snapshot);
    CHECK(held.assembled() == before);
    MotionCoupling<Pose> bad;
    bad.J(0, 0) = kNaN;
    const Increment<Pose> good = held.random_increment();
    CHECK_FALSE(held.motion.add(held.pose, held.pose * good.T_before_after, good, &bad));
    CHECK(held.assembled() == before);
  }
}

// With truth s = s_hat + d the own error of pose and points is C d to first order: the coupling itself, by differences.
TEST_CASE_TEMPLATE("pending motion: the coupling is the derivative of the own error", Pose, SE2, SE3) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Tangent = typename Pose::Tangent;
  for (const ErrorKind error : kBoth)
    for (unsigned seed = 1; seed <= 5; ++seed) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(seed);
      Random random(seed);
      const ErrorModel<Pose> model(error);
      Arena measure;
      const PendingMotion<Pose> unused(measure, model, 40, kDof);
      Arena arena(measure.used());
      PendingMotion<Pose> motion(arena, model, 40, kDof);
      const std::vector<double> walk(kDof, 0.0);
      motion.set_systematic(kDof, kDof, walk.data());
      motion.clear();
      const Pose start(Pose::Rotation::exp(random.normal_vector<kTurn>()),
                       typename Pose::Point(3 * random.normal_vector<kDim>()));
      const typename Pose::Point landmark = 5 * random.normal_vector<kDim>();
      std::vector<Tangent> twists;
      Pose pose = start;
      for (int k = 0; k < 5; ++k) {
        twists.push_back(random.normal_vector<kDof>());
        typename Pose::Square J;
        const Increment<Pose> step = integrate_twist<Pose>(twists.back(), 0.3, Pose::Square::Identity(), &J);
        MotionCoupling<Pose> coupling;
        coupling.dt = 0.3;
        coupling.J.template leftCols<kDof>() = -J;
        const Pose next = pose * step.T_before_after;
        REQUIRE(motion.add(pose, next, step, &coupling));
        pose = next;
      }
      const auto own_error = [&](const Tangent& bias) {
        Pose truth = start;
        for (const Tangent& twist : twists) truth = truth * Pose::exp(Tangent(0.3 * (twist - bias)));
        Eigen::Matrix<double, kDof + kDim, 1> out;
        const Tangent xi = model.error(truth, pose);
        out.template head<kDof>() = xi;
        // The landmark stays: l = Exp(xi_R) l_hat + J_l(xi_R) xi_l with l = l_hat.
        const typename Pose::Rotation::Tangent turn = xi.template tail<kTurn>();
        const typename Pose::Point moved = Pose::Rotation::exp(turn) * landmark;
        out.template tail<kDim>().setZero();
        if (error == ErrorKind::invariant)
          out.template tail<kDim>() = Pose::Rotation::translation_jacobian_inverse(turn) * (landmark - moved);
        return out;
      };
      const auto J = jacobian_at_zero<kDof>(own_error);
      const Dynamic C = motion.C().template leftCols<kDof>();
      CHECK((J.template topRows<kDof>() - C).norm() < 1e-7 * C.norm());
      Dynamic by_turn = Dynamic::Zero(kDim, kDof);
      if (error == ErrorKind::invariant) by_turn = -model.arm(landmark) * C.bottomRows(kTurn);
      CHECK((J.template bottomRows<kDim>() - by_turn).norm() < 1e-7 * C.norm());
    }
}
