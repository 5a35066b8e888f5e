// SPDX-License-Identifier: BSD-3-Clause
// The factor of a place: the cost of a submap about some values, its derivatives, and what is left without some errors.
#include "map/join/sparse/place_factor.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "map/join/sparse/submap_factor.hpp"
#include "numerical.hpp"

namespace {

using namespace cairn;
using cairn::test::kStep;
using cairn::test::Random;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

double difference(const Matrix& a, const Matrix& b) {
  return (a - b).norm() / (1e-300 + b.norm());
}

Matrix symmetric(const Matrix& lower) {
  return lower.selfadjointView<Eigen::Lower>();
}

template <class Pose>
Pose random_pose(Random& random, double turn, double way) {
  const typename Pose::Rotation::Tangent theta = turn * random.normal_vector<Pose::kTurn>();
  return Pose(Pose::Rotation::exp(theta), way * random.normal_vector<Pose::kDim>());
}

// Ordinary errors of [base; poses; landmarks].
template <class Pose>
PlaceValues<Pose> moved(const PlaceValues<Pose>& values, const Vector& e) {
  PlaceValues<Pose> out = values;
  Index at = 0;
  const auto move = [&](Pose& pose) {
    pose = retract(pose, typename Pose::Tangent(e.segment<Pose::kDof>(at)));
    at += Pose::kDof;
  };
  move(out.base);
  for (Pose& pose : out.poses) move(pose);
  for (typename Pose::Point& landmark : out.landmarks) {
    landmark += e.segment<Pose::kDim>(at);
    at += Pose::kDim;
  }
  return out;
}

template <class Pose>
struct Scene {
  explicit Scene(unsigned seed) : random(seed) {
    values.base = random_pose<Pose>(random, 1.0, 10);
    for (int k = 0; k < 3; ++k) values.poses.push_back(random_pose<Pose>(random, 1.0, 10));
    for (int i = 0; i < 4; ++i) values.landmarks.push_back(10 * random.normal_vector<Pose::kDim>());
    n = 3 * Pose::kDof + 4 * Pose::kDim;
    Matrix root(n, n + 3);
    for (Index i = 0; i < root.size(); ++i) root.data()[i] = random.normal();
    cost.information = root * root.transpose();
    cost.gradient = vector(n);
    cost.constant = 3.0;
  }
  Vector vector(Index size) {
    Vector v(size);
    for (Index i = 0; i < size; ++i) v(i) = random.normal();
    return v;
  }

  Random random;
  PlaceValues<Pose> values;
  Index n = 0;
  Quadratic cost;
};

}  // namespace

TEST_CASE_TEMPLATE("place factor: derivatives against differences, and rigid motions cost nothing", Pose, SE3, SE2) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Scene<Pose> scene(seed);
    const PlaceFactor<Pose> factor(scene.values, {1, 2, 3, 4}, scene.cost);
    REQUIRE(factor.columns() == Pose::kDof + scene.n);
    CHECK(factor.evaluate(scene.values).cost == doctest::Approx(3.0));
    for (const double far : {0.0, 0.3}) {
      const PlaceValues<Pose> at = moved<Pose>(scene.values, far * scene.vector(factor.columns()));
      const auto evaluation = factor.evaluate(at);
      for (Index c = 0; c < factor.columns(); ++c) {
        const auto cost = [&](double times) {
          return factor.evaluate(moved<Pose>(at, times * kStep * Vector::Unit(factor.columns(), c))).cost;
        };
        const double slope = (8 * (cost(1) - cost(-1)) - (cost(2) - cost(-2))) / (12 * kStep);
        CHECK(std::abs(slope - evaluation.gradient(c)) <= 1e-6 * (1.0 + evaluation.gradient.norm() + evaluation.cost));
      }
      const Pose T = random_pose<Pose>(scene.random, 2.0, 50);
      PlaceValues<Pose> elsewhere{T * at.base, {}, {}};
      for (const Pose& pose : at.poses) elsewhere.poses.push_back(T * pose);
      for (const auto& landmark : at.landmarks) elsewhere.landmarks.push_back(T * landmark);
      CHECK(factor.evaluate(elsewhere).cost == doctest::Approx(evaluation.cost).epsilon(1e-9));
    }
  }
}

