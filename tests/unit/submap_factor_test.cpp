// SPDX-License-Identifier: BSD-3-Clause
// A closed submap as one observation: its error by its definition, its derivatives by differences, and what is left out
// of it against the problem that leaves nothing out.
#include "map/submap_factor.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>

#include "core/error.hpp"
#include "numerical.hpp"
#include "submap_hessian.hpp"

namespace {

using namespace cairn;
using cairn::test::Random;
using cairn::test::whole_hessian;
using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Numbers = std::vector<Index>;

constexpr ErrorKind kKinds[] = {ErrorKind::invariant, ErrorKind::standard};

Submap random_submap(Random& random, ErrorKind error, int landmarks) {
  Submap submap;
  submap.error = error;
  submap.T_base_end = SE3(SO3::exp(0.8 * random.normal_vector<3>()), 4 * random.normal_vector<3>());
  for (int i = 0; i < landmarks; ++i) {
    submap.ids.push_back(static_cast<std::uint64_t>(100 + i));
    submap.counts.push_back(1);
    submap.landmarks.push_back(5 * random.normal_vector<3>());
  }
  const Index n = 6 + 3 * landmarks;
  Matrix root(n, n + 4);
  for (Index i = 0; i < root.size(); ++i) root.data()[i] = random.normal();
  for (Index r = 0; r < n; ++r) root.row(r) *= r >= 3 && r < 6 ? 0.004 : 0.03;
  submap.covariance = root * root.transpose();
  return submap;
}

// Where the submap's own estimate puts everything, seen from a base.
FactorValues own_values(const Submap& submap, const Numbers& shared, const SE3& base) {
  FactorValues values{base, base * submap.T_base_end, {}};
  for (const Index i : shared) values.shared.push_back(base * submap.landmarks[i]);
  return values;
}

// Ordinary errors [base; end; shared].
FactorValues moved(const FactorValues& values, const Vector& e) {
  FactorValues out{retract(values.base, Vector6(e.head<6>())), retract(values.end, Vector6(e.segment<6>(6))), {}};
  for (std::size_t i = 0; i < values.shared.size(); ++i)
    out.shared.push_back(values.shared[i] + e.segment<3>(12 + 3 * static_cast<Index>(i)));
  return out;
}

FactorValues disturbed(const FactorValues& values, Random& random, double position, double turn) {
  Vector e(12 + 3 * static_cast<Index>(values.shared.size()));
  for (Index i = 0; i < e.size(); ++i) e(i) = position * random.normal();
  e.segment<3>(3) = turn * random.normal_vector<3>().normalized();
  e.segment<3>(9) = turn * random.normal_vector<3>().normalized();
  return moved(values, e);
}

Matrix numerical_jacobian(const SubmapFactor& factor, const FactorValues& values) {
  Matrix J(factor.rows(), factor.columns());
  for (Index c = 0; c < factor.columns(); ++c) {
    const Vector e = cairn::test::kStep * Vector::Unit(factor.columns(), c);
    const auto at = [&](double times) { return factor.residual(moved(values, times * e)); };
    J.col(c) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * cairn::test::kStep);
  }
  return J;
}

double difference(const Matrix& a, const Matrix& b) {
  return (a - b).norm() / (1e-300 + b.norm());
}

Numbers all_of(const Submap& submap) {
  Numbers all;
  for (Index i = 0; i < submap.size(); ++i) all.push_back(i);
  return all;
}

}  // namespace

TEST_CASE("submap factor: no residual where the submap itself puts everything") {
  Random random(1);
  for (const ErrorKind error : kKinds)
    for (const SE3& base : cairn::test::awkward_poses(2)) {
      const Submap submap = random_submap(random, error, 4);
      const SubmapFactor factor(std::make_shared<SubmapData>(submap), {0, 2, 3});
      const FactorValues values = own_values(submap, factor.shared(), base);
      const double rounding = 1e-14 * (10 + base.translation().norm());
      CHECK(factor.residual(values).norm() <= 10 * rounding);
      CHECK(factor.rows() == 15);
      CHECK(factor.columns() == 21);
    }
}

