// SPDX-License-Identifier: BSD-3-Clause
// Matrices of Eigen as inputs and outputs.
#include <Eigen/Core>
#include <cairn/cairn.hpp>
#include <cstdio>
#include <cstring>

#include "scene.hpp"

namespace {

int failures = 0;

void check(bool good, const char* what) {
  if (good) return;
  std::printf("FAILED: %s\n", what);
  ++failures;
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

int main() {
  cairn::Filter filter(scene::small()), same(scene::small());
  const std::int32_t sensor = filter.add_cartesian({});
  same.add_cartesian({});

  // Vectors, and symmetric matrices in either order.
  const Eigen::Vector3d velocity(1, 0, 0);
  const Eigen::RowVector3d rate(0, 0, 0.1);
  const Eigen::VectorXd dynamic = velocity;
  filter.predict_twist(0.1, velocity, rate);
  same.predict_twist(0.1, dynamic, Eigen::Map<const Eigen::Vector3d>(rate.data()));
  const Eigen::Matrix<double, 6, 6> by_columns = 0.01 * Eigen::Matrix<double, 6, 6>::Identity();
  filter.predict_increment({}, by_columns);
  same.predict_increment({}, RowMajor(by_columns));
  check(scene::bytes_of(filter) == scene::bytes_of(same), "column-major and row-major covariances are the same");

  // A Jacobian has rows and columns.
  filter.update(sensor, scene::points());
  RowMajor jacobian(1, 6);
  jacobian << 1, 0, 0, 0, 0, 0;
  const Eigen::VectorXd residual = Eigen::VectorXd::Constant(1, 0.01);
  const Eigen::MatrixXd noise = Eigen::MatrixXd::Constant(1, 1, 0.01);
  check(filter.update_linear(residual, noise, jacobian, {}, {}).result == cairn::Result::kMatched, "update_linear");

  // A part of a larger matrix is refused.
  const Eigen::Matrix3d wide = Eigen::Matrix3d::Random();
  try {
    filter.predict_twist(0.1, velocity, wide.row(0));
    check(false, "a row of a column-major matrix was taken");
  } catch (const cairn::Error& error) {
    check(std::strstr(error.what(), "gaps") != nullptr, error.what());
  }

  const cairn::PoseEstimate estimate = filter.pose();
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> covariance(estimate.covariance.data());
  check(covariance.isApprox(covariance.transpose()) && covariance.trace() > 0, "a covariance as a matrix");
  if (failures == 0) std::printf("Eigen: all checks pass\n");
  return failures;
}
