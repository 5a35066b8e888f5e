// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/alignment.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/chi_square.hpp"
#include "map/merge/compatible_alignment.hpp"
#include "numerical.hpp"

using namespace cairn;
using cairn::test::Random;

namespace {

using Dense = Eigen::MatrixXd;
using DenseVector = Eigen::VectorXd;
using Points = std::vector<Vector3>;

DenseVector normal_of(Random& random, Eigen::Index n) {
  DenseVector x(n);
  for (Eigen::Index i = 0; i < n; ++i) x[i] = random.normal();
  return x;
}

// The covariance of k points of a map from a drive: independent errors, and errors that all points have in common.
Dense joint_covariance(Random& random, const Points& points, double own, double common) {
  const auto n = 3 * static_cast<Eigen::Index>(points.size());
  Dense root(n, n + 6);
  root.setZero();
  for (Eigen::Index i = 0; i < n; i += 3) {
    for (Eigen::Index c = 0; c < 3; ++c) root.block<3, 1>(i, i + c) = own * random.normal_vector<3>();
    root.block<3, 3>(i, n) = common * Matrix3::Identity();
    root.block<3, 3>(i, n + 3) = 0.02 * common * hat(points[static_cast<std::size_t>(i / 3)]);
  }
  return root * root.transpose() + 1e-4 * own * own * Dense::Identity(n, n);
}

PointsCovariance full(const Dense& S) {
  return {{}, std::vector<double>(S.data(), S.data() + S.size())};
}

PointsCovariance blocks(const Dense& S) {
  PointsCovariance covariance;
  for (Eigen::Index i = 0; i < S.rows(); i += 3) covariance.blocks.push_back(S.block<3, 3>(i, i));
  return covariance;
}

Dense only_blocks(const Dense& S) {
  Dense D = Dense::Zero(S.rows(), S.cols());
  for (Eigen::Index i = 0; i < S.rows(); i += 3) D.block<3, 3>(i, i) = S.block<3, 3>(i, i);
  return D;
}

void disturb(Random& random, const Dense& S, Points& points) {
  const DenseVector error = S.llt().matrixL() * normal_of(random, S.rows());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += error.segment<3>(3 * static_cast<Eigen::Index>(i));
}

// Two disturbed views of the same points.
struct Scene {
  SE3 T_a_b;
  Points true_a, true_b;
  Dense Sigma_a, Sigma_b;
  PairedPoints pairs;

  Scene(Random& random, std::size_t k, double own, double common, bool correlated = true) {
    T_a_b = SE3(SO3::exp(3 * random.normal_vector<3>().normalized()), 40 * random.normal_vector<3>());
    for (std::size_t i = 0; i < k; ++i) {
      true_a.emplace_back(20 * random.normal(), 20 * random.normal(), 3 * random.normal());
      true_b.push_back(T_a_b.inverse() * true_a.back());
    }
    Sigma_a = joint_covariance(random, true_a, own, common);
    Sigma_b = joint_covariance(random, true_b, own, common);
    if (!correlated) Sigma_a = only_blocks(Sigma_a), Sigma_b = only_blocks(Sigma_b);
    pairs.covariance_a = correlated ? full(Sigma_a) : blocks(Sigma_a);
    pairs.covariance_b = correlated ? full(Sigma_b) : blocks(Sigma_b);
    draw(random);
  }

  void draw(Random& random) {
    pairs.a = true_a;
    pairs.b = true_b;
    disturb(random, Sigma_a, pairs.a);
    disturb(random, Sigma_b, pairs.b);
  }

  // The distance at a transform, by definition.
  double distance(const SE3& T) const {
    const auto n = Sigma_a.rows();
    Dense R = Dense::Zero(n, n);
    DenseVector r(n);
    for (Eigen::Index i = 0; i < n; i += 3) {
      R.block<3, 3>(i, i) = T.rotation().matrix();
      r.segment<3>(i) = pairs.a[static_cast<std::size_t>(i / 3)] - T * pairs.b[static_cast<std::size_t>(i / 3)];
    }
    return r.dot((Sigma_a + R * Sigma_b * R.transpose()).ldlt().solve(r));
  }
};

double error_norm(const SE3& truth, const SE3& estimate) {
  return pose_error(truth, estimate).norm();
}

// Bounds that a mean of `runs` chi-squares of `dof` exceeds once in a million.
bool is_mean_chi_square(double mean, int runs, int dof) {
  const double n = static_cast<double>(runs) * dof;
  return runs * mean > chi_square_quantile(n, 5e-7) && runs * mean < chi_square_quantile(n, 1 - 5e-7);
}

Matrix6 some_covariance(Random& random, double metres, double radians) {
  Matrix6 A;
  for (int c = 0; c < 6; ++c) A.col(c) = random.normal_vector<6>();
  Vector6 scale;
  scale << Vector3::Constant(metres), Vector3::Constant(radians);
  return scale.asDiagonal() * (A * A.transpose()) * scale.asDiagonal();
}

}  // namespace

