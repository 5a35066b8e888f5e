// SPDX-License-Identifier: BSD-3-Clause
// A state with landmarks, a companion and pending motion, and all of its bits. The same seed gives the same bits.
#pragma once

#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "ekf/ekf_update.hpp"
#include "numerical.hpp"

namespace cairn::test {

template <int N>
Eigen::Matrix<double, N, N> random_square(Random& random, double sigma) {
  Eigen::Matrix<double, N, N> A = Eigen::Matrix<double, N, N>::Identity();
  for (int i = 0; i < N; ++i) A.col(i) += 0.4 * random.normal_vector<N>();
  return sigma * sigma * A * A.transpose();
}

template <class Pose>
struct SampleState {
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  static constexpr Index kPoints = 8;  // the companion in the first slot, then landmarks
  using Point = typename Pose::Point;
  using PointByPose = Eigen::Matrix<double, kDim, kDof>;

  static typename State<Pose>::Capacity capacity() { return {kPoints + 2, kPoints, 1}; }
  static std::size_t bytes() {
    Arena measure;
    const State<Pose> unused(measure, ErrorKind::standard, capacity());
    return measure.used();
  }

  SampleState(ErrorKind error, unsigned seed) : arena(bytes()), state(arena, error, capacity()) {
    Random random(seed);
    state.start(random_pose(random), random_square<kDof>(random, 0.1));
    for (Index i = 1; i < kPoints; ++i) {
      propagate(random);
      const Point arm = 5 * random.normal_vector<kDim>();
      PointByPose J;
      J << Eigen::Matrix<double, kDim, kDim>::Identity(), Pose::Rotation::turn(arm);
      REQUIRE(state.augment(state.pose().translation() + arm, J, random_square<kDim>(random, 0.1), true));
    }
    REQUIRE(state.add_companion(random_pose(random), Pose::Square::Identity(), random_square<kDof>(random, 0.1)));
    propagate(random);
  }

  static Pose random_pose(Random& random) {
    return Pose(Pose::Rotation::exp(random.normal_vector<kTurn>()), Point(20 * random.normal_vector<kDim>()));
  }
  void propagate(Random& random) {
    Increment<Pose> step;
    step.T_before_after =
        Pose(Pose::Rotation::exp(0.2 * random.normal_vector<kTurn>()), Point(random.normal_vector<kDim>()));
    step.covariance = random_square<kDof>(random, 0.05);
    REQUIRE(state.propagate(step));
  }

  Arena arena;
  State<Pose> state;
};

using Bits = std::vector<double>;

inline void append(const SO2& R, Bits& bits) {
  bits.insert(bits.end(), {R.matrix()(0, 0), R.matrix()(1, 0)});
}
inline void append(const SO3& R, Bits& bits) {
  bits.insert(bits.end(), R.quaternion().coeffs().data(), R.quaternion().coeffs().data() + 4);
}
template <class Matrix>
void append_matrix(const Matrix& A, Bits& bits) {
  bits.insert(bits.end(), A.data(), A.data() + A.size());
}

// Everything that a state holds: estimates, covariance and pending motion.
template <class Pose>
Bits bits_of(const State<Pose>& state) {
  const typename State<Pose>::Backup backup = state.backup();
  Bits bits = backup.triangle;
  append_matrix(backup.pose.translation(), bits);
  append(backup.pose.rotation(), bits);
  bits.insert(bits.end(), backup.points.begin(), backup.points.end());
  for (const auto& attitude : backup.attitudes) append(attitude, bits);
  bits.push_back(backup.motion.any);
  append_matrix(backup.motion.F, bits);
  append_matrix(backup.motion.N, bits);
  return bits;
}

inline bool same_bits(const Bits& a, const Bits& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace cairn::test
