// SPDX-License-Identifier: BSD-3-Clause
// Quantiles are slow: each is computed once.
#include "slam/thresholds.hpp"

#include "core/chi_square.hpp"

namespace cairn {

Thresholds::Thresholds(Arena& arena, const Probabilities& probabilities, Index most_rows)
    : probabilities_(probabilities),
      joint_(arena.take<double>(static_cast<std::size_t>(most_rows + 1))),
      known_(arena.take<bool>(static_cast<std::size_t>(most_rows + 1))) {
  if (arena.measuring()) return;
  for (Index rows = 1; rows <= kMostSingle; ++rows)
    single_[rows] = chi_square_quantile(static_cast<double>(rows), probabilities.single);
  for (Index rows = 1; rows <= kMostNew; ++rows)
    new_landmark_[rows] = chi_square_quantile(static_cast<double>(rows), probabilities.new_landmark);
}

double Thresholds::single(Index rows) const {
  return rows <= kMostSingle ? single_[rows] : chi_square_quantile(static_cast<double>(rows), probabilities_.single);
}

double Thresholds::joint(Index rows) {
  if (!known_[rows]) {
    joint_[rows] = chi_square_quantile(static_cast<double>(rows), probabilities_.joint);
    known_[rows] = true;
  }
  return joint_[rows];
}

}  // namespace cairn
