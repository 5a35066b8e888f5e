// SPDX-License-Identifier: BSD-3-Clause
// A submap against the map: innovation, robust factors, inflation of a landmark, and widening of the base.
#include "map/submap_innovation.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <vector>

#include "numerical.hpp"

using namespace cairn;
using cairn::test::Random;

namespace {

constexpr Eigen::Index kLandmarks = 5;
constexpr ErrorKind kBoth[] = {ErrorKind::invariant, ErrorKind::standard};

template <class Pose>
Submap<Pose> some_submap(ErrorKind error, Random& random) {
  Submap<Pose> submap;
  submap.error = error;
  submap.T_base_end = Pose::exp(random.normal_vector<Pose::kDof>());
  for (Eigen::Index i = 0; i < kLandmarks; ++i) {
    submap.ids.push_back(static_cast<std::uint64_t>(i));
    submap.counts.push_back(3);
    submap.landmarks.push_back(4.0 * random.normal_vector<Pose::kDim>());
  }
  const Eigen::Index n = Pose::kDof + Pose::kDim * kLandmarks;
  Eigen::MatrixXd A(n, n);
  for (Eigen::Index i = 0; i < A.size(); ++i) A.data()[i] = 0.1 * random.normal();
  submap.covariance = A * A.transpose();
  return submap;
}

// The submap's error in its own coordinates if all of it is moved by `motion`, an ordinary error of the base.
template <class Pose>
Eigen::VectorXd moved(const Submap<Pose>& submap, const typename Pose::Tangent& motion) {
  const ErrorModel<Pose> model(submap.error);
  const Pose move = retract(Pose(), motion);
  Eigen::VectorXd error(submap.covariance.rows());
  error.head<Pose::kDof>() = model.error(move * submap.T_base_end, submap.T_base_end);
  for (Eigen::Index i = 0; i < submap.size(); ++i) {
    const typename Pose::Point x = submap.landmarks[static_cast<std::size_t>(i)];
    typename Pose::Point e = move * x - x;
    if (model.invariant()) {  // as for the position of a pose with this rotation
      typename Pose::Tangent own = model.error(Pose(move.rotation(), move * x), Pose(typename Pose::Rotation(), x));
      e = own.template head<Pose::kDim>();
    }
    error.segment<Pose::kDim>(Pose::kDof + Pose::kDim * i) = e;
  }
  return error;
}

double smallest_eigenvalue(const Eigen::MatrixXd& P) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(P).eigenvalues().minCoeff();
}

}  // namespace

TEST_CASE_TEMPLATE("submap innovation: widening is a motion of the whole submap, by numerical derivatives", Pose, SE2,
                   SE3) {
  for (const ErrorKind error : kBoth) {
    CAPTURE(static_cast<int>(error));
    Random random(1);
    Submap<Pose> submap = some_submap<Pose>(error, random);
    const Eigen::MatrixXd before = submap.covariance;
    Eigen::MatrixXd U(before.rows(), Pose::kDof);
    const double step = 1e-6;
    for (int c = 0; c < Pose::kDof; ++c) {
      const typename Pose::Tangent e = step * Pose::Tangent::Unit(c);
      U.col(c) = (moved<Pose>(submap, e) - moved<Pose>(submap, -e)) / (2 * step);
    }
    typename Pose::Square A;
    for (Eigen::Index i = 0; i < A.size(); ++i) A.data()[i] = random.normal();
    const typename Pose::Square D = A * A.transpose();
    widen(submap, D);
    CHECK((submap.covariance - before - U * D * U.transpose()).norm() < 1e-6 * submap.covariance.norm());
  }
}

