// SPDX-License-Identifier: BSD-3-Clause
// The index against a scan of all points, through additions, moves and removals.
#include "map/spatial_index.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <thread>
#include <vector>

#include "numerical.hpp"

using namespace cairn;
using cairn::test::Random;

namespace {

using Hits = std::vector<SpatialIndex::Hit>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The owner of the index: points, and which of them are present.
struct World {
  std::vector<Vector3> points;
  std::vector<bool> there;
  SpatialIndex index{[this](std::size_t i) { return points[i]; }};

  void add(const Vector3& p) {
    points.push_back(p);
    there.push_back(true);
    index.add(points.size() - 1);
  }
  void remove(std::size_t i) {
    there[i] = false;
    index.remove(i);
  }

  Hits by_distance(const Vector3& centre) const {
    Hits hits;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (there[i]) hits.push_back({SpatialIndex::distance(points[i], centre), i});
    std::sort(hits.begin(), hits.end(), [](const auto& a, const auto& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.index < b.index;
    });
    return hits;
  }
  Hits within(const Vector3& centre, double radius) const {
    Hits hits = by_distance(centre);
    while (!hits.empty() && !(hits.back().distance <= radius)) hits.pop_back();
    return hits;
  }
  Hits nearest(const Vector3& centre, std::size_t count) const {
    Hits hits = by_distance(centre);
    if (count == 0) hits.clear();
    while (hits.size() > count && hits.back().distance > hits[count - 1].distance) hits.pop_back();
    return hits;
  }
  std::vector<std::size_t> in_box(const Vector3& lower, const Vector3& upper) const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (there[i] && (points[i].array() >= lower.array()).all() && (points[i].array() <= upper.array()).all())
        indices.push_back(i);
    return indices;
  }
};

bool same(const Hits& a, const Hits& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
           return x.index == y.index && x.distance == y.distance;
         });
}

// Compares every kind of query at one place with the scan. Returns true if all agree.
bool agrees(const World& world, const Vector3& centre, double reach) {
  Hits hits;
  std::vector<std::size_t> indices;
  bool good = world.index.size() == static_cast<std::size_t>(std::count(world.there.begin(), world.there.end(), true));
  for (double radius : {0.0, 0.1 * reach, reach, kInfinity, -1.0}) {
    world.index.within(centre, radius, hits);
    good = good && same(hits, world.within(centre, radius));
  }
  const Hits all = world.by_distance(centre);
  if (!all.empty()) {  // a radius that ends on a point
    const double radius = all[all.size() / 3].distance;
    world.index.within(centre, radius, hits);
    good = good && same(hits, world.within(centre, radius));
  }
  for (std::size_t count : {std::size_t(0), std::size_t(1), std::size_t(7), world.points.size() + 1}) {
    world.index.nearest(centre, count, hits);
    good = good && same(hits, world.nearest(centre, count));
  }
  for (const Vector3& half : {Vector3(reach, reach, reach), Vector3(30 * reach, 0.1 * reach, reach), Vector3(0, 0, 0),
                              Vector3(kInfinity, reach, kInfinity), Vector3(kInfinity, kInfinity, kInfinity),
                              Vector3(reach, -reach, reach)}) {
    world.index.in_box(centre - half, centre + half, indices);
    good = good && indices == world.in_box(centre - half, centre + half);
  }
  return good;
}

Vector3 in_box_of(Random& random, const Vector3& half) {
  return Vector3(random.uniform(-half.x(), half.x()), random.uniform(-half.y(), half.y()),
                 random.uniform(-half.z(), half.z()));
}

}  // namespace

TEST_CASE("spatial index: batches, moves small and large, removals and returns") {
  // A cube, a plain, a line, and a plain far from the origin.
  const Vector3 halves[] = {{50, 50, 50}, {200, 200, 1}, {500, 0, 0}, {100, 100, 2}};
  const Vector3 centres[] = {Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), {4e6, -3e6, 1e3}};
  for (int scene = 0; scene < 4; ++scene) {
    CAPTURE(scene);
    Random random(10 + static_cast<unsigned>(scene));
    const Vector3 half = halves[scene], middle = centres[scene];
    World world;
    for (int round = 0; round < 40; ++round) {
      CAPTURE(round);
      for (int i = 0; i < 35; ++i) world.add(middle + in_box_of(random, half));
      const double size = random.uniform(0, 1) < 0.3 ? 40.0 : 0.05;
      if (round % 3 == 1) {  // everything moves
        for (Vector3& p : world.points) p += size * random.normal_vector<3>();
        world.index.moved_all();
      }
      for (int i = 0; i < 20; ++i) {
        const auto one = static_cast<std::size_t>(random.uniform(0, static_cast<double>(world.points.size())));
        if (i % 2 == 0) {
          world.points[one] += size * random.normal_vector<3>();
          world.index.moved(one);
        } else if (world.there[one]) {
          world.remove(one);
        } else {  // comes back at another place
          world.points[one] = middle + in_box_of(random, half);
          world.there[one] = true;
          world.index.add(one);
        }
      }
      for (int query = 0; query < 6; ++query)
        REQUIRE(agrees(world, middle + 1.2 * in_box_of(random, half), 0.1 * half.maxCoeff()));
    }
    for (std::size_t i = 0; i + 5 < world.points.size(); ++i)
      if (world.there[i]) world.remove(i);
    CHECK(agrees(world, middle, 1000));
    world.index.clear();
    std::fill(world.there.begin(), world.there.end(), false);
    CHECK(agrees(world, middle, 1000));
  }
}

TEST_CASE("spatial index: a point that drifts by small steps is found where it is") {
  Random random(20);
  World world;
  for (int i = 0; i < 3000; ++i) world.add(in_box_of(random, Vector3(100, 100, 3)));
  Hits hits;
  for (int step = 0; step < 400; ++step) {
    world.points[7] += Vector3(0.3, 0.1, 0);  // 120 m in the end
    world.index.moved(7);
    world.index.within(world.points[7], 0, hits);
    REQUIRE(hits.size() == 1);
    CHECK(hits[0].index == 7);
  }
  CHECK(agrees(world, world.points[7], 50));
}

TEST_CASE("spatial index: equal points and equal distances") {
  World world;
  for (int i = 0; i < 200; ++i) world.add(Vector3(1, 2, 3));
  for (int x = -5; x <= 5; ++x)
    for (int y = -5; y <= 5; ++y) world.add(Vector3(x, y, 0));
  CHECK(agrees(world, Vector3(0, 0, 0), 2));
  CHECK(agrees(world, Vector3(1, 2, 3), 1));
  Hits hits;
  world.index.nearest(Vector3::Zero(), 3, hits);  // the origin and its four neighbours, all equally near
  CHECK(hits.size() == 5);
}

TEST_CASE("spatial index: queries side by side, the first of which build") {
  Random random(30);
  World world;
  for (int i = 0; i < 2000; ++i) world.add(in_box_of(random, Vector3(100, 100, 3)));
  for (int round = 0; round < 5; ++round) {
    for (Vector3& p : world.points) p += 20 * random.normal_vector<3>();
    world.index.moved_all();
    std::vector<char> good(4, 0);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < good.size(); ++t)
      threads.emplace_back([&, t] {
        bool all = true;
        for (int query = 0; query < 20; ++query)
          all = all && agrees(world, Vector3(10.0 * static_cast<double>(t), 5.0 * query, 0), 20);
        good[t] = all ? 1 : 0;
      });
    for (std::thread& thread : threads) thread.join();
    CHECK(good == std::vector<char>(4, 1));
  }
}
