// SPDX-License-Identifier: BSD-3-Clause
// The thresholds are those of docs/trust.md; each test says wrongly "doubtful" at about one update in 100,000,
// that of the motion's noise at one in 10,000.
#include "health/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "core/chi_square.hpp"

namespace cairn {
namespace {

constexpr double kKeep = 0.95;          // of the NIS from update to update
constexpr double kKeepRefusals = 0.85;  // of the share of refusals
constexpr double kSigmas = 4.5;         // of a test
constexpr double kNisRatio = 1.3;       // less is no reason, however significant
constexpr double kJumpProbability = 1e-6;
constexpr double kMovedProbability = 1e-8;  // of a landmark that a closing refuses: a closing compares many
constexpr double kLostShare = 0.5, kLostCompared = 6.0;  // most of what is seen is refused

}  // namespace

void NisWindow::add(double value, double dof, double keep) {
  nis = keep * nis + value;
  rows = keep * rows + dof;
  squares = keep * keep * squares + 2.0 * dof;
}

double NisWindow::half_width(double sigmas) const {
  return rows > 0.0 ? sigmas * std::sqrt(squares) / rows : 0.0;
}

Verdict::Verdict(double gate_probability) : honest_refusals_(1.0 - gate_probability) {
  for (int rows = 1; rows <= 3; ++rows) moved_bound_[rows] = chi_square_quantile(rows, 1.0 - kMovedProbability);
  for (int dof = 1; dof <= 6; ++dof) jump_bound_[dof] = chi_square_quantile(dof, 1.0 - kJumpProbability);
}

void Verdict::doubt(DoubtReason reason, int hold) {
  for (Index kind = 0; kind < kKinds; ++kind)
    if ((reason >> kind) & 1U) hold_[kind] = std::max(hold_[kind], hold);
}

// Refusals at a share that the gate explains make the sum fall.
void Verdict::judge_refusals(const UpdateEvidence& evidence) {
  const double tolerated = 2.0 * honest_refusals_ + 0.04, bound = 6.0 + 40.0 * honest_refusals_;
  const auto compared = static_cast<double>(evidence.compared), refused = static_cast<double>(evidence.refused);
  compared_ = kKeepRefusals * compared_ + compared;
  refused_ = kKeepRefusals * refused_ + refused;
  excess_.add(refused - tolerated * compared, bound);
  if (excess_.found(bound)) doubt(kDoubtRefusals, 1);
}

void Verdict::judge_jump(const UpdateEvidence& evidence) {
  jump_ = 0.0;
  if (evidence.jump_dof <= 0) return;
  const auto dof = static_cast<double>(evidence.jump_dof);
  jump_ = (evidence.jump - dof) / std::sqrt(2.0 * dof);
  if (evidence.jump > jump_bound_[std::min<Index>(6, evidence.jump_dof)]) doubt(kDoubtJump);
}

void Verdict::add(const UpdateEvidence& evidence) {
  for (int& hold : hold_) hold = std::max(0, hold - 1);
  if (evidence.rows > 0) nis_.add(evidence.nis, static_cast<double>(evidence.rows), kKeep);
  if (nis_.ratio() > kNisRatio && nis_.ratio() > 1.0 + nis_.half_width(kSigmas)) doubt(kDoubtNis, 1);
  judge_refusals(evidence);
  judge_jump(evidence);
  if (evidence.sensor_noise) doubt(kDoubtSensorNoise, 1);
  if (evidence.motion_noise) doubt(kDoubtMotionNoise, 1);
  if (evidence.drift > kSigmas + 0.5) doubt(kDoubtBias, 1);
  if (evidence.contradicting > 0) doubt(kDoubtLandmarks);
  if (evidence.blind > 0) doubt(kDoubtBlind, 1);
  if (!(evidence.pivot > -1e-6)) doubt(kDoubtDefinite, 1);

  reasons_ = 0;
  for (Index kind = 0; kind < kKinds; ++kind)
    if (hold_[kind] > 0) reasons_ |= 1U << kind;
  const bool lost = compared_ >= kLostCompared && refused_share() > kLostShare;
  trust_ = lost ? Trust::lost : reasons_ != 0 ? Trust::doubtful : Trust::good;
  if (lost) reasons_ |= kDoubtRefusals;
  updates_ += 1.0;
  count_[static_cast<int>(trust_)] += 1.0;
}

double Verdict::share(Trust trust) const {
  return updates_ > 0.0 ? count_[static_cast<int>(trust)] / updates_ : 0.0;
}

void Verdict::widened(double amount) {
  widenings_ += 1.0;
  last_widening_ = amount;
  doubt(kDoubtWidened, kHold + 1);  // the update that widened takes one
}

void Verdict::closing(double refused, double known, double worst, Index rows) {
  constexpr double kMostShare = 0.1;
  if (refused > 0.0 && worst > moved_bound_[rows]) doubt(kDoubtLandmarks, 2 * kHold);
  if (refused >= 3.0 && refused > kMostShare * known) doubt(kDoubtClosing, 2 * kHold);
}

}  // namespace cairn
