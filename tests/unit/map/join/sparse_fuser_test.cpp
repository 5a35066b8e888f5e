// SPDX-License-Identifier: BSD-3-Clause
// Submaps of one place become one: the map stays as large as its place, and knows neither more than before nor much
// less.
#include "map/join/sparse/sparse_fuser.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "map/join/sparse/leaf_information.hpp"
#include "map/join/sparse/sparse_map.hpp"
#include "map/join/sparse/sparse_transaction.hpp"
#include "submap_ring.hpp"

namespace {

using namespace cairn;
using cairn::test::Ids;
using cairn::test::kKinds;
using cairn::test::Noise;
using cairn::test::position_of;
using Eigen::Index;
using Matrix = Eigen::MatrixXd;
template <class Pose>
using Ring = cairn::test::Ring<Pose>;
template <class Pose>
using Space = Embedding<Pose>;

template <class Pose>
MapOptions<Pose> options_of(const Ring<Pose>& ring, bool fuse) {
  MapOptions<Pose> options = ring.options();
  options.fuse = fuse;
  options.initial_covariance *= 1e-6;  // small against the noise: the comparison is between landmarks
  return options;
}

// Of the base and of all landmarks, by ascending id.
template <class Pose>
Matrix joint_covariance(const SparseMap<Pose>& map, const Ids& ids) {
  std::vector<std::size_t> indices;
  for (const std::uint64_t id : ids) {
    std::size_t index = 0;
    REQUIRE(map.find(id, index));
    indices.push_back(index);
  }
  const auto n = static_cast<Index>(Pose::kDof + Pose::kDim * ids.size());
  Matrix joint(n, n);
  map.base_joint_covariance(indices.data(), indices.size(), joint.data());
  return joint;
}

template <class Pose>
Ids ids_of(const SparseMap<Pose>& map) {
  Ids ids;
  for (std::size_t i = 0; i < map.size(); ++i) ids.push_back(map.id(i));
  std::sort(ids.begin(), ids.end());
  return ids;
}

// Rounds through a place of few landmarks: the submaps of later rounds are fused with those of the first one.
constexpr int kBases = 8;

}  // namespace

TEST_CASE_TEMPLATE("sparse fuser: a map of one place does not grow", Pose, SE3, SE2) {
  for (const ErrorKind error : kKinds) {
    Ring<Pose> ring(31, error, kBases, 12, {0.05, 0.004});
    SparseMap<Pose> map(options_of(ring, true)), whole(options_of(ring, false));
    std::size_t early = 0;
    for (int i = 0; i < 20 * kBases; ++i) {
      const Submap<Pose> submap = ring.submap(i);
      const JoinReport report = map.join(submap);
      CHECK(report.refused == 0);
      CHECK(report.fused + report.fresh == 7);
      CHECK(report.distance <= report.threshold);
      whole.join(submap);
      if (i >= 4 * kBases && i < 6 * kBases) early = std::max(early, map.memory_bytes());
      if (i >= 6 * kBases) CHECK(map.memory_bytes() <= early + early / 10);
    }
    CHECK(whole.memory_bytes() > 5 * map.memory_bytes());
    // Every submap still has its base and its landmarks.
    REQUIRE(map.submap_count() == whole.submap_count());
    REQUIRE(map.size() == whole.size());
    const double sigma = std::sqrt(whole.base_covariance().topLeftCorner(Pose::kDim, Pose::kDim).trace());
    for (std::size_t k = 0; k < map.submap_count(); ++k) {
      CHECK((map.submap_base(k).translation() - ring.base(static_cast<int>(k)).translation()).norm() <= 0.3);
      const Ids& ids = map.submap_ids(k);
      for (const std::uint64_t id : whole.submap_ids(k)) CHECK(std::find(ids.begin(), ids.end(), id) != ids.end());
    }
    for (const std::uint64_t id : ids_of(map))
      CHECK((position_of(map, id) - position_of(whole, id)).norm() <= 0.5 * sigma);
  }
}

TEST_CASE_TEMPLATE("sparse fuser: it knows no more than the whole problem, and hardly less", Pose, SE3, SE2) {
  for (const ErrorKind error : kKinds) {
    Ring<Pose> ring(32, error, kBases, 12, {1e-5, 1e-6});  // the same linearisation, but for a thousandth
    SparseMap<Pose> map(options_of(ring, true)), whole(options_of(ring, false));
    for (int i = 0; i < 6 * kBases; ++i) {
      const Submap<Pose> submap = ring.submap(i);
      map.join(submap);
      whole.join(submap);
    }
    REQUIRE(map.memory_bytes() < whole.memory_bytes() / 2);
    const Ids ids = ids_of(map);
    const Matrix P = joint_covariance(map, ids), Q = joint_covariance(whole, ids);
    // By directions: P of a unit variance in Q.
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> ratio(P, Q, Eigen::EigenvaluesOnly);
    CHECK(ratio.eigenvalues()(0) >= 0.999);
    const double lost = ratio.eigenvalues().array().log().mean();
    CAPTURE(lost);
    CHECK(lost <= 0.1);  // what the places had in common before they became one
  }
}

