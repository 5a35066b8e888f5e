// SPDX-License-Identifier: BSD-3-Clause
// Absolute fixes beside submaps. On linear-Gaussian problems (known attitude, points observed directly, fixes of the
// position, perhaps a bias of the velocity) a filter with submaps must equal a filter with a single map, except for
// rounding, at every step.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "map/join/ring.hpp"

namespace {

using namespace cairn;
using namespace cairn::test;

struct Case {
  ErrorKind error;
  JoinKind join;
  double bias = 0.0;  // standard deviation at the start; 0: none
  double walk = 0.0;
};

template <class Pose>
struct Vehicle : RingVehicle<Pose> {
  Vehicle(const Case& of, Index submap_landmarks) : RingVehicle<Pose>(options(of, submap_landmarks)) {
    TwistNoise noise;
    noise.velocity_sigma.setConstant(0.05);
    noise.rate_sigma.setZero();
    this->filter.set_twist_noise(noise);
  }
  static FilterOptions<Pose> options(const Case& of, Index submap_landmarks) {
    FilterOptions<Pose> options = ring_options<Pose>(of.error, submap_landmarks, of.join);
    options.systematic.motion_sigma[0] = of.bias;
    options.systematic.motion_sigma[1] = of.bias;
    options.systematic.motion_walk[1] = of.walk;
    return options;
  }
};

template <class Pose>
void check_pose(const Filter<Pose>& single, const Filter<Pose>& submaps, double tolerance) {
  CHECK((single.pose().translation() - submaps.pose().translation()).norm() <= tolerance * 20);
  CHECK(relative_difference(submaps.pose_covariance(), single.pose_covariance()) <= tolerance);
}

template <class Pose>
void check_map(const Filter<Pose>& single, const Filter<Pose>& submaps, double tolerance) {
  const Landmarks &a = single.landmarks(), &b = submaps.landmarks();
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
  single.pose_joint_covariance(in_a.data(), in_a.size(), P.data());
  submaps.pose_joint_covariance(in_b.data(), in_b.size(), Q.data());
  CHECK(relative_difference(Q, P) <= tolerance);
}

// Two rounds on the ring, and a fix of the position after every third frame.
template <class Pose>
void compare(const Case& of, double tolerance) {
  using Space = Embedding<Pose>;
  using Point = typename Pose::Point;
  Random random(7);
  Vehicle<Pose> single(of, 0), submaps(of, 9);
  const std::vector<Point> landmarks = ring_landmarks<Pose>();
  const Pose start = single.filter.pose();
  Pose truth;
  Vector6 twist;
  twist << 1.0, 0, 0.01, 0.01, 0.005, 0.105;
  Vector3 bias = of.bias * Vector3(0.3, -0.8, 0);
  bool seen_again = false;  // the open submap holds a landmark that the map knows
  std::size_t by_fix = 0;
  for (int k = 0; k < kRingSteps; ++k) {
    truth = truth * Pose::exp(Space::down(twist));
    const Vector3 measured = twist.head<3>() + bias + 0.05 * random.normal_vector<3>();
    bias.y() += of.walk * random.normal();
    const std::vector<Observation> seen = see_ring(truth, landmarks, random);
    const Point fix = (start * truth).translation() + 0.3 * random.template normal_vector<Pose::kDim>();
    for (Vehicle<Pose>* vehicle : {&single, &submaps}) {
      vehicle->filter.predict_twist(1.0, measured, Vector3(twist.tail<3>()));
      vehicle->filter.update(0, seen.data(), static_cast<Index>(seen.size()));
      if (k % 3 == 2)
        vehicle->filter.update_position(fix, 0.09 * Eigen::Matrix<double, Pose::kDim, Pose::kDim>::Identity(),
                                        Point::Zero());
      if (vehicle == &submaps && k % 3 == 2)
        by_fix = std::max<std::size_t>(
            by_fix, vehicle->filter.closing().reason == ClosedBy::fix ? vehicle->filter.closing().submaps : by_fix);
    }
    const Landmarks& open = submaps.filter.local_landmarks();
    std::size_t index = 0;
    for (std::size_t i = 0; i < open.size(); ++i)
      seen_again = seen_again || submaps.filter.landmarks().find(open.id(i), index);
    // Beside systematic errors, landmarks that the map knows wait for the closing.
    if (of.bias == 0.0 || !seen_again || open.size() == 0) check_pose(single.filter, submaps.filter, tolerance);
    if (open.size() == 0) seen_again = false;
  }
  CHECK(by_fix == 1);  // only the first fix has closed a submap
  CHECK(submaps.filter.closing().submaps >= 5);
  if (submaps.filter.local_landmarks().size() > 0) submaps.filter.close_submap();
  CHECK(!submaps.filter.closing().failed);
  check_pose(single.filter, submaps.filter, tolerance);
  check_map(single.filter, submaps.filter, tolerance);
}

}  // namespace

TEST_CASE_TEMPLATE("fixes: submaps are equal to a single map on a linear-Gaussian problem", Pose, SE3, SE2) {
  for (const ErrorKind error : {ErrorKind::invariant, ErrorKind::standard})
    for (const JoinKind join : {JoinKind::dense, JoinKind::sparse}) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(static_cast<int>(join));
      compare<Pose>({error, join}, 1e-7);
    }
}