TEST_CASE("alignment: exact points give the exact transform") {
  for (const SE3& T : test::awkward_poses(1)) {
    Random random(2);
    Scene scene(random, 6, 0.1, 0);
    for (std::size_t i = 0; i < 6; ++i) scene.pairs.a[i] = T * scene.pairs.b[i];
    const Alignment alignment = align(scene.pairs);
    REQUIRE(alignment.ok());
    const double size = 1 + T.translation().norm();
    CHECK((alignment.T_a_b.translation() - T.translation()).norm() < 1e-11 * size);
    CHECK((alignment.T_a_b.rotation().matrix() - T.rotation().matrix()).norm() < 1e-12 * size);
    CHECK(alignment.distance < 1e-16 * size * size);
    CHECK(alignment.dof == 12);
  }
}

TEST_CASE("alignment: the distance is at its minimum, and bends as the covariance says") {
  for (unsigned seed = 1; seed < 12; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool correlated = seed % 3 != 0;
    const Scene scene(random, 4 + seed, 0.5, 1.0, correlated);
    const Alignment alignment = align(scene.pairs);
    REQUIRE(alignment.ok());
    CHECK(std::abs(scene.distance(alignment.T_a_b) - alignment.distance) < 1e-8 * (1 + alignment.distance));
    // Steps of one standard deviation of each unknown.
    const Matrix6 L = alignment.covariance.llt().matrixL();
    const auto f = [&](const Vector6& x) { return Vector1(scene.distance(retract(alignment.T_a_b, L * x))); };
    const Eigen::Matrix<double, 1, 6> gradient = test::jacobian_at_zero<6>(f);
    CHECK(gradient.norm() < 1e-7 * (1 + alignment.distance));
  }
  // With small errors the second derivative is twice the inverse of the covariance.
  Random random(20);
  const Scene scene(random, 7, 1e-3, 1e-3);
  const Alignment alignment = align(scene.pairs);
  REQUIRE(alignment.ok());
  const Matrix6 L = alignment.covariance.llt().matrixL();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) {
      const auto f = [&](double x, double y) {
        return scene.distance(retract(alignment.T_a_b, L * (x * Vector6::Unit(i) + y * Vector6::Unit(j))));
      };
      CHECK(0.25 * (f(1, 1) - f(1, -1) - f(-1, 1) + f(-1, -1)) == doctest::Approx(i == j ? 2 : 0).epsilon(0.01));
    }
}

TEST_CASE("alignment: with a prior the sum of both distances is at its minimum") {
  for (unsigned seed = 1; seed < 8; ++seed) {
    CAPTURE(seed);
    Random random(30 + seed);
    const Scene scene(random, 2 + seed, 0.5, 1.0);
    const Matrix6 P = some_covariance(random, 0.5, 0.02);
    const Matrix6 root = P.llt().matrixL();
    const TransformPrior prior{retract(scene.T_a_b, root * random.normal_vector<6>()), P};
    const Alignment alignment = align(scene.pairs, &prior);
    REQUIRE(alignment.ok());
    CHECK(alignment.dof == 3 * static_cast<int>(scene.pairs.size()));
    const auto total = [&](const SE3& T) {
      const Vector6 error = pose_error(T, prior.T_a_b);
      return scene.distance(T) + error.dot(P.ldlt().solve(error));
    };
    CHECK(total(alignment.T_a_b) == doctest::Approx(alignment.distance).epsilon(1e-7));
    const Matrix6 L = alignment.covariance.llt().matrixL();
    const auto f = [&](const Vector6& x) { return Vector1(total(retract(alignment.T_a_b, L * x))); };
    CHECK(test::jacobian_at_zero<6>(f).norm() < 1e-6 * (1 + alignment.distance));
  }
}

TEST_CASE("alignment: a transform that is known exactly stays, and one known in part moves in that part alone") {
  Random random(40);
  const Scene scene(random, 5, 0.1, 0.2);
  TransformPrior prior{retract(scene.T_a_b, 1e-3 * random.normal_vector<6>()), Matrix6::Zero()};
  Alignment alignment = align(scene.pairs, &prior);
  REQUIRE(alignment.ok());
  CHECK(error_norm(prior.T_a_b, alignment.T_a_b) == 0.0);
  CHECK(alignment.covariance == Matrix6::Zero());
  CHECK(alignment.dof == 15);
  CHECK(alignment.distance == doctest::Approx(scene.distance(prior.T_a_b)).epsilon(1e-9));

  prior.covariance(5, 5) = 1e-4;  // heading
  alignment = align(scene.pairs, &prior);
  REQUIRE(alignment.ok());
  const Vector6 error = pose_error(alignment.T_a_b, prior.T_a_b);
  CHECK(error.head<5>().norm() < 1e-12);
  CHECK(std::abs(error[5]) > 1e-6);
  CHECK(alignment.covariance(5, 5) > 0);
  CHECK(alignment.covariance(5, 5) < 1e-4);
}

