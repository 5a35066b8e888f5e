// SPDX-License-Identifier: BSD-3-Clause
// The verdict and its tests: what each of them finds, and that honest noise gives no alarm.
#include "health/verdict.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "health/contradiction.hpp"
#include "health/drift_test.hpp"
#include "health/motion_noise_test.hpp"
#include "health/persistence.hpp"
#include "health/sensor_noise_test.hpp"
#include "health/sighting_memory.hpp"

using namespace cairn;

namespace {

constexpr double kGate = 0.99;

struct Source {
  std::mt19937_64 engine{5};
  double normal() { return std::normal_distribution<double>()(engine); }
  double chi_square(int dof) { return std::chi_squared_distribution<double>(dof)(engine); }
  UpdateEvidence honest() {
    UpdateEvidence evidence;
    evidence.compared = 12;
    for (int i = 0; i < 12; ++i) evidence.refused += std::uniform_real_distribution<double>()(engine) > kGate;
    evidence.rows = 36;
    evidence.nis = chi_square(36);
    evidence.jump = chi_square(6);
    evidence.jump_dof = 6;
    return evidence;
  }
};

}  // namespace

TEST_CASE("verdict: honest updates are good") {
  Verdict verdict(kGate);
  Source source;
  for (int i = 0; i < 20000; ++i) verdict.add(source.honest());
  CHECK(verdict.share(Trust::good) > 0.998);
  CHECK(verdict.share(Trust::lost) == 0.0);
}

TEST_CASE("verdict: each reason is named") {
  const auto after = [](auto&& spoil, int updates) {
    Verdict verdict(kGate);
    Source source;
    for (int i = 0; i < 50; ++i) verdict.add(source.honest());
    REQUIRE(verdict.trust() == Trust::good);
    for (int i = 0; i < updates; ++i) {
      UpdateEvidence evidence = source.honest();
      spoil(evidence, verdict);
      verdict.add(evidence);
    }
    CHECK(verdict.trust() == Trust::doubtful);
    return verdict.reasons();
  };
  CHECK(after([](UpdateEvidence& e, Verdict&) { e.nis *= 2; }, 20) == kDoubtNis);
  CHECK(after([](UpdateEvidence& e, Verdict&) { e.refused = 3; }, 10) == kDoubtRefusals);
  CHECK(after([](UpdateEvidence&, Verdict& v) { v.widened(0.5); }, 1) == kDoubtWidened);
  CHECK(after([](UpdateEvidence& e, Verdict&) { e.sensor_noise = true; }, 1) == kDoubtSensorNoise);
  CHECK(after([](UpdateEvidence& e, Verdict&) { e.motion_noise = true; }, 1) == kDoubtMotionNoise);
  CHECK(after([](UpdateEvidence& e, Verdict&) { e.drift = 6.0; }, 1) == kDoubtBias);
  CHECK(after([](UpdateEvidence& e, Verdict&) { e.jump = 100.0; }, 1) == kDoubtJump);
  CHECK(after([](UpdateEvidence& e, Verdict&) { e.contradicting = 1; }, 1) == kDoubtLandmarks);
  CHECK(after([](UpdateEvidence&, Verdict& v) { v.closing(5, 20, 20.0, 2); }, 1) == kDoubtClosing);
  CHECK(after([](UpdateEvidence&, Verdict& v) { v.closing(1, 20, 50.0, 2); }, 1) == kDoubtLandmarks);
  CHECK(after([](UpdateEvidence&, Verdict& v) { v.closing(5, 20, 50.0, 3); }, 1) == (kDoubtClosing | kDoubtLandmarks));
  CHECK(after([](UpdateEvidence& e, Verdict&) { e.blind = 1; }, 1) == kDoubtBlind);
  CHECK(after([](UpdateEvidence& e, Verdict&) { e.pivot = -0.1; }, 1) == kDoubtDefinite);
}

TEST_CASE("verdict: a landmark that a closing refuses by chance is no reason") {
  Verdict verdict(kGate);
  Source source;
  verdict.closing(1, 20, 30.0, 2);  // beyond the gate, and not impossible for an honest one
  verdict.closing(2, 20, 30.0, 3);
  verdict.closing(0, 20, 0.0, 3);
  verdict.add(source.honest());
  CHECK(verdict.reasons() == 0);
}

TEST_CASE("verdict: lost while most of what is seen is refused, and good again later") {
  Verdict verdict(kGate);
  Source source;
  for (int i = 0; i < 50; ++i) verdict.add(source.honest());
  for (int i = 0; i < 10; ++i) {
    UpdateEvidence evidence = source.honest();
    evidence.refused = 11;
    verdict.add(evidence);
  }
  CHECK(verdict.trust() == Trust::lost);
  CHECK((verdict.reasons() & kDoubtRefusals) != 0);
  for (int i = 0; i < 40; ++i) verdict.add(source.honest());
  CHECK(verdict.trust() == Trust::good);
}

