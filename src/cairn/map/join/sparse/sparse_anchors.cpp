// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_anchors.hpp"

#include <Eigen/Cholesky>

namespace cairn {

template <class Pose>
typename SparseAnchors<Pose>::Square SparseAnchors<Pose>::prior_information() const {
  // An exactly known value counts as known to a micrometre and to a tenth of a microradian.
  Square covariance = prior_covariance_;
  for (int i = 0; i < Pose::kDof; ++i) covariance(i, i) += i < Pose::kDim ? 1e-12 : 1e-14;
  const typename Pose::Tangent scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const Square scaled = scale.asDiagonal() * covariance * scale.asDiagonal();
  return scale.asDiagonal() * scaled.ldlt().solve(Square::Identity()) * scale.asDiagonal();
}

template class SparseAnchors<SE2>;
template class SparseAnchors<SE3>;

}  // namespace cairn
