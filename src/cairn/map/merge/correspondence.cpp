// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/correspondence.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/chi_square.hpp"
#include "map/merge/triangles.hpp"
#include "map/spatial_index.hpp"

namespace cairn {
namespace {

using Pair = std::pair<std::size_t, std::size_t>;
using Pairs = std::vector<Pair>;

constexpr int kRounds = 15;              // of pairing and aligning
constexpr std::size_t kNeighbours = 16;  // of a point, among whom a hypothesis looks for support
constexpr std::size_t kRanked = 20000;   // hypotheses that are remembered
constexpr double kReach = 0.5;           // of the spacing: where the transform is vaguer, nearest means nothing
constexpr int kShifts = 32;              // trials that tell what chance pairs
constexpr double kSame = 0.5;            // of the pairs that two transforms share: they are one

struct Side {
  const PointSet& set;
  SpatialIndex index;
  std::vector<Matrix3> covariances;  // for gates
  double widest = 0;                 // trace of the largest

  // `local`: without the errors that neighbours have in common, which an unknown transform absorbs.
  Side(const PointSet& points, bool local) : set(points), index([&points](std::size_t i) { return points.points[i]; }) {
    for (std::size_t i = 0; i < set.points.size(); ++i) index.add(i);
    covariances = local ? local_covariances(points, index, kNeighbours) : points.covariances;
    for (const Matrix3& covariance : covariances) widest = std::max(widest, covariance.trace());
  }
};

double median_spacing(const Side& side) {
  std::vector<double> nearest;
  std::vector<SpatialIndex::Hit> hits;
  for (const Vector3& p : side.set.points) {
    side.index.nearest(p, 2, hits);
    if (hits.size() > 1) nearest.push_back(hits[1].distance);
  }
  if (nearest.empty()) return std::numeric_limits<double>::infinity();  // a single point is nobody's neighbour
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2), nearest.end());
  return nearest[nearest.size() / 2];
}

struct Gated {
  Pairs pairs;           // by index in a
  std::size_t near = 0;  // points of b where the transform is sharp enough
  double radius = 0;     // of the widest gate among the pairs, m
};

// Pairs that are each other's nearest (Mahalanobis) and inside the gate, `shift` aside, where the transform's own part
// of the gate stays within `reach`. `wide`: nearest in metres instead, within `reach`.
Gated pair_up(const Side& a, const Side& b, const SE3& T, const Matrix6& covariance, double gate, double reach,
              const Vector3& shift = Vector3::Zero(), bool wide = false) {
  struct Best {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t index = 0;
    double radius = 0;
  };
  const Matrix3 R = T.rotation().matrix();
  std::vector<Best> of_a(a.set.points.size()), of_b(b.set.points.size());
  std::vector<SpatialIndex::Hit> hits;
  Gated result;
  for (std::size_t j = 0; j < b.set.points.size(); ++j) {
    const Vector3 arm = R * b.set.points[j];
    Matrix36 J;
    J << Matrix3::Identity(), -hat(arm);
    const Matrix3 by_transform = J * covariance * J.transpose();
    if (!(gate * by_transform.trace() <= reach * reach)) continue;
    ++result.near;
    const Matrix3 by_b = by_transform + R * b.covariances[j] * R.transpose();
    const Vector3 p = arm + T.translation() + shift;
    a.index.within(p, wide ? reach : std::sqrt(gate * (by_b.trace() + a.widest)), hits);
    for (const SpatialIndex::Hit& hit : hits) {
      const Matrix3 S = a.covariances[hit.index] + by_b;
      double distance = hit.distance;
      if (!wide) {
        const Eigen::LLT<Matrix3> L(S);
        if (L.info() != Eigen::Success) continue;
        const Vector3 difference = a.set.points[hit.index] - p;
        distance = difference.dot(L.solve(difference));
        if (distance > gate) continue;
      }
      if (distance < of_b[j].distance) of_b[j] = {distance, hit.index, std::sqrt(gate * S.trace() / 3)};
      if (distance < of_a[hit.index].distance) of_a[hit.index] = {distance, j, 0};
    }
  }
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (!std::isfinite(of_a[i].distance) || of_b[of_a[i].index].index != i) continue;
    result.pairs.emplace_back(i, of_a[i].index);
    result.radius = std::max(result.radius, of_b[of_a[i].index].radius);
  }
  return result;
}

