// SPDX-License-Identifier: BSD-3-Clause
// Decides whether a pair that passes its gate may fit by chance (docs/association.md, "Doubt").
#pragma once

#include <limits>

#include "linear/joint_gate.hpp"
#include "geometry/types.hpp"

namespace cairn {

// nu^T S^-1 nu, or infinity if it exceeds the bound. nu_r^2 / S_rr is a lower bound of it, which refuses most pairs
// quickly, because most pairs are far apart.
inline double distance_within(const Vector3& nu, const Matrix3& S, Index rows, double bound) {
  constexpr double kBeyond = std::numeric_limits<double>::infinity();
  for (Index r = 0; r < rows; ++r)
    if (!(nu(r) * nu(r) <= bound * S(r, r))) return kBeyond;
  const double distance = squared_distance(nu.data(), S.data(), 3, rows);
  return distance >= 0.0 && distance <= bound ? distance : kBeyond;
}
inline bool within_bound(const Vector3& nu, const Matrix3& S, Index rows, double bound) {
  return distance_within(nu, S, rows, bound) <= bound;
}

// Doubt about a pair with innovation covariance S, which includes `noise`.
class Doubt {
 public:
  Doubt(const Matrix3& S, const Matrix3& noise, Index rows, double new_threshold)
      : S_(S), noise_(noise), rows_(rows), bound_(4.0 * new_threshold) {}

  // The prediction is much less certain than the observation.
  bool stale() const {
    constexpr double kStale = 9.0;
    for (Index r = 0; r < rows_; ++r)
      if (S_(r, r) > kStale * noise_(r, r)) return true;
    return false;
  }
  // A landmark at this offset from the prediction could be mistaken for the predicted landmark, although the noise is
  // small enough to tell the two apart.
  bool confuses(const Vector3& apart) const {
    return within_bound(apart, S_, rows_, bound_) && !within_bound(apart, noise_, rows_, bound_);
  }

 private:
  const Matrix3& S_;
  const Matrix3& noise_;
  Index rows_;
  double bound_;  // on the squared distance: twice the radius of the bound for new landmarks
};

}  // namespace cairn
