// SPDX-License-Identifier: BSD-3-Clause
// Kept poses follow the bases of their submaps.
#include "slam/trajectory.hpp"

#include <doctest/doctest.h>

#include <random>

#include "core/error.hpp"

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

}  // namespace

TEST_CASE_TEMPLATE("trajectory: the end of a submap is the next base, and its beginning is its own base", Pose, SE2,
                   SE3) {
  std::mt19937 random(3);
  for (int k = 0; k < 20; ++k) {
    const Pose base = random_pose<Pose>(random, 1.0), end = random_pose<Pose>(random, 1.0);
    const Pose next = base * end * random_pose<Pose>(random, 0.1), last = random_pose<Pose>(random, 1.0);
    Kept<Pose> kept(4);
    kept.poses.add(0, Pose(), 0.0);
    kept.poses.add(0, end, 0.5);
    kept.poses.end_submap(0, end, 0.5);
    kept.poses.add(1, end, 2.0);
    kept.poses.end_submap(1, end, 2.0);
    kept.poses.add(2, end, 1.0);
    const Bases<Pose> map({base, next, last});
    check_same(kept.poses.pose(0, &map), base, 1e-14);
    check_same(kept.poses.pose(1, &map), next, 1e-13);
    check_same(kept.poses.pose(2, &map), last, 1e-13);
    check_same(kept.poses.pose(3, &map), last * end, 1e-14);  // the open submap
    check_same(kept.poses.pose(1, nullptr), end, 0.0);        // a single map
  }
}

// Motions along a line, each with the same variance, are a random walk. Its smoother shares a correction of the end in
// proportion to the variances.
TEST_CASE("trajectory: a random walk gets the correction of its smoother") {
  constexpr int n = 8;
  const double correction = 0.3;
  Kept<SE2> kept(n);
  const auto at = [](double x) { return SE2(SO2(), Vector2(x, 0)); };
  for (int t = 1; t <= n; ++t) kept.poses.add(0, at(t), 0.01 * t);
  kept.poses.end_submap(0, at(n), 0.01 * n);
  const Bases<SE2> map({at(5), at(5 + n + correction)});
  for (int t = 1; t <= n; ++t)
    CHECK(kept.poses.pose(static_cast<std::uint64_t>(t - 1), &map).translation().x() ==
          doctest::Approx(5 + t + correction * t / n).epsilon(1e-14));
}

TEST_CASE("trajectory: a pose that is less certain than the end moves as far as the end") {
  Kept<SE2> kept(2);
  const auto at = [](double x) { return SE2(SO2(), Vector2(x, 0)); };
  kept.poses.add(0, at(9), 4.0);
  kept.poses.add(0, at(3), 0.0);
  kept.poses.end_submap(0, at(1), 1.0);
  const Bases<SE2> map({at(0), at(1.5)});
  CHECK(kept.poses.pose(0, &map).translation().x() == doctest::Approx(9.5));
  CHECK(kept.poses.pose(1, &map).translation().x() == doctest::Approx(3.0));
}

TEST_CASE("trajectory: the end of a submap without errors moves no pose of it") {
  Kept<SE2> kept(1);
  const auto at = [](double x) { return SE2(SO2(), Vector2(x, 0)); };
  kept.poses.add(0, at(1), 0.0);
  kept.poses.end_submap(0, at(1), 0.0);
  const Bases<SE2> map({at(0), at(2)});
  CHECK(kept.poses.pose(0, &map).translation().x() == 1.0);
}

TEST_CASE("trajectory: the newest poses are kept") {
  Kept<SE2> kept(3);
  const auto at = [](double x) { return SE2(SO2(), Vector2(x, 0)); };
  std::vector<SE2> bases{at(0)};
  for (int t = 0; t < 10; ++t) {
    CHECK(kept.poses.end() == static_cast<std::uint64_t>(t));
    CHECK(kept.poses.first() == static_cast<std::uint64_t>(std::max(0, t - 3)));
    // Each submap holds one pose, and ends one metre behind it.
    kept.poses.add(static_cast<std::uint64_t>(t), at(1), 1.0);
    kept.poses.end_submap(static_cast<std::uint64_t>(t), at(2), 2.0);
    bases.push_back(at(2.5 * (t + 1)));
  }
  const Bases<SE2> map(bases);
  for (std::uint64_t t = kept.poses.first(); t < kept.poses.end(); ++t)
    CHECK(kept.poses.pose(t, &map).translation().x() == doctest::Approx(2.5 * static_cast<double>(t) + 1.25));
}

TEST_CASE("trajectory: without room nothing is kept") {
  Kept<SE3> kept(0);
  kept.poses.add(0, SE3(), 1.0);
  kept.poses.end_submap(0, SE3(), 1.0);
  CHECK(kept.poses.end() == 0);
}
