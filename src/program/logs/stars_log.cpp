// SPDX-License-Identifier: BSD-3-Clause
// UTIAS STARS layout in a MATLAB v5 file: a stereo camera carried by a body whose velocity and rate are measured.
//   t 1xK s                     time of each frame
//   v_vk_vk_i, w_vk_vk_i 3xN    measured body velocity (m/s) and rate (rad/s)
//   r_i_vk_i, theta_vk_i 3xN    true position (m), true attitude as a rotation vector (rad)
//   y_k_j 4xKxM                 pixels u_left v_left u_right v_right of M landmarks; -1 or NaN: not seen
//   fu fv cu cv b               rectified stereo camera; the left one is the camera frame
//   C_c_v, rho_v_c_v            rotation from vehicle to camera, camera position in the vehicle (m)
//   rho_i_pj_i 3xM              optional: true landmarks (m)
//   y_var 4x1, v_var 3x1, w_var 3x1   optional: variances
// The attitude's rotation matrix C_vk_i takes vectors from the map to the vehicle and is cos(a) 1 + (1 - cos(a)) n n^T
// - sin(a) n^x, so that its transpose, the one of a pose, is Exp(theta).
#include <algorithm>
#include <cmath>

#include "program/logs/log.hpp"
#include "program/logs/mat_file.hpp"

namespace cairn::program::logs {
namespace {

constexpr double kPixelSigma = 2;
constexpr double kVelocitySigma = 0.1;  // m/s
constexpr double kRateSigma = 0.01;     // rad/s
constexpr double kNotSeen = -1;

bool all_finite(const double* values, std::size_t count) {
  return std::all_of(values, values + count, [](double value) { return std::isfinite(value); });
}

// Quaternion of a rotation matrix, by the largest of its four components (Shepperd), so that no divisor is small.
void quaternion_of_matrix(const double (&R)[3][3], double quaternion[4]) {
  const double trace = R[0][0] + R[1][1] + R[2][2];
  const double squares[4] = {trace, R[0][0], R[1][1], R[2][2]};
  const std::size_t largest = static_cast<std::size_t>(std::max_element(squares, squares + 4) - squares);
  double q[4];
  if (largest == 0) {
    q[0] = 1 + trace;
    q[1] = R[2][1] - R[1][2];
    q[2] = R[0][2] - R[2][0];
    q[3] = R[1][0] - R[0][1];
  } else {
    const std::size_t i = largest - 1;
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    q[0] = R[k][j] - R[j][k];
    q[1 + i] = 1 + 2 * R[i][i] - trace;
    q[1 + j] = R[j][i] + R[i][j];
    q[1 + k] = R[k][i] + R[i][k];
  }
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int i = 0; i < 4; ++i) quaternion[i] = q[i] / norm;
}

class Reader {
 public:
  Reader(const std::string& path, const std::string& content, const NoiseOverride& noise)
      : file_(path, content), noise_(noise) {}

  Log read() {
    log_.format = "STARS log (MATLAB v5)";
    log_.sensor = SensorKind::kStereoCamera;
    read_camera();
    read_times();
    read_motion();
    read_truth();
    read_observations();
    read_landmarks();
    return std::move(log_);
  }

 private:
  void read_camera() {
    cairn_stereo_camera& camera = log_.camera;
    cairn_stereo_camera_init(&camera, sizeof camera, nullptr);
    camera.fu = positive_scalar("fu");
    camera.fv = positive_scalar("fv");
    camera.cu = file_.require_scalar("cu");
    camera.cv = file_.require_scalar("cv");
    camera.baseline = positive_scalar("b");

    const MatArray C = file_.require("C_c_v", 3);
    if (C.values.size() != 9) file_.fail("C_c_v", "not a 3 x 3 matrix");
    double R_body_camera[3][3];  // the transpose of C_c_v, whose columns the file stores one after the other
    for (std::size_t i = 0; i < 9; ++i) R_body_camera[i / 3][i % 3] = C.values[i];
    if (!is_rotation(R_body_camera)) file_.fail("C_c_v", "not a rotation matrix");
    quaternion_of_matrix(R_body_camera, camera.T_body_camera.quaternion);

    const MatArray rho = file_.require("rho_v_c_v", 3);
    if (rho.values.size() != 3 || !all_finite(rho.column(0), 3)) file_.fail("rho_v_c_v", "not 3 finite numbers");
    std::copy_n(rho.column(0), 3, camera.T_body_camera.position);
    read_pixel_noise();
  }

