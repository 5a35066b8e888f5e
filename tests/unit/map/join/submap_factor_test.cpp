// SPDX-License-Identifier: BSD-3-Clause
// A closed submap as one observation: its error against the definition, its derivatives against differences, and the
// elimination of its private landmarks against the complete problem.
#include "map/join/sparse/submap_factor.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "core/error.hpp"
#include "map/join/submap_hessian.hpp"
#include "map/submap_innovation.hpp"
#include "numerical.hpp"

namespace {

using namespace cairn;
using cairn::test::Random;
using cairn::test::whole_hessian;
using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Numbers = std::vector<Index>;

template <class Pose>
using Point = typename Pose::Point;
template <class Pose>
using Tangent = typename Pose::Rotation::Tangent;

constexpr ErrorKind kKinds[] = {ErrorKind::invariant, ErrorKind::standard};

template <class Pose>
Point<Pose> random_point(Random& random, double size = 1) {
  return size * random.normal_vector<Pose::kDim>();
}

template <class Pose>
Tangent<Pose> random_turn(Random& random) {
  return random.normal_vector<Pose::kTurn>();
}

template <class Pose>
Pose random_pose(Random& random, double turn, double way) {
  const Tangent<Pose> tangent = turn * random_turn<Pose>(random);
  return Pose(Pose::Rotation::exp(tangent), random_point<Pose>(random, way));
}

// The position of a landmark in the covariance of the submap, and in the columns of a factor that shares it.
template <class Pose>
Index in_submap(Index landmark) {
  return Pose::kDof + Pose::kDim * landmark;
}
template <class Pose>
Index in_factor(Index shared) {
  return SubmapFactor<Pose>::column(shared);
}

template <class Pose>
Submap<Pose> random_submap(Random& random, ErrorKind error, int landmarks) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  Submap<Pose> submap;
  submap.error = error;
  submap.T_base_end = random_pose<Pose>(random, 0.8, 4);
  for (int i = 0; i < landmarks; ++i) {
    submap.ids.push_back(static_cast<std::uint64_t>(100 + i));
    submap.counts.push_back(1);
    submap.landmarks.push_back(random_point<Pose>(random, 5));
  }
  const Index n = in_submap<Pose>(landmarks);
  Matrix root(n, n + 4);
  for (Index i = 0; i < root.size(); ++i) root.data()[i] = random.normal();
  for (Index r = 0; r < n; ++r) root.row(r) *= r >= kDim && r < kDof ? 0.004 : 0.03;
  submap.covariance = root * root.transpose();
  return submap;
}

// The same with absolute fixes: its base lies at `base`, whose error against Submap::base the submap knows without a
// contribution of the prior.
template <class Pose>
Submap<Pose> fixed_submap(Random& random, ErrorKind error, int landmarks, const Pose& base) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  const Index n = in_submap<Pose>(landmarks), all = n + kDof;
  Submap<Pose> submap = random_submap<Pose>(random, error, landmarks);
  Matrix root(all, all + 4);
  for (Index i = 0; i < root.size(); ++i) root.data()[i] = random.normal();
  for (Index r = 0; r < all; ++r) root.row(r) *= (r >= kDim && r < kDof) || r >= n + kDim ? 0.004 : 0.03;
  const Matrix joint = root * root.transpose();
  SubmapErrors& errors = submap.errors;
  submap.covariance = joint.topLeftCorner(n, n);
  errors.cross = joint.topRightCorner(n, kDof);
  errors.covariance = joint.bottomRightCorner(kDof, kDof);
  errors.prior_covariance = 3 * errors.covariance;
  errors.value = errors.prior = 0.1 * random.normal_vector<kDof>();
  submap.base = retract(base, typename Pose::Tangent(0.2 * random.normal_vector<kDof>()));
  errors.value = errors.prior = pose_error(base, *submap.base);
  return submap;
}

// The estimates of the submap, seen from a base.
template <class Pose>
FactorValues<Pose> own_values(const Submap<Pose>& submap, const Numbers& shared, const Pose& base) {
  FactorValues<Pose> values{base, base * submap.T_base_end, {}};
  for (const Index i : shared) values.shared.push_back(base * submap.landmarks[i]);
  return values;
}

