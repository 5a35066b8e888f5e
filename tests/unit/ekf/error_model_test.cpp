// SPDX-License-Identifier: BSD-3-Clause
// The filter's own error against the ordinary error: e_x = xi_x + G(x) xi_R (docs/invariant_error.md), by differences
// through the retraction. The rotations are zero, 1e-8, random and half a turn.
#include "ekf/error_model.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <vector>

#include "numerical.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

using Dynamic = Eigen::MatrixXd;
constexpr ErrorKind kBoth[] = {ErrorKind::invariant, ErrorKind::standard};
constexpr double kTolerance = 1e-10;

template <class Pose>
Pose moved(const ErrorModel<Pose>& model, const Pose& pose, const typename Pose::Tangent& error) {
  Pose result = pose;
  model.retract(error, result);
  return result;
}

template <int N>
Eigen::Matrix<double, N, N> random_square(Random& random) {
  Eigen::Matrix<double, N, N> A;
  for (int i = 0; i < N; ++i) A.col(i) = random.normal_vector<N>();
  return A * A.transpose();
}

// d[e_p; e_R] / d[xi_p; xi_R] of a pose at `position`.
template <class Pose>
typename Pose::Square ordinary_by_own(const ErrorModel<Pose>& model, const typename Pose::Point& position) {
  typename Pose::Square J = Pose::Square::Identity();
  if (model.invariant()) J.template topRightCorner<Pose::kDim, Pose::kTurn>() = Pose::Rotation::turn(position);
  return J;
}

// Rows that depend on pose and landmark in every way: on the relative position, on both positions, and on the attitude.
template <class Pose>
struct Rows {
  static constexpr int kRows = 3;
  using Value = Eigen::Matrix<double, kRows, 1>;
  Value operator()(const Pose& T, const typename Pose::Point& l) const {
    const typename Pose::Point body = T.inverse() * l, axis = T.rotation() * Pose::Point::UnitX();
    return Value(body[0] + 0.3 * T.translation()[1], body[1] - 0.7 * l[0] + axis[1],
                 0.1 * body[0] * body[1] + 2.0 * axis[0]);
  }
};

}  // namespace

TEST_CASE_TEMPLATE("error model: the ordinary error of a pose by its own error", Pose, SE2, SE3) {
  for (const ErrorKind kind : kBoth) {
    const ErrorModel<Pose> model(kind);
    CAPTURE(model.invariant());
    CHECK(model.kind() == kind);
    for (const Pose& pose : awkward_poses<Pose>(1)) {
      const auto ordinary = [&](const typename Pose::Tangent& xi) { return pose_error(moved(model, pose, xi), pose); };
      const typename Pose::Square numerical = jacobian_at_zero<Pose::kDof>(ordinary);
      const double size = 1 + pose.translation().norm();
      CHECK((numerical - ordinary_by_own(model, pose.translation())).norm() < kTolerance * size);
    }
  }
}

TEST_CASE_TEMPLATE("error model: the ordinary error of a point by its own error", Pose, SE2, SE3) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kBoth_ = kDim + kTurn;
  for (const ErrorKind kind : kBoth) {
    const ErrorModel<Pose> model(kind);
    CAPTURE(model.invariant());
    for (const Pose& pose : awkward_poses<Pose>(2)) {
      const typename Pose::Point x = pose.translation();
      const auto ordinary = [&](const Eigen::Matrix<double, kBoth_, 1>& xi) -> typename Pose::Point {
        const typename Pose::Rotation::Tangent turn = xi.template tail<kTurn>();
        const typename ErrorModel<Pose>::PointRetraction move_point(model, turn);
        return move_point(x, xi.template head<kDim>()) - x;
      };
      const Eigen::Matrix<double, kDim, kBoth_> numerical = jacobian_at_zero<kBoth_>(ordinary);
      CHECK((numerical - ordinary_by_own(model, x).template topRows<kDim>()).norm() < kTolerance * (1 + x.norm()));
    }
  }
}