TEST_CASE_TEMPLATE("place factor: its Hessian is J^T Lambda J in any axes", Pose, SE3, SE2) {
  Scene<Pose> scene(4);
  scene.cost.gradient.setZero();
  const PlaceFactor<Pose> factor(scene.values, {1, 2, 3, 4}, scene.cost);
  const PlaceValues<Pose> at = moved<Pose>(scene.values, 0.3 * scene.vector(factor.columns()));
  std::vector<typename Pose::Rotation> axes;
  Matrix turn = Matrix::Zero(factor.columns(), factor.columns());
  Index row = 0;
  for (int i = 0; i < 8; ++i) {
    axes.push_back(random_pose<Pose>(scene.random, 1.0, 1).rotation());
    turn.block<Pose::kDim, Pose::kDim>(row, row) = axes.back().matrix();
    if (i < 4) {
      const Index first = row + Pose::kDim;
      turn.block<Pose::kTurn, Pose::kTurn>(first, first) = axes.back().adjoint();
    }
    row += i < 4 ? Pose::kDof : Pose::kDim;
  }
  // The gradient is J^T (Lambda d + g): its change by g is J^T.
  Matrix J(scene.n, factor.columns());
  const Vector without = factor.evaluate(at).gradient;
  for (Index r = 0; r < scene.n; ++r) {
    Quadratic pulled = scene.cost;
    pulled.gradient = Vector::Unit(scene.n, r);
    J.row(r) = PlaceFactor<Pose>(scene.values, {}, pulled).evaluate(at).gradient - without;
  }
  const Matrix expected = turn.transpose() * J.transpose() * scene.cost.information * J * turn;
  CHECK(difference(symmetric(factor.hessian(at, axes)), expected) <= 1e-12);
  const typename Pose::Rotation base = at.base.rotation();
  const std::vector<typename Pose::Rotation> of_map(8);
  CHECK(difference(factor.landmark_information(3, base),
                   Matrix(symmetric(factor.hessian(at, of_map)).bottomRightCorner(Pose::kDim, Pose::kDim))) <= 1e-12);
}

// A submap about some values, as a place: the same cost to second order, gradient and Hessian.
TEST_CASE_TEMPLATE("place factor: the cost of one submap is that of the submap", Pose, SE3, SE2) {
  constexpr int kDof = Pose::kDof, kDim = Pose::kDim;
  Random random(21);
  for (const ErrorKind error : {ErrorKind::invariant, ErrorKind::standard}) {
    Submap<Pose> submap;
    submap.error = error;
    submap.T_base_end = random_pose<Pose>(random, 0.8, 4);
    std::vector<Index> all;
    const Pose base = random_pose<Pose>(random, 1.0, 10);
    FactorValues<Pose> values{base, base * submap.T_base_end * random_pose<Pose>(random, 0.01, 0.02), {}};
    for (Index i = 0; i < 4; ++i) {
      submap.ids.push_back(static_cast<std::uint64_t>(i));
      submap.counts.push_back(1);
      submap.landmarks.push_back(5 * random.normal_vector<kDim>());
      values.shared.push_back(base * submap.landmarks.back() + 0.02 * random.normal_vector<kDim>());
      all.push_back(i);
    }
    Matrix root(kDof + 4 * kDim, kDof + 4 * kDim + 3);
    for (Index i = 0; i < root.size(); ++i) root.data()[i] = 0.02 * random.normal();
    submap.covariance = root * root.transpose();
    const SubmapFactor<Pose> factor(std::make_shared<const SubmapData<Pose>>(submap), all);
    const std::vector<typename Pose::Rotation> axes(6, base.rotation());
    const auto before = factor.evaluate(values);
    const Quadratic whole =
        in_axes<Pose>(factor.hessian(values, axes), before.gradient, before.cost, 2, base.rotation());
    std::vector<Index> own;
    for (Index i = kDof; i < factor.columns(); ++i) own.push_back(i);
    const PlaceValues<Pose> there{base, {values.end}, values.shared};
    const PlaceFactor<Pose> place(there, submap.ids, without(whole, {}, own));
    const auto after = place.evaluate(there);
    CHECK(after.cost == doctest::Approx(before.cost).epsilon(1e-12));
    CHECK(difference(after.gradient, before.gradient) <= 1e-9);
    CHECK(difference(symmetric(place.hessian(there, axes)), symmetric(factor.hessian(values, axes))) <= 1e-9);
  }
}