// In one place no pose is cut: the fused map is the whole problem, whatever the linearisation makes of it.
TEST_CASE_TEMPLATE("sparse fuser: one place knows exactly as much as the whole problem", Pose, SE3, SE2) {
  for (const ErrorKind error : kKinds) {
    Ring<Pose> ring(39, error, kBases, 12, {1e-4, 1e-5});
    SparseMap<Pose> map(options_of(ring, true)), whole(options_of(ring, false));
    for (int i = 0; i < 40; ++i) {
      const Submap<Pose> submap = ring.draw(ring.base(i % 3), ring.base((i + 1) % 3), {0, 2, 3, 5, 7, 8, 12, 14});
      map.join(submap);
      whole.join(submap);
    }
    REQUIRE(map.memory_bytes() < whole.memory_bytes() / 4);
    const Ids ids = ids_of(map);
    const Matrix P = joint_covariance(map, ids), Q = joint_covariance(whole, ids);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> ratio(P, Q, Eigen::EigenvaluesOnly);
    CHECK(ratio.eigenvalues()(0) >= 0.999);
    CHECK(ratio.eigenvalues().maxCoeff() <= 1.001);
    const double sigma = std::sqrt(Q.diagonal().minCoeff());
    for (const std::uint64_t id : ids) CHECK((position_of(map, id) - position_of(whole, id)).norm() <= 0.01 * sigma);
  }
}

TEST_CASE_TEMPLATE("sparse fuser: a submap that does not fit leaves a fused map as it was", Pose, SE3, SE2) {
  for (const ErrorKind error : kKinds) {
    Ring<Pose> ring(33, error, kBases, 12, {0.05, 0.004});
    MapOptions<Pose> options = options_of(ring, true);
    options.max_landmarks = 40;
    SparseMap<Pose> map(options), twin(options);
    for (int i = 0; i < 5 * kBases; ++i) {
      const Submap<Pose> submap = ring.submap(i);
      Submap<Pose> wrong = submap, without = submap;
      if (i > 2 * kBases && i % 3 == 0) {  // joins, is undone, then joins without the wrong landmark
        wrong.landmarks[2] += 5 * Pose::Point::Unit(Pose::kDim - 1);
        wrong.counts[2] = 1;
        without = cairn::test::without_landmark(wrong, 2);
        Ids ids = submap.ids;
        for (std::uint64_t id = 60; id < 101; ++id) ids.push_back(id);  // more landmarks than the capacity
        Ring<Pose> strangers(34, error, 24, 12, {0.05, 0.004});
        CHECK_THROWS_AS(map.join(strangers.draw(ring.base(i), ring.base(i + 1), ids)), Error);
      }
      const JoinReport report = map.join(wrong);
      CHECK(report.refused == (wrong.landmarks == submap.landmarks ? 0 : 1));
      twin.join(without);
    }
    REQUIRE(map.size() == twin.size());
    for (const std::uint64_t id : ids_of(map)) CHECK((position_of(map, id) - position_of(twin, id)).norm() <= 0.02);
    CHECK(map.memory_bytes() <= twin.memory_bytes() + twin.memory_bytes() / 5);
  }
}

TEST_CASE_TEMPLATE("sparse fuser: a copy of a fused map goes on with the same bits", Pose, SE3, SE2) {
  Ring<Pose> ring(35, ErrorKind::invariant, kBases, 12, {0.05, 0.004});
  SparseMap<Pose> map(options_of(ring, true));
  for (int i = 0; i < 3 * kBases; ++i) map.join(ring.submap(i));
  SparseMap<Pose> copy(map);
  const Matrix before = joint_covariance(copy, ids_of(copy));
  for (int i = 3 * kBases; i < 5 * kBases; ++i) map.join(ring.submap(i));
  CHECK(joint_covariance(copy, ids_of(copy)) == before);
  Ring<Pose> same(35, ErrorKind::invariant, kBases, 12, {0.05, 0.004});
  for (int i = 0; i < 3 * kBases; ++i) same.submap(i);
  for (int i = 3 * kBases; i < 5 * kBases; ++i) copy.join(same.submap(i));
  CHECK(joint_covariance(copy, ids_of(copy)) == joint_covariance(map, ids_of(map)));
}