// The errors [base; end; shared] are ordinary.
template <class Pose>
FactorValues<Pose> moved(const FactorValues<Pose>& values, const Vector& e) {
  constexpr int kDof = Pose::kDof;
  using Error = typename Pose::Tangent;
  FactorValues<Pose> out{
      retract(values.base, Error(e.head<kDof>())), retract(values.end, Error(e.segment<kDof>(kDof))), {}};
  for (std::size_t i = 0; i < values.shared.size(); ++i)
    out.shared.push_back(values.shared[i] + e.segment<Pose::kDim>(in_factor<Pose>(static_cast<Index>(i))));
  return out;
}

template <class Pose>
FactorValues<Pose> disturbed(const FactorValues<Pose>& values, Random& random, double position, double turn) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  Vector e(in_factor<Pose>(static_cast<Index>(values.shared.size())));
  for (Index i = 0; i < e.size(); ++i) e(i) = position * random.normal();
  e.segment<kTurn>(kDim) = turn * random_turn<Pose>(random).normalized();
  e.segment<kTurn>(kDof + kDim) = turn * random_turn<Pose>(random).normalized();
  return moved(values, e);
}

template <class Pose>
Matrix numerical_jacobian(const SubmapFactor<Pose>& factor, const FactorValues<Pose>& values) {
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

template <class Pose>
Numbers all_of(const Submap<Pose>& submap) {
  Numbers all;
  for (Index i = 0; i < submap.size(); ++i) all.push_back(i);
  return all;
}

}  // namespace

TEST_CASE_TEMPLATE("submap factor: no residual where the submap itself puts everything", Pose, SE3, SE2) {
  Random random(1);
  for (const ErrorKind error : kKinds)
    for (const Pose& base : cairn::test::awkward_poses<Pose>(2)) {
      const Submap<Pose> submap = random_submap<Pose>(random, error, 4);
      const SubmapFactor<Pose> factor(std::make_shared<SubmapData<Pose>>(submap), {0, 2, 3});
      const FactorValues<Pose> values = own_values(submap, factor.shared(), base);
      const double rounding = 1e-14 * (10 + base.translation().norm());
      CHECK(factor.residual(values).norm() <= 10 * rounding);
      CHECK(factor.rows() == Pose::kDof + 3 * Pose::kDim);
      CHECK(factor.columns() == 2 * Pose::kDof + 3 * Pose::kDim);
    }
}

TEST_CASE_TEMPLATE("submap factor: the residual is the error by its definition", Pose, SE3, SE2) {
  using Rotation = typename Pose::Rotation;
  Random random(3);
  for (const ErrorKind error : kKinds)
    for (const double turn : {0.0, 1e-8, 0.1, 1.2, 3.0}) {
      const Submap<Pose> submap = random_submap<Pose>(random, error, 3);
      const SubmapFactor<Pose> factor(std::make_shared<SubmapData<Pose>>(submap), {0, 1, 2});
      const Pose base = random_pose<Pose>(random, 1, 30);
      FactorValues<Pose> values = own_values(submap, factor.shared(), base);
      const Tangent<Pose> turned = turn * random_turn<Pose>(random).normalized();
      values.end = Pose(Rotation::exp(turned) * values.end.rotation(),
                        values.end.translation() + random_point<Pose>(random, 0.3));
      for (Point<Pose>& l : values.shared) l += random_point<Pose>(random, 0.3);
      const Vector xi = factor.residual(values);
      const Tangent<Pose> xi_R = xi.segment<Pose::kTurn>(Pose::kDim);
      const Rotation R = Rotation::exp(xi_R);
      const typename Rotation::Matrix V = Rotation::translation_jacobian(xi_R);
      const Pose T = base.inverse() * values.end;
      CHECK((R.matrix() * submap.T_base_end.rotation().matrix() - T.rotation().matrix()).norm() <= 1e-12);
      for (Index i = -1; i < 3; ++i) {
        const Point<Pose> truth = i < 0 ? T.translation() : Point<Pose>(base.inverse() * values.shared[i]);
        const Point<Pose> estimate = i < 0 ? submap.T_base_end.translation() : submap.landmarks[i];
        const Point<Pose> e = xi.segment<Pose::kDim>(i < 0 ? 0 : in_submap<Pose>(i));
        const Point<Pose> back =
            error == ErrorKind::invariant ? Point<Pose>(R * estimate + V * e) : Point<Pose>(estimate + e);
        CHECK((back - truth).norm() <= 1e-12 * (1 + base.translation().norm()));
      }
    }
}