TEST_CASE("quadratic cost: without some errors it is the least over them") {
  Random random(22);
  for (const std::vector<Index>& gone : {std::vector<Index>{}, {3}, {7, 0, 4}}) {
    const Index n = 9;
    std::vector<Index> kept;
    for (Index i = n; i-- > 0;)
      if (std::find(gone.begin(), gone.end(), i) == gone.end()) kept.push_back(i);
    Matrix root(n, n);
    for (Index i = 0; i < root.size(); ++i) root.data()[i] = random.normal();
    Quadratic cost{root * root.transpose(), Vector(n), 2.0};
    Vector e(n);
    for (Index i = 0; i < n; ++i) cost.gradient(i) = random.normal(), e(i) = random.normal();
    const auto m = static_cast<Index>(gone.size());
    Matrix own(m, m);
    Vector force(m);
    for (Index i = 0; i < m; ++i) {
      const Index at = gone[static_cast<std::size_t>(i)];
      force(i) = cost.gradient(at);
      for (const Index k : kept) force(i) += cost.information(at, k) * e(k);
      for (Index k = 0; k < m; ++k) own(i, k) = cost.information(at, gone[static_cast<std::size_t>(k)]);
    }
    const Vector least = -own.ldlt().solve(force);
    for (Index i = 0; i < m; ++i) e(gone[static_cast<std::size_t>(i)]) = least(i);
    Vector rest(static_cast<Index>(kept.size()));
    for (std::size_t i = 0; i < kept.size(); ++i) rest(static_cast<Index>(i)) = e(kept[i]);
    const auto value = [](const Quadratic& q, const Vector& x) {
      return q.constant + q.gradient.dot(x) + 0.5 * x.dot(q.information * x);
    };
    CHECK(value(without(cost, gone, kept), rest) == doctest::Approx(value(cost, e)).epsilon(1e-9));
  }
  // A direction without information stays without.
  Quadratic flat{Matrix::Zero(3, 3), Vector::Zero(3), 1.0};
  flat.information(2, 2) = 4.0;
  flat.information(0, 0) = 1.0;
  flat.information(2, 0) = flat.information(0, 2) = 1.0;
  const Quadratic rest = without(flat, {0, 1}, {2});
  CHECK(rest.information(0, 0) == doctest::Approx(3.0));
  CHECK(rest.gradient(0) == 0.0);
}

TEST_CASE("quadratic cost: a part is added to other errors of a sum") {
  Random random(23);
  Quadratic cost{Matrix::Zero(4, 4), Vector::Zero(4), 2.0}, sum{Matrix::Identity(5, 5), Vector::Ones(5), 1.0};
  for (Index i = 0; i < 4; ++i)
    for (Index k = 0; k <= i; ++k) cost.information(i, k) = cost.information(k, i) = random.normal();
  for (Index i = 0; i < 4; ++i) cost.gradient(i) = random.normal();
  add_part(cost, {1, 3}, {4, 0}, sum);
  CHECK(sum.constant == 3.0);
  CHECK(sum.gradient(4) == 1.0 + cost.gradient(1));
  CHECK(sum.gradient(0) == 1.0 + cost.gradient(3));
  CHECK(sum.gradient(1) == 1.0);
  CHECK(sum.information(4, 0) == cost.information(1, 3));
  CHECK(sum.information(0, 4) == cost.information(3, 1));
  CHECK(sum.information(4, 4) == 1.0 + cost.information(1, 1));
  CHECK(sum.information(2, 0) == 0.0);
}
