// SPDX-License-Identifier: BSD-3-Clause
// Writes a small STARS log as a MATLAB v5 file, whole or spoilt on purpose:
//   make_stars FILE [--drop NAME] [--set NAME INDEX VALUE] [--cut NAME COLUMNS] [--single] [--compress]
// Frames follow the layout's own formulas (rotation matrices that take vectors from the map to the vehicle and on to
// the camera), not the reader's, so that an error of sign there shows here.
#include <matio.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr std::size_t kFrames = 80;
constexpr std::size_t kLandmarks = 24;
constexpr double kFocal = 450, kCentreU = 320, kCentreV = 240, kBaseline = 0.25;

struct Vector {
  double x, y, z;
};
Vector operator+(Vector a, Vector b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector operator-(Vector a, Vector b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator*(double s, Vector a) {
  return {s * a.x, s * a.y, s * a.z};
}
double dot(Vector a, Vector b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// cos 1 + (1 - cos) n n^T - sin n^x, applied to a vector: a rotation of the axes by `theta`.
Vector turn_axes(Vector theta, Vector p) {
  const double angle = std::sqrt(dot(theta, theta));
  if (angle < 1e-12) return p - cross(theta, p);
  const Vector n = (1 / angle) * theta;
  return std::cos(angle) * p + ((1 - std::cos(angle)) * dot(n, p)) * n - std::sin(angle) * cross(n, p);
}

struct Array {
  std::vector<std::size_t> dimensions;
  std::vector<double> values;
};

// The vehicle turns only about its z axis, so that attitudes add up; the map's axes are tilted against it.
struct Course {
  double yaw = 0;
  Vector position{0, 0, 0};  // in the axes of the first vehicle frame
};

std::map<std::string, Array> make_log() {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  // Vehicle x forward, y left, z up; camera z forward, x right, y down: the rows of C_c_v.
  const Vector rows[3] = {{0, -1, 0}, {0, 0, -1}, {1, 0, 0}};
  const Vector camera_position = {0.3, -0.1, 0.5};
  const Vector tilt = {0.2, -0.1, 0.4};  // rotation vector from the map's axes to the first vehicle frame's
  std::map<std::string, Array> log;
  std::vector<Vector> landmarks;
  std::uniform_real_distribution<double> along(3, 22), aside(-6, 6), above(-1.5, 2.5);
  for (std::size_t j = 0; j < kLandmarks; ++j) landmarks.push_back({along(engine), aside(engine), above(engine)});

  const auto to_map = [&](Vector p) { return turn_axes(-1 * tilt, p); };  // the inverse of an axes' turn
  const auto append = [&](const char* name, Vector v) {
    for (const double value : {v.x, v.y, v.z}) log[name].values.push_back(value);
  };
  std::vector<double>& y = log["y_k_j"].values;
  y.assign(4 * kFrames * kLandmarks, -1);
  Course course;
  for (std::size_t k = 0; k < kFrames; ++k) {
    const double dt = k % 2 == 0 ? 0.08 : 0.12;
    const double speed = 0.9 + 0.3 * std::sin(0.11 * static_cast<double>(k));
    const double rate = 0.25 * std::sin(0.17 * static_cast<double>(k));
    // C_vk_i = turn by yaw about z after the tilt. Its rotation vector comes from composing two quaternions.
    const double a = std::sqrt(dot(tilt, tilt)), c1 = std::cos(a / 2), c2 = std::cos(course.yaw / 2);
    const Vector q1 = (std::sin(a / 2) / a) * tilt, q2 = {0, 0, std::sin(course.yaw / 2)};
    const double w = c1 * c2 - dot(q1, q2);
    const Vector q = c1 * q2 + c2 * q1 + cross(q1, q2);
    append("theta_vk_i", (2 * std::atan2(std::sqrt(dot(q, q)), w) / std::sqrt(dot(q, q))) * q);
    append("r_i_vk_i", to_map(course.position));
    append("v_vk_vk_i", {speed + 0.05 * normal(engine), 0.05 * normal(engine), 0.05 * normal(engine)});
    append("w_vk_vk_i", {0.01 * normal(engine), 0.01 * normal(engine), rate + 0.01 * normal(engine)});
    log["t"].values.push_back(k == 0 ? 100.0 : log["t"].values.back() + (k % 2 == 1 ? 0.08 : 0.12));
    for (std::size_t j = 0; j < kLandmarks; ++j) {
      const Vector body = turn_axes({0, 0, course.yaw}, landmarks[j] - course.position) - camera_position;
      const Vector p = {dot(rows[0], body), dot(rows[1], body), dot(rows[2], body)};
      const double u = kFocal * p.x / p.z, v = kFocal * p.y / p.z;
      if (p.z < 1 || std::abs(u) > kCentreU || std::abs(v) > kCentreV) continue;
      double* pixels = &y[4 * (k + kFrames * j)];
      pixels[0] = kCentreU + u + normal(engine);
      pixels[1] = kCentreV + v + normal(engine);
      pixels[2] = kCentreU + u - kFocal * kBaseline / p.z + normal(engine);
      pixels[3] = kCentreV + v + normal(engine);
    }
    // Velocity and rate hold until the next frame: an arc in the plane.
    const double turn = rate * dt;
    const Vector chord = std::abs(turn) < 1e-9 ? Vector{speed * dt, 0, 0}
                                               : (speed / rate) * Vector{std::sin(turn), 1 - std::cos(turn), 0};
    course.position = course.position + turn_axes({0, 0, -course.yaw}, chord);
    course.yaw += turn;
  }
  for (const Vector& landmark : landmarks) append("rho_i_pj_i", to_map(landmark));
  append("rho_v_c_v", camera_position);
  log["C_c_v"] = {{3, 3}, {0, 0, 1, -1, 0, 0, 0, -1, 0}};  // column by column
  log["t"].dimensions = {1, kFrames};
  for (const char* name : {"theta_vk_i", "r_i_vk_i", "v_vk_vk_i", "w_vk_vk_i"}) log[name].dimensions = {3, kFrames};
  log["y_k_j"].dimensions = {4, kFrames, kLandmarks};
  log["rho_i_pj_i"].dimensions = {3, kLandmarks};
  log["rho_v_c_v"].dimensions = {3, 1};
  log["y_var"] = {{4, 1}, {1, 1, 1, 1}};
  log["v_var"] = {{3, 1}, {0.0025, 0.0025, 0.0025}};
  log["w_var"] = {{3, 1}, {1e-4, 1e-4, 1e-4}};
  const std::map<std::string, double> scalars = {
      {"fu", kFocal}, {"fv", kFocal}, {"cu", kCentreU}, {"cv", kCentreV}, {"b", kBaseline}};
  for (const auto& [name, value] : scalars) log[name] = {{1, 1}, {value}};
  return log;
}

bool write_log(const std::string& path, std::map<std::string, Array>& log, bool single, bool compress) {
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
  if (file == nullptr) return false;
  bool good = true;
  for (auto& [name, array] : log) {
    std::vector<float> floats(array.values.begin(), array.values.end());
    void* data = single ? static_cast<void*>(floats.data()) : array.values.data();
    matvar_t* variable =
        Mat_VarCreate(name.c_str(), single ? MAT_C_SINGLE : MAT_C_DOUBLE, single ? MAT_T_SINGLE : MAT_T_DOUBLE,
                      static_cast<int>(array.dimensions.size()), array.dimensions.data(), data, 0);
    good &= Mat_VarWrite(file, variable, compress ? MAT_COMPRESSION_ZLIB : MAT_COMPRESSION_NONE) == 0;
    Mat_VarFree(variable);
  }
  Mat_Close(file);
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty()) return EXIT_FAILURE;
  std::map<std::string, Array> log = make_log();
  bool single = false;
  bool compress = false;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (word == "--drop") {
      log.erase(arguments.at(++i));
    } else if (word == "--set") {
      Array& array = log.at(arguments.at(i + 1));
      array.values.at(std::stoul(arguments.at(i + 2))) = std::stod(arguments.at(i + 3));
      i += 3;
    } else if (word == "--cut") {
      Array& array = log.at(arguments.at(i + 1));
      array.dimensions = {array.dimensions[0], std::stoul(arguments.at(i + 2))};
      array.values.resize(array.dimensions[0] * array.dimensions[1]);
      i += 2;
    } else if (word == "--single") {
      single = true;
    } else if (word == "--compress") {
      compress = true;
    }
  }
  return write_log(arguments[0], log, single, compress) ? EXIT_SUCCESS : EXIT_FAILURE;
}
