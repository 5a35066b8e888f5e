// SPDX-License-Identifier: BSD-3-Clause
// Evidence of innovations against the stated noise of a motion.
#include "slam/axis_evidence.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "numerical.hpp"

using namespace cairn;
using cairn::test::Random;

namespace {

// Frames of whitened rows of a planar vehicle: r = J e + noise, with an error e that the stated covariance lacks.
struct Frames {
  static constexpr Index kRows = 8;
  explicit Frames(unsigned seed) : random(seed) {}

  // Returns the variance by which the motion has to be widened along x, y and heading.
  Vector3 next(const Vector3& error, double noise = 1.0) {
    double J[3 * kRows], r[kRows];
    for (Index i = 0; i < kRows; ++i) {
      r[i] = noise * random.normal();
      for (int c = 0; c < 3; ++c) {
        J[c * kRows + i] = 0.5 * random.normal();
        r[i] += J[c * kRows + i] * error[c];
      }
    }
    Matrix3 widening = Matrix3::Zero();
    wider = evidence.weigh(sums, J, r, kRows, Matrix3::Identity(), widening);
    return widening.diagonal();
  }

  Random random;
  ForgottenSums sums;
  AxisEvidence<SE2> evidence = {};
  bool wider = false;
};

}  // namespace

TEST_CASE("axis evidence: the bounds") {
  const ForgottenSums sums;
  CHECK(sums.doubtful(1) == doctest::Approx(28.374).epsilon(1e-3));  // chi-square, 1 degree of freedom, 1 - 1e-7
  CHECK(sums.calm(1) == doctest::Approx(0.45494).epsilon(1e-3));
  for (Index n = 2; n <= ForgottenSums::kMost; ++n) {
    CHECK(sums.doubtful(n) > sums.doubtful(n - 1) - 1e-3);  // it rises to a limit, which it overshoots a little
    CHECK(sums.calm(n) > sums.calm(n - 1));
    CHECK(sums.calm(n) < 10.0);  // below the mean
  }
  CHECK(sums.doubtful(ForgottenSums::kMost) == doctest::Approx(36.7).epsilon(0.01));
}

TEST_CASE("axis evidence: noise as stated is hardly ever widened") {
  Frames frames(1);
  int widened = 0;
  constexpr int kFrames = 200000;
  for (int k = 0; k < kFrames; ++k) {
    frames.next(Vector3::Zero());
    widened += frames.wider ? 1 : 0;
  }
  CHECK(widened < kFrames / 2000);  // frames of some short widenings
}

TEST_CASE("axis evidence: an error of three axes is found within a few frames, and its variance is right") {
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    double sum = 0.0;
    int found = 0, late = 0;
    constexpr int kRuns = 60;
    const double sigma = 4.0;
    for (int run = 0; run < kRuns; ++run) {
      Frames frames(static_cast<unsigned>(100 + run));
      for (int k = 0; k < 200; ++k) frames.next(Vector3::Zero());
      int k = 0;
      for (; k < 15 && !frames.wider; ++k) frames.next(sigma * frames.random.normal() * Vector3::Unit(axis));
      late = std::max(late, k);
      // Once the old frames are forgotten, the estimate belongs to the error.
      for (int more = 0; more < 40; ++more) {
        const Vector3 v = frames.next(sigma * frames.random.normal() * Vector3::Unit(axis));
        if (more < 30 || !frames.wider) continue;
        sum += v[axis];
        ++found;
      }
    }
    CHECK(late < 15);
    CHECK(found > 9 * kRuns);
    CHECK(sum / found == doctest::Approx(sigma * sigma).epsilon(0.25));
  }
}

TEST_CASE("axis evidence: a widening ends when the motion is as told again") {
  Frames frames(7);
  for (int k = 0; k < 200; ++k) frames.next(Vector3::Zero());
  for (int k = 0; k < 30; ++k) frames.next(Vector3(6 * frames.random.normal(), 0, 0));
  REQUIRE(frames.wider);
  int k = 0;
  for (; k < 400 && frames.wider; ++k) frames.next(Vector3::Zero());
  CHECK(k < 150);
}

// Where the stated noise never explained what was seen, a contradiction is no news.
TEST_CASE("axis evidence: a bad record blocks, and so does a short one") {
  Frames bad(3), fresh(4);
  for (int k = 0; k < 300; ++k) {
    bad.next(Vector3::Zero(), 1.6);  // variance 2.6 times the stated one
    CHECK(!bad.wider);
  }
  for (int k = 0; k < 30; ++k) {
    bad.next(Vector3(10, 0, 0), 1.6);
    CHECK(!bad.wider);
  }
  for (int k = 0; k < 20; ++k) {
    fresh.next(Vector3(10, 0, 0));
    CHECK(!fresh.wider);
  }
}

TEST_CASE("axis evidence: rows that do not see the pose say nothing") {
  AxisEvidence<SE2> evidence = {};
  const ForgottenSums sums;
  const double J[6] = {}, r[2] = {100, 100};
  Matrix3 widening = Matrix3::Zero();
  for (int k = 0; k < 100; ++k) CHECK(!evidence.weigh(sums, J, r, 2, Matrix3::Identity(), widening));
  CHECK(widening.isZero(0.0));
}
