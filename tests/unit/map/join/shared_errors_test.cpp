// SPDX-License-Identifier: BSD-3-Clause
// Submaps that share systematic errors. On linear-Gaussian problems (known attitude, a bias of the velocity, points
// observed directly) a filter with submaps must equal a filter with a single map, except for rounding.
#include "map/shared_errors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "map/join/ring.hpp"

namespace {

using namespace cairn;
using namespace cairn::test;

template <class Pose>
struct Vehicle : RingVehicle<Pose> {
  explicit Vehicle(const FilterOptions<Pose>& options) : RingVehicle<Pose>(options) {
    TwistNoise noise;
    noise.velocity_sigma.setConstant(0.05);
    noise.rate_sigma.setZero();
    this->filter.set_twist_noise(noise);
  }
};

template <class Pose>
FilterOptions<Pose> options_of(ErrorKind error, Index submap_landmarks, JoinKind join, double walk) {
  FilterOptions<Pose> options = ring_options<Pose>(error, submap_landmarks, join);
  options.systematic.motion_sigma[0] = 0.1;
  options.systematic.motion_sigma[1] = 0.3;
  options.systematic.motion_walk[1] = walk;
  return options;
}

// A drive of two rounds on a ring of landmarks by measured twists whose velocity is biased.
template <class Pose, class Visit>
void drive(double walk, Visit&& visit) {
  using Space = Embedding<Pose>;
  Random random(7);
  const std::vector<typename Pose::Point> landmarks = ring_landmarks<Pose>();
  Pose truth;
  Vector6 twist;
  twist << 1.0, 0, 0.01, 0.01, 0.005, 0.105;
  Vector3 bias(0.08, -0.2, 0);
  for (int k = 0; k < kRingSteps; ++k) {
    truth = truth * Pose::exp(Space::down(twist));
    const Vector3 measured = twist.head<3>() + bias + 0.05 * random.normal_vector<3>();
    bias.y() += walk * random.normal();
    visit(measured, Vector3(twist.tail<3>()), see_ring(truth, landmarks, random));
  }
}

template <class Pose>
struct Errors {
  explicit Errors(const Filter<Pose>& filter)
      : values(filter.systematic().count()), covariance(values.size(), values.size()) {
    filter.systematic_errors(values.data(), covariance.data());
  }
  Eigen::VectorXd values;
  Eigen::MatrixXd covariance;
};

template <class Pose>
void check_pose(const Filter<Pose>& single, const Filter<Pose>& submaps, double tolerance) {
  CHECK((single.pose().translation() - submaps.pose().translation()).norm() <= tolerance * 20);
  CHECK(relative_difference(submaps.pose_covariance(), single.pose_covariance()) <= tolerance);
  const Errors<Pose> a(single), b(submaps);
  CHECK((a.values - b.values).norm() <= tolerance * a.values.norm());
  CHECK(relative_difference(b.covariance, a.covariance) <= tolerance);
}

template <class Pose>
void compare(ErrorKind error, JoinKind join, double walk, double tolerance) {
  Vehicle<Pose> single(options_of<Pose>(error, 0, join, walk)), submaps(options_of<Pose>(error, 9, join, walk));
  bool seen_again = false;  // the open submap holds a landmark that the map knows
  drive<Pose>(walk, [&](const Vector3& v, const Vector3& w, const std::vector<Observation>& seen) {
    for (Vehicle<Pose>* vehicle : {&single, &submaps}) {
      vehicle->filter.predict_twist(1.0, v, w);
      vehicle->filter.update(0, seen.data(), static_cast<Index>(seen.size()));
    }
    const Landmarks& open = submaps.filter.local_landmarks();
    std::size_t index = 0;
    for (std::size_t i = 0; i < open.size(); ++i)
      seen_again = seen_again || submaps.filter.landmarks().find(open.id(i), index);
    // The pose of an open submap knows what the submap found out about the errors. It does not use the map's landmarks.
    if (!seen_again || open.size() == 0) check_pose(single.filter, submaps.filter, tolerance);
    if (open.size() == 0) seen_again = false;
  });
  REQUIRE(submaps.filter.closing().submaps >= 5);
  if (submaps.filter.local_landmarks().size() > 0) submaps.filter.close_submap();
  CHECK(!submaps.filter.closing().failed);
  check_pose(single.filter, submaps.filter, tolerance);
  const Landmarks &a = single.filter.landmarks(), &b = submaps.filter.landmarks();
  REQUIRE(a.size() == b.size());
  std::vector<std::size_t> in_a, in_b;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t j = 0;
    REQUIRE(b.find(a.id(i), j));
    in_a.push_back(i);
    in_b.push_back(j);
    CHECK((a.position(i) - b.position(j)).norm() <= tolerance * a.position(i).norm());
  }
  const auto size = static_cast<Eigen::Index>(6 + 3 * a.size());
  Eigen::MatrixXd P(size, size), Q(size, size);
  single.filter.pose_joint_covariance(in_a.data(), in_a.size(), P.data());
  submaps.filter.pose_joint_covariance(in_b.data(), in_b.size(), Q.data());
  CHECK(relative_difference(Q, P) <= tolerance);
}

}  // namespace

TEST_CASE_TEMPLATE("dense joining: submaps that share a bias are equal to a single map", Pose, SE3, SE2) {
  for (const ErrorKind error : {ErrorKind::invariant, ErrorKind::standard})
    for (const double walk : {0.0, 0.01}) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(walk);
      compare<Pose>(error, JoinKind::dense, walk, 1e-10);
    }
}

TEST_CASE_TEMPLATE("sparse joining: submaps that share a bias are equal to a single map", Pose, SE3, SE2) {
  for (const ErrorKind error : {ErrorKind::invariant, ErrorKind::standard})
    for (const double walk : {0.0, 0.01}) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(walk);
      compare<Pose>(error, JoinKind::sparse, walk, 1e-8);
    }
}

TEST_CASE("shared errors: the posterior without its prior") {
  Random random(3);
  constexpr Eigen::Index g = 3;
  Eigen::MatrixXd half(g, g), prior, information;
  for (Eigen::Index c = 0; c < g; ++c)
    for (Eigen::Index r = 0; r < g; ++r) half(r, c) = random.normal();
  prior = half * half.transpose();
  // Two rows of unit noise on three errors: one direction stays unknown.
  Eigen::MatrixXd rows(2, g);
  for (Eigen::Index c = 0; c < g; ++c)
    for (Eigen::Index r = 0; r < 2; ++r) rows(r, c) = 3.0 * random.normal();
  const Eigen::Vector2d values(0.7, -1.2);
  SubmapErrors errors;
  errors.prior = Eigen::Vector3d(0.1, 0.2, -0.3);
  errors.prior_covariance = prior;
  information = prior.inverse() + rows.transpose() * rows;
  errors.covariance = information.inverse();
  errors.value = errors.prior + errors.covariance * rows.transpose() * (values - rows * errors.prior);
  const ErrorRows found = found_out(errors);
  REQUIRE(found.rows.rows() == 2);
  CHECK(relative_difference(found.rows.transpose() * found.rows, rows.transpose() * rows) < 1e-10);
  CHECK((found.rows.transpose() * found.values - rows.transpose() * values).norm() < 1e-9);
  // A submap that found out nothing.
  errors.covariance = prior;
  errors.value = errors.prior;
  CHECK(found_out(errors).rows.rows() == 0);
}
