// SPDX-License-Identifier: BSD-3-Clause
// A frame's parts against the dense likelihood of all its differences (docs/trust.md, eq. 3 and 4).
#include "health/paired_frame.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

using namespace cairn;

namespace {

constexpr Index kMost = 16;

template <class Pose>
struct Sample {
  static constexpr int kDof = Pose::kDof;
  using Paired = PairedFrame<Pose>;
  using Dynamic = Eigen::MatrixXd;

  Arena arena{1 << 16};
  Paired paired{arena, kMost};
  std::mt19937_64 engine{7};
  typename Pose::Square N = Pose::Square::Zero();
  Dynamic D, H;
  Eigen::VectorXd d;

  double normal() { return std::normal_distribution<double>()(engine); }

  // Differences of `rows` values with noise alpha D, of a motion with noise beta N.
  void make(Index blocks, Index rows, double alpha, double beta, Index noisy_axes) {
    const Index m = blocks * rows;
    D = Dynamic::Zero(m, m), H = Dynamic::Zero(m, kDof), d = Eigen::VectorXd::Zero(m);
    N.setZero();
    typename Pose::Tangent w = Pose::Tangent::Zero();
    for (Index i = 0; i < noisy_axes; ++i) {
      N(i, i) = 0.01 * static_cast<double>(i + 1);
      w(i) = std::sqrt(beta * N(i, i)) * normal();
    }
    paired.start(rows);
    for (Index b = 0; b < blocks; ++b) {
      typename Paired::ByMotion J;
      for (Index c = 0; c < kDof; ++c)
        for (Index r = 0; r < kMostRows; ++r) J(r, c) = normal();
      Matrix3 noise = Matrix3::Identity();
      Vector3 difference = J * w;
      for (Index r = 0; r < rows; ++r) {
        noise(r, r) = 0.02 * static_cast<double>(r + 1);
        difference(r) += std::sqrt(alpha * noise(r, r)) * normal();
      }
      D.block(b * rows, b * rows, rows, rows) = noise.topLeftCorner(rows, rows);
      H.middleRows(b * rows, rows) = J.topRows(rows);
      d.segment(b * rows, rows) = difference.head(rows);
      paired.add(difference, noise, J);
    }
  }
  // d^T (alpha D + beta H N H^T)^-1 d, and the logarithm of the determinant over that of D.
  std::pair<double, double> dense(double alpha, double beta) const {
    const Dynamic C = alpha * D + beta * H * N * H.transpose();
    const Eigen::LLT<Dynamic> factor(C);
    const double logarithm = 2.0 * factor.matrixLLT().diagonal().array().log().sum() - D.diagonal().array().log().sum();
    return {d.dot(factor.solve(d)), logarithm};
  }
};

std::pair<double, double> likelihood(const FrameParts& parts, double alpha, double beta, double shrink) {
  double square = (parts.rest + shrink * parts.residual) / alpha;
  double logarithm = static_cast<double>(parts.rest_dof + parts.residual_dof) * std::log(alpha);
  for (Index j = 0; j < parts.commons; ++j) {
    const double variance = alpha + beta * parts.common[j].weight;
    square += parts.common[j].square / variance;
    logarithm += std::log(variance);
  }
  return {square, logarithm};
}

// The mean of a chi-square variable below its 0.995 quantile, over its mean: F_{rows + 2} over 0.995.
double shrink_of(Index rows) {
  return rows == 2 ? 0.97339 : 0.97995;
}

template <class Pose>
void compare(Index blocks, Index rows, Index noisy_axes) {
  Sample<Pose> sample;
  sample.make(blocks, rows, 1.0, 1.0, noisy_axes);
  const FrameParts parts = sample.paired.split(sample.N, 1.0, 1.0);
  REQUIRE(parts.blocks == blocks);
  CHECK(parts.commons + parts.rest_dof + parts.residual_dof == blocks * rows);
  for (const auto& [alpha, beta] : {std::pair{1.0, 1.0}, {0.3, 2.0}, {5.0, 0.1}}) {
    const auto split = likelihood(parts, alpha, beta, shrink_of(rows)), dense = sample.dense(alpha, beta);
    CHECK(split.first == doctest::Approx(dense.first).epsilon(1e-3));
    CHECK(split.second == doctest::Approx(dense.second).epsilon(1e-8));
  }
}

}  // namespace

TEST_CASE("paired frame: the parts have the likelihood of the whole frame") {
  compare<SE3>(9, 3, 6);
  compare<SE3>(9, 3, 4);  // two directions without noise
  compare<SE2>(7, 2, 3);
  compare<SE2>(7, 2, 1);
  compare<SE2>(1, 2, 3);  // fewer values than directions
  compare<SE3>(1, 3, 0);
}

TEST_CASE("paired frame: gross errors of a third of the observations are left out") {
  Sample<SE2> sample;
  sample.make(12, 2, 1.0, 1.0, 3);
  sample.paired.start(2);
  for (Index b = 0; b < 12; ++b) {
    typename PairedFrame<SE2>::ByMotion J = PairedFrame<SE2>::ByMotion::Zero();
    J.topRows(2) = sample.H.middleRows(2 * b, 2);
    Matrix3 noise = Matrix3::Identity();
    noise.topLeftCorner<2, 2>() = sample.D.block<2, 2>(2 * b, 2 * b);
    Vector3 difference(sample.d(2 * b), sample.d(2 * b + 1), 0.0);
    if (b % 3 == 0) difference.x() += 50.0;
    sample.paired.add(difference, noise, J);
  }
  const FrameParts parts = sample.paired.split(sample.N, 1.0, 1.0);
  CHECK(parts.blocks == 8);
  CHECK(parts.residual < 3.0 * static_cast<double>(parts.residual_dof));
  using Step = PairedFrame<SE2>::Step;
  for (Index b = 0; b < 12; ++b) CHECK((sample.paired.step(b) == (b % 3 == 0 ? Step::jumped : Step::agrees)));
}

TEST_CASE("paired frame: a jump of the whole vehicle is no gross error") {
  Sample<SE2> sample;
  sample.make(8, 2, 1.0, 1e4, 3);
  const FrameParts parts = sample.paired.split(sample.N, 1.0, 1.0);
  CHECK(parts.blocks == 8);
  CHECK(parts.residual < 3.0 * static_cast<double>(parts.residual_dof));
  double jump = 0.0;
  for (Index j = 0; j < parts.commons; ++j) jump += parts.common[j].square / (1.0 + parts.common[j].weight);
  CHECK(jump > 100.0);
}

TEST_CASE("paired frame: what is no difference is left out") {
  Arena arena(1 << 16);
  PairedFrame<SE2> paired(arena, 4);
  paired.start(2);
  const PairedFrame<SE2>::ByMotion J = PairedFrame<SE2>::ByMotion::Ones();
  CHECK_FALSE(paired.add(Vector3(NAN, 0, 0), Matrix3::Identity(), J));
  CHECK_FALSE(paired.add(Vector3::Zero(), Matrix3::Zero(), J));
  CHECK_FALSE(paired.add(Vector3::Zero(), Matrix3::Identity(), INFINITY * J));
  CHECK(paired.count() == 0);
  CHECK(paired.split(SE2::Square::Identity(), 1.0, 1.0).blocks == 0);
}
