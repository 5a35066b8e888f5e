// SPDX-License-Identifier: BSD-3-Clause
// Both gates of a batch without any shortcut: every distance comes from Eigen's inverse of the blocks that are left.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "linear/joint_gate.hpp"

namespace cairn::test {

// One block that a gate refused, by its number in the whole batch.
struct Refusal {
  Gate gate;
  Index block;
  double distance, bound;
};

struct GateResult {
  std::vector<Refusal> refusals;  // in their order
  std::vector<Index> kept;
  double distance;  // of the kept blocks, jointly
};

// Joint squared Mahalanobis distance of chosen blocks of `rows` rows.
inline double exhaustive_distance(const Eigen::MatrixXd& S, const Eigen::VectorXd& residual, Index rows,
                                  const std::vector<Index>& blocks) {
  std::vector<Index> chosen;
  for (const Index block : blocks)
    for (Index r = 0; r < rows; ++r) chosen.push_back(block * rows + r);
  if (chosen.empty()) return 0.0;
  const Eigen::MatrixXd part = S(chosen, chosen);
  const Eigen::VectorXd r = residual(chosen);
  return r.dot(part.inverse() * r);
}

inline std::vector<Index> without(std::vector<Index> blocks, Index position) {
  blocks.erase(blocks.begin() + position);
  return blocks;
}

// The single gate judges each block by itself. The joint gate then refuses the block without which the distance of the
// rest is smallest, until the rest is within its bound.
template <class Bound>
GateResult exhaustive_gates(const Eigen::MatrixXd& S, const Eigen::VectorXd& residual, Index rows, double single,
                            Bound&& bound) {
  GateResult result;
  for (Index a = 0; a < residual.size() / rows; ++a) {
    const double distance = exhaustive_distance(S, residual, rows, {a});
    if (distance <= single)
      result.kept.push_back(a);
    else
      result.refusals.push_back({Gate::single, a, distance, single});
  }
  for (;;) {
    result.distance = exhaustive_distance(S, residual, rows, result.kept);
    const Index left = static_cast<Index>(result.kept.size());
    if (left == 0 || result.distance <= bound(left * rows)) return result;
    Index worst = 0;
    double smallest = 0.0;
    for (Index k = 0; k < left; ++k) {
      const double rest = exhaustive_distance(S, residual, rows, without(result.kept, k));
      if (k == 0 || rest < smallest) smallest = rest, worst = k;
    }
    result.refusals.push_back(
        {Gate::joint, result.kept[static_cast<std::size_t>(worst)], result.distance, bound(left * rows)});
    result.kept = without(result.kept, worst);
  }
}

// The blocks that gate_blocks() refuses, by their numbers in the whole batch: the joint gate itself counts only the
// blocks that the single gate left.
class RefusalLog {
 public:
  explicit RefusalLog(Index count) {
    for (Index a = 0; a < count; ++a) left_.push_back(a);
  }
  void operator()(Gate gate, Index block, double distance, double bound) {
    if (gate == Gate::joint && !joint_) {
      for (std::size_t i = refusals.size(); i-- > 0;) left_ = without(left_, refusals[i].block);
      joint_ = true;
    }
    refusals.push_back({gate, left_[static_cast<std::size_t>(block)], distance, bound});
  }
  std::vector<Refusal> refusals;

 private:
  std::vector<Index> left_;
  bool joint_ = false;
};

// Whether both name the same blocks in the same order, at distances that agree to 1e-9 of their size.
inline bool same_refusals(const std::vector<Refusal>& a, const std::vector<Refusal>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double scale = 1 + std::abs(b[i].distance);
    if (a[i].gate != b[i].gate || a[i].block != b[i].block || a[i].bound != b[i].bound) return false;
    if (!(std::abs(a[i].distance - b[i].distance) <= 1e-9 * scale)) return false;
  }
  return true;
}

}  // namespace cairn::test
