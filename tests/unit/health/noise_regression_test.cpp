// SPDX-License-Identifier: BSD-3-Clause
// The factors of sensors and motion, from squares with known variances.
#include "health/noise_regression.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace cairn;

namespace {

struct Source {
  std::mt19937_64 engine{3};
  double square() {
    const double x = std::normal_distribution<double>()(engine);
    return x * x;
  }
  FrameParts frame(double alpha, double beta, Index dof) {
    FrameParts parts;
    parts.residual_dof = dof;
    for (Index i = 0; i < dof; ++i) parts.residual += alpha * square();
    for (const double weight : {0.1, 1.0, 20.0})
      parts.common[parts.commons++] = {weight, (alpha + beta * weight) * square()};
    return parts;
  }
};

}  // namespace

TEST_CASE("noise regression: finds both factors from 1/9 to 9") {
  for (const double alpha : {1.0 / 9, 1.0, 9.0})
    for (const double beta : {1.0 / 9, 1.0, 9.0})
      for (const Index dof : {Index{0}, Index{20}}) {
        Arena arena(1 << 12);
        NoiseRegression noise(arena, 2, 300.0);
        Source source;
        for (int frame = 0; frame < 500; ++frame) noise.add(1, source.frame(alpha, beta, dof));
        CAPTURE(alpha);
        CAPTURE(beta);
        CAPTURE(dof);
        const NoiseFactor sensor = noise.sensor(1), motion = noise.motion();
        if (dof > 0 || alpha >= beta) CHECK(std::sqrt(sensor.value / alpha) == doctest::Approx(1.0).epsilon(0.15));
        if (beta >= alpha) CHECK(std::sqrt(motion.value / beta) == doctest::Approx(1.0).epsilon(0.15));
        CHECK(std::abs(sensor.value - alpha) < 4.0 * sensor.sigma);
        CHECK(std::abs(motion.value - beta) < 4.0 * motion.sigma);
        CHECK(noise.sensor(0).sigma > noise.sensor(0).value);
      }
}

TEST_CASE("noise regression: two sensors share the motion") {
  Arena arena(1 << 12);
  NoiseRegression noise(arena, 2, 300.0);
  Source source;
  for (int frame = 0; frame < 300; ++frame) {
    noise.add(0, source.frame(4.0, 2.0, 12));
    noise.add(1, source.frame(0.25, 2.0, 12));
  }
  CHECK(noise.sensor(0).value == doctest::Approx(4.0).epsilon(0.2));
  CHECK(noise.sensor(1).value == doctest::Approx(0.25).epsilon(0.2));
  CHECK(noise.motion().value == doctest::Approx(2.0).epsilon(0.3));
}

TEST_CASE("noise regression: a slip moves the motion's factor little") {
  Arena arena(1 << 12);
  NoiseRegression noise(arena, 1, 300.0);
  Source source;
  for (int frame = 0; frame < 200; ++frame) noise.add(0, source.frame(1.0, 1.0, 20));
  const double before = noise.motion().value;
  FrameParts slip = source.frame(1.0, 1.0, 20);
  for (Index j = 0; j < slip.commons; ++j) slip.common[j].square *= 1e6;
  noise.add(0, slip);
  CHECK(noise.motion().value < before + 0.2);
}

TEST_CASE("noise regression: what is not finite changes nothing") {
  Arena arena(1 << 12);
  NoiseRegression noise(arena, 1, 300.0);
  FrameParts bad;
  bad.commons = 1;
  bad.common[0] = {INFINITY, NAN};
  bad.residual_dof = 3;
  bad.residual = NAN;
  noise.add(0, bad);
  CHECK(noise.motion().value == doctest::Approx(1.0));
  CHECK(noise.sensor(0).value == doctest::Approx(1.0));
}
