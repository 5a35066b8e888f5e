// SPDX-License-Identifier: BSD-3-Clause
#include "program/runners/vehicle_score.hpp"

#include <cmath>

namespace cairn::program {

double position_norm(const double covariance[36]) {
  const double xx = covariance[0], xy = covariance[1], yy = covariance[7];
  return std::sqrt(xx * xx + 2 * xy * xy + yy * yy);
}

double VehicleScore::rmse() const {
  return std::sqrt(square_error / static_cast<double>(steps));
}
double VehicleScore::landmark_rmse() const {
  return std::sqrt(landmark_square / static_cast<double>(landmarks_known));
}
double VehicleScore::anees() const {
  return nees / (3.0 * static_cast<double>(nees_steps));
}
void VehicleScore::add(const VehicleScore& other) {
  steps += other.steps;
  nees_steps += other.nees_steps;
  claimed += other.claimed;
  square_error += other.square_error;
  nees += other.nees;
  landmark_square += other.landmark_square;
  landmarks += other.landmarks;
  landmarks_known += other.landmarks_known;
  paired += other.paired;
  paired_wrongly += other.paired_wrongly;
}

}  // namespace cairn::program