TEST_CASE_TEMPLATE("error model: a pose's position moves as a point at the same place does", Pose, SE2, SE3) {
  Random random(3);
  for (const ErrorKind kind : kBoth) {
    const ErrorModel<Pose> model(kind);
    for (const typename Pose::Rotation::Tangent& turn : awkward_turns<Pose::kTurn>(4)) {
      const Pose pose(Pose::Rotation::exp(random.normal_vector<Pose::kTurn>()),
                      typename Pose::Point(10 * random.normal_vector<Pose::kDim>()));
      typename Pose::Tangent xi;
      xi << random.normal_vector<Pose::kDim>(), turn;
      const typename ErrorModel<Pose>::PointRetraction move_point(model, turn);
      const typename Pose::Point point = move_point(pose.translation(), xi.template head<Pose::kDim>());
      CHECK((moved(model, pose, xi).translation() - point).norm() < 1e-13 * (1 + pose.translation().norm()));
    }
  }
}

TEST_CASE_TEMPLATE("error model: error() is what retract() applied, up to half a turn", Pose, SE2, SE3) {
  Random random(5);
  for (const ErrorKind kind : kBoth) {
    const ErrorModel<Pose> model(kind);
    CAPTURE(model.invariant());
    for (const typename Pose::Rotation::Tangent& turn : awkward_turns<Pose::kTurn>(6)) {
      const double length = turn.norm();
      CAPTURE(length);
      const Pose pose(Pose::Rotation::exp(random.normal_vector<Pose::kTurn>()),
                      typename Pose::Point(10 * random.normal_vector<Pose::kDim>()));
      typename Pose::Tangent xi;
      xi << random.normal_vector<Pose::kDim>(), turn;
      const Pose truth = moved(model, pose, xi);
      const typename Pose::Tangent error = model.error(truth, pose);
      const double size = 1 + pose.translation().norm();
      if (length < 3.14159) CHECK((error - xi).norm() < 1e-12 * size);
      // Half a turn in either direction is the same rotation, and gives the same pose.
      CHECK(pose_error(moved(model, pose, error), truth).norm() < 1e-12 * size);
    }
  }
}

TEST_CASE_TEMPLATE("error model: own() and to_ordinary() are inverse to each other", Pose, SE2, SE3) {
  constexpr int kDof = Pose::kDof;
  using Square = typename Pose::Square;
  Random random(7);
  const auto no_point = [](const typename Pose::Point& position) { return [&position](Index) { return position; }; };
  for (const ErrorKind kind : kBoth) {
    const ErrorModel<Pose> model(kind);
    CAPTURE(model.invariant());
    for (const Pose& pose : awkward_poses<Pose>(8)) {
      const typename Pose::Point p = pose.translation();
      const double size = (1 + p.norm()) * (1 + p.norm());
      const Square P = random_square<kDof>(random);
      Square there = model.own(P, p);
      model.to_ordinary(0, no_point(p), there.data(), kDof);
      CHECK((there - P).norm() < 1e-13 * size * P.norm());
      Square ordinary = P;
      model.to_ordinary(0, no_point(p), ordinary.data(), kDof);
      CHECK((model.own(ordinary, p) - P).norm() < 1e-13 * size * P.norm());
      const Square J = ordinary_by_own(model, p);
      CHECK((ordinary - J * P * J.transpose()).norm() < 1e-13 * size * P.norm());
      if (!model.invariant()) CHECK(model.own(P, p) == P);
    }
  }
}

TEST_CASE_TEMPLATE("error model: to_ordinary() of pose and points is A M A^T, both triangles alike", Pose, SE2, SE3) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  Random random(9);
  for (const ErrorKind kind : kBoth)
    for (Index points = 0; points <= 4; ++points) {
      const ErrorModel<Pose> model(kind);
      CAPTURE(model.invariant());
      CAPTURE(points);
      const typename Pose::Point p = 5 * random.normal_vector<kDim>();
      std::vector<typename Pose::Point> x;
      for (Index i = 0; i < points; ++i) x.push_back(8 * random.normal_vector<kDim>());
      const Index n = kDof + kDim * points, ld = n + 2;
      Dynamic half(n, n);
      for (Index c = 0; c < n; ++c)
        for (Index r = 0; r < n; ++r) half(r, c) = random.normal();
      Dynamic M = half * half.transpose(), A = Dynamic::Identity(n, n);
      M = (0.5 * (M + M.transpose())).eval();
      if (model.invariant()) {
        A.block(0, kDim, kDim, kTurn) = Pose::Rotation::turn(p);
        for (Index i = 0; i < points; ++i)
          A.block(kDof + kDim * i, kDim, kDim, kTurn) = Pose::Rotation::turn(x[static_cast<std::size_t>(i)]);
      }
      Dynamic stored = Dynamic::Constant(ld, n, -7.25);
      stored.topRows(n) = M;
      model.to_ordinary(
          points, [&](Index i) { return i < 0 ? p : x[static_cast<std::size_t>(i)]; }, stored.data(), ld);
      const Dynamic result = stored.topRows(n), expected = A * M * A.transpose();
      CHECK((result - expected).norm() < 1e-13 * expected.norm());
      CHECK(result == result.transpose());
      CHECK(stored.bottomRows(2) == Dynamic::Constant(2, n, -7.25));
    }
}

