// SPDX-License-Identifier: BSD-3-Clause
// Kept poses follow the bases of their submaps.
#include "slam/trajectory.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <random>
#include <vector>

using namespace cairn;

namespace {

// A map that has only bases.
template <class Pose>
class Bases final : public GlobalMap<Pose> {
 public:
  explicit Bases(std::vector<Pose> bases) : bases_(std::move(bases)) {}

  Pose base() const override { return bases_.back(); }
  std::size_t submap_count() const override { return bases_.size() - 1; }
  Pose submap_base(std::size_t submap) const override { return bases_[submap]; }

  std::unique_ptr<MapTransaction<Pose>> begin() override { return nullptr; }
  Eigen::VectorXd errors() const override { return {}; }
  Eigen::MatrixXd joint_with_errors(const std::size_t*, std::size_t) const override { return {}; }
  void remove(std::uint64_t) override {}
  typename Pose::Square base_covariance() const override { return Pose::Square::Zero(); }
  void base_joint_covariance(const std::size_t*, std::size_t, double*) const override {}
  const std::vector<std::uint64_t>& submap_ids(std::size_t) const override { return none_; }
  std::size_t size() const override { return 0; }
  std::uint64_t id(std::size_t) const override { return 0; }
  std::uint64_t observations(std::size_t) const override { return 0; }
  Vector3 position(std::size_t) const override { return Vector3::Zero(); }
  Matrix3 covariance(std::size_t) const override { return Matrix3::Zero(); }
  bool find(std::uint64_t, std::size_t&) const override { return false; }
  void joint_covariance(const std::size_t*, std::size_t, double*) const override {}

 private:
  std::vector<Pose> bases_;
  std::vector<std::uint64_t> none_;
};

template <class Pose>
struct Kept {
  explicit Kept(Index capacity) : arena(bytes(capacity)), poses(arena, capacity) {}
  static std::size_t bytes(Index capacity) {
    Arena measure;
    const Trajectory<Pose> unused(measure, capacity);
    return measure.used();
  }

  Arena arena;
  Trajectory<Pose> poses;
};

template <class Pose>
Pose random_pose(std::mt19937& random, double scale) {
  std::normal_distribution<double> normal(0.0, scale);
  typename Pose::Tangent tau;
  for (Index i = 0; i < tau.size(); ++i) tau(i) = normal(random);
  return Pose::exp(tau);
}

template <class Pose>
void check_same(const Pose& a, const Pose& b, double tolerance) {
  CHECK(pose_error(a, b).norm() <= tolerance);
}

// Poses on a line, with independent errors along x and along the others.
SE2 at(double x) {
  return SE2(SO2(), Vector2(x, 0));
}
Matrix3 certain(double x, double others) {
  return Vector3(x, others, others).asDiagonal();
}

}  // namespace

TEST_CASE_TEMPLATE("trajectory: the end of a submap is the next base, and its beginning is its own base", Pose, SE2,
                   SE3) {
  std::mt19937 random(3);
  for (int k = 0; k < 20; ++k) {
    const Pose base = random_pose<Pose>(random, 1.0), end = random_pose<Pose>(random, 1.0);
    const Pose next = base * end * random_pose<Pose>(random, 0.1), last = random_pose<Pose>(random, 1.0);
    const typename Pose::Square known = Pose::Square::Zero(), some = Pose::Square::Identity();
    Kept<Pose> kept(4);
    kept.poses.add(0, Pose(), known);
    kept.poses.add(0, end, 0.5 * some);
    kept.poses.end_submap(0, end, 0.5 * some);
    kept.poses.add(1, end, 2.0 * some);
    kept.poses.end_submap(1, end, 2.0 * some);
    kept.poses.add(2, end, some);
    const Bases<Pose> map({base, next, last});
    check_same(kept.poses.pose(0, &map, {}), base, 1e-14);
    check_same(kept.poses.pose(1, &map, {}), next, 1e-7);  // the jitter of a singular covariance
    check_same(kept.poses.pose(2, &map, {}), last, 1e-7);
    // The open submap, and what it would be if it were closed now.
    check_same(kept.poses.pose(3, &map, {last, last * end, end, some}), last * end, 1e-14);
    check_same(kept.poses.pose(3, &map, {next, next * last, end, some}), next * last, 1e-7);
    check_same(kept.poses.pose(1, nullptr, {}), end, 0.0);  // a single map
  }
}

