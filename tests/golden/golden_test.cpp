// SPDX-License-Identifier: BSD-3-Clause
// Compares the library with values that make_golden.py computed by other methods (golden_values.hpp).
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <cairn/cairn.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/chi_square.hpp"
#include "geometry/se3.hpp"
#include "golden_values.hpp"

namespace {

constexpr double kTolerance = 1e-9;

void near(double actual, double expected, double scale = 1) {
  CHECK(std::abs(actual - expected) <= kTolerance * std::max(scale, std::abs(expected)));
}

void ok(cairn_status status) {
  REQUIRE_MESSAGE(status == CAIRN_OK, std::string(cairn_last_message()));
}

// A rotation matrix by rows, and its quaternion.
void quaternion_of(const double* rows, double quaternion[4]) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const cairn::SO3 R = cairn::SO3::from_matrix(Eigen::Map<const RowMajor>(rows));
  const Eigen::Quaterniond& q = R.quaternion();
  quaternion[0] = q.w(), quaternion[1] = q.x(), quaternion[2] = q.y(), quaternion[3] = q.z();
}

struct Expected {
  int32_t error;
  const double *states, *covariance, *nis;
};

constexpr int kSteps = 3, kLandmarks = 3, kStateValues = 21, kJoint = 6 + 3 * kLandmarks;

cairn_filter* start_filter(int32_t error, int32_t* sensor) {
  cairn_filter_options options;
  ok(cairn_filter_options_init(&options, sizeof options, nullptr));
  options.state_error = error;
  options.gate_probability = options.batch_gate_probability = 1;
  options.iterations = 3;
  options.iteration_tolerance = 1e-12;  // always all three
  std::copy_n(golden::kStart, 3, options.initial_pose.position);
  quaternion_of(golden::kStart + 3, options.initial_pose.quaternion);
  std::copy_n(golden::kCovariance, 36, options.initial_covariance);
  cairn_filter* filter = nullptr;
  ok(cairn_filter_create(&options, &filter, nullptr));
  // The same values as in the script.
  cairn_twist_noise noise;
  ok(cairn_twist_noise_init(&noise, sizeof noise, nullptr));
  const double sigma[6] = {0.05, 0.04, 0.03, 0.01, 0.012, 0.014};
  std::copy_n(sigma, 3, noise.velocity_sigma);
  std::copy_n(sigma + 3, 3, noise.rate_sigma);
  ok(cairn_filter_set_twist_noise(filter, &noise, nullptr));
  cairn_stereo_head head;
  ok(cairn_stereo_head_init(&head, sizeof head, nullptr));
  const double platform[3] = {0.3, -0.1, 1.2}, stick[3] = {0.15, 0.05, 0.2};
  std::copy_n(platform, 3, head.platform);
  std::copy_n(stick, 3, head.stick);
  head.range_sigma = 0.5;
  head.azimuth_sigma = 0.03;
  head.elevation_sigma = 0.02;
  head.pan_sigma = 0.02;
  head.stick_sigma = 0.015;
  head.encoder_mode = CAIRN_ENCODER_PER_FRAME;
  ok(cairn_filter_add_stereo_head(filter, &head, sensor, nullptr));
  ok(cairn_filter_point_head(filter, *sensor, 0.3, -0.2, nullptr));
  return filter;
}

void check_state(const cairn_filter* filter, const double* expected, int landmarks) {
  cairn_pose pose;
  ok(cairn_filter_pose(filter, &pose, nullptr, nullptr));
  double quaternion[4];
  quaternion_of(expected, quaternion);
  const double sign = quaternion[0] * pose.quaternion[0] < 0 ? -1 : 1;
  for (int i = 0; i < 4; ++i) near(sign * pose.quaternion[i], quaternion[i]);
  for (int i = 0; i < 3; ++i) near(pose.position[i], expected[9 + i]);
  for (int l = 0; l < landmarks; ++l) {
    cairn_landmark landmark;
    ok(cairn_map_landmark(cairn_filter_map(filter), static_cast<uint64_t>(l), &landmark, nullptr));
    for (int i = 0; i < 3; ++i) near(landmark.position[i], expected[12 + 3 * l + i]);
  }
}

