// SPDX-License-Identifier: BSD-3-Clause
// The filter against the reference on random drives: every estimate and the full joint covariance after every call.
#include <cmath>

#include "reference_scenario.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

// Both do some thousand operations on numbers of very different size. The reference's numerical differences are
// accurate to 1e-13. The remaining error is rounding. It grows with the factor by which an update reduces a covariance.
constexpr double kTolerance = 1e-9;
constexpr ErrorKind kBoth[] = {ErrorKind::invariant, ErrorKind::standard};

void check(Pair& pair) {
  const Difference d = pair.difference();
  CHECK(d.state < kTolerance);
  CHECK(d.covariance < kTolerance);
}

// Motion, frames of one sensor, and now and then a removal.
void drive_with(const Sensor<SE3>& sensor, ErrorKind error, unsigned seed, double noise_scale = 1) {
  CAPTURE(seed);
  CAPTURE(static_cast<int>(error));
  Random random(seed);
  const FilterOptions<SE3> options = random_options(error, random);
  Pair pair(options);
  Drive drive(seed + 1000, options);
  const int number = pair.add(sensor);
  for (int step = 0; step < 8; ++step) {
    CAPTURE(step);
    drive.move(pair);
    check(pair);
    const Matrix2 mount = sensor.mount_noise();
    const Vector2 angles = mount.diagonal().cwiseSqrt().cwiseProduct(drive.random().normal_vector<2>());
    CHECK(pair.update(number, drive.look(sensor, 6, noise_scale, angles)));
    check(pair);
    if (step % 3 == 2 && pair.filter().landmarks().size() > 2) {
      if (step == 5) drive.move(pair);  // a removal before the motion's noise was applied
      pair.remove(pair.reference().ids()[static_cast<std::size_t>(step) % pair.reference().ids().size()]);
      check(pair);
    }
  }
  CHECK(pair.filter().landmarks().size() > 3);
}

}  // namespace

TEST_CASE("ekf: a stereo head whose encoders err in each observation") {
  for (ErrorKind error : kBoth)
    for (unsigned seed : {1, 2, 3}) drive_with(scenario_head(0.01, false), error, seed);
}

TEST_CASE("ekf: a stereo head whose encoders err once a frame") {
  for (ErrorKind error : kBoth)
    for (unsigned seed : {11, 12, 13}) drive_with(scenario_head(0.03, true), error, seed);
}

TEST_CASE("ekf: a stereo head with perfect encoders, so noisy that updates iterate") {
  for (ErrorKind error : kBoth)
    for (unsigned seed : {21, 22}) drive_with(scenario_head(0, false), error, seed, 3);
}

TEST_CASE("ekf: a stereo camera") {
  for (ErrorKind error : kBoth)
    for (unsigned seed : {31, 32}) drive_with(scenario_camera(), error, seed);
}

TEST_CASE("ekf: points in the sensor's frame") {
  for (ErrorKind error : kBoth)
    for (unsigned seed : {41, 42}) drive_with(scenario_points(), error, seed);
}

TEST_CASE("ekf: a custom sensor that depends on more than the body point") {
  for (ErrorKind error : kBoth)
    for (unsigned seed : {51, 52}) drive_with(scenario_compass(), error, seed);
}

