// SPDX-License-Identifier: BSD-3-Clause
// Damped Gauss-Newton on the sparse map's factor. The factor may be of older linearisation points; the gradient never
// is, so that what the steps converge to is the minimum.
#include <algorithm>
#include <cmath>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "map/sparse_undo.hpp"

namespace cairn {

template <class Visit>
void SparseMap::for_leaves_of(Variable v, Visit&& visit) const {
  const auto number = static_cast<Number>(v >> 1);
  if (is_landmark(v)) {
    for (const Number leaf : landmarks_[number].submaps) visit(leaf);
    return;
  }
  if (number > 0) visit(number - 1);
  if (number < leaves_.size()) visit(number);
}

void SparseMap::gradient_of(Variable v, double* b) const {
  for_leaves_of(v, [&](Number number) {
    const Leaf& leaf = leaves_[number];
    const auto at = std::lower_bound(leaf.variables.begin(), leaf.variables.end(), v) - leaf.variables.begin();
    for (Index d = 0; d < dimension(v); ++d) b[d] -= leaf.gradient(leaf.states[at] + d);
  });
}

// One linear solution: the steps worth taking.
class SparseMap::Step final : public EliminationTree::System {
 public:
  explicit Step(const SparseMap& map) : map_(map), tolerance_(map.options_.step_tolerance) {}

  void right_hand_side(Variable v, double* b, Index) const override { map_.gradient_of(v, b); }
  bool solution(Variable v, const double* x, Index, const double* weight) override {
    Entry entry{v, {}};
    double sigmas = 0.0;
    for (Index d = 0; d < dimension(v); ++d) {
      entry.value[d] = x[d];
      sigmas = std::max(sigmas, std::abs(x[d]) * weight[d]);
    }
    if (!(sigmas >= tolerance_)) return false;
    largest = std::max(largest, sigmas);
    entries.push_back(entry);
    return true;
  }

  struct Entry {
    Variable variable;
    double value[6];
  };
  std::vector<Entry> entries;
  double largest = 0.0;

 private:
  const SparseMap& map_;
  double tolerance_;
};

// Iterates from where `dirty` leaves, and those that an earlier change left unsettled, pull.
void SparseMap::optimise(std::vector<Number> dirty, Undo& undo, JoinReport& report, int most_iterations) {
  constexpr int kHalvings = 6;
  dirty.insert(dirty.end(), unsettled_.begin(), unsettled_.end());
  unsettled_.clear();
  for (int i = 0; i < most_iterations && !dirty.empty(); ++i) {
    std::vector<EliminationTree::Touch> touches;
    for (const Number leaf : dirty) touches.push_back(tree_.touch(leaves_[leaf].key));
    Step step(*this);
    tree_.solve(std::move(touches), 1, step);
    ++report.iterations;
    if (step.entries.empty()) return;

    std::vector<Number> pulled;
    for (const Step::Entry& entry : step.entries)
      for_leaves_of(entry.variable, [&](Number leaf) { pulled.push_back(leaf); });
    std::sort(pulled.begin(), pulled.end());
    pulled.erase(std::unique(pulled.begin(), pulled.end()), pulled.end());
    double before = 0.0;
    for (const Number leaf : pulled) {
      save_leaf(undo, leaf);
      before += leaves_[leaf].cost;
    }
    std::vector<SE3> bases;
    std::vector<Vector3> positions;
    for (const Step::Entry& entry : step.entries) {
      const auto number = static_cast<Number>(entry.variable >> 1);
      if (is_landmark(entry.variable)) {
        save_landmark(undo, number);
        positions.push_back(landmarks_[number].position);
      } else {
        save_base(undo, number);
        bases.push_back(bases_[number]);
      }
    }
    // The step is a direction of descent: it is halved until the cost falls.
    double factor = 1.0, after = 0.0;
    for (int halving = 0; halving <= kHalvings; ++halving, factor *= 0.5) {
      std::size_t base = 0, position = 0;
      for (const Step::Entry& entry : step.entries) {
        const auto number = static_cast<Number>(entry.variable >> 1);
        if (is_landmark(entry.variable))
          landmarks_[number].position = positions[position++] + factor * Eigen::Map<const Vector3>(entry.value);
        else
          bases_[number] = retract(bases[base++], Vector6(factor * Eigen::Map<const Vector6>(entry.value)));
      }
      after = 0.0;
      for (const Number leaf : pulled) {
        evaluate(leaf);
        after += leaves_[leaf].cost;
      }
      if (after <= before * (1.0 + 1e-9) + 1e-9) break;
    }
    if (!std::isfinite(after))
      throw Error(ErrorCode::numerical, "submap: the map's landmarks would not stay finite; nothing was changed");
    dirty = std::move(pulled);
    if (factor == 1.0 && step.largest < options_.convergence_tolerance) return;
  }
  unsettled_ = std::move(dirty);
}

// A fix of the newest base.
FixReport SparseMap::fix(const AbsoluteFix& fix, double threshold) {
  FixReport report;
  const int rows = fix.rows();
  const SE3 T = bases_.back();
  if (!fix.defined(T)) return report;
  const Eigen::MatrixXd J = fix.jacobian(T).topRows(rows);
  const Eigen::VectorXd r = fix.residual(T).head(rows);
  const Eigen::MatrixXd S = J * base_covariance_ * J.transpose() + fix.covariance().topLeftCorner(rows, rows);
  report.distance = r.dot(S.ldlt().solve(r));
  report.accepted = report.distance <= threshold;
  if (!report.accepted) return report;
  if (leaves_.empty()) {  // nothing but the prior, in one linearisation
    const Eigen::MatrixXd PJ = base_covariance_ * J.transpose();
    const Vector6 e = PJ * S.ldlt().solve(r);
    const Matrix6 lower = base_covariance_ - PJ * S.ldlt().solve(PJ.transpose());
    bases_[0] = prior_ = retract(T, e);
    base_covariance_ = prior_covariance_ = lower.selfadjointView<Eigen::Lower>();
    report.iterations = 1;
    return report;
  }
  Undo undo(*this, ++change_);
  JoinReport joined;
  try {
    const auto leaf = static_cast<Number>(leaves_.size() - 1);
    fixes_[leaf + 1].push_back(fix);
    save_leaf(undo, leaf);
    evaluate(leaf);
    EliminationTree::Changes changes;
    changes.leaves.push_back(leaves_[leaf].key);
    refactor(std::move(changes), undo, joined);
    optimise({leaf}, undo, joined, options_.most_iterations);
    finish(undo, joined);
  } catch (...) {
    roll_back(undo);
    throw;
  }
  report.iterations = joined.iterations;
  return report;
}

}  // namespace cairn
