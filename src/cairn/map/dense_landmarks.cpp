// SPDX-License-Identifier: BSD-3-Clause
#include "map/dense_landmarks.hpp"

#include <Eigen/Cholesky>
#include <numeric>

#include "core/error.hpp"

namespace cairn {
namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;

Index at(std::size_t i) {
  return 3 * static_cast<Index>(i);
}

// Blocks of a covariance; if R is given, each is turned by R on both sides.
Matrix blocks(const Matrix& from, const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns,
              const Matrix3* R = nullptr) {
  Matrix out(at(rows.size()), at(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Matrix3 block = from.block<3, 3>(at(rows[r]), at(columns[c]));
      out.block<3, 3>(at(r), at(c)) = R != nullptr ? Matrix3(*R * block * R->transpose()) : block;
    }
  return out;
}

}  // namespace

DenseLandmarks::DenseLandmarks(const Landmarks& source) : planar_(source.planar()) {
  const std::size_t n = source.size();
  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), std::size_t{0});
  for (const std::size_t i : all) {
    ids_.push_back(source.id(i));
    counts_.push_back(source.observations(i));
    positions_.push_back(source.position(i));
    slots_.emplace(ids_.back(), i);
  }
  covariance_.resize(at(n), at(n));
  if (n > 0) source.joint_covariance(all.data(), n, covariance_.data());
}

// The errors e_a, e_b and those of the transform, tau, obey e_a,K - R e_b,K - G tau = -r for the common landmarks K,
// where r = a_K - T b_K and G = [I, -hat(R b)]. With S = Cov(e_a,K - R e_b,K), V = S^-1 G and C = Cov(tau), and the
// states x = [a; T b of the landmarks F that only the other map holds]:
//   x_hat += X S^-1 r    with X = [-P_a,K; R P_b,FK R^T]
//   P      = blkdiag(P_a, R P_b,FF R^T) - X S^-1 X^T + Q C Q^T    with Q = [P_a,K V; G_F - R P_b,FK R^T V]
// T minimises the distance. Without a prior, G^T S^-1 r = 0; with a prior, the rest of it is the prior's share: no
// landmark needs a second correction. docs/map_merging.md.
DenseLandmarks::DenseLandmarks(const DenseLandmarks& map, const DenseLandmarks& other, const MergePlan& plan)
    : ids_(map.ids_), counts_(map.counts_), positions_(map.positions_), slots_(map.slots_) {
  const SE3& T = plan.alignment.T_a_b;
  const Matrix3 R = T.rotation().matrix();
  std::vector<std::size_t> all(map.size()), in_map, in_other, fresh;
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<char> common(other.size(), 0);
  for (const auto& [i, j] : plan.pairs) {
    in_map.push_back(i);
    in_other.push_back(j);
    common[j] = 1;
    counts_[i] += other.counts_[j];
  }
  for (std::size_t j = 0; j < other.size(); ++j) {
    if (common[j] != 0) continue;
    slots_.emplace(plan.ids[j], ids_.size());
    ids_.push_back(plan.ids[j]);
    counts_.push_back(other.counts_[j]);
    positions_.push_back(T * other.positions_[j]);
    fresh.push_back(j);
  }
  const std::size_t k = in_map.size();
  const Index n_map = at(map.size()), n_fresh = at(fresh.size()), n = n_map + n_fresh;

  Matrix X(n, at(k));
  X.topRows(n_map) = -blocks(map.covariance_, all, in_map);
  X.bottomRows(n_fresh) = blocks(other.covariance_, fresh, in_other, &R);
  const Matrix of_other = blocks(other.covariance_, in_other, in_other, &R);
  const Eigen::LLT<Matrix> S(blocks(map.covariance_, in_map, in_map) + of_other);
  if (S.info() != Eigen::Success)
    throw Error(ErrorCode::numerical, "other: the common landmarks' joint covariance is not positive definite");
  Eigen::VectorXd lambda(at(k));
  for (std::size_t i = 0; i < k; ++i)
    lambda.segment<3>(at(i)) = map.positions_[in_map[i]] - T * other.positions_[in_other[i]];
  S.solveInPlace(lambda);
  const Eigen::VectorXd correction = X * lambda, other_correction = of_other * lambda;
  for (std::size_t i = 0; i < positions_.size(); ++i) positions_[i] += correction.segment<3>(at(i));

  // Turns are about the common landmarks' centre: far from the frame's origin the effects of dp and dtheta would be
  // nearly equal, and cancel.
  Vector3 centre = Vector3::Zero();
  for (const std::size_t j : in_other) centre += R * other.positions_[j] / static_cast<double>(k);
  Matrix6 to_centre = Matrix6::Identity();
  to_centre.topRightCorner<3, 3>() = -hat(centre);
  const Matrix6 C = to_centre * plan.alignment.covariance * to_centre.transpose();
  const auto by_transform = [&](const Vector3& x) {  // of a point at x in the frame of `map`
    Matrix36 G;
    G << Matrix3::Identity(), -hat(Vector3(x - T.translation() - centre));
    return G;
  };
  Eigen::Matrix<double, Eigen::Dynamic, 6> V(at(k), 6), Q(n, 6);
  for (std::size_t i = 0; i < k; ++i)
    V.middleRows<3>(at(i)) = by_transform(T * other.positions_[in_other[i]] + other_correction.segment<3>(at(i)));
  S.solveInPlace(V);
  Q.noalias() = -(X * V);
  for (std::size_t i = 0; i < fresh.size(); ++i)
    Q.middleRows<3>(n_map + at(i)) += by_transform(positions_[map.size() + i]);

  covariance_ = Matrix::Zero(n, n);
  covariance_.topLeftCorner(n_map, n_map) = map.covariance_;
  covariance_.bottomRightCorner(n_fresh, n_fresh) = blocks(other.covariance_, fresh, fresh, &R);
  const Matrix W = S.matrixL().solve(X.transpose());
  covariance_.selfadjointView<Eigen::Lower>().rankUpdate(W.transpose(), -1.0);
  covariance_.triangularView<Eigen::Lower>() += Q * C * Q.transpose();
  covariance_.triangularView<Eigen::StrictlyUpper>() = covariance_.transpose();
  for (std::size_t i = 0; i < positions_.size(); ++i)
    if (!positions_[i].allFinite() || covariance(i).llt().info() != Eigen::Success)
      throw Error(ErrorCode::numerical, "other: the covariance of landmark %llu would lose positive definiteness",
                  static_cast<unsigned long long>(ids_[i]));
}

Matrix3 DenseLandmarks::covariance(std::size_t index) const {
  return covariance_.block<3, 3>(at(index), at(index));
}

bool DenseLandmarks::find(std::uint64_t id, std::size_t& index) const {
  const auto found = slots_.find(id);
  if (found == slots_.end()) return false;
  index = found->second;
  return true;
}

void DenseLandmarks::joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  Eigen::Map<Matrix> out(matrix, at(count), at(count));
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t r = 0; r < count; ++r)
      out.block<3, 3>(at(r), at(c)) = covariance_.block<3, 3>(at(indices[r]), at(indices[c]));
}

}  // namespace cairn