TEST_CASE_TEMPLATE("submap innovation: inflation scales the ordinary error of one landmark", Pose, SE2, SE3) {
  for (const ErrorKind error : kBoth) {
    CAPTURE(static_cast<int>(error));
    Random random(2);
    const Submap<Pose> before = some_submap<Pose>(error, random);
    Submap<Pose> one = before, four = before;
    inflate(one, 2, 1.0);
    CHECK((one.covariance - before.covariance).norm() < 1e-14 * before.covariance.norm());
    inflate(four, 2, 4.0);
    CHECK(smallest_eigenvalue(four.covariance) > -1e-12);
    CHECK(four.covariance.isApprox(four.covariance.transpose(), 1e-13));
    Eigen::MatrixXd ordinary = before.covariance, after = four.covariance;
    to_ordinary<Pose>(before, {0, 2}, ordinary);
    to_ordinary<Pose>(four, {0, 2}, after);
    const Eigen::Index other = Pose::kDof, at = Pose::kDof + 2 * Pose::kDim;
    const auto block = [](const Eigen::MatrixXd& P, Eigen::Index r, Eigen::Index c) {
      return Eigen::MatrixXd(P.block<Pose::kDim, Pose::kDim>(r, c));
    };
    CHECK(block(after, at, at).isApprox(4.0 * block(ordinary, at, at), 1e-12));
    CHECK(block(after, other, at).isApprox(2.0 * block(ordinary, other, at), 1e-12));
    CHECK(block(after, other, other).isApprox(block(ordinary, other, other), 1e-12));
    CHECK(after.topLeftCorner<Pose::kDof, Pose::kDof>() == ordinary.topLeftCorner<Pose::kDof, Pose::kDof>());
  }
}

TEST_CASE_TEMPLATE("submap innovation: residual, covariance, and the factors of a loss", Pose, SE2, SE3) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  Random random(3);
  Submap<Pose> submap = some_submap<Pose>(ErrorKind::standard, random);
  submap.covariance.setIdentity();
  submap.covariance *= 1e-4;
  const Pose base = Pose::exp(random.normal_vector<kDof>());
  const std::vector<Eigen::Index> locals = {4, 1, 0};
  std::vector<typename Pose::Point> points;
  for (const Eigen::Index local : locals) points.push_back(base * submap.landmarks[static_cast<std::size_t>(local)]);
  const double wrong = 1.0;
  points[1] += base.rotation() * typename Pose::Point(wrong * Pose::Point::UnitX());
  const Eigen::MatrixXd P = 1e-6 * Eigen::MatrixXd::Identity(kDof + 3 * kDim, kDof + 3 * kDim);
  const SubmapInnovation<Pose> innovation(base, P, points, submap, locals, submap.covariance);
  REQUIRE(innovation.count() == 3);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(3 * kDim);
  expected[kDim] = -wrong;
  CHECK((innovation.residual - expected).norm() < 1e-12);
  // The same from numerical derivatives of y = R^T (l - p).
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3 * kDim, kDof + 3 * kDim);
  for (int a = 0; a < 3; ++a) {
    const typename Pose::Point point = points[static_cast<std::size_t>(a)];
    H.block<kDim, kDof>(kDim * a, 0) =
        cairn::test::pose_jacobian([&](const Pose& T) { return typename Pose::Point(T.inverse() * point); }, base);
    H.block<kDim, kDim>(kDim * a, kDof + kDim * a) = base.rotation().inverse().matrix();
    CHECK((innovation.by_base[static_cast<std::size_t>(a)] - H.block<kDim, kDof>(kDim * a, 0)).norm() < 1e-8);
  }
  const Eigen::MatrixXd S = H * P * H.transpose() + 1e-4 * Eigen::MatrixXd::Identity(3 * kDim, 3 * kDim);
  CHECK((innovation.S - S).norm() < 1e-10);
  CHECK(innovation.sigma.isApprox(1e-4 * Eigen::MatrixXd::Identity(3 * kDim, 3 * kDim), 1e-12));

  for (const double factor : noise_factors(innovation, RobustLoss())) CHECK(factor == 1.0);
  for (const LossKind kind : {LossKind::huber, LossKind::cauchy}) {
    const RobustLoss loss(kind, 1.5);
    const std::vector<double> factors = noise_factors(innovation, loss);
    REQUIRE(factors.size() == 3);
    CHECK(factors[0] < 1.2 * loss.noise_factor(0.0, kDim));
    CHECK(factors[2] < 1.2 * loss.noise_factor(0.0, kDim));
    CHECK(factors[1] > 50.0 * factors[0]);  // 100 standard deviations off
  }
}
