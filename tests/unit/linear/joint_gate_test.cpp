// SPDX-License-Identifier: BSD-3-Clause
// Both gates on random batches with outliers, against a search that inverts the innovation of every subset.
#include "linear/joint_gate.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <limits>
#include <memory>
#include <vector>

#include "core/chi_square.hpp"
#include "linear/gate_reference.hpp"
#include "numerical.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

using Dynamic = Eigen::MatrixXd;
using DynamicVector = Eigen::VectorXd;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A batch for gate_blocks() that consists only of S and a residual.
class PlainBatch {
 public:
  PlainBatch(const Dynamic& S, const DynamicVector& residual, Index rows)
      : S_(S),
        residual_(residual),
        rows_(rows),
        kept_(static_cast<std::size_t>(count())),
        refused_(std::make_unique<bool[]>(static_cast<std::size_t>(count()))) {}

  Index count() const { return residual_.size() / rows_; }
  double distance(Index block) const {
    return squared_distance(residual_.data() + block * rows_, S_.data() + block * rows_ * (S_.rows() + 1), S_.rows(),
                            rows_);
  }
  void keep(const Index* blocks, Index count) {
    std::vector<Index> chosen;
    for (Index k = 0; k < count; ++k)
      for (Index r = 0; r < rows_; ++r) chosen.push_back(blocks[k] * rows_ + r);
    S_ = S_(chosen, chosen).eval();
    residual_ = residual_(chosen).eval();
    ++keeps;
  }
  template <class Bound>
  bool consistent(Bound&& bound) {
    ++judged;
    return count() == 0 || joint_distance() <= bound(residual_.size());
  }
  InverseInnovation invert() {
    inverse_ = S_.inverse();
    u_ = inverse_ * residual_;
    workspace_.resize(static_cast<std::size_t>(rows_ * (rows_ + residual_.size())));
    return {inverse_.data(), u_.data(), u_.dot(residual_), workspace_.data()};
  }
  void refactor() { ++refactored; }
  Index* kept() { return kept_.data(); }
  bool* refused() { return refused_.get(); }

  double joint_distance() const { return count() == 0 ? 0.0 : residual_.dot(S_.llt().solve(residual_)); }
  const DynamicVector& residual() const { return residual_; }
  int keeps = 0, judged = 0, refactored = 0;

 private:
  Dynamic S_;
  DynamicVector residual_;
  Index rows_;
  std::vector<Index> kept_;
  std::unique_ptr<bool[]> refused_;
  Dynamic inverse_;
  DynamicVector u_;
  std::vector<double> workspace_;
};

struct Sample {
  Dynamic S;
  DynamicVector residual;
};

// Blocks that share a part of their error, and some of them wrong by `outlier` sigmas.
Sample random_batch(Random& random, Index count, Index rows, double share, double outlier) {
  const Index m = count * rows;
  Dynamic A(m, m);
  for (Index c = 0; c < m; ++c)
    for (Index r = 0; r < m; ++r) A(r, c) = random.uniform(-1, 1);
  Sample sample{share * A * A.transpose() + Dynamic::Identity(m, m), DynamicVector(m)};
  for (Index i = 0; i < m; ++i) sample.residual[i] = random.normal();
  if (m > 0) sample.residual = (sample.S.llt().matrixL() * sample.residual).eval();
  for (Index a = 0; a < count; ++a)
    if (random.uniform(0, 1) < 0.3)
      for (Index r = 0; r < rows; ++r) sample.residual[a * rows + r] += outlier * random.normal();
  return sample;
}

struct Tally {
  int single = 0, joint = 0, kept = 0, emptied = 0;
};