TEST_CASE_TEMPLATE("error model: to_ordinary_point() is to_ordinary() for that point only", Pose, SE2, SE3) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  Random random(12);
  for (const ErrorKind kind : kBoth)
    for (Index point = 0; point < 3; ++point) {
      const ErrorModel<Pose> model(kind);
      CAPTURE(model.invariant());
      CAPTURE(point);
      const Index n = kDof + 3 * kDim, at = kDof + kDim * point;
      Dynamic half(n, n);
      for (Index c = 0; c < n; ++c)
        for (Index r = 0; r < n; ++r) half(r, c) = random.normal();
      const Dynamic M = half * half.transpose();
      const typename Pose::Point x = 8 * random.normal_vector<kDim>();
      Dynamic A = Dynamic::Identity(n, n), result = M;
      if (model.invariant()) A.block(at, kDim, kDim, kTurn) = Pose::Rotation::turn(x);
      model.to_ordinary_point(x, at, result);
      const Dynamic expected = A * M * A.transpose();
      CHECK((result - expected).norm() < 1e-13 * expected.norm());
      if (!model.invariant()) CHECK(result == M);
    }
}

TEST_CASE_TEMPLATE("error model: add_turn gives the Jacobian of rows by the own error", Pose, SE2, SE3) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof, kRows = Rows<Pose>::kRows;
  using Point = typename Pose::Point;
  using ByPose = Eigen::Matrix<double, kRows, kDof>;
  using ByPoint = Eigen::Matrix<double, kRows, kDim>;
  const Rows<Pose> rows;
  Random random(10);
  for (const ErrorKind kind : kBoth) {
    const ErrorModel<Pose> model(kind);
    CAPTURE(model.invariant());
    for (const Pose& pose : awkward_poses<Pose>(11)) {
      if (pose.translation().norm() > 500) continue;  // the numerical differences lose these digits
      const Point l = pose.translation() + Point(4 * random.normal_vector<kDim>());
      const ByPose J_pose = pose_jacobian([&](const Pose& T) { return rows(T, l); }, pose);
      const ByPoint J_point = jacobian<kDim>([&](const Point& x) { return rows(pose, x); }, l);

      ByPose block = J_pose;  // column-major
      model.add_turn(kRows, J_pose, pose.translation(), block.data());
      const double size = (1 + pose.translation().norm()) * (1 + pose.translation().norm());

      // The pose's error changes, the landmark stays.
      const ByPose by_pose =
          jacobian_at_zero<kDof>([&](const typename Pose::Tangent& xi) { return rows(moved(model, pose, xi), l); });
      CHECK((block - by_pose).norm() < 10 * kTolerance * size);

      // All of the filter's own errors change: the landmark turns with the pose's xi_R.
      model.add_turn(kRows, J_point, l, block.data());
      const ByPose by_all = jacobian_at_zero<kDof>([&](const typename Pose::Tangent& xi) {
        const typename Pose::Rotation::Tangent turn = xi.template tail<kTurn>();
        const typename ErrorModel<Pose>::PointRetraction move_point(model, turn);
        return rows(moved(model, pose, xi), move_point(l, Point::Zero()));
      });
      CHECK((block - by_all).norm() < 10 * kTolerance * size);
      const ByPoint by_landmark = jacobian_at_zero<kDim>([&](const Point& xi) {
        const typename ErrorModel<Pose>::PointRetraction move_point(model, Pose::Rotation::Tangent::Zero());
        return rows(pose, move_point(l, xi));
      });
      CHECK((J_point - by_landmark).norm() < 10 * kTolerance * size);
      if (!model.invariant()) CHECK(block == J_pose);
    }
  }
}