// A motion without observations: the least change of the increments that leads to a corrected end. Its solution moves
// the poses on the way, too.
TEST_CASE_TEMPLATE("trajectory: odometry gets the correction of its smoother", Pose, SE2, SE3) {
  constexpr int n = 6, kDof = Pose::kDof;
  using Square = typename Pose::Square;
  using Tangent = typename Pose::Tangent;
  std::mt19937 random(7);
  const Pose base = random_pose<Pose>(random, 1.0);
  std::vector<Pose> increments;
  std::vector<Square> noises;
  for (int t = 0; t < n; ++t) {
    increments.push_back(random_pose<Pose>(random, 0.7));
    Square root;
    for (Index i = 0; i < root.size(); ++i) root.data()[i] = std::normal_distribution<double>(0.0, 0.1)(random);
    noises.push_back(root * root.transpose() + 1e-3 * Square::Identity());
  }
  // The poses in the submap, with the error Exp(errors_t) on the base's side of each increment.
  const auto drive = [&](const Eigen::VectorXd& errors) {
    std::vector<Pose> poses{Pose()};
    for (int t = 0; t < n; ++t)
      poses.push_back(poses.back() * Pose::exp(Tangent(errors.segment<kDof>(kDof * t))) *
                      increments[static_cast<std::size_t>(t)]);
    return poses;
  };
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(kDof * n);
  const std::vector<Pose> poses = drive(none);
  Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(kDof * n, kDof * n);
  for (int t = 0; t < n; ++t) Q.block<kDof, kDof>(kDof * t, kDof * t) = noises[static_cast<std::size_t>(t)];
  // Ordinary covariances of all poses by numerical Jacobians.
  constexpr double h = 1e-6;
  Eigen::MatrixXd J(kDof * (n + 1), kDof * n);
  for (Index i = 0; i < kDof * n; ++i) {
    Eigen::VectorXd d = none;
    d(i) = h;
    const std::vector<Pose> ahead = drive(d), behind = drive(-d);
    for (std::size_t t = 0; t <= n; ++t)
      J.block<kDof, 1>(kDof * static_cast<Index>(t), i) =
          (pose_error(ahead[t], poses[t]) - pose_error(behind[t], poses[t])) / (2 * h);
  }
  const Eigen::MatrixXd P = J * Q * J.transpose();
  Kept<Pose> kept(n + 1);
  for (int t = 0; t <= n; ++t)
    kept.poses.add(0, poses[static_cast<std::size_t>(t)], P.block<kDof, kDof>(kDof * t, kDof * t));
  kept.poses.end_submap(0, poses.back(), P.bottomRightCorner<kDof, kDof>());

  Tangent correction;
  for (Index i = 0; i < kDof; ++i) correction(i) = 1e-5 * static_cast<double>(i + 1);
  const Pose end = retract(poses.back(), correction);
  const Eigen::MatrixXd J_end = J.bottomRows<kDof>();
  const Eigen::VectorXd least =
      Q * J_end.transpose() * Eigen::MatrixXd(J_end * Q * J_end.transpose()).ldlt().solve(Eigen::VectorXd(correction));
  const std::vector<Pose> smooth = drive(least);
  const Bases<Pose> map({base, base * end});
  for (std::size_t t = 0; t <= n; ++t) check_same(kept.poses.pose(t, &map, {}), base * smooth[t], 1e-3 * correction.norm());
}

TEST_CASE("trajectory: a pose that is less certain than the end moves as far as the end") {
  Kept<SE2> kept(2);
  kept.poses.add(0, at(9), certain(4.0, 0.0));
  kept.poses.add(0, at(0), certain(0.5, 0.0));
  kept.poses.end_submap(0, at(1), certain(1.0, 0.0));
  const Bases<SE2> map({at(0), at(1.5)});
  CHECK(kept.poses.pose(0, &map, {}).translation().x() == doctest::Approx(9.5));
  CHECK(kept.poses.pose(1, &map, {}).translation().x() == doctest::Approx(0.25));
}

TEST_CASE("trajectory: the end of a submap without errors moves no pose of it") {
  Kept<SE2> kept(1);
  kept.poses.add(0, at(1), certain(0.0, 0.0));
  kept.poses.end_submap(0, at(1), certain(0.0, 0.0));
  const Bases<SE2> map({at(0), at(2)});
  CHECK(kept.poses.pose(0, &map, {}).translation().x() == 1.0);
}

TEST_CASE("trajectory: an error that all axes have in common is shared, too") {
  Kept<SE2> kept(1);
  kept.poses.add(0, at(0), 0.5 * Matrix3::Ones());
  kept.poses.end_submap(0, at(0), Matrix3::Ones());
  const Bases<SE2> map({at(0), SE2::exp(Vector3(0.1, 0.1, 0.1))});
  check_same(kept.poses.pose(0, &map, {}), SE2::exp(Vector3(0.05, 0.05, 0.05)), 1e-6);
}

TEST_CASE("trajectory: the newest poses are kept") {
  Kept<SE2> kept(3);
  std::vector<SE2> bases{at(0)};
  for (int t = 0; t < 10; ++t) {
    CHECK(kept.poses.end() == static_cast<std::uint64_t>(t));
    CHECK(kept.poses.first() == static_cast<std::uint64_t>(std::max(0, t - 3)));
    // Each submap holds one pose, and ends one metre behind it.
    kept.poses.add(static_cast<std::uint64_t>(t), at(1), certain(1.0, 1.0));
    kept.poses.end_submap(static_cast<std::uint64_t>(t), at(2), certain(2.0, 4.0));
    bases.push_back(at(2.5 * (t + 1)));
  }
  const Bases<SE2> map(bases);
  for (std::uint64_t t = kept.poses.first(); t < kept.poses.end(); ++t)
    CHECK(kept.poses.pose(t, &map, {}).translation().x() == doctest::Approx(2.5 * static_cast<double>(t) + 1.25));
}

TEST_CASE("trajectory: without room nothing is kept") {
  Kept<SE3> kept(0);
  kept.poses.add(0, SE3(), Matrix6::Identity());
  kept.poses.end_submap(0, SE3(), Matrix6::Identity());
  CHECK(kept.poses.end() == 0);
}
