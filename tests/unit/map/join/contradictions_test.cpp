// SPDX-License-Identifier: BSD-3-Clause
// Landmarks of a submap that contradict the map, in both joinings.
#include "map/contradictions.hpp"

#include <doctest/doctest.h>

#include <memory>

#include "map/join/dense/dense_map.hpp"
#include "map/join/sparse/sparse_map.hpp"
#include "submap_ring.hpp"

namespace {

using namespace cairn;
using cairn::test::difference;
using cairn::test::kKinds;
using Matrix = Eigen::MatrixXd;
template <class Pose>
using Ring = cairn::test::Ring<Pose>;

template <class Pose>
std::unique_ptr<GlobalMap<Pose>> map_of(bool sparse, const MapOptions<Pose>& options) {
  if (sparse) return std::make_unique<SparseMap<Pose>>(options);
  return std::make_unique<DenseMap<Pose>>(options);
}

std::size_t index_of(const Landmarks& map, std::uint64_t id) {
  std::size_t index = 0;
  REQUIRE(map.find(id, index));
  return index;
}

void check_names(const Landmarks& map) {
  for (std::size_t i = 0; i < map.size(); ++i) CHECK(index_of(map, map.id(i)) == i);
}

// Nine submaps, and a tenth of which one landmark is somewhere else.
template <class Pose>
struct Contradicted {
  static constexpr Eigen::Index kLiar = 3;
  Contradicted(ErrorKind error, std::uint64_t count) : ring(14, error, 8, 12, {0.05, 0.004}), options(ring.options()) {
    for (int i = 0; i < 9; ++i) submaps.push_back(ring.submap(i));
    bad = ring.submap(9);
    id = bad.ids[kLiar];
    bad.counts[kLiar] = count;
    bad.landmarks[kLiar] += Embedding<Pose>::down(Vector3(2, -1, 1));
  }
  std::unique_ptr<GlobalMap<Pose>> map(bool sparse) const {
    auto out = map_of<Pose>(sparse, options);
    for (const Submap<Pose>& submap : submaps) out->join(submap);
    return out;
  }
  Ring<Pose> ring;
  MapOptions<Pose> options;
  std::vector<Submap<Pose>> submaps;
  Submap<Pose> bad;
  std::uint64_t id;
};

}  // namespace

TEST_CASE_TEMPLATE("contradictions: of two young landmarks the one with more support stays", Pose, SE3, SE2) {
  for (const bool sparse : {false, true})
    for (const ErrorKind error : kKinds)
      for (const std::uint64_t count : {1, 2, 5}) {  // 2 in the map
        Contradicted<Pose> world(error, count);
        const auto map = world.map(sparse);
        REQUIRE(map->observations(index_of(*map, world.id)) == 2);
        const Vector3 before = map->position(index_of(*map, world.id));
        const std::size_t size = map->size(), fresh = world.bad.ids.size() - 7;
        const JoinReport report = map->join(world.bad);
        CHECK(report.refused == 1);
        CHECK(report.fresh == fresh);
        std::size_t index = 0;
        CHECK(map->find(world.id, index) == (count != 2));
        CHECK(map->size() == size + fresh - (count == 2 ? 1 : 0));
        if (count != 2) {
          const double moved = (map->position(index) - before).norm();
          CHECK((moved < 0.05) == (count == 1));
          CHECK((moved > 1.5) == (count == 5));
          CHECK(map->observations(index) == (count == 1 ? 2 : 5));
        }
        check_names(*map);
        CHECK(map->join(world.ring.submap(10)).refused == 0);  // and the map works as before
        check_names(*map);
      }
}