TEST_CASE_TEMPLATE("submap factor: derivatives against differences", Pose, SE3, SE2) {
  Random random(4);
  for (const ErrorKind error : kKinds)
    for (const double turn : {0.0, 1e-8, 1e-3, 0.1, 0.7, 1.4})
      for (int repeat = 0; repeat < 3; ++repeat) {
        const Submap<Pose> submap = random_submap<Pose>(random, error, 5);
        const SubmapFactor<Pose> factor(std::make_shared<SubmapData<Pose>>(submap), {1, 2, 4});
        const Pose base = repeat == 0 ? Pose() : random_pose<Pose>(random, 2, 20);
        const FactorValues<Pose> values = disturbed(own_values(submap, factor.shared(), base), random, turn, turn);
        const Matrix J = numerical_jacobian(factor, values);
        Numbers states;
        for (Index d = 0; d < Pose::kDof; ++d) states.push_back(d);
        for (const Index i : factor.shared())
          for (Index d = 0; d < Pose::kDim; ++d) states.push_back(in_submap<Pose>(i) + d);
        const Matrix own = submap.covariance(states, states);
        const Matrix information = own.ldlt().solve(Matrix::Identity(own.rows(), own.rows()));
        const Vector xi = factor.residual(values);
        CHECK(difference(factor.weighted(xi), information * xi) <= 1e-9);
        const typename SubmapFactor<Pose>::Evaluation out = factor.evaluate(values);
        CHECK(out.cost == doctest::Approx(0.5 * xi.dot(information * xi)).epsilon(1e-9));
        const Matrix WJ = information * J;
        CHECK((out.gradient - WJ.transpose() * xi).norm() <= 1e-7 * WJ.norm() * (1e-3 + xi.norm()));
        const Matrix H = whole_hessian(factor, values);
        CHECK(difference(H, J.transpose() * WJ) <= 1e-7);
        std::vector<typename Pose::Rotation> axes;  // a different one for each
        Matrix R = Matrix::Zero(H.rows(), H.rows());
        for (Index i = 0; i < 2 + factor.shared_count(); ++i) {
          axes.push_back(Pose::Rotation::exp(random_turn<Pose>(random)));
          const Index at = i < 2 ? Pose::kDof * i : in_factor<Pose>(i - 2), turn_at = at + Pose::kDim;
          R.block<Pose::kDim, Pose::kDim>(at, at) = axes.back().matrix();
          if (i < 2) R.block<Pose::kTurn, Pose::kTurn>(turn_at, turn_at) = axes.back().adjoint();
        }
        CHECK(difference(whole_hessian(factor, values, axes), R.transpose() * H * R) <= 1e-12);
      }
}

TEST_CASE_TEMPLATE("submap factor: what one landmark is known by", Pose, SE3, SE2) {
  Random random(5);
  for (const ErrorKind error : kKinds) {
    const Submap<Pose> submap = random_submap<Pose>(random, error, 3);
    const SubmapFactor<Pose> factor(std::make_shared<SubmapData<Pose>>(submap), {0, 2});
    const Pose base = random_pose<Pose>(random, 1, 1);
    const Matrix H = whole_hessian(factor, own_values(submap, factor.shared(), base));
    for (Index i = 0; i < 2; ++i)
      CHECK(difference(factor.landmark_information(i, base.rotation()),
                       H.block<Pose::kDim, Pose::kDim>(in_factor<Pose>(i), in_factor<Pose>(i))) <= 1e-10);
  }
}

