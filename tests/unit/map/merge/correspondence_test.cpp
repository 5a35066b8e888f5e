// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/correspondence.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/chi_square.hpp"
#include "geometry/angle.hpp"
#include "numerical.hpp"

using namespace cairn;
using cairn::test::Random;
using Reason = CorrespondenceReason;

namespace {

// Rolling ground, one landmark in 160 m^2 on average, some of them on top of boulders.
Vector3 on_ground(double x, double y, double height) {
  return Vector3(x, y, 3 * std::sin(x / 15) + 2 * std::cos(y / 12) + height);
}

Vector3 random_landmark(Random& random, const Vector3& low, const Vector3& high) {
  const double x = random.uniform(low.x(), high.x()), y = random.uniform(low.y(), high.y());
  return on_ground(x, y, random.uniform(0, 1.5));
}

// Two maps in different frames, and the points that they have in common.
struct Maps {
  SE3 T_a_b;
  std::vector<Vector3> true_a, true_b;  // both in frame a
  std::vector<std::size_t> partner;     // by point of b: the same point in a, or none
  PointSet a, b;
  static constexpr std::size_t kNone = SIZE_MAX;

  void observe(Random& random, double sigma) {
    T_a_b = SE3(SO3::exp(Vector3(0.1, -0.2, random.uniform(-3, 3))), 100 * random.normal_vector<3>());
    // b in another order
    for (std::size_t i = true_b.size(); i > 1; --i) {
      const auto j = static_cast<std::size_t>(random.uniform(0, static_cast<double>(i)));
      std::swap(true_b[i - 1], true_b[j]);
      std::swap(partner[i - 1], partner[j]);
    }
    const auto add = [&](PointSet& set, const Vector3& p) {
      const Vector3 sigmas =
          sigma * Vector3(random.uniform(0.6, 1.4), random.uniform(0.6, 1.4), random.uniform(0.6, 1.4));
      set.points.push_back(p + sigmas.cwiseProduct(random.normal_vector<3>()));
      set.covariances.push_back(sigmas.cwiseAbs2().asDiagonal());
    };
    for (const Vector3& p : true_a) add(a, p);
    for (const Vector3& p : true_b) add(b, T_a_b.inverse() * p);
  }

  // How many of the pairs are correct.
  std::size_t right(const Correspondence& result) const {
    return static_cast<std::size_t>(std::count_if(result.pairs.begin(), result.pairs.end(), [&](const auto& pair) {
      return partner[pair.second] == pair.first;
    }));
  }
  // The error of the transform. The position error is taken at the points of b: at an origin far from them, the
  // smallest rotation makes metres.
  double nees(const Correspondence& result) const {
    Vector3 centre = Vector3::Zero();
    for (const Vector3& p : b.points) centre += p / static_cast<double>(b.points.size());
    const SE3 there(SO3(), centre);
    Matrix6 J = Matrix6::Identity();
    J.topRightCorner<3, 3>() = -hat(result.alignment.T_a_b.rotation() * centre);
    const Vector6 error = pose_error(T_a_b * there, result.alignment.T_a_b * there);
    return error.dot((J * result.alignment.covariance * J.transpose()).ldlt().solve(error));
  }
};

// Two strips that overlap at their ends: they share `common` of their n points.
Maps strips(Random& random, std::size_t n, std::size_t common, double sigma) {
  Maps maps;
  const double breadth = 60, length = 160.0 * static_cast<double>(n) / breadth;
  const double shared = length * static_cast<double>(common) / static_cast<double>(n);
  const auto fill = [&](double from, double to, std::size_t count, auto&& add) {
    for (std::size_t i = 0; i < count; ++i) add(random_landmark(random, Vector3(from, 0, 0), Vector3(to, breadth, 0)));
  };
  fill(0, length - shared, n - common, [&](const Vector3& p) { maps.true_a.push_back(p); });
  fill(length - shared, length, common, [&](const Vector3& p) {
    maps.partner.push_back(maps.true_a.size());
    maps.true_a.push_back(p);
    maps.true_b.push_back(p);
  });
  fill(length, 2 * length - shared, n - common, [&](const Vector3& p) {
    maps.partner.push_back(Maps::kNone);
    maps.true_b.push_back(p);
  });
  maps.observe(random, sigma);
  return maps;
}

// Two maps of one square that share only `common` of its landmarks.
Maps mixed(Random& random, std::size_t n, std::size_t common, double sigma) {
  Maps maps;
  const double side = std::sqrt(160.0 * static_cast<double>(2 * n - common));
  const auto one = [&] { return random_landmark(random, Vector3::Zero(), Vector3(side, side, 0)); };
  for (std::size_t i = 0; i < n; ++i) maps.true_a.push_back(one());
  for (std::size_t i = 0; i < n; ++i) {
    maps.true_b.push_back(i < common ? maps.true_a[i] : one());
    maps.partner.push_back(i < common ? i : Maps::kNone);
  }
  maps.observe(random, sigma);
  return maps;
}

// Both maps hold all of these points.
Maps of_layout(Random& random, const std::vector<Vector3>& layout, double sigma) {
  Maps maps;
  maps.true_a = maps.true_b = layout;
  for (std::size_t i = 0; i < layout.size(); ++i) maps.partner.push_back(i);
  maps.observe(random, sigma);
  return maps;
}

// Checks that nearly all common points are found and none is wrong, that the covariance covers the error of the
// transform, and that the joint test passes.
void check_found(const Maps& maps, const Correspondence& result, std::size_t common) {
  CAPTURE(static_cast<int>(result.reason));
  CAPTURE(common);
  CAPTURE(result.hypotheses);
  CAPTURE(result.verified);
  REQUIRE(result.found());
  const std::size_t right = maps.right(result);
  CHECK(static_cast<double>(right) >= 0.93 * static_cast<double>(common));
  CHECK(static_cast<double>(result.pairs.size() - right) <= 0.03 * static_cast<double>(common) + result.chance);
  CHECK(maps.nees(result) < chi_square_quantile(6, 1 - 1e-6));
  CHECK(result.alignment.distance <= chi_square_quantile(result.alignment.dof, 0.99));
  CHECK(std::is_sorted(result.pairs.begin(), result.pairs.end()));
}

}  // namespace

