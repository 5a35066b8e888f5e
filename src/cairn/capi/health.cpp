// SPDX-License-Identifier: BSD-3-Clause
// The verdict on a filter, and what each sensor's observations show.
#include <cairn/health.h>

#include <cmath>

#include "capi/filter_handle.hpp"

using namespace cairn;
using namespace cairn::capi;

namespace cairn {
namespace capi {
namespace {

constexpr double kBand = 1.959963984540054;  // 95 %

// The reasons have the same bits on both sides.
constexpr bool same(Doubt here, int there) {
  return static_cast<int>(here) == there;
}
static_assert(same(kDoubtNis, CAIRN_DOUBT_NIS) && same(kDoubtRefusals, CAIRN_DOUBT_REFUSALS) &&
              same(kDoubtWidened, CAIRN_DOUBT_WIDENED) && same(kDoubtSensorNoise, CAIRN_DOUBT_SENSOR_NOISE) &&
              same(kDoubtMotionNoise, CAIRN_DOUBT_MOTION_NOISE) && same(kDoubtBias, CAIRN_DOUBT_BIAS) &&
              same(kDoubtJump, CAIRN_DOUBT_JUMP) && same(kDoubtLandmarks, CAIRN_DOUBT_LANDMARKS) &&
              same(kDoubtClosing, CAIRN_DOUBT_CLOSING) && same(kDoubtBlind, CAIRN_DOUBT_BLIND) &&
              same(kDoubtDefinite, CAIRN_DOUBT_DEFINITE));

cairn_verdict verdict_of(Trust trust) {
  switch (trust) {
    case Trust::good:
      break;
    case Trust::doubtful:
      return CAIRN_VERDICT_DOUBTFUL;
    case Trust::lost:
      return CAIRN_VERDICT_LOST;
  }
  return CAIRN_VERDICT_GOOD;
}

// `Health` is the struct of a filter or of a sensor.
template <class Health>
void write_nis(const NisWindow& nis, Health& out) {
  if (nis.rows <= 0.0) return;
  out.nis_per_row = nis.ratio();
  out.nis_lower = std::max(0.0, 1.0 - nis.half_width(kBand));
  out.nis_upper = 1.0 + nis.half_width(kBand);
}

// The factor of a standard deviation, from that of a variance.
void write_scale(const NoiseFactor& factor, double& scale, double& sigma) {
  scale = std::sqrt(factor.value);
  sigma = 0.5 * factor.sigma / scale;
}

template <class Pose>
cairn_health health_of(const HealthMonitor<Pose>& health) {
  const Verdict& verdict = health.verdict();
  const UpdateEvidence& last = health.evidence();
  cairn_health out = {};
  out.verdict = verdict_of(verdict.trust());
  out.reasons = verdict.reasons();
  out.blind_directions = static_cast<std::uint32_t>(last.blind);
  out.contradicting = static_cast<std::uint32_t>(last.contradicting);
  out.updates = static_cast<std::uint64_t>(verdict.updates());
  out.good_share = verdict.share(Trust::good);
  out.doubtful_share = verdict.share(Trust::doubtful);
  out.lost_share = verdict.share(Trust::lost);
  write_nis(verdict.nis(), out);
  out.refused_share = verdict.refused_share();
  out.widenings = static_cast<std::uint64_t>(verdict.widenings());
  out.last_widening = verdict.last_widening();
  write_scale(health.motion_noise(), out.motion_scale, out.motion_scale_sigma);
  out.bias_sigmas = last.drift;
  out.jump_sigmas = verdict.jump();
  out.pose_pivot = last.pivot;
  return out;
}

}  // namespace
}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_filter_health(const cairn_filter* filter, cairn_health* health, cairn_error* error) {
  return guard(error, [&] {
    cairn_health out = {};
    with_filter(filter, [&](const auto& f) { out = health_of(f.health()); });
    write_report(out, health, "health");
  });
}

cairn_status cairn_filter_sensor_health(const cairn_filter* filter, int32_t sensor, cairn_sensor_health* health,
                                        cairn_error* error) {
  return guard(error, [&] {
    cairn_sensor_health out = {};
    with_filter(filter, [&](const auto& f) {
      f.check_sensor(sensor);
      const SensorHealth& from = f.health().sensor(sensor);
      out.compared = static_cast<std::uint64_t>(from.compared);
      out.refused = static_cast<std::uint64_t>(from.refused);
      write_nis(from.nis, out);
      write_scale(f.health().sensor_noise(sensor), out.scale, out.scale_sigma);
      for (Index lag = 1; lag <= kPersistenceLags; ++lag) out.persistence[lag - 1] = from.persistence.correlation(lag);
    });
    write_report(out, health, "health");
  });
}

const char* cairn_verdict_text(cairn_verdict verdict) {
  switch (verdict) {
    case CAIRN_VERDICT_GOOD:
      return "good";
    case CAIRN_VERDICT_DOUBTFUL:
      return "doubtful";
    case CAIRN_VERDICT_LOST:
      return "lost";
    default:
      return "unknown";
  }
}

const char* cairn_doubt_text(cairn_doubts reason) {
  switch (reason) {
    case CAIRN_DOUBT_NIS:
      return "the innovations are larger than their covariance";
    case CAIRN_DOUBT_REFUSALS:
      return "the gates refuse more than they refuse of honest observations";
    case CAIRN_DOUBT_WIDENED:
      return "the motion was widened, because most of what was seen contradicted it";
    case CAIRN_DOUBT_SENSOR_NOISE:
      return "a sensor's noise is larger than what is stated";
    case CAIRN_DOUBT_MOTION_NOISE:
      return "the motion's noise is larger than what is stated";
    case CAIRN_DOUBT_BIAS:
      return "the motion has a constant error";
    case CAIRN_DOUBT_JUMP:
      return "a frame contradicts the motion since the last frame";
    case CAIRN_DOUBT_LANDMARKS:
      return "single landmarks contradict the rest";
    case CAIRN_DOUBT_CLOSING:
      return "a closed submap contradicted the map";
    case CAIRN_DOUBT_BLIND:
      return "the last frames say nothing about some directions of the pose";
    case CAIRN_DOUBT_DEFINITE:
      return "the covariance of the pose is not positive semidefinite";
    default:
      return "unknown";
  }
}

}  // extern "C"
