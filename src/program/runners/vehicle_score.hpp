// SPDX-License-Identifier: BSD-3-Clause
// Sums of what one vehicle of a team claims and how far it is off.
#pragma once

#include <cstddef>

namespace cairn::program {

// Frobenius norm of the covariance of the position in the plane, m^2.
double position_norm(const double covariance[36]);

// Scores of one vehicle, over all scored steps.
struct VehicleScore {
  std::size_t steps = 0, nees_steps = 0;
  double claimed = 0;       // sum of ||C_qq||, Frobenius, m^2
  double square_error = 0;  // sum, m^2
  double nees = 0;          // sum
  double landmark_square = 0;
  std::size_t landmarks = 0, landmarks_known = 0;  // of its map; of these, those with known truth
  std::size_t paired = 0, paired_wrongly = 0;
  double rmse() const;
  double landmark_rmse() const;
  double anees() const;  // for each degree of freedom
  void add(const VehicleScore& other);
};

}  // namespace cairn::program
