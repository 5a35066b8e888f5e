// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/correspondence_search.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/chi_square.hpp"

namespace cairn {
namespace {

constexpr int kShifts = 32;     // trials that measure how many pairs chance gives
constexpr double kSame = 0.5;   // two transforms that share more of their pairs count as one
constexpr int kExtensions = 5;  // rounds at most

}  // namespace

bool CorrespondenceSearch::Candidate::has(std::size_t i, std::size_t j) const {
  const auto it = std::lower_bound(pairs.begin(), pairs.end(), IndexPair(i, 0));
  return it != pairs.end() && *it == IndexPair(i, j);
}

bool CorrespondenceSearch::Candidate::explains(const TriangleHypothesis& h) const {
  return has(h.a[0], h.b[0]) && has(h.a[1], h.b[1]) && has(h.a[2], h.b[2]);
}

bool CorrespondenceSearch::Candidate::same_as(const Candidate& other) const {
  std::size_t shared = 0;
  for (const IndexPair& pair : pairs) shared += other.has(pair.first, pair.second) ? 1u : 0u;
  return static_cast<double>(shared) > kSame * static_cast<double>(std::min(pairs.size(), other.pairs.size()));
}

CorrespondenceSearch::CorrespondenceSearch(const PointSet& a, const PointSet& b, const CorrespondenceOptions& options)
    : a_(a, true),
      b_(b, true),
      options_(options),
      gate_(chi_square_quantile(3, options.gate_probability)),
      least_(std::max<std::size_t>(options.min_pairs, 4)) {}

Correspondence CorrespondenceSearch::run() {
  result_.reason = CorrespondenceReason::too_few;
  if (a_.size() < least_ || b_.size() < least_) return result_;
  TriangleHypotheses hypotheses(a_, b_, options_, gate_);
  if (!hypotheses.possible()) return result_;
  const PointPairing pairing(a_, b_, gate_, kPairingReach * hypotheses.spacing());
  hypotheses.propose();
  result_.hypotheses = hypotheses.tried();
  verify(hypotheses, pairing);
  choose(hypotheses, pairing);
  return result_;
}

void CorrespondenceSearch::keep_compatible(Candidate& candidate, const PointPairing& pairing) const {
  pairing.keep_compatible(options_.joint_probability, options_.gate_probability, nullptr, candidate.pairs,
                          candidate.alignment);
}

// Grows the best hypotheses into candidates, the candidate with the most pairs first.
void CorrespondenceSearch::verify(const TriangleHypotheses& hypotheses, const PointPairing& pairing) {
  for (const TriangleHypothesis& h : hypotheses.ranked()) {
    if (std::any_of(candidates_.begin(), candidates_.end(), [&h](const Candidate& c) { return c.explains(h); }))
      continue;
    if (result_.verified == options_.max_verified) {
      unverified_ = h.score;
      break;
    }
    ++result_.verified;
    Candidate candidate{h.score, {}, {}};
    for (std::size_t c = 0; c < 3; ++c) candidate.pairs.emplace_back(h.a[c], h.b[c]);
    std::sort(candidate.pairs.begin(), candidate.pairs.end());
    if (!pairing.grow(nullptr, candidate.pairs, candidate.alignment)) continue;
    const auto same = std::find_if(candidates_.begin(), candidates_.end(),
                                   [&](const Candidate& other) { return candidate.same_as(other); });
    if (same == candidates_.end()) {
      candidates_.push_back(std::move(candidate));
    } else if (candidate.pairs.size() > same->pairs.size()) {
      candidate.score = std::max(candidate.score, same->score);
      *same = std::move(candidate);
    }
  }
  std::stable_sort(candidates_.begin(), candidates_.end(),
                   [](const Candidate& x, const Candidate& y) { return x.pairs.size() > y.pairs.size(); });
}

// The number of pairs that a wrong transform finds in the same place: the mean over shifts that are just too long for
// correct pairs.
double CorrespondenceSearch::chance(const Candidate& candidate, const PointPairing& pairing, double spacing) const {
  const GatedPairs unshifted = pairing.pair(candidate.alignment.T_a_b, candidate.alignment.covariance);
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : a_.set().points) mean += p / static_cast<double>(a_.size());
  Matrix3 spread = Matrix3::Zero();
  for (const Vector3& p : a_.set().points) spread += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(spread);
  const Vector3 u = eigen.eigenvectors().col(2), v = eigen.eigenvectors().col(1);
  double sum = 1;  // never zero: the trials only show that such pairs are rare
  for (int s = 0; s < kShifts; ++s) {
    const double angle = 2.399963229728653 * s;  // the golden angle: no two directions are alike
    const double length = 2 * unshifted.radius + spacing * (0.3 + 0.7 * s / kShifts);
    const Vector3 shift = length * (std::cos(angle) * u + std::sin(angle) * v);
    sum += static_cast<double>(
        pairing.pair(candidate.alignment.T_a_b, candidate.alignment.covariance, shift).pairs.size());
  }
  return sum / kShifts;
}