TEST_CASE("contradiction: a moved landmark is found at its second sighting, an honest one hardly ever") {
  Contradiction moved;
  moved.add(200.0, 2);
  CHECK_FALSE(moved.found());
  moved.add(std::nan(""), 2);
  CHECK(moved.found());
  for (int i = 0; i < 8; ++i) moved.add(1.0, 2);
  CHECK_FALSE(moved.found());
  Source source;
  for (const int rows : {2, 3}) {
    int found = 0;
    Contradiction honest;
    for (int i = 0; i < 1000000; ++i) {
      honest.add(source.chi_square(rows), rows);
      found += honest.found();
    }
    CHECK(found < 40);
  }
}

TEST_CASE("drift: a mean of the corrections is found, and white ones give no alarm") {
  using Square = SE2::Square;
  const SE2 pose(SO2::from_angle(0.7), Vector2(3, -2));
  Source source;
  int alarms = 0;
  double most = 0.0;
  for (const double bias : {0.0, 0.5}) {
    DriftTest<SE2> drift;
    for (int i = 0; i < 5000; ++i) {
      SE2::Tangent step(bias + source.normal(), source.normal(), 0.01 * source.normal());
      step.head<2>() = pose.rotation() * Vector2(step.head<2>());
      Square learned = Square::Identity();
      learned(2, 2) = 1e-4;
      drift.add(Correction<SE2>(pose, 2.0 * learned, retract(pose, step), learned));
      if (bias == 0.0) alarms += drift.sigmas() > 5.0;
      if (bias > 0.0 && i > 100) most = std::max(most, drift.sigmas());
    }
  }
  CHECK(alarms == 0);
  CHECK(most > 5.0);
}

// A frame that says nothing new about the pose takes off nothing but rounding, and moves it by rounding.
TEST_CASE("drift: rounding is no bias") {
  const SE2 pose(SO2::from_angle(0.7), Vector2(3, -2));
  DriftTest<SE2> drift;
  const SE2::Square P = 0.01 * SE2::Square::Identity();
  for (int i = 0; i < 20; ++i)
    drift.add(Correction<SE2>(pose, P, retract(pose, SE2::Tangent(1e-12, 1e-12, 1e-12)), (1.0 - 1e-15) * P));
  CHECK(drift.sigmas() < 1e-3);
}

namespace {

// A filter of a vehicle that stands still and measures its pose directly: the noise of motion and sensor has the stated
// standard deviations times `motion` and `sensor`, and the covariances are those for the stated ones.
struct Tracker {
  using Square = SE2::Square;
  using Tangent = SE2::Tangent;

  double motion = 1.0, sensor = 1.0;
  Source source;
  SE2 pose = SE2(SO2::from_angle(0.7), Vector2(3, -2));
  Tangent error = Tangent::Zero();  // of the pose
  Tangent unit = Tangent(0.1, 0.2, 0.01);
  Square P = Square::Zero();
  MotionNoiseTest<SE2> test;

  void update(double slip = 0.0) {
    constexpr double kShare = 0.15;  // of the sensor's variance that the motion's has
    Tangent innovation;
    for (int i = 0; i < 3; ++i) {
      error(i) += unit(i) * (motion * std::sqrt(kShare) * source.normal() + slip);
      innovation(i) = unit(i) * sensor * source.normal() - error(i);
    }
    const Square R = unit.cwiseAbs2().asDiagonal();
    const Square before = P + kShare * R;
    const Square S = before + R, K = before * S.inverse();
    const Tangent step = K * innovation;
    error += step;
    P = before - K * S * K.transpose();
    constexpr Index kRows = 30;
    double nis = innovation.dot(S.inverse() * innovation);
    nis += sensor * sensor * source.chi_square(kRows - 3);
    test.add(Correction<SE2>(pose, before, retract(pose, step), P), nis, kRows, 1.0);
  }
  int alarms(int updates) {
    int count = 0;
    for (int i = 0; i < updates; ++i) {
      update();
      count += test.found() ? 1 : 0;
    }
    return count;
  }
};

}  // namespace

TEST_CASE("motion noise: three times the stated noise is found, honest noise gives no alarm") {
  Tracker honest;
  CHECK(honest.alarms(200000) < 200);
  int early = 0;
  for (int run = 0; run < 20; ++run) {
    Tracker noisy;
    noisy.source.engine.seed(static_cast<std::uint64_t>(run));
    early += noisy.alarms(50) > 0 ? 1 : 0;
    noisy.motion = 3.0;
    CHECK(noisy.alarms(50) > 0);
  }
  CHECK(early <= 1);
}