TEST_CASE_TEMPLATE("sparse fuser: removed landmarks leave nothing behind", Pose, SE3, SE2) {
  Ring<Pose> ring(36, ErrorKind::invariant, kBases, 12, {0.05, 0.004});
  SparseMap<Pose> map(options_of(ring, true));
  std::size_t early = 0;
  for (int i = 0; i < 20 * kBases; ++i) {
    Submap<Pose> submap = ring.submap(i);
    // Every landmark has another name in every third round.
    for (std::uint64_t& id : submap.ids) id += 1000 * static_cast<std::uint64_t>(i / (3 * kBases));
    if (i % (3 * kBases) == kBases)
      for (const std::uint64_t id : ids_of(map))
        if (id / 1000 < submap.ids[3] / 1000) map.remove(id);
    CHECK(map.join(submap).refused == 0);
    if (i >= 6 * kBases && i < 9 * kBases) early = std::max(early, map.memory_bytes());
    if (i >= 9 * kBases) CHECK(map.memory_bytes() <= 2 * early);
  }
}

TEST_CASE("sparse fuser: fused maps are merged") {
  Ring<SE3> ring(37, ErrorKind::invariant, kBases, 12, {0.05, 0.004});
  Ring<SE3> others(37, ErrorKind::invariant, kBases, 12, {0.05, 0.004});  // the same landmarks, other noise
  SparseMap<SE3> map(options_of(ring, true)), other(options_of(ring, true));
  for (int i = 0; i < 4 * kBases; ++i) map.join(ring.submap(i));
  for (int i = 0; i < 9; ++i) others.submap(i);
  for (int i = kBases; i < 5 * kBases; ++i) other.join(others.submap(i));
  const std::size_t submaps = map.submap_count() + other.submap_count();
  const double before = map.covariance(3).trace();
  MergeReport report;
  const MergePlan plan = plan_merge(map, other, MergeOptions(), 100, report);
  map.append(other, plan, MergeOptions(), report);
  CHECK(map.submap_count() == submaps + 1);  // and the bridge
  CHECK(map.size() == 4 * kBases);           // the fifth landmark of a place is in no submap
  CHECK(map.covariance(3).trace() < before);
  for (const std::uint64_t id : ids_of(map)) CHECK((position_of(map, id) - ring.landmarks[id]).norm() < 0.3);
  for (std::size_t k = 0; k < 4 * kBases; ++k)
    CHECK((map.submap_base(k).translation() - ring.base(static_cast<int>(k)).translation()).norm() < 0.3);
  for (int i = 0; i < kBases; ++i) CHECK(map.submap_ids(static_cast<std::size_t>(i)).size() >= 7);
}

TEST_CASE_TEMPLATE("sparse fuser: covariances are those of what the leaves know", Pose, SE3, SE2) {
  Ring<Pose> ring(38, ErrorKind::invariant, kBases, 12, {1e-3, 1e-4});
  SparseState<Pose> state(options_of(ring, true));
  SpatialIndex index([&](std::size_t i) { return Space<Pose>::up(state.point(i)); });
  for (int i = 0; i < 6 * kBases; ++i) {
    SparseTransaction<Pose> transaction(state, index);
    transaction.join(ring.submap(i));
    transaction.commit();
    if (i % 5 != 0) continue;
    std::map<Variable, Index> at;
    Index n = 0;
    for (const auto& leaf : state.leaves)
      for (const Variable v : leaf.variables)
        if (at.emplace(v, n).second) n += dimension<Pose>(v);
    Matrix H = Matrix::Zero(n, n);
    const LeafInformation<Pose> source(state);
    for (std::uint32_t number = 0; number < state.leaves.size(); ++number) {
      const auto& leaf = state.leaves[number];
      if (!leaf.used()) continue;
      std::vector<Index> rows;
      for (const Variable v : leaf.variables)
        for (Index d = 0; d < dimension<Pose>(v); ++d) rows.push_back(at.at(v) + d);
      const auto size = static_cast<Index>(rows.size());
      Matrix own = Matrix::Zero(size, size);
      source.information(number, own.data(), size);
      H(rows, rows) += Matrix(own.template selfadjointView<Eigen::Lower>());
    }
    const Matrix P = H.ldlt().solve(Matrix::Identity(n, n));
    for (std::size_t k = 0; k < state.visible.size(); ++k) {
      const std::uint32_t landmark = state.visible[k];
      if (!state.shared(landmark)) continue;
      const Index row = at.at(landmark_variable(landmark));
      Matrix own = P.block<Pose::kDim, Pose::kDim>(row, row);
      state.to_map_axes({landmark_variable(landmark)}, own);
      Matrix joint(Pose::kDof + Pose::kDim, Pose::kDof + Pose::kDim);
      joint_covariance_of_base(state, &k, 1, joint.data());
      CHECK((joint.bottomRightCorner(Pose::kDim, Pose::kDim) - own).norm() <= 1e-3 * own.norm());
    }
  }
}