TEST_CASE("submap factor: the residual is the error by its definition") {
  Random random(3);
  for (const ErrorKind error : kKinds)
    for (const double turn : {0.0, 1e-8, 0.1, 1.2, 3.0}) {
      const Submap submap = random_submap(random, error, 3);
      const SubmapFactor factor(std::make_shared<SubmapData>(submap), {0, 1, 2});
      const SE3 base(SO3::exp(random.normal_vector<3>()), 30 * random.normal_vector<3>());
      FactorValues values = own_values(submap, factor.shared(), base);
      values.end = SE3(SO3::exp(turn * random.normal_vector<3>().normalized()) * values.end.rotation(),
                       values.end.translation() + 0.3 * random.normal_vector<3>());
      for (Vector3& l : values.shared) l += 0.3 * random.normal_vector<3>();
      const Vector xi = factor.residual(values);
      const SO3 R = SO3::exp(xi.segment<3>(3));
      const Matrix3 V = SO3::left_jacobian(xi.segment<3>(3));
      const SE3 T = base.inverse() * values.end;
      CHECK((R.matrix() * submap.T_base_end.rotation().matrix() - T.rotation().matrix()).norm() <= 1e-12);
      for (Index i = -1; i < 3; ++i) {
        const Vector3 truth = i < 0 ? T.translation() : Vector3(base.inverse() * values.shared[i]);
        const Vector3 estimate = i < 0 ? submap.T_base_end.translation() : submap.landmarks[i];
        const Vector3 e = xi.segment<3>(i < 0 ? 0 : 6 + 3 * i);
        const Vector3 back = error == ErrorKind::invariant ? Vector3(R * estimate + V * e) : Vector3(estimate + e);
        CHECK((back - truth).norm() <= 1e-12 * (1 + base.translation().norm()));
      }
    }
}

TEST_CASE("submap factor: derivatives against differences") {
  Random random(4);
  for (const ErrorKind error : kKinds)
    for (const double turn : {0.0, 1e-8, 1e-3, 0.1, 0.7, 1.4})
      for (int repeat = 0; repeat < 3; ++repeat) {
        const Submap submap = random_submap(random, error, 5);
        const SubmapFactor factor(std::make_shared<SubmapData>(submap), {1, 2, 4});
        const SE3 base =
            repeat == 0 ? SE3() : SE3(SO3::exp(2 * random.normal_vector<3>()), 20 * random.normal_vector<3>());
        const FactorValues values = disturbed(own_values(submap, factor.shared(), base), random, turn, turn);
        const Matrix J = numerical_jacobian(factor, values);
        const Numbers states{0, 1, 2, 3, 4, 5, 9, 10, 11, 12, 13, 14, 18, 19, 20};
        const Matrix information = Matrix(submap.covariance(states, states)).ldlt().solve(Matrix::Identity(15, 15));
        const Vector xi = factor.residual(values);
        CHECK(difference(factor.weighted(xi), information * xi) <= 1e-9);
        const SubmapFactor::Evaluation out = factor.evaluate(values);
        CHECK(out.cost == doctest::Approx(0.5 * xi.dot(information * xi)).epsilon(1e-9));
        const Matrix WJ = information * J;
        CHECK((out.gradient - WJ.transpose() * xi).norm() <= 1e-7 * WJ.norm() * (1e-3 + xi.norm()));
        const Matrix H = whole_hessian(factor, values);
        CHECK(difference(H, J.transpose() * WJ) <= 1e-7);
        std::vector<Matrix3> axes;  // each of its own
        Matrix R = Matrix::Zero(H.rows(), H.rows());
        for (Index i = 0; i < 2 + factor.shared_count(); ++i) {
          axes.push_back(SO3::exp(random.normal_vector<3>()).matrix());
          for (Index d = i < 2 ? 6 * i : 6 + 3 * i; d < (i < 2 ? 6 * i + 6 : 9 + 3 * i); d += 3)
            R.block<3, 3>(d, d) = axes.back();
        }
        CHECK(difference(whole_hessian(factor, values, axes), R.transpose() * H * R) <= 1e-12);
      }
}

TEST_CASE("submap factor: what one landmark is known by") {
  Random random(5);
  for (const ErrorKind error : kKinds) {
    const Submap submap = random_submap(random, error, 3);
    const SubmapFactor factor(std::make_shared<SubmapData>(submap), {0, 2});
    const SE3 base(SO3::exp(random.normal_vector<3>()), random.normal_vector<3>());
    const Matrix H = whole_hessian(factor, own_values(submap, factor.shared(), base));
    for (Index i = 0; i < 2; ++i)
      CHECK(difference(factor.landmark_information(i, base.rotation()), H.block<3, 3>(12 + 3 * i, 12 + 3 * i)) <=
            1e-10);
  }
}