TEST_CASE("ekf: all sensors, absolute measurements and linear updates in turn") {
  const StereoHead per_frame = scenario_head(0.02, true), per_observation = scenario_head(0.01, false);
  const StereoCamera camera = scenario_camera();
  const Cartesian<SE3> points = scenario_points();
  const CustomSensor<SE3> compass = scenario_compass();
  const Sensor<SE3>* sensors[] = {&per_frame, &camera, &points, &per_observation, &compass};
  for (ErrorKind error : kBoth) {
    CAPTURE(static_cast<int>(error));
    Random random(7);
    FilterOptions<SE3> options = random_options(error, random);
    options.initial_pose = SE3(SO3::exp(Vector3(0.1, 0.2, 2)), Vector3(30, -10, 5));  // nearly level
    Pair pair(options);
    Drive drive(70, options);
    for (const Sensor<SE3>* sensor : sensors) pair.add(*sensor);
    for (int step = 0; step < 15; ++step) {
      CAPTURE(step);
      drive.move(pair);
      CHECK(pair.update(step % 5, drive.look(*sensors[step % 5], 5)));
      check(pair);
      drive.move(pair);
      const SE3& truth = drive.truth();
      Vector3 arm(0.5, -0.3, 1.5);
      Matrix3 covariance = Vector3(0.3, 0.2, 0.5).cwiseAbs2().asDiagonal();
      covariance(0, 1) = covariance(1, 0) = 0.02;
      switch (step % 4) {
        case 0: {
          const Vector3 z = truth * arm + 0.3 * random.normal_vector<3>();
          pair.filter().update_position(z, covariance, arm);
          pair.reference().update_position(z, covariance, arm);
          break;
        }
        case 1: {
          const SO3 z = SO3::exp(0.05 * random.normal_vector<3>()) * truth.rotation();
          pair.filter().update_attitude(z, 0.01 * covariance);
          pair.reference().update_attitude(z, 0.01 * covariance);
          break;
        }
        case 2: {
          const Vector3 forward = truth.rotation() * Vector3::UnitX();
          const double z = std::atan2(forward.y(), forward.x()) + 0.05 * random.normal();
          pair.filter().update_heading(z, 0.03);
          pair.reference().update_heading(z, 0.03);
          break;
        }
        default: {  // two landmarks' difference and a mixture of pose and landmark, four rows with a common noise
          const std::vector<std::uint64_t>& ids = pair.reference().ids();
          REQUIRE(ids.size() > 3);
          const std::vector<std::uint64_t> chosen = {ids[3], ids[1]};
          Dynamic J_pose = Dynamic::Zero(4, 6), J_landmarks = Dynamic::Zero(4, 6);
          for (int i = 0; i < 4; ++i) {
            J_pose.row(i) = random.normal_vector<6>();
            J_landmarks.row(i) = random.normal_vector<6>();
          }
          const Dynamic noise = 0.04 * Dynamic::Identity(4, 4) + Dynamic::Constant(4, 4, 0.01);
          const DynamicVector residual = 0.2 * random.normal_vector<4>();
          using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
          const RowMajor pose_rows = J_pose, landmark_rows = J_landmarks;
          pair.filter().update_linear(
              {residual.data(), 4, noise.data(), pose_rows.data(), chosen.data(), 2, landmark_rows.data()});
          pair.reference().update_linear(residual, noise, J_pose, chosen, J_landmarks);
        }
      }
      CHECK(pair.filter().report().matched == 1);
      check(pair);
    }
  }
}

TEST_CASE("ekf: a start that is exactly known") {
  for (ErrorKind error : kBoth) {
    Random random(8);
    FilterOptions<SE3> options = random_options(error, random);
    options.initial_covariance.setZero();
    Pair pair(options);
    Drive drive(80, options);
    const Cartesian<SE3> points = scenario_points();
    pair.add(points);
    CHECK(pair.update(0, drive.look(points, 4)));
    CHECK(pair.update(0, drive.look(points, 8)));
    check(pair);
    drive.move(pair);
    CHECK(pair.update(0, drive.look(points, 8)));
    check(pair);
  }
}

TEST_CASE("ekf: frames of many rows in a larger map") {
  for (ErrorKind error : kBoth) {
    CAPTURE(static_cast<int>(error));
    Random random(15);
    FilterOptions<SE3> options = random_options(error, random);
    options.max_landmarks = options.max_observations = 45;
    const StereoHead head = scenario_head(0.02, true);
    Pair pair(options);
    Drive drive(15, options, 45);
    pair.add(head);
    for (int step = 0; step < 4; ++step) {
      drive.move(pair);
      CHECK(pair.update(0, drive.look(head, 15 + 5 * static_cast<std::size_t>(step))));
      check(pair);
    }
    CHECK(pair.filter().report().rows > 48);  // more than one panel of the innovation's factor
  }
}

TEST_CASE("ekf: gates refuse what trying everything refuses") {
  int refused = 0, taken = 0;
  for (ErrorKind error : kBoth)
    for (unsigned seed = 90; seed < 102; ++seed) {
      CAPTURE(seed);
      Random random(seed);
      FilterOptions<SE3> options = random_options(error, random);
      options.gate_probability = seed % 2 == 0 ? 1 : 0.99;
      options.batch_gate_probability = 0.9;
      const StereoHead head = scenario_head(0.02, seed % 3 == 0);
      Pair pair(options);
      Drive drive(seed, options);
      pair.add(head);
      for (int step = 0; step < 6; ++step) {
        drive.move(pair);
        std::vector<Seen> frame = drive.look(head, 8);
        for (std::size_t i = 0; step > 1 && i < frame.size(); i += 3) frame[i].z += 0.1 * random.normal_vector<3>();
        const bool same = pair.update(0, frame);
        const UpdateReport& report = pair.filter().report();
        if (report.placed_again > 0 || report.deferred > 0) break;  // the reference places no landmark again
        CHECK(same);
        check(pair);
        refused += static_cast<int>(report.rejected);
        taken += static_cast<int>(report.matched);
      }
    }
  CHECK(refused > 20);
  CHECK(taken > 100);
}