TEST_CASE_TEMPLATE("fixes: the same where submaps share a bias", Pose, SE3, SE2) {
  for (const ErrorKind error : {ErrorKind::invariant, ErrorKind::standard})
    for (const JoinKind join : {JoinKind::dense, JoinKind::sparse})
      for (const double walk : {0.0, 0.01}) {
        CAPTURE(static_cast<int>(error));
        CAPTURE(static_cast<int>(join));
        CAPTURE(walk);
        compare<Pose>({error, join, 0.3, walk}, 1e-7);
      }
}

namespace {

// A straight drive past landmarks, with noise in all six directions, a frame and a fix of 1 m every 0.1 m.
struct Street {
  explicit Street(unsigned seed) : random(seed) {
    for (int i = 0; i < 60; ++i) {
      // One draw a statement: the order of arguments is the compiler's.
      Vector3 landmark;
      landmark.x() = random.uniform(-5, 45);
      landmark.y() = random.uniform(-10, 10);
      landmark.z() = random.uniform(-1, 1);
      landmarks.push_back(landmark);
    }
  }
  static FilterOptions<SE3> options(Index submap_landmarks, JoinKind join) {
    FilterOptions<SE3> options;
    options.max_landmarks = 100;
    options.max_observations = 60;
    options.submap_landmarks = submap_landmarks;
    options.join = join;
    options.initial_covariance = 1e-4 * Matrix6::Identity();
    return options;
  }
  // The next step: motion, frame, fix.
  void move() {
    truth = SE3(SO3(), truth.translation() + Vector3(0.1, 0, 0));
    v = Vector3(1, 0, 0) + 0.1 * random.normal_vector<3>();
    w = 0.002 * random.normal_vector<3>();
    seen.clear();
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Vector3 y = truth.inverse() * landmarks[i] + 0.1 * random.normal_vector<3>();
      if (std::abs(y.x()) < 8.0) seen.push_back({i, {y.x(), y.y(), y.z()}, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}});
    }
    fix = truth.translation() + random.normal_vector<3>();
  }
  void drive(Filter<SE3>& filter) const {
    filter.predict_twist(0.1, v, w);
    filter.update(0, seen.data(), static_cast<Index>(seen.size()));
  }

  Random random;
  std::vector<Vector3> landmarks;
  SE3 truth;
  Vector3 v, w, fix;
  std::vector<Observation> seen;
};

struct StreetVehicle : RingVehicle<SE3> {
  StreetVehicle(Index submap_landmarks, JoinKind join) : RingVehicle<SE3>(Street::options(submap_landmarks, join)) {
    TwistNoise noise;
    noise.velocity_sigma.setConstant(0.1);
    noise.rate_sigma.setConstant(0.002);
    filter.set_twist_noise(noise);
  }
};

}  // namespace

TEST_CASE("fixes: a fix in every frame costs no submap, and the pose is as good as with a single map") {
  double of_single = 0.0, of_submaps[2] = {0.0, 0.0};
  for (unsigned seed = 1; seed <= 3; ++seed) {
    Street street(seed);
    StreetVehicle single(0, JoinKind::dense), dense(30, JoinKind::dense), sparse(30, JoinKind::sparse),
        without_fixes(30, JoinKind::dense);
    for (int k = 0; k < 350; ++k) {
      street.move();
      for (StreetVehicle* vehicle : {&single, &dense, &sparse}) {
        street.drive(vehicle->filter);
        vehicle->filter.update_position(street.fix, Matrix3::Identity(), Vector3::Zero());
      }
      street.drive(without_fixes.filter);
      const auto error = [&](const StreetVehicle& vehicle) {
        return (vehicle.filter.pose().translation() - street.truth.translation()).squaredNorm();
      };
      of_single += error(single);
      of_submaps[0] += error(dense), of_submaps[1] += error(sparse);
    }
    for (const StreetVehicle* vehicle : {&dense, &sparse}) {
      CHECK(vehicle->filter.closing().submaps >= 3);
      CHECK(vehicle->filter.closing().submaps <= without_fixes.filter.closing().submaps + 1);
      CHECK(vehicle->filter.closing().reason == ClosedBy::landmarks);
    }
  }
  for (const double submaps : of_submaps) CHECK(std::sqrt(submaps / of_single) <= 1.02);
}

TEST_CASE("fixes: landmarks that agree between two wrong fixes keep the vehicle where it is") {
  for (const JoinKind join : {JoinKind::dense, JoinKind::sparse}) {
    Street street(5);
    StreetVehicle vehicle(30, join);
    const auto fix = [&](const Vector3& at, double sigma) {
      vehicle.filter.update_position(at, sigma * sigma * Matrix3::Identity(), Vector3::Zero());
    };
    for (int k = 0; k < 100; ++k) {
      street.move();
      street.drive(vehicle.filter);
      fix(street.fix, 1.0);
    }
    const std::size_t submaps = vehicle.filter.closing().submaps;
    for (int k = 0; k < 5; ++k) {
      street.move();
      street.drive(vehicle.filter);
      const SE3 before = vehicle.filter.pose();
      const Matrix6 covariance = vehicle.filter.pose_covariance();
      fix(street.truth.translation() + Vector3(0, 8, 0), 0.1);
      CHECK(vehicle.filter.pose().translation() == before.translation());  // refused, and nothing has changed
      CHECK(vehicle.filter.pose_covariance() == covariance);
    }
    CHECK(vehicle.filter.closing().submaps <= submaps + 1);
    CHECK((vehicle.filter.pose().translation() - street.truth.translation()).norm() < 1.0);
  }
}
