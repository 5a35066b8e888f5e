// SPDX-License-Identifier: BSD-3-Clause
// Nearest neighbour and joint compatibility (docs/association.md).
#include "association/association.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cairn {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Start of row i of a packed lower triangle.
Index row_start(Index i) {
  return i * (i + 1) / 2;
}

}  // namespace

Association::Association(Arena& arena, const Capacity& capacity)
    : first_(arena.take<Index>(static_cast<std::size_t>(capacity.observations) + 1)),
      order_(arena.take<Index>(static_cast<std::size_t>(capacity.observations))),
      queue_(arena.take<Index>(static_cast<std::size_t>(capacity.candidates))),
      joint_(arena.take<double>(static_cast<std::size_t>(capacity.candidates))),
      taken_(arena.take<char>(static_cast<std::size_t>(capacity.landmarks))),
      current_(arena.take<Index>(static_cast<std::size_t>(capacity.observations))),
      best_(arena.take<Index>(static_cast<std::size_t>(capacity.observations))),
      factor_(arena.take<double>(static_cast<std::size_t>(row_start(kMostRows * capacity.observations)))),
      whitened_(arena.take<double>(static_cast<std::size_t>(kMostRows * capacity.observations))) {}

void Association::begin(const PairCandidate* candidates, Index count, Index observations) {
  candidates_ = candidates;
  observations_ = all_observations_ = observations;
  Index at = 0;
  for (Index o = 0; o < observations; ++o) {
    first_[o] = at;
    while (at < count && candidates[at].observation == o) ++at;
    best_[o] = kUnpaired;
  }
  first_[observations] = at;
  for (Index c = 0; c < count; ++c) taken_[candidates[c].landmark] = 0;
  best_pairs_ = nodes_ = 0;
  best_distance_ = 0.0;
  exhausted_ = false;
}

void Association::nearest_neighbour(const PairCandidate* candidates, Index count, Index observations) {
  begin(candidates, count, observations);
  std::iota(queue_, queue_ + count, Index{0});
  std::sort(queue_, queue_ + count, [&](Index a, Index b) {
    return candidates[a].distance != candidates[b].distance ? candidates[a].distance < candidates[b].distance : a < b;
  });
  for (const Index* c = queue_; c != queue_ + count; ++c) {
    const PairCandidate& candidate = candidates[*c];
    if (best_[candidate.observation] != kUnpaired || taken_[candidate.landmark] != 0) continue;
    best_[candidate.observation] = *c;
    taken_[candidate.landmark] = 1;
    ++best_pairs_;
    best_distance_ += candidate.distance;
  }
}

void Association::joint_compatibility(const PairCandidate* candidates, Index count, Index observations,
                                      const Innovations& innovations, Index nodes) {
  begin(candidates, count, observations);
  innovations_ = &innovations;
  rows_ = innovations.rows();
  budget_ = nodes;
  // Observations with few candidates come first: their pairs make the innovations of the others sharper.
  std::iota(order_, order_ + observations, Index{0});
  const auto candidates_of = [&](Index o) { return first_[o + 1] - first_[o]; };
  std::sort(order_, order_ + observations, [&](Index a, Index b) {
    return candidates_of(a) != candidates_of(b) ? candidates_of(a) < candidates_of(b) : a < b;
  });
  // Observations without candidates take no part in the search.
  while (observations_ > 0 && candidates_of(order_[0]) == 0) {
    std::rotate(order_, order_ + 1, order_ + observations_);
    --observations_;
  }
  search(0, 0, 0.0);
}

// Extends the Cholesky factor of the current set of `pairs` pairs by a candidate c and returns the growth of the joint
// distance, or infinity if the covariance of c given the set is not positive definite. With L L^T = S of the set,
//   L' = [L 0; X^T L_c],  X = L^-1 S_set,c,  L_c L_c^T = S_cc - X^T X,  y_c = L_c^-1 (nu_c - X^T y),
// and the distance grows by |y_c|^2 (docs/association.md). The rows of L are packed, so that the rows of the set stay
// in place.
double Association::extend(Index candidate, Index pairs) {
  const Index k = rows_, n = k * pairs;
  double block[kMostRows * kMostRows], nu[kMostRows];
  for (Index p = 0; p < pairs; ++p) {
    innovations_->covariance(candidate, current_[p], block);
    for (Index r = 0; r < k; ++r)
      for (Index c = 0; c < k; ++c) factor_[row_start(n + r) + k * p + c] = block[c * k + r];
  }
  innovations_->covariance(candidate, candidate, block);
  innovations_->innovation(candidate, nu);
  double grown = 0.0;
  for (Index r = 0; r < k; ++r) {
    double* row = factor_ + row_start(n + r);
    for (Index c = 0; c <= r; ++c) row[n + c] = block[c * k + r];
    for (Index i = 0; i < n + r; ++i) {
      const double* L = factor_ + row_start(i);
      row[i] = (row[i] - dot(L, row, i)) / L[i];
    }
    const double pivot = row[n + r] - dot(row, row, n + r);
    if (!(pivot > 0.0)) return kNever;
    row[n + r] = std::sqrt(pivot);
    const double y = (nu[r] - dot(row, whitened_, n + r)) / row[n + r];
    whitened_[n + r] = y;
    grown += y * y;
  }
  return grown;
}

// Extends the current set by one more observation: by each compatible candidate, the best first, then by none.
void Association::search(Index depth, Index pairs, double distance) {
  if (depth == observations_) {
    if (!better(pairs, distance)) return;
    for (Index d = 0; d < observations_; ++d) best_[order_[d]] = kUnpaired;
    for (Index p = 0; p < pairs; ++p) best_[candidates_[current_[p]].observation] = current_[p];
    best_pairs_ = pairs;
    best_distance_ = distance;
    return;
  }
  const Index o = order_[depth], rest = observations_ - depth - 1;
  const Index begin = first_[o], end = first_[o + 1];
  const double bound = innovations_->threshold(rows_ * (pairs + 1));
  Index* fitting = queue_ + begin;  // each observation has its own part of the queue
  Index count = 0, extended = kUnpaired;
  for (Index c = begin; c < end; ++c) {
    if (taken_[candidates_[c].landmark] != 0) continue;
    joint_[c] = distance + extend(c, pairs);
    extended = c;
    ++nodes_;
    if (joint_[c] <= bound) fitting[count++] = c;
  }
  std::sort(fitting, fitting + count,
            [&](Index a, Index b) { return joint_[a] != joint_[b] ? joint_[a] < joint_[b] : a < b; });
  // Deeper calls use the parts of other observations, so this list stays valid.
  for (Index i = 0; i < count; ++i) {
    const Index c = fitting[i];
    // At best, all remaining observations are matched without adding distance.
    if (!better(pairs + 1 + rest, joint_[c])) break;
    if (i > 0 && nodes_ >= budget_) {
      exhausted_ = true;
      return;
    }
    if (c != extended) extend(c, pairs);
    extended = kUnpaired;  // deeper calls overwrite the rows of this candidate
    current_[pairs] = c;
    taken_[candidates_[c].landmark] = 1;
    search(depth + 1, pairs + 1, joint_[c]);
    taken_[candidates_[c].landmark] = 0;
  }
  if (!better(pairs + rest, distance)) return;
  if (count > 0 && nodes_ >= budget_) {
    exhausted_ = true;
    return;
  }
  search(depth + 1, pairs, distance);
}

}  // namespace cairn
