// SPDX-License-Identifier: BSD-3-Clause
// The dense joining. On linear-Gaussian problems (known attitude, points observed directly) a filter with submaps must
// equal a filter with a single map, except for rounding.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "map/join/dense/dense_map.hpp"
#include "map/join/sparse/sparse_map.hpp"
#include "numerical.hpp"
#include "slam/filter.hpp"

namespace {

using namespace cairn;
using cairn::test::Random;

template <class Pose>
struct Vehicle {
  explicit Vehicle(const FilterOptions<Pose>& options)
      : arena(Filter<Pose>::arena_bytes(options)), filter(arena, options) {
    Cartesian<Pose> sensor;
    filter.add(sensor);
  }
  Arena arena;
  Filter<Pose> filter;
};

template <class Pose>
FilterOptions<Pose> options_of(ErrorKind error, Index submap_landmarks, JoinKind join) {
  using Space = Embedding<Pose>;
  FilterOptions<Pose> options;
  options.error = error;
  options.max_landmarks = 60;
  options.max_observations = 16;
  options.submap_landmarks = submap_landmarks;
  options.join = join;
  options.gate_probability = 1.0;
  options.batch_gate_probability = 1.0;
  options.step_tolerance = 1e-12;
  options.initial_pose = Space::down(SE3(SO3::exp(Vector3(0.1, -0.2, 0.7)), Vector3(10, -5, 2)));
  options.initial_covariance.template topLeftCorner<Pose::kDim, Pose::kDim>() =
      Space::down(Vector3(0.04, 0.01, 0.09)).asDiagonal();
  return options;
}

// A drive of two rounds on a ring of landmarks; both filters get the same data.
template <class Pose, class Visit>
void drive(double turn_sigma, Visit&& visit) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn;
  using Point = typename Pose::Point;
  using Space = Embedding<Pose>;
  Random random(7);
  std::vector<Point> landmarks;
  for (int i = 0; i < 30; ++i)
    landmarks.push_back(
        Space::down(Vector3(12 * std::cos(0.21 * i), 12 * std::sin(0.21 * i), 0.5 * std::sin(1.3 * i))));
  Pose truth;
  const Pose step = Space::down(SE3(SO3::exp(Vector3(0.01, 0.005, 0.105)), Vector3(1.0, 0, 0.01)));
  for (int k = 0; k < 120; ++k) {
    Increment<Pose> increment;
    const Point noise = 0.05 * random.normal_vector<kDim>();
    const typename Pose::Rotation::Tangent turn = turn_sigma * random.normal_vector<kTurn>();
    increment.T_before_after = Pose(Pose::Rotation::exp(turn) * step.rotation(), step.translation() + noise);
    increment.covariance.setZero();
    increment.covariance.diagonal().template head<kDim>().setConstant(0.0025);
    increment.covariance.diagonal().template tail<kTurn>().setConstant(turn_sigma * turn_sigma);
    truth = truth * step;
    std::vector<Observation> seen;
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Point y = truth.inverse() * landmarks[i];
      if (y.norm() > 9.0 || seen.size() == 16) continue;
      Observation observation{i, {}, {}};
      const Point z = y + 0.1 * random.normal_vector<kDim>();
      for (int d = 0; d < kDim; ++d) {
        observation.z[d] = z(d);
        observation.covariance[(kDim + 1) * d] = 0.01;
      }
      seen.push_back(observation);
    }
    visit(increment, seen);
  }
}

template <class Pose>
void feed(Filter<Pose>& filter, const Increment<Pose>& increment, const std::vector<Observation>& seen) {
  filter.propagate(increment);
  filter.update(0, seen.data(), static_cast<Index>(seen.size()));
}

double relative(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / (1e-300 + b.norm());
}

template <class Pose>
void compare(ErrorKind error, JoinKind join, double tolerance) {
  Vehicle<Pose> single(options_of<Pose>(error, 0, join)), submaps(options_of<Pose>(error, 9, join));
  drive<Pose>(0.0, [&](const Increment<Pose>& increment, const std::vector<Observation>& seen) {
    feed(single.filter, increment, seen);
    feed(submaps.filter, increment, seen);
  });
  REQUIRE(submaps.filter.closing().submaps >= 5);
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
  CHECK(relative(Q, P) <= tolerance);
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
      }
}
