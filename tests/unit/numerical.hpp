// SPDX-License-Identifier: BSD-3-Clause
// Numerical derivatives for all tests of Jacobians, and the inputs at which Jacobians tend to be wrong.
#pragma once

#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

#include "geometry/rigid.hpp"
#include "geometry/so3.hpp"
#include "geometry/types.hpp"

namespace cairn::test {

// Step of the central differences below. Their error is step^4 / 30 times the fifth derivative, which is 3e-11 for 1/x
// at x = 0.1, plus about 1e-12 of the function's value by rounding.
constexpr double kStep = 1e-4;

// The difference of two function values. A function of angles passes its own difference.
struct Minus {
  template <class Value>
  Value operator()(const Value& a, const Value& b) const {
    return a - b;
  }
};

// df/dx at x = 0 by five points, one column for each coordinate. f takes a Vector<double, Columns> and returns a
// vector.
template <int Columns, class F, class Difference = Minus>
auto jacobian_at_zero(const F& f, const Difference& minus = {}) {
  using Input = Eigen::Matrix<double, Columns, 1>;
  using Output = std::decay_t<decltype(f(Input()))>;
  Eigen::Matrix<double, Output::RowsAtCompileTime, Columns> J;
  for (int i = 0; i < Columns; ++i) {
    const Input e = kStep * Input::Unit(i);
    const Output near_slope = minus(f(e), f(-e)), far_slope = minus(f(2 * e), f(-2 * e));
    J.col(i) = (8 * near_slope - far_slope) / (12 * kStep);
  }
  return J;
}

// df / dx at x. f takes and returns vectors.
template <int Columns, class F, class Difference = Minus>
auto jacobian(const F& f, const Eigen::Matrix<double, Columns, 1>& x, const Difference& minus = {}) {
  using Input = Eigen::Matrix<double, Columns, 1>;
  return jacobian_at_zero<Columns>([&](const Input& d) { return f(Input(x + d)); }, minus);
}

// df/d[dp; dtheta] at a pose, in the ordinary error: p + dp, Exp(dtheta) R.
template <class Rotation, class F, class Difference = Minus>
auto pose_jacobian(const F& f, const Rigid<Rotation>& pose, const Difference& minus = {}) {
  using Pose = Rigid<Rotation>;
  return jacobian_at_zero<Pose::kDof>([&](const typename Pose::Tangent& error) { return f(retract(pose, error)); },
                                      minus);
}

// Random numbers from a seed that the test states. The engine of <random> is the same everywhere, its distributions are
// not.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) / 9007199254740992.0);
  }
  double normal() {  // Box-Muller
    const double u = 1 - uniform(0, 1);
    return std::sqrt(-2 * std::log(u)) * std::cos(uniform(0, 6.283185307179586));
  }
  template <int N>
  Eigen::Matrix<double, N, 1> normal_vector() {
    Eigen::Matrix<double, N, 1> x;
    for (int i = 0; i < N; ++i) x[i] = normal();
    return x;
  }

 private:
  std::mt19937_64 engine_;
};

// Rotation vectors of length N at which formulas tend to break: zero, too small to square, small, about one where the
// series of the Stumpff functions ends, arbitrary, close to a half turn, and a half turn.
template <int N>
std::vector<Eigen::Matrix<double, N, 1>> awkward_turns(unsigned seed) {
  Random random(seed);
  const double pi = 3.14159265358979323846;
  std::vector<Eigen::Matrix<double, N, 1>> turns;
  turns.push_back(Eigen::Matrix<double, N, 1>::Zero());
  for (double length : {1e-200, 1e-12, 1e-8, 1e-5, 1e-4, 0.01, 0.999, 1.001, 2.5, pi - 1e-5, pi - 1e-9, pi}) {
    for (int repeat = 0; repeat < 3; ++repeat) turns.push_back(length * random.normal_vector<N>().normalized());
  }
  return turns;
}

// Poses with these rotations, from the origin to far away.
template <class Pose = Rigid<SO3>>
std::vector<Pose> awkward_poses(unsigned seed) {
  Random random(seed);
  std::vector<Pose> poses;
  double far = 0;
  for (const typename Pose::Rotation::Tangent& turn : awkward_turns<Pose::kTurn>(seed + 1)) {
    poses.emplace_back(Pose::Rotation::exp(turn), far * random.normal_vector<Pose::kDim>());
    far = far == 0 ? 1e-8 : far > 100 ? 0 : 100 * far;
  }
  return poses;
}

}  // namespace cairn::test
