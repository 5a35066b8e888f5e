// SPDX-License-Identifier: BSD-3-Clause
// The limits of a submap, and the wait after closings that fail.
#include "slam/submap_policy.hpp"

#include <doctest/doctest.h>

using namespace cairn;

namespace {

struct Bare {
  explicit Bare(const FilterOptions<SE2>& given) : options(given), arena(bytes(options)), map(arena, options) {
    map.start(SE2(), Matrix3::Zero());
  }
  static std::size_t bytes(const FilterOptions<SE2>& options) {
    Arena measure;
    const LocalMap<SE2> unused(measure, options);
    return measure.used();
  }
  void place(std::uint64_t id, const Vector2& at) {
    EkfUpdate<SE2> update = map.state().begin({});
    REQUIRE(update.place(at, Eigen::Matrix<double, 2, 3>::Zero(), nullptr, Matrix2::Identity(), false));
    map.name_placed(id);
  }

  FilterOptions<SE2> options;
  Arena arena;
  LocalMap<SE2> map;
};

FilterOptions<SE2> options_with(Index landmarks) {
  FilterOptions<SE2> options;
  options.submap_landmarks = landmarks;
  options.max_observations = 4;
  return options;
}

}  // namespace

TEST_CASE("submap policy: an empty submap reaches no limit but that of its landmarks") {
  FilterOptions<SE2> options = options_with(2);
  options.submap_distance = 10.0;
  options.submap_extent = 5.0;
  Bare bare(options);
  SubmapPolicy<SE2> policy(bare.options, bare.map);
  policy.drive(11.0);
  CHECK(policy.limit() == ClosedBy::none);
  bare.place(1, {1, 0});
  CHECK(policy.limit() == ClosedBy::distance);
  policy.restart();
  CHECK(policy.driven() == 0.0);
  CHECK(policy.limit() == ClosedBy::none);
  bare.place(2, {9, 0});
  CHECK(policy.limit() == ClosedBy::landmarks);
}

TEST_CASE("submap policy: extent and uncertainty") {
  FilterOptions<SE2> options = options_with(10);
  options.submap_extent = 5.0;
  options.submap_sigma = 0.5;
  Bare bare(options);
  const SubmapPolicy<SE2> policy(bare.options, bare.map);
  bare.place(1, {1, 0});
  CHECK(policy.limit() == ClosedBy::none);
  Increment<SE2> step;
  step.covariance(1, 1) = 0.3;
  REQUIRE(bare.map.state().propagate(step));
  CHECK(policy.limit() == ClosedBy::sigma);
  bare.place(2, {4, 4});
  CHECK(policy.limit() == ClosedBy::extent);
}

TEST_CASE("submap policy: deferred landmarks do not fill a submap") {
  FilterOptions<SE2> options = options_with(1);
  options.deferred_sightings = 2;
  Bare bare(options);
  const SubmapPolicy<SE2> policy(bare.options, bare.map);
  bare.place(1, {1, 0});
  CHECK(policy.limit() == ClosedBy::none);
  bare.map.count_from_now(0);
  CHECK(policy.limit() == ClosedBy::landmarks);
}

TEST_CASE("submap policy: the wait after a failed closing doubles up to 64 frames, and a closing resets it") {
  Bare bare(options_with(1));
  SubmapPolicy<SE2> policy(bare.options, bare.map);
  const auto frames = [&] {
    int count = 0;
    while (policy.wait()) ++count;
    return count;
  };
  CHECK(frames() == 0);
  for (const int wait : {1, 2, 4, 8, 16, 32, 64, 64, 64}) {
    policy.put_off();
    CHECK(frames() == wait);
  }
  policy.restart();
  policy.put_off();
  CHECK(frames() == 1);
}