void CorrespondenceSearch::choose(const TriangleHypotheses& hypotheses, const PointPairing& pairing) {
  result_.reason = hypotheses.exhausted() ? CorrespondenceReason::budget : CorrespondenceReason::nothing;
  if (candidates_.empty()) return;
  Candidate best = candidates_.front();
  result_.chance = chance(best, pairing, hypotheses.spacing());
  keep_compatible(best, pairing);
  const double count = static_cast<double>(best.pairs.size());
  if (best.pairs.size() < least_) return;
  // Three pairs fit any transform. The probability that chance gives the others is P(Poisson(chance) >= n), per trial.
  const double alarm = chi_square_cdf(2 * (count - 3), 2 * result_.chance) * static_cast<double>(result_.hypotheses);
  if (alarm > options_.false_alarm) return;

  for (std::size_t s = 1; s < std::min<std::size_t>(candidates_.size(), 4); ++s) {
    Candidate& rival = candidates_[s];
    if (rival.pairs.size() <= result_.rivals) break;
    keep_compatible(rival, pairing);
    result_.rivals = std::max(result_.rivals, rival.pairs.size());
  }
  if (static_cast<double>(result_.rivals) >= options_.ambiguity * count) {
    result_.reason = CorrespondenceReason::ambiguous;
  } else if (unverified_ >= options_.ambiguity * best.score &&
             static_cast<double>(result_.rivals) >= 0.5 * options_.ambiguity * count) {
    result_.reason = CorrespondenceReason::budget;
  } else {
    extend(best, pairing);
    result_.reason = CorrespondenceReason::found;
    result_.pairs = best.pairs;
    result_.alignment = best.alignment;
  }
}

// Local gates are too narrow if a map has bent over a long distance. A pair closer than half the spacing is added if
// the joint test, which knows the bend, accepts it. A fit of independent points decides which pairs are close: the
// joint transform between the frames is as uncertain as the frames are.
void CorrespondenceSearch::extend(Candidate& candidate, const PointPairing& pairing) const {
  if (!a_.set().joint && !b_.set().joint) return;
  for (int round = 0; round < kExtensions; ++round) {
    const Alignment fit = align(pairing.independent_points(candidate.pairs));
    if (!fit.ok()) return;
    const GatedPairs wide = pairing.pair_within_reach(fit.T_a_b, fit.covariance);
    std::vector<bool> used_a(a_.size(), false), used_b(b_.size(), false);
    for (const IndexPair& pair : candidate.pairs) used_a[pair.first] = used_b[pair.second] = true;
    Candidate larger = candidate;
    for (const IndexPair& pair : wide.pairs)
      if (!used_a[pair.first] && !used_b[pair.second]) larger.pairs.push_back(pair);
    std::sort(larger.pairs.begin(), larger.pairs.end());
    if (larger.pairs.size() > candidate.pairs.size()) keep_compatible(larger, pairing);
    if (!larger.alignment.ok() || larger.pairs.size() <= candidate.pairs.size()) return;
    candidate = larger;
  }
}

}  // namespace cairn