// The reference is the problem with all landmarks as variables: the elimination must not lose information.
TEST_CASE_TEMPLATE("submap factor: private landmarks leave cost and gradient of the others as they are", Pose, SE3,
                   SE2) {
  Random random(6);
  for (const ErrorKind error : kKinds)
    for (const double size : {0.0, 1e-3, 0.2, 1.0}) {
      const Submap<Pose> submap = random_submap<Pose>(random, error, 6);
      const auto data = std::make_shared<const SubmapData<Pose>>(submap);
      const SubmapFactor<Pose> part(data, {1, 4}), full(data, all_of(submap));
      const Pose base = random_pose<Pose>(random, 1, 10);
      const FactorValues<Pose> values = disturbed(own_values(submap, part.shared(), base), random, size, size);
      const Vector xi = part.residual(values), weight = part.weighted(xi);
      FactorValues<Pose> whole{values.base, values.end, {}};
      const typename SubmapFactor<Pose>::Points placed = part.place_private(values, xi, weight);
      for (Index i = 0; i < 6; ++i)
        whole.shared.push_back(i == 1 ? values.shared[0] : i == 4 ? values.shared[1] : Point<Pose>(placed.col(i)));
      const typename SubmapFactor<Pose>::Evaluation a = part.evaluate(values), b = full.evaluate(whole);
      CHECK(b.cost == doctest::Approx(a.cost).epsilon(1e-8).scale(1e-12));
      const double scale = 1e-7 * (1e-2 + b.gradient.norm());
      CHECK((a.gradient.head(2 * Pose::kDof) - b.gradient.head(2 * Pose::kDof)).norm() <= scale);
      for (Index i = 0; i < 6; ++i) {
        Vector expected = Vector::Zero(Pose::kDim);
        if (i == 1) expected = a.gradient.segment(in_factor<Pose>(0), Pose::kDim);
        if (i == 4) expected = a.gradient.segment(in_factor<Pose>(1), Pose::kDim);
        CHECK((b.gradient.segment(in_factor<Pose>(i), Pose::kDim) - expected).norm() <= scale);
      }
      for (const Index i : {0, 5}) {  // no other values have a smaller cost
        FactorValues<Pose> elsewhere = whole;
        elsewhere.shared[i] += random_point<Pose>(random, 0.01);
        CHECK(full.evaluate(elsewhere).cost > b.cost);
      }
    }
}

TEST_CASE_TEMPLATE("submap factor: covariances of private landmarks against the whole problem's", Pose, SE3, SE2) {
  Random random(7);
  for (const ErrorKind error : kKinds)
    for (int repeat = 0; repeat < 6; ++repeat) {
      const Pose base = random_pose<Pose>(random, 1, 10);
      const Submap<Pose> submap =
          repeat < 4 ? random_submap<Pose>(random, error, 5) : fixed_submap<Pose>(random, error, 5, base);
      const auto data = std::make_shared<const SubmapData<Pose>>(submap);
      const Numbers shared = repeat == 0 ? Numbers{} : Numbers{1, 3},
                    privates = repeat == 0 ? Numbers{4, 0, 2} : Numbers{4, 2};
      const SubmapFactor<Pose> part(data, shared), full(data, all_of(submap));
      const FactorValues<Pose> values = own_values(submap, shared, base);
      const FactorValues<Pose> whole = own_values(submap, all_of(submap), base);
      // Other information about base, end and shared landmarks.
      const Index m = part.columns();
      Matrix root(m, m);
      for (Index i = 0; i < root.size(); ++i) root.data()[i] = 5 * random.normal();
      const Matrix rest = root.transpose() * root;
      Numbers of_part;
      for (Index i = 0; i < 2 * Pose::kDof; ++i) of_part.push_back(i);
      for (const Index i : shared)
        for (Index d = 0; d < Pose::kDim; ++d) of_part.push_back(in_factor<Pose>(i) + d);
      Matrix H = whole_hessian(full, whole);
      H(of_part, of_part) += rest;
      const Matrix P = H.ldlt().solve(Matrix::Identity(H.rows(), H.rows()));
      const Matrix of_others = (whole_hessian(part, values) + rest).ldlt().solve(Matrix::Identity(m, m));
      CHECK(difference(of_others, P(of_part, of_part)) <= 1e-8);

      Matrix A, W;
      part.express_private(privates, values, A, W);
      Numbers of_privates;
      for (const Index i : privates)
        for (Index d = 0; d < Pose::kDim; ++d) of_privates.push_back(in_factor<Pose>(i) + d);
      CHECK(difference(A * of_others * A.transpose() + W, P(of_privates, of_privates)) <= 1e-8);
      CHECK(difference(A * of_others, P(of_privates, of_part)) <= 1e-8);
    }
}