TEST_CASE("correspondence: all in common, a third, a tenth, at several noises") {
  for (double sigma : {0.01, 0.1, 0.3})
    for (std::size_t common : {120, 40, 15}) {
      CAPTURE(sigma);
      Random random(1 + common);
      Maps maps = strips(random, 120, common, sigma);
      check_found(maps, match_points(maps.a, maps.b), common);
      if (common < 40) continue;
      maps = mixed(random, 120, common, sigma);
      check_found(maps, match_points(maps.a, maps.b), common);
    }
}

TEST_CASE("correspondence: few points, and far from their origins") {
  Random random(20);
  Maps maps = mixed(random, 12, 12, 0.05);
  check_found(maps, match_points(maps.a, maps.b), 12);
  const Vector3 away(3e5, -2e5, 100);
  for (Vector3& p : maps.b.points) p += away;
  maps.T_a_b = maps.T_a_b * SE3(SO3(), -away);
  check_found(maps, match_points(maps.a, maps.b), 12);
  maps.a.points.resize(4);
  maps.a.covariances.resize(4);
  CHECK(match_points(maps.a, maps.b).reason == Reason::too_few);
  CHECK(match_points(PointSet{}, PointSet{}).reason == Reason::too_few);
}

TEST_CASE("correspondence: maps of different places do not match") {
  for (std::size_t n : {8, 40, 200})
    for (unsigned seed = 1; seed <= 3; ++seed)
      for (double sigma : {0.02, 0.2}) {
        CAPTURE(n);
        CAPTURE(seed);
        CAPTURE(sigma);
        Random random(30 + seed);
        const Maps maps = mixed(random, n, 0, sigma);
        const Correspondence result = match_points(maps.a, maps.b);
        CHECK(result.reason == Reason::nothing);
        CHECK(result.pairs.empty());
      }
}

TEST_CASE("correspondence: a mirrored map is another place") {
  Random random(40);
  Maps maps = mixed(random, 80, 80, 0.05);
  check_found(maps, match_points(maps.a, maps.b), 80);
  for (Vector3& p : maps.b.points) p.y() = -p.y();
  CHECK_FALSE(match_points(maps.a, maps.b).found());
  CorrespondenceOptions options;
  options.max_tilt = 1;
  CHECK(match_points(maps.a, maps.b, options).reason == Reason::nothing);
}

