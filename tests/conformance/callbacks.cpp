/* SPDX-License-Identifier: BSD-3-Clause */
/* Every operation is rounded on its own (-ffp-contract=off), so that all languages get the same bits. */
#include "callbacks.hpp"

#include <cmath>
#include <limits>
#include <set>

namespace conformance {
namespace {

struct Rotation {
  double r[3][3];
};

Rotation rotation_of(const cairn_pose& pose) {
  const double w = pose.quaternion[0], x = pose.quaternion[1], y = pose.quaternion[2], z = pose.quaternion[3];
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

int32_t range_only(const double d[3], double* z, double* jacobian_pose, double* jacobian_landmark) {
  const double range = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  if (range < 0.1) return 0;
  z[0] = range;
  for (int i = 0; i < 3; ++i) {
    jacobian_landmark[i] = d[i] / range;
    jacobian_pose[i] = -(d[i] / range);
    jacobian_pose[3 + i] = 0;
  }
  return 1;
}

int32_t predict(const Payload& which, const cairn_pose& pose, const double l[3], double* z, double* jacobian_pose,
                double* jacobian_landmark) {
  if (which.predict == "aborting") return -1;
  if (which.predict == "refusing") return 0;
  const double d[3] = {l[0] - pose.position[0], l[1] - pose.position[1], l[2] - pose.position[2]};
  if (which.predict == "range_only") return range_only(d, z, jacobian_pose, jacobian_landmark);
  const Rotation R = rotation_of(pose);
  double b[3];
  for (int i = 0; i < 3; ++i) b[i] = R.r[0][i] * d[0] + R.r[1][i] * d[1] + R.r[2][i] * d[2];
  if (which.predict == "body_point_ahead") {
    if (b[0] < -5) return -1;
    if (b[0] < 0) return 0;
  }
  for (uint32_t i = 0; i < which.rows; ++i) {
    z[i] = b[i];
    for (int k = 0; k < 3; ++k) {
      const int m = (k + 1) % 3, n = (k + 2) % 3;
      jacobian_pose[6 * i + k] = -R.r[k][i];
      jacobian_pose[6 * i + 3 + k] = R.r[m][i] * d[n] - R.r[n][i] * d[m];
      jacobian_landmark[3 * i + k] = R.r[k][i];
    }
  }
  if (which.predict == "wrong_jacobian") jacobian_landmark[0] = R.r[0][0] + 0.5;
  if (which.predict == "unfinished") jacobian_pose[0] = std::numeric_limits<double>::quiet_NaN();
  return 1;
}

int32_t place(const Payload& which, const cairn_pose& pose, const double* z, double* l, double* jacobian_pose,
              double* jacobian_z) {
  if (which.place == "aborting") return -1;
  if (which.place == "refusing") return 0;
  const Rotation R = rotation_of(pose);
  double v[3] = {0, 0, 0}, c[3];
  for (uint32_t i = 0; i < which.rows; ++i) v[i] = z[i];
  for (int i = 0; i < 3; ++i) c[i] = R.r[i][0] * v[0] + R.r[i][1] * v[1] + R.r[i][2] * v[2];
  const double turn[3][3] = {{0, c[2], -c[1]}, {-c[2], 0, c[0]}, {c[1], -c[0], 0}};
  for (int i = 0; i < 3; ++i) {
    l[i] = pose.position[i] + c[i];
    for (int k = 0; k < 3; ++k) {
      jacobian_pose[6 * i + k] = i == k ? 1 : 0;
      jacobian_pose[6 * i + 3 + k] = turn[i][k];
    }
    for (uint32_t k = 0; k < which.rows; ++k) jacobian_z[which.rows * static_cast<uint32_t>(i) + k] = R.r[i][k];
  }
  return 1;
}

}  // namespace

bool is_predict(const std::string& name) {
  static const std::set<std::string> names = {"body_point", "body_point_ahead", "range_only", "wrong_jacobian",
                                              "unfinished", "refusing",         "aborting"};
  return names.count(name) != 0;
}

bool is_place(const std::string& name) {
  static const std::set<std::string> names = {"body_point", "refusing", "aborting"};
  return names.count(name) != 0;
}

}  // namespace conformance

int32_t conformance_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                            double* jacobian_pose, double* jacobian_landmark) {
  return conformance::predict(*static_cast<conformance::Payload*>(user), *pose, landmark, z, jacobian_pose,
                              jacobian_landmark);
}

int32_t conformance_place(void* user, const cairn_pose* pose, const double* z, double landmark[3],
                          double* jacobian_pose, double* jacobian_z) {
  return conformance::place(*static_cast<conformance::Payload*>(user), *pose, z, landmark, jacobian_pose, jacobian_z);
}

void conformance_log(void* payload, const char* line) {
  static_cast<conformance::Payload*>(payload)->lines->emplace_back(line);
}

void conformance_release(void* user) {
  ++static_cast<conformance::Payload*>(user)->released;
}
