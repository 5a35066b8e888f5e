// SPDX-License-Identifier: BSD-3-Clause
// A motion of several steps against the covariance of products of poses; the factor of one observation.
#include "health/chained_motion.hpp"

#include <doctest/doctest.h>

#include <random>

#include "health/small_factor.hpp"
#include "linear/joint_gate.hpp"

using namespace cairn;

namespace {

template <class Pose>
struct Steps {
  std::mt19937_64 engine{5};
  double normal() { return std::normal_distribution<double>()(engine); }
  Increment<Pose> step() {
    typename Pose::Tangent twist;
    typename Pose::Square B;
    for (int c = 0; c < Pose::kDof; ++c) {
      twist(c) = normal();
      for (int r = 0; r < Pose::kDof; ++r) B(r, c) = normal();
    }
    Increment<Pose> step;
    step.T_before_after = Pose::exp(twist);
    step.covariance = B * B.transpose();
    return step;
  }
};

template <class Pose>
void compare() {
  using Square = typename Pose::Square;
  Steps<Pose> steps;
  Increment<Pose> whole;
  ChainedMotion<Pose> motion, first_half, second_half;
  for (int k = 0; k < 10; ++k) {
    const Increment<Pose> step = steps.step();
    const ProductJacobians J(whole.T_before_after, step.T_before_after);
    whole.covariance = J.covariance(whole.covariance, step.covariance);
    whole.T_before_after = whole.T_before_after * step.T_before_after;
    motion.append(ChainedMotion<Pose>(step));
    (k < 5 ? first_half : second_half).append(ChainedMotion<Pose>(step));
    const Square to_body = Pose::turn_axes(whole.T_before_after.rotation().inverse());
    const Square expected = to_body * whole.covariance * to_body.transpose();
    CHECK((motion.noise - expected).norm() < 1e-12 * expected.norm());
    CHECK((motion.noise - motion.noise.transpose()).norm() < 1e-14 * expected.norm());
    CHECK(pose_error(motion.T, whole.T_before_after).norm() < 1e-13);
  }
  first_half.append(second_half);
  CHECK((first_half.noise - motion.noise).norm() < 1e-12 * motion.noise.norm());
}

}  // namespace

TEST_CASE("chained motion: the covariance of a motion in the axes after it") {
  compare<SE2>();
  compare<SE3>();
}

TEST_CASE("small factor: distances and whitened Jacobians of one to three rows") {
  std::mt19937_64 engine(3);
  const auto normal = [&] { return std::normal_distribution<double>()(engine); };
  for (Index rows = 1; rows <= 3; ++rows) {
    Matrix3 B;
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) B(r, c) = normal();
    const Matrix3 S = B * B.transpose();
    Vector3 x = Vector3::Zero(), y;
    for (Index r = 0; r < rows; ++r) x(r) = normal();
    y = x;
    const SmallFactor factor(S, rows);
    REQUIRE(factor.definite());
    factor.solve(x);
    CHECK(x.squaredNorm() == doctest::Approx(squared_distance(y.data(), S.data(), 3, rows)).epsilon(1e-12));
  }
  CHECK_FALSE(SmallFactor(Matrix3::Zero(), 1).definite());
  CHECK_FALSE(SmallFactor(Matrix3::Ones(), 2).definite());
  CHECK(SmallFactor(Matrix3::Ones(), 1).definite());
  CHECK_FALSE(SmallFactor(Matrix3::Constant(std::nan("")), 3).definite());
  CHECK_FALSE(SmallFactor(Matrix3(Vector3(1, 1, -1).asDiagonal()), 3).definite());
}