  double positive_scalar(const char* name) const {
    const double value = file_.require_scalar(name);
    if (!(value > 0)) file_.fail(name, "not positive");
    return value;
  }

  static bool is_rotation(const double (&R)[3][3]) {
    constexpr double kTolerance = 1e-3;  // files are written with few digits
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) {
        const double dot = R[i][0] * R[j][0] + R[i][1] * R[j][1] + R[i][2] * R[j][2];
        if (!(std::abs(dot - (i == j ? 1 : 0)) < kTolerance)) return false;
      }
    }
    const double determinant = R[0][0] * (R[1][1] * R[2][2] - R[1][2] * R[2][1]) -
                               R[0][1] * (R[1][0] * R[2][2] - R[1][2] * R[2][0]) +
                               R[0][2] * (R[1][0] * R[2][1] - R[1][1] * R[2][0]);
    return determinant > 0;
  }

  // The filter's v is the mean of both images' rows: its variance is a quarter of the sum of theirs.
  void read_pixel_noise() {
    double* sigma = log_.camera.sigma;
    const double pixel = noise_.pixel.value_or(kPixelSigma);
    sigma[0] = pixel;
    sigma[1] = pixel;
    sigma[2] = pixel / std::sqrt(2.0);
    if (noise_.pixel) return;
    if (const std::optional<std::vector<double>> variance = read_variances("y_var", 4)) {
      sigma[0] = std::sqrt((*variance)[0]);
      sigma[1] = std::sqrt((*variance)[2]);
      sigma[2] = std::sqrt(((*variance)[1] + (*variance)[3]) / 4);
    }
  }

  std::optional<std::vector<double>> read_variances(const char* name, std::size_t count) const {
    const std::optional<MatArray> array = file_.find(name);
    if (!array) return std::nullopt;
    const auto good = [](double value) { return std::isfinite(value) && value > 0; };
    if (array->values.size() != count || !std::all_of(array->values.begin(), array->values.end(), good)) {
      file_.fail(name, "not " + std::to_string(count) + " positive variances");
    }
    return array->values;
  }

  void read_times() {
    const MatArray t = file_.require("t");
    if (t.values.empty()) file_.fail("t", "empty");
    for (std::size_t k = 0; k < t.values.size(); ++k) {
      if (!std::isfinite(t.values[k])) fail_at("t", k, "not finite");
      if (k > 0 && !(t.values[k] > t.values[k - 1])) fail_at("t", k, "time does not increase");
      log_.steps.emplace_back();
      log_.steps.back().number = k;
      log_.steps.back().time = t.values[k];
    }
  }

  [[noreturn]] void fail_at(const char* name, std::size_t column, const std::string& cause) const {
    file_.fail(name, "column " + std::to_string(column + 1) + ": " + cause);
  }

  // A 3xN array with at least one column for each frame.
  MatArray read_columns(const char* name) {
    MatArray array = file_.require(name, 3);
    const std::size_t steps = log_.steps.size();
    if (array.columns() < steps) {
      file_.fail(name, "has " + std::to_string(array.columns()) + " columns, expected " + std::to_string(steps) +
                           ", one for each time");
    }
    if (array.columns() > steps && log_.notes.empty()) {
      log_.notes.push_back(std::string(name) + " goes on to frame " + std::to_string(array.columns()) +
                           ", the times t end with frame " + std::to_string(steps) + ": the rest is left out");
    }
    return array;
  }

  void read_motion() {
    const MatArray velocity = read_columns("v_vk_vk_i");
    const MatArray rate = read_columns("w_vk_vk_i");
    for (std::size_t k = 0; k + 1 < log_.steps.size(); ++k) {
      Twist twist{};
      twist.dt = log_.steps[k + 1].time - log_.steps[k].time;
      if (!all_finite(velocity.column(k), 3)) fail_at("v_vk_vk_i", k, "not finite");
      if (!all_finite(rate.column(k), 3)) fail_at("w_vk_vk_i", k, "not finite");
      std::copy_n(velocity.column(k), 3, twist.velocity.begin());
      std::copy_n(rate.column(k), 3, twist.rate.begin());
      log_.steps[k + 1].twist = twist;
    }
    cairn_twist_noise_init(&log_.twist_noise, sizeof log_.twist_noise, nullptr);
    set_noise(log_.twist_noise.velocity_sigma, noise_.velocity, "v_var", kVelocitySigma);
    set_noise(log_.twist_noise.rate_sigma, noise_.rate, "w_var", kRateSigma);
  }

  void set_noise(double (&sigma)[3], const std::optional<double>& wanted, const char* variable, double otherwise) {
    std::fill(sigma, sigma + 3, wanted.value_or(otherwise));
    if (wanted) return;
    if (const std::optional<std::vector<double>> variance = read_variances(variable, 3)) {
      for (std::size_t i = 0; i < 3; ++i) sigma[i] = std::sqrt((*variance)[i]);
    }
  }

  void read_truth() {
    const MatArray position = read_columns("r_i_vk_i");
    const MatArray attitude = read_columns("theta_vk_i");
    for (std::size_t k = 0; k < log_.steps.size(); ++k) {
      const bool known = all_finite(position.column(k), 3) && all_finite(attitude.column(k), 3);
      if (!known && k == 0) fail_at("r_i_vk_i", k, "the first true pose is not known");
      if (!known) continue;
      cairn_pose pose{};
      std::copy_n(position.column(k), 3, pose.position);
      cairn_quaternion_exp(attitude.column(k), pose.quaternion, nullptr);
      log_.steps[k].truth = pose;
    }
  }

  void read_observations() {
    const MatArray y = file_.require("y_k_j", 4);
    const std::size_t steps = log_.steps.size();
    if (y.dimensions.size() > 3 || y.dimensions[1] != steps) {
      file_.fail("y_k_j", "is not 4 x " + std::to_string(steps) + " x M, with a frame for each time");
    }
    const std::size_t landmarks = y.dimensions.size() == 3 ? y.dimensions[2] : 1;
    for (std::size_t j = 0; j < landmarks; ++j) {
      for (std::size_t k = 0; k < steps; ++k) {
        const double* pixels = y.column(k + steps * j);
        const auto unseen = [](double value) { return value == kNotSeen || std::isnan(value); };
        if (std::any_of(pixels, pixels + 4, unseen)) continue;
        if (!all_finite(pixels, 4)) fail_at("y_k_j", k + steps * j, "not finite");
        cairn_observation observation{};
        observation.id = j;
        observation.z[0] = pixels[0];
        observation.z[1] = pixels[2];
        observation.z[2] = (pixels[1] + pixels[3]) / 2;
        log_.steps[k].observations.push_back(observation);
      }
    }
    observed_landmarks_ = landmarks;
  }

  void read_landmarks() {
    const std::optional<MatArray> rho = file_.find("rho_i_pj_i", 3);
    if (!rho) return;
    if (rho->columns() != observed_landmarks_) {
      file_.fail("rho_i_pj_i", "has " + std::to_string(rho->columns()) + " landmarks, y_k_j has " +
                                   std::to_string(observed_landmarks_));
    }
    for (std::size_t j = 0; j < rho->columns(); ++j) {
      const double* p = rho->column(j);
      if (all_finite(p, 3)) log_.landmarks[j] = {p[0], p[1], p[2]};
    }
  }

  MatFile file_;
  NoiseOverride noise_;
  Log log_;
  std::size_t observed_landmarks_ = 0;
};

}  // namespace

Log read_stars_log(const std::string& path, const std::string& content, const NoiseOverride& noise) {
  return Reader(path, content, noise).read();
}

}  // namespace cairn::program::logs