void check(const Sample& sample, Index count, Index rows, double single, double probability, Tally& tally) {
  const auto bound = [&](Index left) {
    REQUIRE(left > 0);  // a batch without rows has no bound
    return chi_square_quantile(static_cast<double>(left), probability);
  };
  const GateResult expected = exhaustive_gates(sample.S, sample.residual, rows, single, bound);
  PlainBatch batch(sample.S, sample.residual, rows);
  RefusalLog log(count);
  gate_blocks(batch, rows, single, bound, log);
  CHECK(same_refusals(log.refusals, expected.refusals));
  REQUIRE(batch.count() == static_cast<Index>(expected.kept.size()));
  for (Index k = 0; k < batch.count(); ++k)
    CHECK(batch.residual().segment(k * rows, rows) ==
          sample.residual.segment(expected.kept[static_cast<std::size_t>(k)] * rows, rows));
  CHECK(batch.joint_distance() == doctest::Approx(expected.distance).epsilon(1e-9));
  int joint = 0;
  for (const Refusal& refusal : expected.refusals) joint += refusal.gate == Gate::joint;
  const int alone = static_cast<int>(expected.refusals.size()) - joint;
  CHECK(batch.judged == 1);
  CHECK(batch.keeps == (alone > 0) + (joint > 0));
  CHECK(batch.refactored == (joint > 0));
  tally.joint += joint;
  tally.single += alone;
  tally.kept += static_cast<int>(expected.kept.size());
  tally.emptied += count > 0 && expected.kept.empty();
}

}  // namespace

TEST_CASE("joint gate: both gates refuse what an exhaustive search refuses") {
  Random random(1);
  Tally tally;
  for (const Index rows : {1, 2, 3})
    for (Index count = 0; count <= 9; ++count)
      for (int repeat = 0; repeat < 30; ++repeat) {
        CAPTURE(rows);
        CAPTURE(count);
        CAPTURE(repeat);
        const Sample sample = random_batch(random, count, rows, repeat % 3, repeat % 4 == 3 ? 0.0 : 4.0);
        const double single = repeat % 2 == 0 ? kInfinity : chi_square_quantile(static_cast<double>(rows), 0.99);
        check(sample, count, rows, single, 0.9, tally);
      }
  CHECK(tally.single > 100);
  CHECK(tally.joint > 300);
  CHECK(tally.kept > 500);
  CHECK(tally.emptied > 10);
}

TEST_CASE("joint gate: a batch without blocks, and one with a single block") {
  for (const Index rows : {1, 2, 3}) {
    CAPTURE(rows);
    const auto bound = [](Index left) { return 4.0 * static_cast<double>(left); };
    PlainBatch empty(Dynamic(0, 0), DynamicVector(0), rows);
    RefusalLog nothing(0);
    gate_blocks(empty, rows, 1.0, bound, nothing);
    CHECK(nothing.refusals.empty());
    CHECK((empty.judged == 1 && empty.keeps == 0 && empty.refactored == 0));

    // S = I: the distance is the square of the residual's length.
    const Dynamic S = Dynamic::Identity(rows, rows);
    const double joint = 4.0 * static_cast<double>(rows);
    const struct {
      double distance, single;
      int refusals;
      Gate gate;
    } cases[] = {{0.5 * joint, 10 * joint, 0, Gate::joint},
                 {2 * joint, 10 * joint, 1, Gate::joint},
                 {2 * joint, joint, 1, Gate::single},
                 {0.5 * joint, 0.1 * joint, 1, Gate::single}};
    for (const auto& c : cases) {
      DynamicVector residual = DynamicVector::Zero(rows);
      residual[rows - 1] = std::sqrt(c.distance);
      PlainBatch one(S, residual, rows);
      RefusalLog log(1);
      gate_blocks(one, rows, c.single, bound, log);
      REQUIRE(log.refusals.size() == static_cast<std::size_t>(c.refusals));
      CHECK(one.count() == 1 - c.refusals);
      if (c.refusals == 0) continue;
      CHECK((log.refusals[0].gate == c.gate && log.refusals[0].block == 0));
      CHECK(log.refusals[0].distance == doctest::Approx(c.distance));
      CHECK(log.refusals[0].bound == (c.gate == Gate::single ? c.single : joint));
    }
  }
}

TEST_CASE("joint gate: a block whose distance is no number is refused by the single gate, open or not") {
  const Dynamic S = Dynamic::Identity(3, 3);
  DynamicVector residual = DynamicVector::Constant(3, 0.1);
  residual[1] = std::numeric_limits<double>::quiet_NaN();
  PlainBatch batch(S, residual, 1);
  RefusalLog log(3);
  gate_blocks(
      batch, 1, kInfinity, [](Index left) { return 10.0 * static_cast<double>(left); }, log);
  REQUIRE(log.refusals.size() == 1);
  CHECK((log.refusals[0].gate == Gate::single && log.refusals[0].block == 1));
  CHECK(batch.count() == 2);
}