void run_filter(const Expected& expected) {
  int32_t sensor = -1;
  cairn_filter* filter = start_filter(expected.error, &sensor);
  for (int k = 0; k < kSteps; ++k) {
    CAPTURE(k);
    const double* twist = golden::kTwists + 7 * k;
    ok(cairn_filter_predict_twist(filter, twist[6], twist, twist + 3, nullptr));
    const int count = k == 0 ? 2 : kLandmarks;
    cairn_observation frame[kLandmarks] = {};
    for (int i = 0; i < count; ++i) {
      frame[i].id = static_cast<uint64_t>(i);
      std::copy_n(golden::kFrames + 9 * k + 3 * i, 3, frame[i].z);
    }
    ok(cairn_filter_update(filter, sensor, frame, static_cast<size_t>(count), nullptr, nullptr));
    cairn_update_report report = {};
    report.struct_size = sizeof report;
    ok(cairn_filter_last_update(filter, &report, nullptr));
    near(report.nis, expected.nis[k]);
    CHECK(report.iterations == (k == 0 ? 0u : 3u));
    check_state(filter, expected.states + kStateValues * k, count);
  }
  const uint64_t ids[kLandmarks] = {0, 1, 2};
  double joint[kJoint * kJoint];
  size_t needed = 0;
  ok(cairn_filter_joint_covariance(filter, ids, kLandmarks, joint, kJoint * kJoint, &needed, nullptr));
  for (int r = 0; r < kJoint; ++r)
    for (int c = 0; c < kJoint; ++c) {
      const double* P = expected.covariance;
      const double off = std::abs(joint[r * kJoint + c] - P[r * kJoint + c]);
      CHECK(off <= kTolerance * std::sqrt(P[r * kJoint + r] * P[c * kJoint + c]));
    }
  cairn_filter_destroy(filter);
}

}  // namespace

TEST_CASE("golden: exponential and logarithm of poses") {
  for (const double* row = golden::kPoses; row < std::end(golden::kPoses); row += 18) {
    const cairn::Vector6 tau = Eigen::Map<const cairn::Vector6>(row);
    CAPTURE(tau);
    const cairn::SE3 T = cairn::SE3::exp(tau);
    const cairn::Matrix3 R = T.rotation().matrix();
    for (int i = 0; i < 9; ++i) near(R(i / 3, i % 3), row[6 + i]);
    for (int i = 0; i < 3; ++i) near(T.translation()[i], row[15 + i]);
    double quaternion[4];
    quaternion_of(row + 6, quaternion);
    const cairn::SE3 given(cairn::SO3::from_quaternion(quaternion[0], quaternion[1], quaternion[2], quaternion[3]),
                           Eigen::Map<const cairn::Vector3>(row + 15));
    const cairn::Vector6 log = given.log();
    for (int i = 0; i < 6; ++i) near(log[i], tau[i], tau.norm());
  }
}

TEST_CASE("golden: chi-square quantiles") {
  for (const double* row = golden::kQuantiles; row < std::end(golden::kQuantiles); row += 3)
    CHECK(cairn::chi_square_quantile(row[0], row[1]) == doctest::Approx(row[2]).epsilon(1e-12));
}

TEST_CASE("golden: three steps of the invariant filter") {
  run_filter(
      {CAIRN_STATE_ERROR_INVARIANT, golden::kInvariantStates, golden::kInvariantCovariance, golden::kInvariantNis});
}

TEST_CASE("golden: three steps of the standard filter") {
  run_filter({CAIRN_STATE_ERROR_STANDARD, golden::kStandardStates, golden::kStandardCovariance, golden::kStandardNis});
}
