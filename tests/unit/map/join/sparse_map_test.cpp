// SPDX-License-Identifier: BSD-3-Clause
// The sparse map against Gauss-Newton over the whole problem, and its behaviour when a submap does not fit.
#include "map/join/sparse/sparse_map.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "core/error.hpp"
#include "submap_ring.hpp"

namespace {

using namespace cairn;
using cairn::test::difference;
using cairn::test::Ids;
using cairn::test::kKinds;
using cairn::test::Noise;
using cairn::test::position_of;
using Eigen::Index;
using Matrix = Eigen::MatrixXd;
template <class Pose>
using Ring = cairn::test::Ring<Pose>;
template <class Pose>
using Reference = cairn::test::Reference<Pose>;
template <class Pose>
using Space = Embedding<Pose>;

// All outputs of a map, to the bit.
template <class Pose>
std::vector<double> everything(const SparseMap<Pose>& map) {
  std::vector<double> out{static_cast<double>(map.size()), static_cast<double>(map.submap_count()), map.cost()};
  const auto add = [&](const auto& values) { out.insert(out.end(), values.data(), values.data() + values.size()); };
  const auto add_pose = [&](const Pose& pose) {
    const SE3 in_space = Space<Pose>::up(pose);
    add(in_space.translation());
    add(in_space.rotation().quaternion().coeffs());
  };
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < map.size(); ++i) {
    all.push_back(i);
    out.push_back(static_cast<double>(map.id(i)));
    out.push_back(static_cast<double>(map.observations(i)));
    add(map.position(i));
    std::size_t index = 0;
    CHECK(map.find(map.id(i), index));
    CHECK(index == i);
  }
  map.prepare_covariances(all);
  for (const std::size_t i : all) add(map.covariance(i));
  const std::size_t states = Pose::kDof + Pose::kDim * map.size();
  Matrix joint(states, states);
  map.base_joint_covariance(all.data(), all.size(), joint.data());
  add(joint);
  add_pose(map.base());
  add(map.base_covariance());
  for (std::size_t i = 0; i < map.submap_count(); ++i) add_pose(map.submap_base(i));
  for (const std::size_t i : within(map, Vector3(5, 5, 0), 15)) out.push_back(static_cast<double>(i));
  return out;
}

}  // namespace

TEST_CASE_TEMPLATE("sparse map: the minimum of the whole problem", Pose, SE3, SE2) {
  for (const ErrorKind error : kKinds)
    for (const bool rough : {false, true}) {
      CAPTURE(rough);
      Ring<Pose> ring(11, error, 8, 12, rough ? Noise{0.4, 0.06} : Noise{0.05, 0.004});
      SparseMap<Pose> map(ring.options());
      std::vector<Submap<Pose>> submaps;
      for (int i = 0; i < 18; ++i) {  // more than two rounds
        submaps.push_back(ring.submap(i));
        const JoinReport report = map.join(submaps.back());
        CHECK(report.refused == 0);
        CHECK(report.fused + report.fresh == 7);
        CHECK(report.rows == Pose::kDim * report.fused);
        if (i != 6 && i != 11 && i != 17) continue;
        Reference<Pose> reference(map.submap_count() > 0 ? ring.options() : MapOptions<Pose>(), submaps);
        reference.solve();
        const double least = reference.cost();
        CHECK(map.cost() == doctest::Approx(least).epsilon(1e-6));
        REQUIRE(map.size() == reference.landmarks.size());
        for (const auto& [id, position] : reference.landmarks)
          CHECK((position_of(map, id) - Space<Pose>::up(position)).norm() <= (rough ? 4e-3 : 5e-4));
        for (std::size_t k = 0; k < submaps.size(); ++k)
          CHECK((map.submap_base(k).translation() - reference.bases[k].translation()).norm() <= (rough ? 4e-3 : 5e-4));
      }
    }
}

