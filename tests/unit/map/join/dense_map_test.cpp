// SPDX-License-Identifier: BSD-3-Clause
// The dense map against the whole problem, with errors so small that one linearisation is sufficient.
#include "map/join/dense/dense_map.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "submap_ring.hpp"

namespace {

using namespace cairn;
using cairn::test::difference;
using cairn::test::kKinds;
using cairn::test::Noise;
using Eigen::Index;
using Matrix = Eigen::MatrixXd;

}  // namespace

TEST_CASE_TEMPLATE("dense map: the minimum of the whole problem, and its covariance", Pose, SE3, SE2) {
  using Space = Embedding<Pose>;
  for (const ErrorKind error : kKinds) {
    cairn::test::Ring<Pose> ring(21, error, 8, 12, Noise{1e-4, 4e-6});
    MapOptions<Pose> options = ring.options();
    options.initial_covariance *= 1e-6;
    DenseMap<Pose> map(options);
    std::vector<Submap<Pose>> submaps;
    for (int i = 0; i < 12; ++i) {  // one and a half rounds
      submaps.push_back(ring.submap(i));
      const JoinReport report = map.join(submaps.back());
      CHECK(report.refused == 0);
      CHECK(report.fused + report.fresh == 7);
      CHECK(report.rows == Pose::kDim * report.fused);
      if (i != 0 && i != 6 && i != 11) continue;
      cairn::test::Reference<Pose> reference(options, submaps);
      reference.solve();
      REQUIRE(map.size() == reference.landmarks.size());
      std::vector<std::size_t> indices;
      std::vector<Index> at;
      const Index newest = reference.states_of_bases() - Pose::kDof;
      for (Index d = 0; d < Pose::kDof; ++d) at.push_back(newest + d);
      double far = 0.0;
      for (const auto& [id, position] : reference.landmarks) {
        std::size_t index = 0;
        REQUIRE(map.find(id, index));
        indices.push_back(index);
        for (Index d = 0; d < Pose::kDim; ++d) at.push_back(reference.states.at(id) + d);
        far = std::max(far, (map.position(index) - Space::up(position)).norm());
      }
      CHECK(far <= 1e-7);  // a thousandth of the errors of the submaps
      CHECK((map.base().translation() - reference.bases.back().translation()).norm() <= 1e-7);
      const Matrix whole = reference.covariance(), expected = whole(at, at);
      Matrix joint(expected.rows(), expected.cols());
      map.base_joint_covariance(indices.data(), indices.size(), joint.data());
      CHECK(difference(joint, expected) <= 1e-3);
      CHECK(difference(map.base_covariance(), expected.topLeftCorner<Pose::kDof, Pose::kDof>()) <= 1e-3);
    }
  }
}

TEST_CASE("dense map: of the plane, it speaks of space all the same") {
  cairn::test::Ring<SE2> ring(22, ErrorKind::invariant, 8, 12, Noise{0.01, 4e-4});
  DenseMap<SE2> map(ring.options());
  for (int i = 0; i < 3; ++i) map.join(ring.submap(i));
  CHECK(map.planar());
  REQUIRE(map.size() > 6);
  const std::size_t indices[] = {4, 1, 6};
  Matrix joint(3 + 2 * 3, 3 + 2 * 3), landmarks(9, 9);
  map.base_joint_covariance(indices, 3, joint.data());
  map.joint_covariance(indices, 3, landmarks.data());
  for (Index a = 0; a < 3; ++a) {
    CHECK(map.position(indices[a]).z() == 0.0);
    CHECK(map.covariance(indices[a]) == landmarks.block<3, 3>(3 * a, 3 * a));
    for (Index b = 0; b < 3; ++b) {
      CHECK(landmarks.block<2, 2>(3 * a, 3 * b) == joint.block<2, 2>(3 + 2 * a, 3 + 2 * b));
      CHECK(landmarks.block<2, 2>(3 * a, 3 * b).norm() > 0.0);
      CHECK(landmarks.block<3, 1>(3 * a, 3 * b + 2).isZero(0.0));
      CHECK(landmarks.block<1, 3>(3 * a + 2, 3 * b).isZero(0.0));
    }
  }
}