// A submap that is precise in itself, and whose base was widened by hundreds of metres: its covariance is regular only
// with the small noise. Another map knows a shared landmark, and so, nearly, everything else.
TEST_CASE_TEMPLATE("submap factor: no negative variance after the base was widened", Pose, SE3, SE2) {
  Random random(11);
  for (const ErrorKind error : kKinds)
    for (int repeat = 0; repeat < 20; ++repeat) {
      Submap<Pose> submap = random_submap<Pose>(random, error, 6);
      submap.covariance *= std::pow(10.0, -0.3 * repeat);
      const typename Pose::Tangent motion = 300 * Pose::Tangent::Unit(0) + 0.1 * Pose::Tangent::Unit(Pose::kDof - 1);
      widen(submap, typename Pose::Square(motion * motion.transpose()));
      const Numbers shared = {1, 3}, privates = {4, 0, 2, 5};
      const SubmapFactor<Pose> factor(std::make_shared<const SubmapData<Pose>>(submap), shared);
      const FactorValues<Pose> values = own_values(submap, shared, Pose());
      Matrix H = whole_hessian(factor, values);
      H.topLeftCorner<Pose::kDof, Pose::kDof>() += 1e8 * Pose::Square::Identity();  // the base, and a landmark
      H.template block<Pose::kDim, Pose::kDim>(in_factor<Pose>(0), in_factor<Pose>(0)) +=
          1e4 * Pose::Point::UnitX().asDiagonal().toDenseMatrix();
      const Matrix of_others = H.ldlt().solve(Matrix::Identity(H.rows(), H.rows()));
      Matrix A, W;
      factor.express_private(privates, values, A, W);
      const Matrix P = A * of_others * A.transpose() + W;
      CHECK(P.diagonal().minCoeff() > 0.0);
    }
}

TEST_CASE_TEMPLATE("submap factor: exact knowledge is no division by zero, and no covariance is an error", Pose, SE3,
                   SE2) {
  Random random(8);
  for (const ErrorKind error : kKinds) {
    Submap<Pose> submap = random_submap<Pose>(random, error, 2);
    submap.T_base_end = Pose();
    submap.covariance.topRows(Pose::kDof).setZero();
    submap.covariance.leftCols(Pose::kDof).setZero();
    const SubmapFactor<Pose> factor(std::make_shared<SubmapData<Pose>>(submap), {0, 1});
    FactorValues<Pose> values = own_values(submap, {0, 1}, random_pose<Pose>(random, 1, 3));
    CHECK(factor.evaluate(values).cost <= 1e-12);
    CHECK(whole_hessian(factor, values).allFinite());
    values.end = Pose(values.end.rotation(), values.end.translation() + 1e-3 * Point<Pose>::UnitX());
    CHECK(factor.evaluate(values).cost == doctest::Approx(0.5e6).epsilon(0.1));  // a micrometre counts as exact
    const Index l = in_submap<Pose>(0);
    submap.covariance(l + 1, l + 1) = -1.0;
    CHECK_THROWS_AS(SubmapFactor<Pose>(std::make_shared<SubmapData<Pose>>(submap), {0, 1}), Error);
    // Independent of the landmarks that are shared already.
    CHECK_THROWS_AS(SubmapFactor<Pose>(std::make_shared<SubmapData<Pose>>(submap), {1}), Error);
    // One common error: singular until a little noise is added.
    submap.covariance = Matrix::Ones(submap.covariance.rows(), submap.covariance.rows());
    CHECK(whole_hessian(SubmapFactor<Pose>(std::make_shared<SubmapData<Pose>>(submap), {0, 1}), values).allFinite());
    submap.covariance(l + 2, l + 1) = submap.covariance(l + 1, l + 2) = 2.0;  // not a covariance
    CHECK_THROWS_AS(SubmapFactor<Pose>(std::make_shared<SubmapData<Pose>>(submap), {0, 1}), Error);
  }
}