TEST_CASE_TEMPLATE("sparse map: a loop closed far from its start", Pose, SE3, SE2) {
  for (const ErrorKind error : kKinds) {
    Ring<Pose> ring(12, error, 24, 150, {0.1, 0.015});
    SparseMap<Pose> map(ring.options());
    std::vector<Submap<Pose>> submaps;
    double drift = 0.0;
    for (int i = 0; i < 34; ++i) {
      if (i == 23) drift = (map.base().translation() - ring.base(23).translation()).norm();
      submaps.push_back(ring.submap(i));
      const JoinReport report = map.join(submaps.back());
      CHECK(report.refused == 0);
      if (i == 23) CHECK(report.moved_max > 0.3 * drift);  // the first landmarks are observed again
      if (i != 24 && i != 33) continue;
      // A closing may leave a small part of its steps to the next closing, but never forever.
      Reference<Pose> reference(ring.options(), submaps);
      reference.solve();
      const double settled = i == 33 ? 1e-6 : 1e-2;
      CHECK(map.cost() == doctest::Approx(reference.cost()).epsilon(settled));
      const double sigma = std::sqrt(
          reference.covariance().block(Pose::kDof * (i + 1), Pose::kDof * (i + 1), Pose::kDim, Pose::kDim).trace());
      CHECK((map.base().translation() - reference.bases.back().translation()).norm() <= (i == 33 ? 0.01 : 0.2) * sigma);
      if (i != 33) continue;
      const Matrix P = reference.covariance();
      const Index newest = reference.states_of_bases() - Pose::kDof;
      CHECK(difference(map.base_covariance(), P.block<Pose::kDof, Pose::kDof>(newest, newest)) <=
            0.1);  // the factor contains older linearisations
    }
    CHECK(drift > 1.0);
  }
}

TEST_CASE_TEMPLATE("sparse map: what is carried along in a long loop lands where it would be led step by step", Pose,
                   SE3, SE2) {
  for (const ErrorKind error : kKinds) {
    Ring<Pose> ring(19, error, 160, 300, {0.05, 0.004});
    MapOptions<Pose> options = ring.options(), exact = options;
    options.step_tolerance = MapOptions<Pose>().step_tolerance;
    options.cost_tolerance = MapOptions<Pose>().cost_tolerance;
    exact.most_iterations = 30;
    SparseMap<Pose> map(options), twin(options), reference(exact);
    std::size_t carried = 0;
    double moved = 0.0;
    for (int i = 0; i < 200; ++i) {
      const Submap<Pose> submap = ring.submap(i);
      Submap<Pose> wrong = submap, without = submap;
      if (i >= 160 && i % 8 == 0) {  // joins, is undone, then joins without the wrong landmark
        wrong.landmarks[2] += 5 * Pose::Point::Unit(Pose::kDim - 1);
        without = cairn::test::without_landmark(wrong, 2);
      }
      const JoinReport report = map.join(wrong);
      CHECK(report.refused == (wrong.landmarks == submap.landmarks ? 0 : 1));
      twin.join(without);
      reference.join(without);
      carried += report.carried;
      moved = std::max(moved, report.moved_max);
    }
    CHECK(carried > 1000);
    CHECK(moved > 5.0);
    const double sigma = std::sqrt(reference.base_covariance().topLeftCorner(Pose::kDim, Pose::kDim).trace());
    CAPTURE(sigma);
    const auto base = [](const SparseMap<Pose>& of, std::size_t k) {  // the one after the last submap is the map's
      return (k < of.submap_count() ? of.submap_base(k) : of.base()).translation();
    };
    for (std::size_t k = 0; k <= 200; k += 10) {
      CHECK((base(map, k) - base(twin, k)).norm() <= 1e-9);
      CHECK((base(map, k) - base(reference, k)).norm() <= 0.01 * sigma);
    }
    for (std::size_t i = 0; i < map.size(); ++i) {
      CHECK((map.position(i) - position_of(twin, map.id(i))).norm() <= 1e-9);
      CHECK((map.position(i) - position_of(reference, map.id(i))).norm() <= 0.01 * sigma);
    }
  }
}