TEST_CASE("motion noise: neither the sensor's noise nor a single update counts as noise of the motion") {
  Tracker tracker;
  tracker.sensor = 3.0;
  CHECK(tracker.alarms(20000) < 40);
  Tracker slip;
  slip.alarms(50);
  slip.update(50.0);
  CHECK_FALSE(slip.test.found());
}

TEST_CASE("motion noise: an update that corrects nothing, and what is not finite, change nothing") {
  using Square = SE2::Square;
  MotionNoiseTest<SE2> test;
  const SE2 pose;
  for (int i = 0; i < 100; ++i) {
    test.add(Correction<SE2>(pose, Square::Identity(), pose, Square::Identity()), 0.0, 0, 1.0);
    test.add(Correction<SE2>(pose, Square::Identity(), SE2(SO2(), Vector2(NAN, 0)), Square::Zero()), NAN, 3, 1.0);
    test.add(Correction<SE2>(pose, NAN * Square::Identity(), pose, Square::Zero()), 1.0, 3, 1.0);
  }
  CHECK_FALSE(test.found());
}

TEST_CASE("correction: independent numbers of unit variance, zero where nothing was corrected") {
  using Square = SE2::Square;
  Square D;
  D << 0.04, 0.01, 0.001, 0.01, 0.09, -0.002, 0.001, -0.002, 0.0004;
  SE2::Tangent step(0.1, -0.3, 0.02), white;
  Correction<SE2> correction(SE2(), 2.0 * D, retract(SE2(), step), D);
  REQUIRE(correction.whiten(white));
  CHECK(white.squaredNorm() ==
        doctest::Approx(step.dot(D.inverse() * step)).epsilon(0.02));  // the variances are 1 % larger
  D.row(1).setZero();
  D.col(1).setZero();
  step.tail<2>().setZero();
  correction = Correction<SE2>(SE2(), 2.0 * D, retract(SE2(), step), D);
  REQUIRE(correction.whiten(white));
  CHECK(white(1) == 0.0);
}

TEST_CASE("sensor noise: 1.7 times the stated noise is found, 1.3 times is not") {
  constexpr Index kDof = 18;
  const auto alarms = [](double scale, double used, int frames) {
    SensorNoiseTest test;
    Source source;
    int count = 0;
    for (int i = 0; i < frames; ++i) {
      test.add(scale * scale * source.chi_square(kDof), kDof, used);
      count += test.found() ? 1 : 0;
    }
    return count;
  };
  CHECK(alarms(1.0, 1.0, 100000) == 0);
  CHECK(alarms(1.3, 1.0, 1000) < 10);
  CHECK(alarms(1.7, 1.0, 50) > 0);
  CHECK(alarms(1.7, 1.7 * 1.7, 1000) == 0);  // the filter knows it
  SensorNoiseTest test;
  test.add(NAN, kDof, 1.0);
  test.add(30.0, 3, 1.0);
  CHECK_FALSE(test.found());
}

TEST_CASE("persistence: the correlation of errors that last") {
  for (const double correlation : {0.0, 0.6}) {
    Persistence persistence;
    Source source;
    for (int landmark = 0; landmark < 200; ++landmark) {
      PastErrors past = {};
      Vector3 error(source.normal(), source.normal(), 0);
      for (int i = 0; i < 20; ++i) {
        persistence.add(error, past);
        const Vector3 fresh(source.normal(), source.normal(), 0);
        error = correlation * error + std::sqrt(1 - correlation * correlation) * fresh;
      }
    }
    CHECK(std::abs(persistence.correlation(1) - correlation) < 0.05);
    CHECK(std::abs(persistence.correlation(3) - std::pow(correlation, 3)) < 0.05);
  }
  CHECK(Persistence().correlation(1) == 0.0);
}

TEST_CASE("sighting memory: the oldest landmark makes room") {
  Arena arena(1 << 16);
  SightingMemory<SE2> memory(arena, 3);
  for (std::uint64_t id = 10; id < 14; ++id) memory.find_or_make(id).anchors[0].frame = id;
  CHECK(memory.find(10) == nullptr);
  REQUIRE(memory.find(11) != nullptr);
  CHECK(memory.find(11)->anchors[0].frame == 11);
  CHECK(memory.find_or_make(13).anchors[0].frame == 13);
  CHECK(memory.find_or_make(10).anchors[0].frame == 0);
}