TEST_CASE_TEMPLATE("contradictions: a landmark that takes the id is placed as a new one is", Pose, SE3, SE2) {
  for (const bool sparse : {false, true})
    for (const ErrorKind error : kKinds) {
      Contradicted<Pose> world(error, 5);
      const auto superseded = world.map(sparse), renamed = world.map(sparse);
      superseded->join(world.bad);
      Submap<Pose> other = world.bad;
      constexpr std::uint64_t kFree = 1000;
      other.ids[Contradicted<Pose>::kLiar] = kFree;
      renamed->join(other);
      renamed->remove(world.id);
      const std::size_t a = index_of(*superseded, world.id), b = index_of(*renamed, kFree);
      const double tolerance = sparse ? 1e-3 : 1e-12;  // the sparse joining stops where steps are small
      CHECK((superseded->position(a) - renamed->position(b)).norm() <= tolerance);
      std::vector<std::size_t> here, there;
      for (std::size_t i = 0; i < superseded->size(); ++i) {
        here.push_back(i);
        there.push_back(index_of(*renamed, superseded->id(i) == world.id ? kFree : superseded->id(i)));
      }
      const auto n = static_cast<Eigen::Index>(Pose::kDof + Pose::kDim * here.size());
      Matrix P(n, n), Q(n, n);
      superseded->base_joint_covariance(here.data(), here.size(), P.data());
      renamed->base_joint_covariance(there.data(), there.size(), Q.data());
      CHECK(difference(P, Q) <= (sparse ? 1e-2 : 1e-9));
    }
}

TEST_CASE_TEMPLATE("contradictions: neither stays if nothing says which is wrong", Pose, SE3, SE2) {
  for (const ErrorKind error : kKinds) {
    Contradicted<Pose> world(error, 2);
    const auto map = world.map(false), poor = world.map(false);
    map->join(world.bad);
    poor->join(cairn::test::without_landmark(world.bad, Contradicted<Pose>::kLiar));
    poor->remove(world.id);
    REQUIRE(map->size() == poor->size());
    for (std::size_t i = 0; i < map->size(); ++i)
      CHECK((map->position(i) - poor->position(index_of(*poor, map->id(i)))).norm() <= 1e-12);
  }
}

TEST_CASE_TEMPLATE("contradictions: where most landmarks contradict, the map keeps its own", Pose, SE3, SE2) {
  for (const bool sparse : {false, true}) {
    Contradicted<Pose> world(ErrorKind::invariant, 5);
    const auto map = world.map(sparse);
    std::vector<std::uint64_t> ids;
    for (std::size_t i = 0; i < world.bad.ids.size(); ++i) {
      std::size_t index = 0;
      if (!map->find(world.bad.ids[i], index)) continue;
      ids.push_back(world.bad.ids[i]);
      world.bad.counts[i] = 5;
      if (ids.size() > 2) world.bad.landmarks[i] += (3.0 + static_cast<double>(i)) * Pose::Point::Unit(i % 2);
    }
    REQUIRE(ids.size() >= 6);
    const JoinReport report = map->join(world.bad);
    CHECK(report.refused > report.fused);
    for (const std::uint64_t id : ids) index_of(*map, id);  // all are still there
  }
}

TEST_CASE_TEMPLATE("contradictions: without room for both, the map keeps its own", Pose, SE3, SE2) {
  Contradicted<Pose> world(ErrorKind::invariant, 5);
  const std::size_t size = world.map(false)->size();
  world.options.max_landmarks = size + world.bad.ids.size() - 7;
  const auto map = world.map(false);
  const Vector3 before = map->position(index_of(*map, world.id));
  CHECK(map->join(world.bad).refused == 1);
  CHECK((map->position(index_of(*map, world.id)) - before).norm() < 0.05);
  check_names(*map);
}

TEST_CASE_TEMPLATE("contradictions: a transaction without commit changes nothing", Pose, SE3, SE2) {
  for (const bool sparse : {false, true})
    for (const std::uint64_t count : {2, 5}) {
      Contradicted<Pose> world(ErrorKind::invariant, count);
      const auto map = world.map(sparse), twin = world.map(sparse);
      map->begin()->join(world.bad);
      REQUIRE(map->size() == twin->size());
      for (std::size_t i = 0; i < map->size(); ++i) {
        CHECK(map->id(i) == twin->id(i));
        CHECK(map->position(i) == twin->position(i));
        CHECK(map->covariance(i) == twin->covariance(i));
        CHECK(map->observations(i) == twin->observations(i));
      }
      check_names(*map);
    }
}