TEST_CASE_TEMPLATE("sparse map: covariances are the whole problem's", Pose, SE3, SE2) {
  for (const ErrorKind error : kKinds) {
    Ring<Pose> ring(13, error, 8, 12, {0.01, 4e-4});
    MapOptions<Pose> options = ring.options();
    options.initial_covariance *= 1e-4;
    SparseMap<Pose> map(options);
    std::vector<Submap<Pose>> submaps;
    for (int i = 0; i < 12; ++i) {
      submaps.push_back(ring.submap(i));
      map.join(submaps.back());
      if (i != 0 && i != 5 && i != 11) continue;
      Reference<Pose> reference(options, submaps);
      reference.solve();
      const Matrix P = reference.covariance();
      std::vector<std::size_t> indices;
      std::vector<Index> at;
      const Index newest = reference.states_of_bases() - Pose::kDof;
      for (Index d = 0; d < Pose::kDof; ++d) at.push_back(newest + d);
      for (std::size_t k = 0; k < map.size(); k += 2) {  // private and shared landmarks
        indices.push_back(map.size() - 1 - k);
        for (Index d = 0; d < Pose::kDim; ++d) at.push_back(reference.states.at(map.id(indices.back())) + d);
      }
      const Matrix expected = P(at, at);
      Matrix joint(expected.rows(), expected.cols());
      map.base_joint_covariance(indices.data(), indices.size(), joint.data());
      CHECK(difference(joint, expected) <= 5e-3);
      CHECK(joint == Matrix(joint.transpose()));
      CHECK(difference(map.base_covariance(), expected.topLeftCorner<Pose::kDof, Pose::kDof>()) <= 5e-3);
      Matrix landmarks(3 * indices.size(), 3 * indices.size());
      map.joint_covariance(indices.data(), indices.size(), landmarks.data());
      const auto block = [&](std::size_t a, std::size_t b) {
        const auto row = static_cast<Index>(Pose::kDof + Pose::kDim * a);
        const auto column = static_cast<Index>(Pose::kDof + Pose::kDim * b);
        const typename Pose::Rotation::Matrix own = joint.block<Pose::kDim, Pose::kDim>(row, column);
        return Matrix3(Space<Pose>::up(own));
      };
      for (std::size_t a = 0; a < indices.size(); ++a) {
        CHECK(difference(map.covariance(indices[a]), block(a, a)) <= 1e-9);
        for (std::size_t b = 0; b < indices.size(); ++b)
          CHECK(landmarks.block<3, 3>(static_cast<Index>(3 * a), static_cast<Index>(3 * b)) == block(a, b));
      }
    }
  }
}

TEST_CASE_TEMPLATE("sparse map: a landmark that contradicts the map is left out, and it alone", Pose, SE3, SE2) {
  for (const ErrorKind error : kKinds) {
    Ring<Pose> ring(14, error, 8, 12, {0.05, 0.004});
    SparseMap<Pose> map(ring.options());
    for (int i = 0; i < 9; ++i) map.join(ring.submap(i));
    SparseMap<Pose> without(map);
    const Submap<Pose> good = ring.submap(9);
    Submap<Pose> bad = good;
    const std::uint64_t liar = bad.ids[3];
    bad.counts[3] = 1;  // fewer than in the map
    bad.landmarks[3] += Space<Pose>::down(Vector3(2, -1, 1));
    const Vector3 before = position_of(map, liar);
    const JoinReport report = map.join(bad);
    CHECK(report.refused == 1);
    CHECK(report.worst_refused > 50.0);
    CHECK(report.fused == 6);
    CHECK(report.rows == 6 * Pose::kDim);
    CHECK(report.distance <= report.threshold);
    CHECK((position_of(map, liar) - before).norm() <= 0.05);
    // Equal to a map whose submap never held it.
    CHECK(without.join(cairn::test::without_landmark(good, 3)).refused == 0);
    CHECK(map.cost() == doctest::Approx(without.cost()).epsilon(1e-6));
    for (std::size_t k = 0; k < map.size(); ++k)
      CHECK((map.position(k) - position_of(without, map.id(k))).norm() <= 1e-4);
    CHECK(map.join(ring.submap(10)).refused == 0);  // and the map works as before
  }
}