TEST_CASE("alignment: independent points in blocks and in one matrix are the same") {
  Random random(50);
  const Scene scene(random, 9, 0.3, 0.5, false);
  PairedPoints in_full = scene.pairs, mixed = scene.pairs;
  in_full.covariance_a = full(scene.Sigma_a);
  in_full.covariance_b = full(scene.Sigma_b);
  mixed.covariance_b = full(scene.Sigma_b);
  PairedPoints mixed_too = scene.pairs;
  mixed_too.covariance_a = full(scene.Sigma_a);
  const Alignment expected = align(scene.pairs, nullptr, true);
  REQUIRE(expected.ok());
  for (const PairedPoints* pairs : {&in_full, &mixed, &mixed_too}) {
    const Alignment alignment = align(*pairs, nullptr, true);
    REQUIRE(alignment.ok());
    CHECK(error_norm(expected.T_a_b, alignment.T_a_b) < 1e-9);
    CHECK((expected.covariance - alignment.covariance).norm() < 1e-9 * expected.covariance.norm());
    CHECK(alignment.distance == doctest::Approx(expected.distance).epsilon(1e-9));
    for (std::size_t i = 0; i < 9; ++i) CHECK(alignment.falls[i] == doctest::Approx(expected.falls[i]).epsilon(1e-6));
  }
}

TEST_CASE("alignment: over many draws distance and error are chi-square") {
  constexpr int kRuns = 400;
  for (int kind = 0; kind < 4; ++kind) {  // correlated, independent, with a prior, with an exact prior
    CAPTURE(kind);
    Random random(60 + static_cast<unsigned>(kind));
    Scene scene(random, 8, 0.05, 0.2, kind != 1);
    Matrix6 P = Matrix6::Zero();
    if (kind == 2) P = some_covariance(random, 0.1, 0.005);
    const Matrix6 root = kind == 2 ? Matrix6(P.llt().matrixL()) : P;
    double distance = 0, error = 0;
    int dof = 0;
    for (int run = 0; run < kRuns; ++run) {
      scene.draw(random);
      const TransformPrior prior{retract(scene.T_a_b, root * random.normal_vector<6>()), P};
      const Alignment alignment = align(scene.pairs, kind >= 2 ? &prior : nullptr);
      REQUIRE(alignment.ok());
      dof = alignment.dof;
      distance += alignment.distance / kRuns;
      const Vector6 e = pose_error(scene.T_a_b, alignment.T_a_b);
      if (kind != 3) error += e.dot(alignment.covariance.ldlt().solve(e)) / kRuns;
    }
    CHECK(dof == (kind < 2 ? 18 : 24));
    CHECK(is_mean_chi_square(distance, kRuns, dof));
    if (kind != 3) CHECK(is_mean_chi_square(error, kRuns, 6));
  }
}

TEST_CASE("alignment: falls are what leaving a pair out gives") {
  for (int kind = 0; kind < 4; ++kind) {  // correlated, independent, each without and with a prior
    CAPTURE(kind);
    Random random(70 + static_cast<unsigned>(kind));
    Scene scene(random, 6, 0.002, 0.005, kind % 2 == 0);
    scene.pairs.a[2] += Vector3(0.01, -0.02, 0.01);
    const Matrix6 P = some_covariance(random, 0.01, 0.001);
    const TransformPrior given{scene.T_a_b, P};
    const TransformPrior* prior = kind >= 2 ? &given : nullptr;
    const Alignment all = align(scene.pairs, prior, true);
    REQUIRE(all.ok());
    REQUIRE(all.falls.size() == 6);
    for (std::size_t leave = 0; leave < 6; ++leave) {
      std::vector<std::size_t> rest;
      for (std::size_t i = 0; i < 6; ++i)
        if (i != leave) rest.push_back(i);
      const Alignment without = align(select_pairs(scene.pairs, rest), prior);
      REQUIRE(without.ok());
      CHECK(all.distance - without.distance == doctest::Approx(all.falls[leave]).epsilon(0.01));
    }
  }
}