TEST_CASE("correspondence: a flat mirrored map matches upside down, unless both know up") {
  Random random(50);
  std::vector<Vector3> flat;
  for (int i = 0; i < 60; ++i) flat.emplace_back(random.uniform(0, 100), random.uniform(0, 100), 0);
  Maps maps = of_layout(random, flat, 0.05);
  maps.b.points.clear();
  for (const Vector3& p : maps.true_b) maps.b.points.emplace_back(p.x(), -p.y(), p.z());
  CorrespondenceOptions options;
  CHECK(match_points(maps.a, maps.b, options).found());
  options.max_tilt = 0.5;
  CHECK(match_points(maps.a, maps.b, options).reason == Reason::nothing);
}

TEST_CASE("correspondence: what looks the same from several sides is ambiguous") {
  Random random(60);
  std::vector<Vector3> grid, ring, twice;
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 7; ++y) grid.emplace_back(10 * x, 10 * y, 0);
  for (int i = 0; i < 12; ++i) ring.push_back(Vector3(30 * std::cos(kPi * i / 6), 30 * std::sin(kPi * i / 6), i % 2));
  for (int i = 0; i < 25; ++i) {  // and all of them again, rotated by half a turn
    const Vector3 p(random.uniform(5, 60), random.uniform(-40, 40), random.uniform(0, 5));
    twice.push_back(p);
    twice.emplace_back(-p.x(), -p.y(), p.z());
  }
  for (const std::vector<Vector3>& layout : {grid, ring, twice}) {
    CAPTURE(layout.size());
    const Maps maps = of_layout(random, layout, 0.05);
    const Correspondence result = match_points(maps.a, maps.b);
    CAPTURE(static_cast<int>(result.reason));
    CHECK((result.reason == Reason::ambiguous || result.reason == Reason::budget));
    CHECK(result.pairs.empty());
  }
  // If only half of the points have a rotated copy, the rotated transform is worse.
  twice.resize(twice.size() / 2);
  for (int i = 0; i < 25; ++i)
    twice.emplace_back(random.uniform(-60, 60), random.uniform(-40, 40), random.uniform(0, 5));
  const Maps maps = of_layout(random, twice, 0.05);
  check_found(maps, match_points(maps.a, maps.b), twice.size());
}

TEST_CASE("correspondence: landmarks that have moved are left out") {
  Random random(70);
  Maps maps = mixed(random, 100, 80, 0.1);
  std::size_t moved = 0;
  for (std::size_t j = 0; j < maps.b.points.size() && moved < 12; ++j)
    if (maps.partner[j] != Maps::kNone) {
      maps.b.points[j] += Vector3(0.8, 0.8, moved % 2 == 0 ? 0.5 : -0.5);
      maps.partner[j] = Maps::kNone;
      ++moved;
    }
  check_found(maps, match_points(maps.a, maps.b), 68);
}

TEST_CASE("correspondence: the joint covariance sees what marginals hide") {
  Random random(80);
  Maps maps = strips(random, 100, 50, 0.05);
  // Both frames are uncertain by a metre: an error that all points of a map share.
  const auto share = [&](PointSet& set) {
    const Vector3 common = random.normal_vector<3>();
    const std::vector<Matrix3> own = set.covariances;
    for (std::size_t i = 0; i < set.points.size(); ++i) {
      set.points[i] += common;
      set.covariances[i] += Matrix3::Identity();
    }
    set.joint = [own](const std::size_t* indices, std::size_t count, double* matrix) {
      const auto n = 3 * static_cast<Eigen::Index>(count);
      Eigen::Map<Eigen::MatrixXd> S(matrix, n, n);
      for (Eigen::Index i = 0; i < n; i += 3)
        for (Eigen::Index j = 0; j < n; j += 3)
          S.block<3, 3>(i, j) =
              Matrix3::Identity() + (i == j ? own[indices[static_cast<std::size_t>(i / 3)]] : Matrix3(Matrix3::Zero()));
    };
  };
  share(maps.a);
  share(maps.b);
  // One point has moved by half a metre: little compared with a metre, much compared with 5 cm.
  std::size_t odd = 0;
  while (maps.partner[odd] == Maps::kNone) ++odd;
  maps.b.points[odd] += Vector3(0.4, 0.3, 0);
  const std::size_t was = maps.partner[odd];
  maps.partner[odd] = Maps::kNone;
  const Correspondence result = match_points(maps.a, maps.b);
  check_found(maps, result, 49);
  CHECK(std::find(result.pairs.begin(), result.pairs.end(), std::make_pair(was, odd)) == result.pairs.end());
}