// The problem with all landmarks as variables is the yardstick: what was eliminated must not be missed.
TEST_CASE("submap factor: private landmarks leave cost and gradient of the others as they are") {
  Random random(6);
  for (const ErrorKind error : kKinds)
    for (const double size : {0.0, 1e-3, 0.2, 1.0}) {
      const Submap submap = random_submap(random, error, 6);
      const auto data = std::make_shared<const SubmapData>(submap);
      const SubmapFactor part(data, {1, 4}), full(data, all_of(submap));
      const SE3 base(SO3::exp(random.normal_vector<3>()), 10 * random.normal_vector<3>());
      const FactorValues values = disturbed(own_values(submap, part.shared(), base), random, size, size);
      const Vector xi = part.residual(values), weight = part.weighted(xi);
      FactorValues whole{values.base, values.end, {}};
      const Eigen::Matrix3Xd placed = part.place_private(values, xi, weight);
      for (Index i = 0; i < 6; ++i)
        whole.shared.push_back(i == 1 ? values.shared[0] : i == 4 ? values.shared[1] : Vector3(placed.col(i)));
      const SubmapFactor::Evaluation a = part.evaluate(values), b = full.evaluate(whole);
      CHECK(b.cost == doctest::Approx(a.cost).epsilon(1e-8).scale(1e-12));
      const double scale = 1e-7 * (1e-2 + b.gradient.norm());
      CHECK((a.gradient.head<12>() - b.gradient.head<12>()).norm() <= scale);
      for (Index i = 0; i < 6; ++i) {
        Vector3 expected = Vector3::Zero();
        if (i == 1) expected = a.gradient.segment<3>(12);
        if (i == 4) expected = a.gradient.segment<3>(15);
        CHECK((b.gradient.segment<3>(12 + 3 * i) - expected).norm() <= scale);
      }
      for (const Index i : {0, 5}) {  // and nowhere else would cost less
        FactorValues elsewhere = whole;
        elsewhere.shared[i] += 0.01 * random.normal_vector<3>();
        CHECK(full.evaluate(elsewhere).cost > b.cost);
      }
    }
}

TEST_CASE("submap factor: covariances of private landmarks against the whole problem's") {
  Random random(7);
  for (const ErrorKind error : kKinds)
    for (int repeat = 0; repeat < 4; ++repeat) {
      const Submap submap = random_submap(random, error, 5);
      const auto data = std::make_shared<const SubmapData>(submap);
      const Numbers shared = repeat == 0 ? Numbers{} : Numbers{1, 3},
                    privates = repeat == 0 ? Numbers{4, 0, 2} : Numbers{4, 2};
      const SubmapFactor part(data, shared), full(data, all_of(submap));
      const SE3 base(SO3::exp(random.normal_vector<3>()), 10 * random.normal_vector<3>());
      const FactorValues values = own_values(submap, shared, base);
      const FactorValues whole = own_values(submap, all_of(submap), base);
      // What else is known of base, end and shared landmarks.
      const Index m = part.columns();
      Matrix root(m, m);
      for (Index i = 0; i < root.size(); ++i) root.data()[i] = 5 * random.normal();
      const Matrix rest = root.transpose() * root;
      Numbers of_part;
      for (Index i = 0; i < 12; ++i) of_part.push_back(i);
      for (const Index i : shared)
        for (Index d = 0; d < 3; ++d) of_part.push_back(12 + 3 * i + d);
      Matrix H = whole_hessian(full, whole);
      H(of_part, of_part) += rest;
      const Matrix P = H.ldlt().solve(Matrix::Identity(H.rows(), H.rows()));
      const Matrix of_others = (whole_hessian(part, values) + rest).ldlt().solve(Matrix::Identity(m, m));
      CHECK(difference(of_others, P(of_part, of_part)) <= 1e-8);

      Matrix A, W;
      part.express_private(privates, values, A, W);
      Numbers of_privates;
      for (const Index i : privates)
        for (Index d = 0; d < 3; ++d) of_privates.push_back(12 + 3 * i + d);
      CHECK(difference(A * of_others * A.transpose() + W, P(of_privates, of_privates)) <= 1e-8);
      CHECK(difference(A * of_others, P(of_privates, of_part)) <= 1e-8);
    }
}

TEST_CASE("submap factor: exact knowledge is no division by zero, and no covariance is an error") {
  Random random(8);
  for (const ErrorKind error : kKinds) {
    Submap submap = random_submap(random, error, 2);
    submap.T_base_end = SE3();
    submap.covariance.topRows<6>().setZero();
    submap.covariance.leftCols<6>().setZero();
    const SubmapFactor factor(std::make_shared<SubmapData>(submap), {0, 1});
    FactorValues values = own_values(submap, {0, 1}, SE3(SO3::exp(random.normal_vector<3>()), Vector3(1, 2, 3)));
    CHECK(factor.evaluate(values).cost <= 1e-12);
    CHECK(whole_hessian(factor, values).allFinite());
    values.end = SE3(values.end.rotation(), values.end.translation() + Vector3(1e-3, 0, 0));
    CHECK(factor.evaluate(values).cost == doctest::Approx(0.5e6).epsilon(0.1));  // a micrometre counts as exact
    submap.covariance(7, 7) = -1.0;
    CHECK_THROWS_AS(SubmapFactor(std::make_shared<SubmapData>(submap), {0, 1}), Error);
    CHECK_THROWS_AS(SubmapFactor(std::make_shared<SubmapData>(submap), {1}), Error);  // whoever is shared so far
    submap.covariance = Matrix::Ones(12, 12);  // all one error: singular, which a grain of noise repairs
    CHECK(whole_hessian(SubmapFactor(std::make_shared<SubmapData>(submap), {0, 1}), values).allFinite());
    submap.covariance(8, 7) = submap.covariance(7, 8) = 2.0;  // no covariance
    CHECK_THROWS_AS(SubmapFactor(std::make_shared<SubmapData>(submap), {0, 1}), Error);
  }
}
