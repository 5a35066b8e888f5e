// SPDX-License-Identifier: BSD-3-Clause
// The gates of an update's batch, against a search that inverts the innovation of every subset; and the update with the
// remaining blocks.
#include "ekf/update_gates.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <limits>
#include <vector>

#include "core/chi_square.hpp"
#include "ekf/sample_state.hpp"
#include "linear/gate_reference.hpp"
#include "numerical.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

using Dynamic = Eigen::MatrixXd;
using DynamicVector = Eigen::VectorXd;
constexpr ErrorKind kBoth[] = {ErrorKind::invariant, ErrorKind::standard};
constexpr Index kPoints = 8;

// Rows of a batch, one block for each point, by ordinary errors.
template <class Pose>
struct Rows {
  static constexpr int kDim = Pose::kDim, kDof = Pose::kDof;

  Rows(const State<Pose>& state, Random& random, Index count) {
    for (Index a = 0; a < count; ++a) slots.push_back((3 * a + 1) % kPoints);  // all different
    const Index m = kDim * count, n = kDof + m;
    H = Dynamic::Zero(m, n);
    noise = Dynamic::Zero(m, m);
    for (Index a = 0; a < count; ++a) {
      const Index row = kDim * a;
      for (Index c = 0; c < kDof; ++c) H.col(c).segment(row, kDim) = random.normal_vector<kDim>();
      for (Index c = 0; c < kDim; ++c) H.col(kDof + row + c).segment(row, kDim) = random.normal_vector<kDim>();
      noise.block(row, row, kDim, kDim) = random_square<kDim>(random, 0.2);
    }
    Dynamic P(n, n);
    state.gather_ordinary(slots.data(), count, P.data(), n);
    S = H * P * H.transpose() + noise;
    residual = DynamicVector(m);
    for (Index i = 0; i < m; ++i) residual[i] = random.normal();
    if (m > 0) residual = (S.llt().matrixL() * residual).eval();
    for (Index a = 0; a < count; ++a)
      if (random.uniform(0, 1) < 0.3) residual.segment(kDim * a, kDim) += 2 * random.normal_vector<kDim>();
  }

  // Fills a batch whose window holds all slots with the rows of chosen blocks.
  void fill(EkfUpdate<Pose>& update, const std::vector<Index>& blocks) const {
    update.batch().clear();
    for (const Index a : blocks) {
      const Index from = kDim * a, row = update.batch().add_rows(kDim);
      const auto pose = update.add_pose_block(row, kDim, H.block(from, 0, kDim, kDof), false);
      update.add_landmark_block(row, kDim, H.block(from, kDof + from, kDim, kDim), a, pose);
      Eigen::Map<Eigen::Matrix<double, kDim, kDim>>(update.batch().add_noise(row, kDim)) =
          noise.block(from, from, kDim, kDim);
      Eigen::Map<typename Pose::Point>(update.batch().residual() + row) = residual.segment(from, kDim);
    }
  }

  std::vector<Index> slots;
  Dynamic H, noise, S;
  DynamicVector residual;
};

}  // namespace

TEST_CASE_TEMPLATE("update gates: an update's gates refuse what an exhaustive search refuses", Pose, SE2, SE3) {
  constexpr int kDim = Pose::kDim;
  int single_ones = 0, joint_ones = 0, kept = 0;
  for (const ErrorKind error : kBoth)
    for (unsigned seed = 1; seed <= 60; ++seed) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(seed);
      const Index count = seed % (kPoints + 1);
      SampleState<Pose> world(error, seed), twin(error, seed);
      Random random(seed + 1000);
      const Rows<Pose> rows(world.state, random, count);
      std::vector<Index> all;
      for (Index a = 0; a < count; ++a) all.push_back(a);
      const auto bound = [](Index left) {
        REQUIRE(left > 0);
        return chi_square_quantile(static_cast<double>(left), 0.9);
      };
      const double single = seed % 2 == 0 ? chi_square_quantile(kDim, 0.99) : std::numeric_limits<double>::infinity();
      const GateResult expected = exhaustive_gates(rows.S, rows.residual, kDim, single, bound);

      EkfUpdate<Pose> update = world.state.begin({rows.slots.data(), count});
      update.linearise([&](double*) { return rows.fill(update, all), true; });
      UpdateGates<Pose> gates(update, kDim);
      RefusalLog log(count);
      gate_blocks(gates, kDim, single, bound, log);
      CHECK(same_refusals(log.refusals, expected.refusals));
      REQUIRE(update.batch().rows() == kDim * static_cast<Index>(expected.kept.size()));
      CHECK(update.nis() == doctest::Approx(expected.distance).epsilon(1e-8));
      CHECK(same_bits(bits_of(world.state), bits_of(twin.state)));  // the gates leave the state as it is

      // The update with the remaining blocks equals an update that never had the other blocks.
      update.solve();
      update.commit();
      EkfUpdate<Pose> direct = twin.state.begin({rows.slots.data(), count});
      direct.linearise([&](double*) { return rows.fill(direct, expected.kept), true; });
      direct.factor();
      direct.solve();
      direct.commit();
      CHECK(same_bits(bits_of(world.state), bits_of(twin.state)));

      for (const Refusal& refusal : expected.refusals) ++(refusal.gate == Gate::single ? single_ones : joint_ones);
      kept += static_cast<int>(expected.kept.size());
    }
  CHECK(single_ones > 20);
  CHECK(joint_ones > 40);
  CHECK(kept > 150);
}