TEST_CASE_TEMPLATE("sparse map: a submap that can't be taken in changes nothing", Pose, SE3, SE2) {
  for (const ErrorKind error : kKinds) {
    Ring<Pose> ring(15, error, 8, 12, {0.05, 0.004});
    MapOptions<Pose> options = ring.options();
    options.max_landmarks = 40;
    SparseMap<Pose> map(options), twin(options);
    for (int i = 0; i < 11; ++i) {
      const Submap<Pose> submap = ring.submap(i);
      const std::vector<double> before = everything(map);
      Submap<Pose> crowd = submap;  // more landmarks than the capacity
      Ring<Pose> strangers(16, error, 24, 12, {0.05, 0.004});
      Ids ids = submap.ids;
      for (std::uint64_t id = 60; id < 101; ++id) ids.push_back(id);
      crowd = strangers.draw(ring.base(i), ring.base(i + 1), ids);
      CHECK_THROWS_AS(map.join(crowd), Error);
      CHECK(everything(map) == before);
      Submap<Pose> broken = submap;
      broken.covariance(1, 1) = -1;
      CHECK_THROWS_AS(map.join(broken), Error);
      CHECK(everything(map) == before);
      map.join(submap);
      twin.join(submap);
      CHECK(everything(map) == everything(twin));  // the same bits as without the failed join
    }
  }
}

TEST_CASE_TEMPLATE("sparse map: a transaction without commit changes nothing", Pose, SE3, SE2) {
  Ring<Pose> ring(20, ErrorKind::invariant, 8, 12, {0.05, 0.004});
  MapOptions<Pose> options = ring.options();
  options.initial_covariance += 1e-4 * Pose::Square::Identity();
  SparseMap<Pose> map(options), twin(options);
  for (int i = 0; i < 12; ++i) {
    const auto fix = AbsoluteFix<Pose>::position(ring.base(i + 1).translation(),
                                                 0.01 * Pose::Rotation::Matrix::Identity(), Pose::Point::Zero());
    const Submap<Pose> submap = ring.submap(i);
    const std::vector<double> before = everything(map);
    Submap<Pose> wrong = submap;  // needs the second try
    wrong.landmarks[2] += 5 * Pose::Point::Unit(Pose::kDim - 1);
    for (const Submap<Pose>& joined : {submap, wrong}) {
      const auto transaction = map.begin();
      transaction->join(joined);
      CHECK(transaction->fix(fix, 1e9).accepted);
    }
    CHECK(map.begin()->fix(fix, 1e9).accepted);
    CHECK(everything(map) == before);
    map.join(submap);
    twin.join(submap);
    CHECK(everything(map) == everything(twin));  // the same bits as without the failed join
  }
}

TEST_CASE_TEMPLATE("sparse map: a copy is a map of its own", Pose, SE3, SE2) {
  Ring<Pose> ring(17, ErrorKind::invariant, 8, 12, {0.05, 0.004});
  SparseMap<Pose> map(ring.options());
  for (int i = 0; i < 6; ++i) map.join(ring.submap(i));
  const std::vector<double> before = everything(map);
  SparseMap<Pose> copy(map);
  CHECK(everything(copy) == before);
  const Submap<Pose> next = ring.submap(6);
  copy.join(next);
  CHECK(everything(map) == before);
  map.join(next);
  CHECK(everything(map) == everything(copy));
}

TEST_CASE_TEMPLATE("sparse map: a landmark removed is gone, and what it taught stays", Pose, SE3, SE2) {
  Ring<Pose> ring(18, ErrorKind::invariant, 8, 12, {0.05, 0.004});
  SparseMap<Pose> map(ring.options());
  for (int i = 0; i < 9; ++i) map.join(ring.submap(i));
  const std::size_t size = map.size();
  const double cost = map.cost();
  const std::uint64_t gone[] = {map.id(3), map.id(size - 1)};
  std::size_t index = 0;
  REQUIRE(map.find(map.id(5), index));
  const Matrix3 kept = map.covariance(index);
  const std::uint64_t witness = map.id(5);
  for (const std::uint64_t id : gone) map.remove(id);
  map.remove(4711);
  CHECK(map.size() == size - 2);
  CHECK(map.cost() == cost);
  for (const std::uint64_t id : gone) CHECK(!map.find(id, index));
  REQUIRE(map.find(witness, index));
  CHECK(map.covariance(index) == kept);
  everything(map);  // checks that ids and indices agree
  CHECK(within(map, Vector3::Zero(), 1e6).size() == size - 2);
  // When it is observed again, it is a new landmark.
  const JoinReport report = map.join(ring.submap(9));
  CHECK(report.refused == 0);
  CHECK(report.fresh + report.fused == 7);
  everything(map);
}
