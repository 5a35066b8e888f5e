// SPDX-License-Identifier: BSD-3-Clause
// The dense joining. On linear-Gaussian problems (known attitude, points observed directly) a filter with submaps must
// equal a filter with a single map, except for rounding.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "map/join/dense/dense_map.hpp"
#include "map/join/ring.hpp"
#include "map/join/sparse/sparse_map.hpp"

namespace {

using namespace cairn;
using namespace cairn::test;

// A drive of two rounds on a ring of landmarks; both filters get the same data.
template <class Pose, class Visit>
void drive(double turn_sigma, Visit&& visit) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn;
  using Point = typename Pose::Point;
  using Space = Embedding<Pose>;
  Random random(7);
  const std::vector<typename Pose::Point> landmarks = ring_landmarks<Pose>();
  Pose truth;
  const Pose step = Space::down(SE3(SO3::exp(Vector3(0.01, 0.005, 0.105)), Vector3(1.0, 0, 0.01)));
  for (int k = 0; k < kRingSteps; ++k) {
    Increment<Pose> increment;
    const Point noise = 0.05 * random.normal_vector<kDim>();
    const typename Pose::Rotation::Tangent turn = turn_sigma * random.normal_vector<kTurn>();
    increment.T_before_after = Pose(Pose::Rotation::exp(turn) * step.rotation(), step.translation() + noise);
    increment.covariance.setZero();
    increment.covariance.diagonal().template head<kDim>().setConstant(0.0025);
    increment.covariance.diagonal().template tail<kTurn>().setConstant(turn_sigma * turn_sigma);
    truth = truth * step;
    visit(increment, see_ring(truth, landmarks, random));
  }
}

template <class Pose>
void feed(Filter<Pose>& filter, const Increment<Pose>& increment, const std::vector<Observation>& seen) {
  filter.propagate(increment);
  filter.update(0, seen.data(), static_cast<Index>(seen.size()));
}

// The number of submaps that were fused with an earlier one: they share its list of landmarks.
template <class Pose>
std::size_t in_places(const GlobalMap<Pose>& map) {
  std::size_t count = 0;
  for (std::size_t k = 1; k < map.submap_count(); ++k) {
    std::size_t earlier = 0;
    while (earlier < k && &map.submap_ids(earlier) != &map.submap_ids(k)) ++earlier;
    if (earlier < k) ++count;
  }
  return count;
}

// `every`: submaps are closed after so many steps, too; 0: they are not.
template <class Pose>
void compare(ErrorKind error, JoinKind join, double tolerance, int every = 0, std::size_t fused = 0) {
  int step = 0;
  RingVehicle<Pose> single(ring_options<Pose>(error, 0, join)), submaps(ring_options<Pose>(error, 9, join));
  drive<Pose>(0.0, [&](const Increment<Pose>& increment, const std::vector<Observation>& seen) {
    feed(single.filter, increment, seen);
    feed(submaps.filter, increment, seen);
    if (every > 0 && ++step % every == 0 && submaps.filter.local_landmarks().size() > 0) submaps.filter.close_submap();
  });
  REQUIRE(submaps.filter.closing().submaps >= 5);
  CHECK(in_places(*submaps.filter.map()) >= fused);
  if (submaps.filter.local_landmarks().size() > 0) submaps.filter.close_submap();
  CHECK(!submaps.filter.closing().failed);
  const Landmarks &a = single.filter.landmarks(), &b = submaps.filter.landmarks();
  REQUIRE(a.size() == b.size());
  std::vector<std::size_t> in_a, in_b;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t j = 0;
    REQUIRE(b.find(a.id(i), j));
    in_a.push_back(i);
    in_b.push_back(j);
    CHECK((a.position(i) - b.position(j)).norm() <= tolerance * a.position(i).norm());
    CHECK(a.observations(i) == b.observations(j));
  }
  const auto size = static_cast<Eigen::Index>(6 + 3 * a.size());
  Eigen::MatrixXd P(size, size), Q(size, size);
  single.filter.pose_joint_covariance(in_a.data(), in_a.size(), P.data());
  submaps.filter.pose_joint_covariance(in_b.data(), in_b.size(), Q.data());
  CHECK(relative_difference(Q, P) <= tolerance);
  CHECK((single.filter.pose().translation() - submaps.filter.pose().translation()).norm() <= tolerance * 20);
}

}  // namespace

TEST_CASE_TEMPLATE("dense joining: equal to a single map on a linear-Gaussian problem", Pose, SE3, SE2) {
  SUBCASE("invariant") {
    compare<Pose>(ErrorKind::invariant, JoinKind::dense, 1e-10);
  }
  SUBCASE("standard") {
    compare<Pose>(ErrorKind::standard, JoinKind::dense, 1e-10);
  }
}

TEST_CASE_TEMPLATE("sparse joining: equal to a single map on a linear-Gaussian problem", Pose, SE3, SE2) {
  SUBCASE("invariant") {
    compare<Pose>(ErrorKind::invariant, JoinKind::sparse, 1e-8);
  }
  SUBCASE("standard") {
    compare<Pose>(ErrorKind::standard, JoinKind::sparse, 1e-8);
  }
}

TEST_CASE_TEMPLATE("sparse joining: equal to a single map where submaps of one place have become one", Pose, SE3, SE2) {
  for (const ErrorKind error : {ErrorKind::invariant, ErrorKind::standard})
    compare<Pose>(error, JoinKind::sparse, 1e-8, 3, 5);
}

TEST_CASE_TEMPLATE("joining: a single landmark's gate is that of so many coordinates", Pose, SE3, SE2) {
  constexpr double kSigma = 0.05;
  const auto submap_of = [](const Vector3& landmark) {
    Submap<Pose> submap;
    submap.ids = {1};
    submap.counts = {1};
    submap.landmarks = {Embedding<Pose>::down(landmark)};
    const Eigen::Index n = Pose::kDof + Pose::kDim;
    submap.covariance = 1e-10 * Eigen::MatrixXd::Identity(n, n);
    submap.covariance.diagonal().template tail<Pose::kDim>().setConstant(kSigma * kSigma);
    return submap;
  };
  for (const ErrorKind error : {ErrorKind::invariant, ErrorKind::standard})
    for (const bool sparse : {false, true})
      for (const double squared_distance : {8.5, 10.3, 12.0}) {  // the bound is 11.3, in the plane 9.2
        CAPTURE(squared_distance);
        MapOptions<Pose> options;
        options.error = error;
        options.initial_covariance = 1e-8 * Pose::Square::Identity();
        std::unique_ptr<GlobalMap<Pose>> map;
        if (sparse)
          map = std::make_unique<SparseMap<Pose>>(options);
        else
          map = std::make_unique<DenseMap<Pose>>(options);
        Submap<Pose> first = submap_of(Vector3(5, 0, 0));
        first.error = error;
        map->join(first);
        Submap<Pose> second = submap_of(Vector3(5, kSigma * std::sqrt(2 * squared_distance), 0));
        second.error = error;
        const JoinReport report = map->join(second);
        CHECK(report.refused == (squared_distance < (Pose::kDim == 3 ? 11.3 : 9.2) ? 0 : 1));
        CHECK(report.fused == 1 - report.refused);
        CHECK(report.worst_refused == doctest::Approx(report.refused > 0 ? squared_distance : 0.0).epsilon(0.01));
      }
}