TEST_CASE("alignment: wrong pairs are found, and no others") {
  for (int kind = 0; kind < 4; ++kind) {
    CAPTURE(kind);
    Random random(80 + static_cast<unsigned>(kind));
    for (int run = 0; run < 10; ++run) {
      Scene scene(random, 14, 0.05, 1.0, kind % 2 == 0);
      const double size = kind % 2 == 0 ? 3.0 : 20.0;  // if correlated: far smaller than the common errors
      scene.pairs.a[3] += size * Vector3(1, 1, 0);
      scene.pairs.b[9] += 2 * size * Vector3(0, 1, -1);
      const TransformPrior given{scene.T_a_b, some_covariance(random, 0.1, 0.01)};
      CompatibleAlignment result = align_compatible(scene.pairs, 1 - 1e-6, 1, kind >= 2 ? &given : nullptr);
      CAPTURE(run);
      REQUIRE(result.alignment.ok());
      std::sort(result.left_out.begin(), result.left_out.end());
      CHECK(result.left_out == std::vector<std::size_t>{3, 9});
      CHECK(result.kept == std::vector<std::size_t>{0, 1, 2, 4, 5, 6, 7, 8, 10, 11, 12, 13});
      CHECK(result.alignment.dof == (kind < 2 ? 30 : 36));
      const Alignment direct = align(select_pairs(scene.pairs, result.kept), kind >= 2 ? &given : nullptr);
      CHECK(error_norm(direct.T_a_b, result.alignment.T_a_b) < 1e-6);
      CHECK(direct.distance == doctest::Approx(result.alignment.distance).epsilon(1e-6));
    }
  }
}

TEST_CASE("alignment: among many pairs each is held against the others") {
  for (const bool correlated : {true, false}) {
    CAPTURE(correlated);
    Random random(85);
    Scene scene(random, 60, 0.05, 0.1, correlated);
    // Wrong enough to fail its own test, but hidden in the sum of 174 squares.
    double fall = 0;
    while (fall < 45) {
      scene.pairs.a[10].y() += 0.02;
      fall = align(scene.pairs, nullptr, true).falls[10];
    }
    CHECK(align_compatible(scene.pairs, 1 - 1e-9, 1).left_out.empty());
    CHECK(align_compatible(scene.pairs, 1 - 1e-9, 1 - 1e-5).left_out == std::vector<std::size_t>{10});
  }
}

TEST_CASE("alignment: what no transform can do is said") {
  Random random(90);
  Scene scene(random, 8, 0.05, 0.1);
  CHECK(align(select_pairs(scene.pairs, {0, 1})).status == AlignmentStatus::too_few);
  CHECK(align(PairedPoints{}).status == AlignmentStatus::too_few);
  const TransformPrior prior{scene.T_a_b, Matrix6::Zero()};
  CHECK(align(PairedPoints{}, &prior).status == AlignmentStatus::too_few);
  CHECK(align(select_pairs(scene.pairs, {0}), &prior).ok());
  CHECK(align(select_pairs(scene.pairs, {0, 1, 2})).ok());
  CHECK(align_compatible(select_pairs(scene.pairs, {0, 1}), 0.99, 0.999).kept.empty());

  PairedPoints line;  // exactly on a line, then on a line only within their covariances, then all at one place
  for (double noise : {0.0, 0.05}) {
    line = PairedPoints{};
    for (int i = 0; i < 30; ++i) {
      line.b.push_back(Vector3(i, 2 * i, 0) + noise * random.normal_vector<3>());
      line.a.push_back(scene.T_a_b * Vector3(i, 2 * i, 0) + noise * random.normal_vector<3>());
      line.covariance_a.blocks.push_back(0.0025 * Matrix3::Identity());
      line.covariance_b.blocks.push_back(0.0025 * Matrix3::Identity());
    }
    CHECK(align(line).status == AlignmentStatus::degenerate);
    CHECK(align(line, &prior).ok());
  }
  for (Vector3& b : line.b) b.setOnes();
  for (Vector3& a : line.a) a.setZero();
  CHECK(align(line).status == AlignmentStatus::degenerate);

  PairedPoints certain = scene.pairs;
  std::fill(certain.covariance_a.full.begin(), certain.covariance_a.full.end(), 0.0);
  std::fill(certain.covariance_b.full.begin(), certain.covariance_b.full.end(), 0.0);
  CHECK(align(certain).status == AlignmentStatus::singular);
}

TEST_CASE("alignment: a mirrored set is no rotation of itself") {
  Random random(100);
  Scene scene(random, 10, 0.02, 0.05);
  for (Vector3& a : scene.pairs.a) a.y() = -a.y();
  const Alignment alignment = align(scene.pairs);
  CHECK(alignment.T_a_b.rotation().matrix().determinant() == doctest::Approx(1));
  CHECK((!alignment.ok() || alignment.distance > 100 * chi_square_quantile(alignment.dof, 0.999)));
}