TEST_CASE("correspondence: maps that drift as they are driven") {
  // Brownian drift along the strip, from one end in a and from the other end in b, plus the noise of each landmark.
  static constexpr double kDrift = 0.002;  // m^2 per metre: 1 m after 500 m
  Random random(110);
  for (int run = 0; run < 3; ++run) {
    CAPTURE(run);
    Maps maps = strips(random, 150, 60, 0.05);
    double last = 0;
    for (const Vector3& p : maps.true_b) last = std::max(last, p.x());
    const auto drift = [&](PointSet& set, const std::vector<Vector3>& truth, bool backwards, const SO3& R) {
      std::vector<double> driven;
      for (const Vector3& p : truth) driven.push_back(backwards ? last - p.x() : p.x());
      std::vector<std::size_t> order;
      for (std::size_t i = 0; i < driven.size(); ++i) order.push_back(i);
      std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return driven[i] < driven[j]; });
      Vector3 error = Vector3::Zero();
      double at = 0;
      const std::vector<Matrix3> own = set.covariances;
      for (std::size_t i : order) {
        error += std::sqrt(kDrift * (driven[i] - at)) * random.normal_vector<3>();
        at = driven[i];
        set.points[i] += R * error;
        set.covariances[i] += kDrift * at * Matrix3::Identity();
      }
      set.joint = [own, driven](const std::size_t* indices, std::size_t count, double* matrix) {
        const auto n = 3 * static_cast<Eigen::Index>(count);
        Eigen::Map<Eigen::MatrixXd> S(matrix, n, n);
        for (std::size_t i = 0; i < count; ++i)
          for (std::size_t j = 0; j < count; ++j) {
            Matrix3 block = kDrift * std::min(driven[indices[i]], driven[indices[j]]) * Matrix3::Identity();
            if (i == j) block += own[indices[i]];
            S.block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * static_cast<Eigen::Index>(j)) = block;
          }
      };
    };
    drift(maps.a, maps.true_a, false, SO3());
    drift(maps.b, maps.true_b, true, maps.T_a_b.rotation().inverse());
    check_found(maps, match_points(maps.a, maps.b), 60);
  }
}

TEST_CASE("correspondence: with a prior") {
  Random random(90);
  const Maps maps = strips(random, 80, 30, 0.1);
  Vector6 sigmas;
  sigmas << 0.3, 0.3, 0.3, 0.004, 0.004, 0.004;
  // About the centre of the common points, not about a distant origin.
  Vector3 centre = Vector3::Zero();
  for (std::size_t j = 0; j < maps.true_b.size(); ++j)
    if (maps.partner[j] != Maps::kNone) centre += maps.true_b[j] / 30;
  Matrix6 lever = Matrix6::Identity();
  lever.topRightCorner<3, 3>() = hat(centre - maps.T_a_b.translation());
  const Matrix6 root = lever * sigmas.asDiagonal();
  TransformPrior prior{retract(maps.T_a_b, root * random.normal_vector<6>()), root * root.transpose()};
  Correspondence result = match_points_near(maps.a, maps.b, prior);
  check_found(maps, result, 30);
  CHECK(result.alignment.dof == 3 * static_cast<int>(result.pairs.size()));

  prior = {maps.T_a_b, Matrix6::Zero()};
  result = match_points_near(maps.a, maps.b, prior);
  REQUIRE(result.found());
  CHECK(maps.right(result) >= 28);
  CHECK(pose_error(maps.T_a_b, result.alignment.T_a_b).norm() == 0.0);

  prior.covariance = 100 * Matrix6::Identity();
  CHECK(match_points_near(maps.a, maps.b, prior).reason == Reason::too_vague);
  prior = {SE3(SO3(), Vector3(1e4, 0, 0)), 1e-6 * Matrix6::Identity()};
  CHECK_FALSE(match_points_near(maps.a, maps.b, prior).found());
  CHECK(match_points_near(PointSet{}, maps.b, prior).reason == Reason::too_few);
}

TEST_CASE("correspondence: the same input gives the same bits, and the budget is kept") {
  Random random(100);
  const Maps maps = mixed(random, 60, 30, 0.1);
  const Correspondence one = match_points(maps.a, maps.b), two = match_points(maps.a, maps.b);
  REQUIRE(one.found());
  CHECK(one.pairs == two.pairs);
  CHECK(one.alignment.distance == two.alignment.distance);
  CHECK(one.alignment.covariance == two.alignment.covariance);
  CorrespondenceOptions options;
  options.max_hypotheses = 1;
  const Correspondence starved = match_points(mixed(random, 60, 0, 0.1).a, maps.b, options);
  CHECK(starved.reason == Reason::budget);
  CHECK(starved.hypotheses < 500);
}