namespace {

// Errors of which the second and the fourth walk: three points in space, constant, at the base and at the end.
SharedErrorOptions error_options() {
  return {{0.1, 0.3, 0.02, 0.5}, {1, 3}};
}

template <class Pose>
Submap<Pose> submap_with_errors(Random& random, ErrorKind error) {
  const Index landmarks = 4, n = in_submap<Pose>(landmarks), g = 4, d = 2, all = n + g + d;
  Submap<Pose> submap = random_submap<Pose>(random, error, static_cast<int>(landmarks));
  Matrix root(all, all + 4);
  for (Index i = 0; i < root.size(); ++i) root.data()[i] = random.normal();
  for (Index r = 0; r < all; ++r) root.row(r) *= r >= Pose::kDim && r < Pose::kDof ? 0.004 : 0.02;
  const Matrix joint = root * root.transpose();
  SubmapErrors& errors = submap.errors;
  submap.covariance = joint.topLeftCorner(n, n);
  errors.cross = joint.topRightCorner(n, g + d);
  errors.covariance = joint.bottomRightCorner(g + d, g + d);
  errors.prior_covariance = 3 * errors.covariance.topLeftCorner(g, g);
  errors.prior = Vector::Zero(g);
  errors.value.resize(g);
  for (Index i = 0; i < g; ++i) errors.value(i) = 0.1 * random.normal();
  errors.walked = 0.05 * Vector::Ones(d);
  return submap;
}

}  // namespace

TEST_CASE_TEMPLATE("submap factor: derivatives by systematic errors against differences", Pose, SE3, SE2) {
  Random random(12);
  for (const ErrorKind error : kKinds)
    for (const double turn : {0.0, 0.1, 0.7}) {
      const Submap<Pose> submap = submap_with_errors<Pose>(random, error);
      const ErrorPoints<Pose> points(error_options());
      const SubmapFactor<Pose> factor(std::make_shared<SubmapData<Pose>>(submap, points), {0, 2});
      const Index first = factor.column(factor.shared_count()), own = factor.columns() - first;
      CHECK(own == Pose::kDim * points.factor_points());
      CHECK(factor.rows() == Pose::kDof + 2 * Pose::kDim + 2);
      FactorValues<Pose> values =
          disturbed(own_values(submap, factor.shared(), random_pose<Pose>(random, 2, 20)), random, turn, turn);
      values.errors = 0.3 * Vector::Ones(own);
      const auto at = [&](const Vector& e) {
        FactorValues<Pose> out = moved(values, e);
        out.errors = values.errors + e.tail(own);
        return out;
      };
      // The cost is a sum of squares: its gradient and, without residual, its Hessian by differences.
      const auto slope = [&](Index c) {
        const Vector e = cairn::test::kStep * Vector::Unit(factor.columns(), c);
        const auto cost = [&](double times) { return factor.evaluate(at(times * e)).cost; };
        return (8 * (cost(1) - cost(-1)) - (cost(2) - cost(-2))) / (12 * cairn::test::kStep);
      };
      const typename SubmapFactor<Pose>::Evaluation out = factor.evaluate(values);
      for (Index c = 0; c < factor.columns(); ++c)
        CHECK(out.gradient(c) == doctest::Approx(slope(c)).epsilon(1e-5).scale(1 + out.gradient.norm()));
      // The columns of the errors are linear: their block of the Hessian is exact anywhere.
      const Matrix H = factor.hessian(
          values, std::vector<typename Pose::Rotation>(static_cast<std::size_t>(2 + factor.shared_count())));
      for (Index c = first; c < factor.columns(); ++c) {
        const Vector e = 0.1 * Vector::Unit(factor.columns(), c);
        const Vector change = (factor.evaluate(at(e)).gradient - factor.evaluate(at(-e)).gradient) / 0.2;
        CHECK((change.tail(own) -
               Matrix(Matrix(H.bottomRightCorner(own, own)).selfadjointView<Eigen::Lower>()).col(c - first))
                  .norm() <= 1e-7 * (1 + change.norm()));
        CHECK((change.head(first) - H.row(c).head(first).transpose()).norm() <= 1e-7 * (1 + change.norm()));
      }
    }
}

