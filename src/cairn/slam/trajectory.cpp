// SPDX-License-Identifier: BSD-3-Clause
#include "slam/trajectory.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace cairn {

template <class Pose>
Trajectory<Pose>::Trajectory(Arena& arena, Index capacity)
    : capacity_(static_cast<std::uint64_t>(capacity)),
      poses_(arena.take<Local>(static_cast<std::size_t>(capacity))),
      ends_(arena.take<Local>(static_cast<std::size_t>(capacity))) {}

template <class Pose>
void Trajectory<Pose>::add(std::uint64_t submap, const Pose& T_base_body, const Square& covariance) {
  if (capacity_ == 0) return;
  poses_[end_ % capacity_] = pack(submap, T_base_body, covariance);
  ++end_;
}

template <class Pose>
void Trajectory<Pose>::end_submap(std::uint64_t submap, const Pose& T_base_end, const Square& covariance) {
  if (capacity_ == 0) return;
  ends_[submap % capacity_] = pack(submap, T_base_end, covariance);
}

template <class Pose>
typename Trajectory<Pose>::Local Trajectory<Pose>::pack(std::uint64_t submap, const Pose& T_base_body,
                                                        const Square& covariance) {
  Local local{submap, T_base_body, {}};
  const Square own = ErrorModel<Pose>(ErrorKind::invariant).own(covariance, T_base_body.translation());
  double* next = local.covariance;
  for (int r = 0; r < kDof; ++r)
    for (int c = 0; c <= r; ++c) *next++ = own(r, c);
  return local;
}

template <class Pose>
typename Trajectory<Pose>::Square Trajectory<Pose>::covariance_of(const Local& local) {
  Square covariance;
  const double* next = local.covariance;
  for (int r = 0; r < kDof; ++r)
    for (int c = 0; c <= r; ++c) covariance(r, c) = covariance(c, r) = *next++;
  return covariance;
}

// docs/trajectory.md, eq. (3)
template <class Pose>
typename Trajectory<Pose>::Square Trajectory<Pose>::gain(const Local& local, const Local& end) {
  Square C_end = covariance_of(end);
  // The end may be known exactly along an axis. The jitter is for a covariance that is singular along a diagonal.
  constexpr double kJitter = 1e-9;
  for (int i = 0; i < kDof; ++i) C_end(i, i) = C_end(i, i) > 0.0 ? (1.0 + kJitter) * C_end(i, i) : 1.0;
  const Eigen::LLT<Square> factor(C_end);
  if (factor.info() != Eigen::Success) return Square::Zero();
  const auto L = factor.matrixL();
  const Square half = L.solve(covariance_of(local));
  const Square white = L.solve(Square(half.transpose()));  // L^-1 C L^-T
  const Eigen::SelfAdjointEigenSolver<Square> eigen(white);
  const auto shares = eigen.eigenvalues().cwiseMax(0.0).cwiseMin(1.0);
  const Square inverse = L.solve(Square(Square::Identity()));
  return L * Square(eigen.eigenvectors() * shares.asDiagonal() * eigen.eigenvectors().transpose()) * inverse;
}

template <class Pose>
Pose Trajectory<Pose>::pose(std::uint64_t number, const GlobalMap<Pose>* map, const Open& open) const {
  const Local& local = poses_[number % capacity_];
  if (map == nullptr) return local.T_base_body;
  const std::size_t submap = local.submap, closed = map->submap_count();
  const bool is_open = submap == closed;
  const Pose T_map_base = is_open ? open.base_ : map->submap_base(submap);
  const Pose T_map_end = is_open ? open.end_ : submap + 1 == closed ? map->base() : map->submap_base(submap + 1);
  const Local& end = is_open ? open.local_ : ends_[submap % capacity_];
  // docs/trajectory.md, eq. (2): the correction of the submap's end.
  const typename Pose::Tangent correction = (T_map_base.inverse() * T_map_end * end.T_base_body.inverse()).log();
  // eq. (4)
  const typename Pose::Tangent share = gain(local, end) * correction;
  return T_map_base * Pose::exp(share) * local.T_base_body;
}

template class Trajectory<SE2>;
template class Trajectory<SE3>;

}  // namespace cairn