PairedPoints points_of(const Side& a, const Side& b, const Pairs& pairs, bool jointly) {
  PairedPoints paired;
  std::vector<std::size_t> of_a, of_b;
  for (const Pair& pair : pairs) {
    of_a.push_back(pair.first);
    of_b.push_back(pair.second);
    paired.a.push_back(a.set.points[pair.first]);
    paired.b.push_back(b.set.points[pair.second]);
  }
  const auto covariance = [jointly](const Side& side, const std::vector<std::size_t>& indices) {
    PointsCovariance result;
    if (jointly && side.set.joint) {
      result.full.resize(9 * indices.size() * indices.size());
      side.set.joint(indices.data(), indices.size(), result.full.data());
    } else {
      for (std::size_t i : indices) result.blocks.push_back(side.covariances[i]);
    }
    return result;
  };
  paired.covariance_a = covariance(a, of_a);
  paired.covariance_b = covariance(b, of_b);
  return paired;
}

// Pairs, aligns, and pairs again until nothing changes. From a few neighbours the set grows outward, as far as the
// transform is sharp each time. False where align() fails.
bool grow(const Side& a, const Side& b, double gate, double reach, const TransformPrior* prior, Pairs& pairs,
          Alignment& alignment) {
  for (int round = 0; round < kRounds; ++round) {
    if (!pairs.empty()) {
      const SE3 start = alignment.T_a_b;
      alignment = align(points_of(a, b, pairs, false), prior, false, round > 0 ? &start : nullptr);
      if (!alignment.ok()) return false;
    }
    Pairs next = pair_up(a, b, alignment.T_a_b, alignment.covariance, gate, reach).pairs;
    if (next.empty()) return false;
    if (next == pairs) break;
    pairs.swap(next);
  }
  return true;
}

// Drops what contradicts the rest, jointly.
void settle(const Side& a, const Side& b, const CorrespondenceOptions& options, const TransformPrior* prior,
            Pairs& pairs, Alignment& alignment) {
  const SE3 start = alignment.T_a_b;
  const CompatibleAlignment compatible =
      align_compatible(points_of(a, b, pairs, true), options.joint_probability, options.gate_probability, prior,
                       prior == nullptr ? &start : nullptr);
  Pairs kept;
  for (std::size_t i : compatible.kept) kept.push_back(pairs[i]);
  pairs.swap(kept);
  alignment = compatible.alignment;
}

// A triangle of b laid onto one of a.
struct Hypothesis {
  double score;   // how surprising its support is: sum of log(spacing / tolerance) over the supporting neighbours
  double misfit;  // of the sides, chi-square of 3
  std::array<std::uint32_t, 3> a, b;
};

class Matcher {
 public:
  Matcher(const PointSet& a, const PointSet& b, const CorrespondenceOptions& options)
      : a_(a, true), b_(b, true), options_(options), gate_(chi_square_quantile(3, options.gate_probability)) {}

  Correspondence run() {
    Correspondence result;
    result.reason = CorrespondenceReason::too_few;
    const std::size_t least = std::max<std::size_t>(options_.min_pairs, 4);
    if (a_.set.points.size() < least || b_.set.points.size() < least) return result;
    in_a_ = make_triangles(a_.set, a_.index, options_.triangle_corners, kNeighbours, options_.max_triangles);
    in_b_ = make_triangles(b_.set, b_.index, options_.triangle_corners, kNeighbours, options_.max_triangles);
    if (in_a_.triangles.empty() || in_b_.triangles.empty()) return result;
    reach_ = kReach * in_a_.spacing;
    propose(result);
    verify(result);
    choose(least, result);
    return result;
  }

 private:
  // A transform and all that it pairs.
  struct Solution {
    double score;
    Pairs pairs;
    Alignment alignment;
    bool pairs_up(std::size_t i, std::size_t j) const {
      const auto it = std::lower_bound(pairs.begin(), pairs.end(), Pair(i, 0));
      return it != pairs.end() && *it == Pair(i, j);
    }
    bool explains(const Hypothesis& h) const {
      return pairs_up(h.a[0], h.b[0]) && pairs_up(h.a[1], h.b[1]) && pairs_up(h.a[2], h.b[2]);
    }
    bool is(const Solution& other) const {
      std::size_t shared = 0;
      for (const Pair& pair : pairs) shared += other.pairs_up(pair.first, pair.second) ? 1u : 0u;
      return static_cast<double>(shared) > kSame * static_cast<double>(std::min(pairs.size(), other.pairs.size()));
    }
  };