TEST_CASE_TEMPLATE("submap factor: derivatives by a base of which fixes tell, against differences", Pose, SE3, SE2) {
  Random random(13);
  for (const ErrorKind error : kKinds)
    for (const double away : {0.0, 0.1, 0.5}) {
      const Pose base = random_pose<Pose>(random, 1, 20);
      const Submap<Pose> submap = fixed_submap<Pose>(random, error, 4, base);
      const SubmapFactor<Pose> factor(std::make_shared<SubmapData<Pose>>(submap), {0, 2});
      const FactorValues<Pose> values = disturbed(own_values(submap, factor.shared(), base), random, away, away);
      const typename SubmapFactor<Pose>::Evaluation out = factor.evaluate(values);
      for (Index c = 0; c < factor.columns(); ++c) {
        const Vector e = cairn::test::kStep * Vector::Unit(factor.columns(), c);
        const auto cost = [&](double times) { return factor.evaluate(moved(values, times * e)).cost; };
        const double slope = (8 * (cost(1) - cost(-1)) - (cost(2) - cost(-2))) / (12 * cairn::test::kStep);
        CHECK(out.gradient(c) == doctest::Approx(slope).epsilon(1e-5).scale(1 + out.gradient.norm()));
      }
      if (away > 0.0) continue;
      CHECK(out.cost < 1e-20);  // without residual the second derivative of the cost is J^T Sigma^-1 J
      const Matrix H = whole_hessian(factor, values);
      for (Index c = 0; c < factor.columns(); ++c) {
        const Vector e = 1e-5 * Vector::Unit(factor.columns(), c);
        const Vector change =
            (factor.evaluate(moved(values, e)).gradient - factor.evaluate(moved(values, -1.0 * e)).gradient) / 2e-5;
        CHECK((change - H.col(c)).norm() <= 1e-6 * H.norm());
      }
    }
}

TEST_CASE_TEMPLATE("submap factor: without its frame a submap keeps what the fixes told about the way", Pose, SE3,
                   SE2) {
  Random random(14);
  for (const ErrorKind error : kKinds) {
    const Pose base = random_pose<Pose>(random, 1, 10);
    const Submap<Pose> submap = fixed_submap<Pose>(random, error, 3, base);
    const SubmapData<Pose> data(submap), relative = data.without_base();
    const SubmapFactor<Pose> with(std::make_shared<SubmapData<Pose>>(data), all_of(submap)),
        without(std::make_shared<SubmapData<Pose>>(relative), all_of(submap));
    CHECK(!relative.base.has_value());
    const FactorValues<Pose> values = own_values(submap, all_of(submap), base);
    const Matrix H = whole_hessian(without, values), G = whole_hessian(with, values);
    constexpr int kDof = Pose::kDof;
    // Motions of the whole submap cost nothing any more.
    Matrix rigid = Matrix::Zero(H.rows(), kDof);
    rigid.topRows<kDof>().setIdentity();
    const ProductJacobians of_end(base, submap.T_base_end);
    rigid.middleRows<kDof>(kDof) = of_end.by_a;
    for (Index i = 0; i < submap.size(); ++i) {
      const Index row = in_factor<Pose>(i);
      rigid.block<Pose::kDim, Pose::kDim>(row, 0).setIdentity();
      rigid.block<Pose::kDim, Pose::kTurn>(row, Pose::kDim) =
          Pose::Rotation::turn(base.rotation() * submap.landmarks[static_cast<std::size_t>(i)]);
    }
    CHECK((H * rigid).norm() <= 1e-9 * H.norm() * rigid.norm());
    CHECK((G * rigid).norm() > 1e-6 * G.norm());
    // After the base is eliminated, both say the same about what no motion of the whole changes.
    const Index m = H.rows() - kDof;
    const auto shape = [&](const Matrix& information, double hold) {
      const Matrix free = rigid.bottomRows(m);
      const Matrix own = information.bottomRightCorner(m, m), cross = information.bottomLeftCorner(m, kDof);
      const Matrix rest =
          own - cross * Matrix(information.topLeftCorner(kDof, kDof)).ldlt().solve(Matrix(cross.transpose()));
      const Matrix basis = Eigen::FullPivLU<Matrix>(free.transpose()).kernel();
      const Matrix P = (rest + hold * free * free.transpose()).ldlt().solve(basis);
      return Matrix(basis.transpose() * P);
    };
    CHECK(difference(shape(H, 1.0), shape(G, 0.0)) < 1e-4);
  }
}
