// SPDX-License-Identifier: BSD-3-Clause
// A mount whose error all rows of a frame share, against a dense filter that has the mount in its state. The residuals
// are zero, so that the estimates do not change and both error models give the same result in ordinary errors.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>

#include "ekf/ekf_update.hpp"
#include "ekf/sample_state.hpp"
#include "numerical.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

constexpr ErrorKind kBoth[] = {ErrorKind::invariant, ErrorKind::standard};

}  // namespace

TEST_CASE_TEMPLATE("ekf update: a mount whose errors are correlated is part of the state while a frame lasts", Pose,
                   SE2, SE3) {
  using Dynamic = Eigen::MatrixXd;
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof, kMount = kMountErrors<Pose>;
  constexpr Index kPoints = SampleState<Pose>::kPoints, kSeen = 3, kRows = kDim * kSeen;
  const Index slots[] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  for (const ErrorKind error : kBoth)
    for (unsigned seed = 17; seed <= 22; ++seed) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(seed);
      SampleState<Pose> sample(error, seed);
      State<Pose>& state = sample.state;
      Random random(seed + 100);
      const auto fill = [&](auto&& matrix) {
        for (Index c = 0; c < matrix.cols(); ++c)
          for (Index r = 0; r < matrix.rows(); ++r) matrix(r, c) = random.normal();
      };
      // The dense state is [pose; points; mount].
      const Index n = kDof + kDim * kPoints, all = n + kMount;
      const MountSquare<Pose> mount_noise = random_square<kMount>(random, 0.2);
      Dynamic P = Dynamic::Zero(all, all), before(n, n);
      state.gather_ordinary(slots, kPoints, before.data(), n);
      P.topLeftCorner(n, n) = before;
      P.bottomRightCorner(kMount, kMount) = mount_noise;
      Dynamic H = Dynamic::Zero(kRows, all), noise = Dynamic::Zero(kRows, kRows);
      fill(H.leftCols(kDof));
      for (Index a = 0; a < kSeen; ++a) {
        fill(H.block(kDim * a, kDof + kDim * (2 * a + 1), kDim, kDim));
        noise.block(kDim * a, kDim * a, kDim, kDim) = random_square<kDim>(random, 0.1);
      }
      fill(H.rightCols(kMount));

      const Index seen[] = {1, 3, 5};
      EkfUpdate<Pose> update = state.begin({seen, kSeen, &mount_noise});
      update.linearise([&](double*) {
        for (Index a = 0; a < kSeen; ++a) {
          const Index row = update.batch().add_rows(kDim);
          const auto pose = update.add_pose_block(row, kDim, H.block(row, 0, kDim, kDof), false);
          update.add_landmark_block(row, kDim, H.block(row, kDof + kDim * seen[a], kDim, kDim), a, pose);
          update.add_mount_block(row, kDim, H.block(row, n, kDim, kMount));
          Eigen::Map<typename State<Pose>::PointSquare>(update.batch().add_noise(row, kDim)) =
              noise.block(row, row, kDim, kDim);
          std::fill_n(update.batch().residual() + row, kDim, 0.0);
        }
        return true;
      });
      update.factor();
      update.solve();
      update.commit();
      const Dynamic S = H * P * H.transpose() + noise, K = P * H.transpose() * S.inverse();
      P = (P - K * S * K.transpose()).eval();

      typename State<Pose>::PointByPose J_pose;
      typename State<Pose>::PointByMount J_mount;
      fill(J_pose);
      fill(J_mount);
      const typename State<Pose>::PointSquare own = random_square<kDim>(random, 0.1);
      REQUIRE(update.place(Pose::Point::Constant(3), J_pose, &J_mount, own, false));
      Dynamic T = Dynamic::Zero(n + kDim, all);  // from [pose; points; mount] to [pose; points; new point]
      T.topLeftCorner(n, n).setIdentity();
      T.block(n, 0, kDim, kDof) = J_pose;
      T.block(n, n, kDim, kMount) = J_mount;
      Dynamic expected = T * P * T.transpose(), after(n + kDim, n + kDim);
      expected.bottomRightCorner(kDim, kDim) += own;
      state.gather_ordinary(slots, kPoints + 1, after.data(), n + kDim);
      const Eigen::VectorXd scale = expected.diagonal().cwiseSqrt().cwiseInverse();
      CHECK((scale.asDiagonal() * (after - expected) * scale.asDiagonal()).cwiseAbs().maxCoeff() < 1e-9);
      CHECK(state.smallest_pivot() > 0);
    }
}
