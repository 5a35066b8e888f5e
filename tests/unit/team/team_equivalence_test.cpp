// SPDX-License-Identifier: BSD-3-Clause
// Extended observations with the noise that all observations of a scan share equal a joint filter in which the
// teammate's pose has a flat prior: at every scan the mutual sighting places the teammate, the teammate's scan is used,
// and the teammate is removed. With independent noise the covariance is too small, until the filter finds that its
// observations contradict it and widens the motion.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/angle.hpp"
#include "numerical.hpp"
#include "slam/filter.hpp"
#include "team/sighting.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

constexpr double kRange = 30.0, kBearing = 0.3 * kPi / 180, kSpeed = 0.2, kRate = 0.1 * kPi / 180, kPeriod = 5.0;
constexpr int kScans = 200, kFeatures = 10;

struct Boat {
  explicit Boat(const SE2& start, const FilterOptions<SE2>& options)
      : truth(start), arena(Filter<SE2>::arena_bytes(options)), filter(arena, options) {}
  SE2 truth;
  Arena arena;
  Filter<SE2> filter;
  int widenings = 0;
};

Observation look(const SE2& from, const Vector2& at, std::uint64_t id, Random& random) {
  const Vector2 y = from.inverse() * at;
  Observation o{};
  o.id = id;
  o.z[0] = y.norm() + kRange * random.normal();
  o.z[1] = wrap_angle(std::atan2(y.y(), y.x()) + kBearing * random.normal());
  return o;
}

void take(Boat& boat, int sensor, const std::vector<Observation>& scan) {
  boat.filter.update(sensor, scan.data(), static_cast<Index>(scan.size()));
  boat.widenings += boat.filter.report().widened() ? 1 : 0;
}

struct Claims {
  double alone = 0, diagonal = 0, full = 0, flat = 0;  // means of ||C_qq||, Frobenius
  double full_beside_diagonal = 0;                     // over the scans of `diagonal`: until that filter widens
  int scans_of_diagonal = 0, widenings = 0;            // widenings of the filters with a correct model
};

Claims drive(ErrorKind error, unsigned seed) {
  Random random(seed);
  FilterOptions<SE2> options;
  options.error = error;
  options.max_landmarks = options.max_observations = kFeatures;
  options.max_companions = 1;
  options.gate_probability = options.batch_gate_probability = 1;
  const double radius = 1700 / (2 * kPi), speed = 1700.0 / 1500, rate = 2 * kPi / 1500;
  options.initial_pose = SE2(SO2(), Vector2(-750, -radius));
  SE2 truth[2] = {options.initial_pose, SE2(SO2(), Vector2(750, -radius))};
  std::vector<Vector2> features;
  for (int i = 0; i < kFeatures; ++i) features.emplace_back(random.uniform(-4000, 4000), random.uniform(-4000, 4000));

  RangeBearingParameters radar;
  radar.range_sigma = kRange, radar.bearing_sigma = kBearing;
  Boat alone(truth[0], options), diagonal(truth[0], options), full(truth[0], options), flat(truth[0], options);
  Boat* all[] = {&alone, &diagonal, &full, &flat};
  for (Boat* boat : all) {
    boat->filter.add(RangeBearing(radar));
    boat->filter.name_vehicle(1);
  }
  const int by_diagonal = diagonal.filter.add(ExtendedObservation(radar, {}, false));
  const int by_full = full.filter.add(ExtendedObservation(radar, {}, true));
  TwistNoise noise;
  noise.velocity_sigma << kSpeed, 0, 0;
  noise.rate_sigma << 0, 0, kRate;

  Claims claims;
  for (int k = 0; k <= kScans; ++k) {
    if (k > 0) {
      const Vector3 v(speed, 0, 0), w(0, 0, rate);
      for (SE2& T : truth)
        T = T * SE2::exp(kPeriod * Vector3(speed + kSpeed * random.normal(), 0, rate + kRate * random.normal()));
      for (Boat* boat : all) boat->filter.propagate(integrate_twist<SE2>(v, w, kPeriod, noise));
    }
    std::vector<Observation> own, seen_by_teammate;
    for (std::size_t i = 0; i < features.size(); ++i) {
      if ((features[i] - truth[0].translation()).norm() < 5000) own.push_back(look(truth[0], features[i], i, random));
      if ((features[i] - truth[1].translation()).norm() < 5000)
        seen_by_teammate.push_back(look(truth[1], features[i], i, random));
    }
    const Observation there = look(truth[0], truth[1].translation(), 2, random),
                      back = look(truth[1], truth[0].translation(), 1, random);
    MutualSighting seen;
    seen.range = 0.5 * (there.z[0] + back.z[0]), seen.bearing = there.z[1], seen.back = back.z[1];
    seen.covariance = Vector3(0.5 * kRange * kRange, kBearing * kBearing, kBearing * kBearing).asDiagonal();

    for (Boat* boat : all) take(*boat, 0, own);
    diagonal.filter.set_sighting(by_diagonal, seen);
    take(diagonal, by_diagonal, seen_by_teammate);
    full.filter.set_sighting(by_full, seen);
    take(full, by_full, seen_by_teammate);
    add_by_sighting(flat.filter, 2, seen);
    flat.filter.look_from(2);
    take(flat, 0, seen_by_teammate);
    flat.filter.look_from(1);
    flat.filter.remove_vehicle(2);
    CHECK(flat.filter.smallest_pivot() > -1e-12);  // the start is known, and the first noise has two directions

    const auto claim = [](const Boat& boat) { return boat.filter.pose_covariance().topLeftCorner<2, 2>().norm(); };
    claims.alone += claim(alone) / kScans;
    claims.full += claim(full) / kScans;
    claims.flat += claim(flat) / kScans;
    if (diagonal.widenings > 0) continue;
    claims.diagonal += claim(diagonal) / kScans;
    claims.full_beside_diagonal += claim(full) / kScans;
    ++claims.scans_of_diagonal;
  }
  claims.widenings = alone.widenings + full.widenings + flat.widenings;
  return claims;
}

}  // namespace

TEST_CASE("team: extended observations with their common noise are the joint filter with a flat prior") {
  for (ErrorKind error : {ErrorKind::invariant, ErrorKind::standard})
    for (unsigned seed : {1, 2, 3}) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(seed);
      const Claims c = drive(error, seed);
      CHECK(std::abs(c.full / c.flat - 1) < 0.005);
      CHECK(c.full < 0.97 * c.alone);  // cooperation reduces the covariance
      CHECK(c.widenings == 0);
      CHECK(c.scans_of_diagonal > 5);
      CHECK(c.diagonal < 0.99 * c.full_beside_diagonal);  // and independent noise is overconfident
    }
}
