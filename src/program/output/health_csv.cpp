// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/health_csv.hpp"

namespace cairn::program {
namespace {

constexpr const char* kHeader =
    "step,t_s,verdict,reasons,nis_per_row,nis_lower,nis_upper,refused_share,widened,motion_scale,motion_scale_sigma,"
    "sensor_scale,sensor_scale_sigma,persistence,bias_sigmas,jump_sigmas,pose_pivot,blind_directions,"
    "contradicting_landmarks\n";

// By bits, as the constants CAIRN_DOUBT_ number them.
constexpr const char* kReasons[] = {"nis",  "refusals",  "widened", "sensor_noise", "motion_noise", "bias",
                                    "jump", "landmarks", "closing", "blind",        "definite"};

std::string reasons_text(cairn_doubts reasons) {
  std::string text;
  for (unsigned bit = 0; bit < sizeof kReasons / sizeof *kReasons; ++bit) {
    if ((reasons >> bit & 1U) == 0) continue;
    if (!text.empty()) text += "|";
    text += kReasons[bit];
  }
  return text;
}

}  // namespace

HealthCsv::HealthCsv(const std::string& folder) : file_(folder, "health.csv") {
  file_.text(kHeader);
}

// A scale of which the observations have said nothing yet is left out.
void HealthCsv::add_scale(double scale, double sigma) {
  if (sigma < scale) {
    file_.field(scale);
    file_.field(sigma);
  } else {
    file_.empty(2);
  }
}

void HealthCsv::add(const DriveStep& step, const StepResult& result) {
  const cairn_health& health = result.health;
  file_.field(step.number);
  file_.field(step.time);
  file_.field(cairn_verdict_text(health.verdict));
  file_.field(reasons_text(health.reasons));
  if (health.nis_upper > 0) {
    for (const double value : {health.nis_per_row, health.nis_lower, health.nis_upper}) file_.field(value);
  } else {
    file_.empty(3);
  }
  file_.field(health.refused_share);
  file_.field(health.widenings > widenings_ ? health.last_widening : 0.0);
  widenings_ = health.widenings;
  add_scale(health.motion_scale, health.motion_scale_sigma);
  add_scale(result.sensor_health.scale, result.sensor_health.scale_sigma);
  for (const double value :
       {result.sensor_health.persistence[0], health.bias_sigmas, health.jump_sigmas, health.pose_pivot})
    file_.field(value);
  file_.field(std::uint64_t{health.blind_directions});
  file_.field(std::uint64_t{health.contradicting});
  file_.end();
}

}  // namespace cairn::program