  void propose(Correspondence& result);
  void consider(const Triangle& a, const Triangle& b, Correspondence& result);
  double support(const Hypothesis& h, const SE3& T, double variance, double height) const;
  void verify(Correspondence& result);
  void choose(std::size_t least, Correspondence& result);
  double chance(const Solution& solution) const;
  void extend(Solution& solution) const;

  const Side a_, b_;
  const CorrespondenceOptions& options_;
  const double gate_;
  double reach_ = 0;
  Triangles in_a_, in_b_;
  std::vector<Hypothesis> hypotheses_;
  std::vector<Solution> solutions_;
  bool exhausted_ = false;  // there were more hypotheses than the budget
  double unverified_ = 0;   // score of the best hypothesis that no solution explains and nobody looked at
};

// Begins with the triangles of a whose sides few triangles of b share: they tell most.
void Matcher::propose(Correspondence& result) {
  std::vector<Vector3> sides;
  double widest = 0;
  for (const Triangle& triangle : in_b_.triangles) {
    sides.push_back(triangle.sides);
    widest = std::max(widest, triangle.variances.maxCoeff());
  }
  SpatialIndex table([&sides](std::size_t i) { return sides[i]; });
  for (std::size_t i = 0; i < sides.size(); ++i) table.add(i);
  const auto look_up = [&](const Triangle& triangle, std::vector<SpatialIndex::Hit>& hits) {
    table.within(triangle.sides, std::sqrt(gate_ * (triangle.variances.maxCoeff() + widest)), hits);
  };
  std::vector<SpatialIndex::Hit> hits;
  std::vector<std::pair<std::size_t, std::size_t>> order;  // number of hits, triangle
  for (std::size_t t = 0; t < in_a_.triangles.size(); ++t) {
    look_up(in_a_.triangles[t], hits);
    if (!hits.empty()) order.emplace_back(hits.size(), t);
  }
  std::sort(order.begin(), order.end());
  for (const auto& entry : order) {
    if (result.hypotheses >= options_.max_hypotheses) {
      exhausted_ = true;
      break;
    }
    look_up(in_a_.triangles[entry.second], hits);
    for (const SpatialIndex::Hit& hit : hits)
      consider(in_a_.triangles[entry.second], in_b_.triangles[hit.index], result);
  }
  std::sort(hypotheses_.begin(), hypotheses_.end(), [](const Hypothesis& x, const Hypothesis& y) {
    if (x.score != y.score) return x.score > y.score;
    if (x.misfit != y.misfit) return x.misfit < y.misfit;
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
}

// All ways of laying b onto a that the sides allow: more than one where sides are about equal.
void Matcher::consider(const Triangle& a, const Triangle& b, Correspondence& result) {
  for (const std::array<int, 3>& way : kPairings) {
    Hypothesis h{};
    double variance = 0;
    for (int s = 0; s < 3; ++s) {
      const int w = way[static_cast<std::size_t>(s)];
      const double sum = a.variances[s] + b.variances[w], difference = a.sides[s] - b.sides[w];
      h.misfit += difference * difference / sum;
      variance = std::max(variance, sum);
      h.a[static_cast<std::size_t>(s)] = a.points[static_cast<std::size_t>(s)];
      h.b[static_cast<std::size_t>(s)] = b.points[static_cast<std::size_t>(w)];
    }
    if (!(h.misfit <= gate_)) continue;
    ++result.hypotheses;
    const auto corners = [](const PointSet& set, const std::array<std::uint32_t, 3>& i) {
      return std::array<Vector3, 3>{set.points[i[0]], set.points[i[1]], set.points[i[2]]};
    };
    const std::array<Vector3, 3> on = corners(a_.set, h.a);
    const SE3 T = lay_onto(on, corners(b_.set, h.b));
    if (std::acos(std::clamp((T.rotation() * Vector3::UnitZ()).z(), -1.0, 1.0)) > options_.max_tilt) continue;
    const double height = (on[1] - on[0]).cross(on[2] - on[0]).norm() / a.sides[2];
    h.score = support(h, T, variance, height);
    if (h.score <= 0) continue;
    hypotheses_.push_back(h);
    if (hypotheses_.size() >= 2 * kRanked) {
      std::nth_element(hypotheses_.begin(), hypotheses_.begin() + kRanked, hypotheses_.end(),
                       [](const Hypothesis& x, const Hypothesis& y) { return x.score > y.score; });
      hypotheses_.resize(kRanked);
    }
  }
}

// Scores how many neighbours of one corner in b fall onto neighbours of that corner in a.
double Matcher::support(const Hypothesis& h, const SE3& T, double variance, double height) const {
  const auto is_corner = [](const std::array<std::uint32_t, 3>& corners, std::uint32_t i) {
    return corners[0] == i || corners[1] == i || corners[2] == i;
  };
  const Vector3 middle = (b_.set.points[h.b[0]] + b_.set.points[h.b[1]] + b_.set.points[h.b[2]]) / 3;
  const double most = in_a_.spacing * in_a_.spacing;
  double score = 0;
  for (std::uint32_t j : in_b_.neighbours[h.b[0]]) {
    if (is_corner(h.b, j)) continue;
    // The triangle's errors, levered out to where the neighbour stands.
    const double tolerance = gate_ * variance * (1 + (b_.set.points[j] - middle).squaredNorm() / (height * height));
    if (tolerance >= most) continue;
    const Vector3 p = T * b_.set.points[j];
    double nearest = tolerance;
    for (std::uint32_t i : in_a_.neighbours[h.a[0]]) {
      if (is_corner(h.a, i)) continue;
      nearest = std::min(nearest, (a_.set.points[i] - p).squaredNorm());
    }
    if (nearest < tolerance) score += 0.5 * std::log(most / tolerance);
  }
  return score;
}

void Matcher::verify(Correspondence& result) {
  for (const Hypothesis& h : hypotheses_) {
    Solution* known = nullptr;
    for (Solution& solution : solutions_)
      if (solution.explains(h)) known = &solution;
    if (known != nullptr) continue;
    if (result.verified == options_.max_verified) {
      unverified_ = h.score;
      break;
    }
    ++result.verified;
    Solution solution{h.score, {}, {}};
    for (std::size_t c = 0; c < 3; ++c) solution.pairs.emplace_back(h.a[c], h.b[c]);
    std::sort(solution.pairs.begin(), solution.pairs.end());
    if (!grow(a_, b_, gate_, reach_, nullptr, solution.pairs, solution.alignment)) continue;
    const auto same =
        std::find_if(solutions_.begin(), solutions_.end(), [&](const Solution& other) { return solution.is(other); });
    if (same == solutions_.end()) {
      solutions_.push_back(std::move(solution));
    } else if (solution.pairs.size() > same->pairs.size()) {
      solution.score = std::max(solution.score, same->score);
      *same = std::move(solution);
    }
  }
  std::stable_sort(solutions_.begin(), solutions_.end(),
                   [](const Solution& x, const Solution& y) { return x.pairs.size() > y.pairs.size(); });
}

// Pairs that a wrong transform finds at the same place: the mean over shifts that are just too long for right ones.
double Matcher::chance(const Solution& solution) const {
  const Gated at_home = pair_up(a_, b_, solution.alignment.T_a_b, solution.alignment.covariance, gate_, reach_);
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : a_.set.points) mean += p / static_cast<double>(a_.set.points.size());
  Matrix3 spread = Matrix3::Zero();
  for (const Vector3& p : a_.set.points) spread += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(spread);
  const Vector3 u = eigen.eigenvectors().col(2), v = eigen.eigenvectors().col(1);
  double sum = 1;  // never none: no more is known than that it is rare
  for (int s = 0; s < kShifts; ++s) {
    const double angle = 2.399963229728653 * s;  // the golden angle: no two directions alike
    const double length = 2 * at_home.radius + in_a_.spacing * (0.3 + 0.7 * s / kShifts);
    const Vector3 shift = length * (std::cos(angle) * u + std::sin(angle) * v);
    sum += static_cast<double>(
        pair_up(a_, b_, solution.alignment.T_a_b, solution.alignment.covariance, gate_, reach_, shift).pairs.size());
  }
  return sum / kShifts;
}

void Matcher::choose(std::size_t least, Correspondence& result) {
  result.reason = exhausted_ ? CorrespondenceReason::budget : CorrespondenceReason::nothing;
  if (solutions_.empty()) return;
  Solution best = solutions_.front();
  result.chance = chance(best);
  settle(a_, b_, options_, nullptr, best.pairs, best.alignment);
  const double count = static_cast<double>(best.pairs.size());
  if (best.pairs.size() < least) return;
  // Three pairs fit any transform. The probability that chance gives the others is P(Poisson(chance) >= n), per trial.
  const double alarm = chi_square_cdf(2 * (count - 3), 2 * result.chance) * static_cast<double>(result.hypotheses);
  if (alarm > options_.false_alarm) return;

  for (std::size_t s = 1; s < std::min<std::size_t>(solutions_.size(), 4); ++s) {
    Solution& rival = solutions_[s];
    if (rival.pairs.size() <= result.rivals) break;
    settle(a_, b_, options_, nullptr, rival.pairs, rival.alignment);
    result.rivals = std::max(result.rivals, rival.pairs.size());
  }
  if (static_cast<double>(result.rivals) >= options_.ambiguity * count) {
    result.reason = CorrespondenceReason::ambiguous;
  } else if (unverified_ >= options_.ambiguity * best.score &&
             static_cast<double>(result.rivals) >= 0.5 * options_.ambiguity * count) {
    result.reason = CorrespondenceReason::budget;
  } else {
    extend(best);
    result.reason = CorrespondenceReason::found;
    result.pairs = best.pairs;
    result.alignment = best.alignment;
  }
}

// Local gates are too narrow where maps have bent on a long way. A pair closer than half the spacing may join if the
// joint test, which knows the bend, accepts it. The local fit tells which pairs are close: the transform between the
// frames is as vague as the frames are.
void Matcher::extend(Solution& solution) const {
  constexpr int kExtensions = 5;
  if (!a_.set.joint && !b_.set.joint) return;
  for (int round = 0; round < kExtensions; ++round) {
    const Alignment fit = align(points_of(a_, b_, solution.pairs, false));
    if (!fit.ok()) return;
    const Gated wide = pair_up(a_, b_, fit.T_a_b, fit.covariance, gate_, reach_, Vector3::Zero(), true);
    std::vector<bool> used_a(a_.set.points.size(), false), used_b(b_.set.points.size(), false);
    for (const Pair& pair : solution.pairs) used_a[pair.first] = used_b[pair.second] = true;
    Solution larger = solution;
    for (const Pair& pair : wide.pairs)
      if (!used_a[pair.first] && !used_b[pair.second]) larger.pairs.push_back(pair);
    std::sort(larger.pairs.begin(), larger.pairs.end());
    if (larger.pairs.size() > solution.pairs.size()) settle(a_, b_, options_, nullptr, larger.pairs, larger.alignment);
    if (!larger.alignment.ok() || larger.pairs.size() <= solution.pairs.size()) return;
    solution = larger;
  }
}

}  // namespace

Correspondence match_points(const PointSet& a, const PointSet& b, const CorrespondenceOptions& options) {
  return Matcher(a, b, options).run();
}

Correspondence match_points_near(const PointSet& a, const PointSet& b, const TransformPrior& prior,
                                 const CorrespondenceOptions& options) {
  Correspondence result;
  result.reason = CorrespondenceReason::too_few;
  if (a.points.empty() || b.points.empty()) return result;
  const Side side_a(a, false), side_b(b, false);
  const double gate = chi_square_quantile(3, options.gate_probability);
  const double reach = kReach * median_spacing(side_a);
  if (pair_up(side_a, side_b, prior.T_a_b, prior.covariance, gate, reach).near == 0) {
    result.reason = CorrespondenceReason::too_vague;
    return result;
  }
  result.reason = CorrespondenceReason::nothing;
  Alignment alignment;
  alignment.T_a_b = prior.T_a_b;
  alignment.covariance = prior.covariance;
  Pairs pairs;
  if (!grow(side_a, side_b, gate, reach, &prior, pairs, alignment)) return result;
  settle(side_a, side_b, options, &prior, pairs, alignment);
  if (pairs.empty()) return result;
  result.reason = CorrespondenceReason::found;
  result.pairs = pairs;
  result.alignment = alignment;
  return result;
}

}  // namespace cairn
