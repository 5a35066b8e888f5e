// SPDX-License-Identifier: BSD-3-Clause
// One vehicle's filter: its sensors, the names of its landmarks, and what becomes of each observation.
#pragma once

#include <cstdint>
#include <variant>

#include "core/arena.hpp"
#include "core/id_table.hpp"
#include "ekf/ekf.hpp"
#include "map/landmarks.hpp"
#include "motion/motion.hpp"
#include "sensor/cartesian.hpp"
#include "sensor/custom.hpp"
#include "sensor/stereo_camera.hpp"
#include "sensor/stereo_head.hpp"

namespace cairn {

constexpr std::uint64_t kNoId = UINT64_MAX;

struct FilterOptions {
  ErrorKind error = ErrorKind::invariant;
  Index max_landmarks = 1000;
  Index max_observations = 64;
  Index max_sensors = 8;
  int iterations = 3;
  double iteration_tolerance = 0.1;
  double gate_probability = 0.99;
  double batch_gate_probability = 0.9999;
  SE3 initial_pose;
  Matrix6 initial_covariance = Matrix6::Zero();
};

struct Observation {
  std::uint64_t id;
  double z[3];
  double covariance[9];  // all zero: the sensor's own
};

enum class Decision { matched, placed, rejected };
enum class Reason { none, gate, batch_gate, no_image, no_place };

struct Match {
  std::uint64_t landmark = kNoId;
  Decision decision = Decision::rejected;
  Reason reason = Reason::none;
  double distance = 0.0;
  double threshold = 0.0;
};

struct UpdateReport {
  Index matched = 0, placed = 0, rejected = 0;
  Index rows = 0;
  int iterations = 0;
  double nis = 0.0;
};

class Filter final : public Landmarks {
 public:
  using Log = void (*)(void* payload, const char* line);

  Filter(Arena& arena, const FilterOptions& options);
  ~Filter() override;
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;
  static std::size_t required_bytes(const FilterOptions& options);
  const FilterOptions& options() const { return options_; }
  void set_log(Log log, void* payload) { log_ = log, log_payload_ = payload; }

  // --- sensors --- numbered from 0 as they come
  template <class AnySensor>
  int add(const AnySensor& sensor) {
    return add_sensor(AnySensorSlot(sensor));
  }
  int sensor_rows(int sensor) { return sensor_at(sensor).rows(); }
  void point_head(int sensor, double pan, double stick);

  // --- motion --- throws where the result is not finite, with nothing changed
  void set_wheels(const Wheels& wheels) { wheels_ = wheels; }
  void set_twist_noise(const TwistNoise& noise) { twist_noise_ = noise; }
  void predict_wheels(double dt, double left, double right) { propagate(drive_wheels(wheels_, left, right, dt)); }
  void predict_twist(double dt, const Vector3& v, const Vector3& w) {
    propagate(integrate_twist(v, w, dt, twist_noise_));
  }
  void propagate(const Increment<SE3>& increment);

  // --- observations --- each throws with nothing changed; decisions() holds one a observation after it
  Observation* staging() { return observations_; }  // room for max_observations
  void update(int sensor, Index count);             // of staging()
  struct Linear {
    const double* residual;
    Index rows;
    const double* covariance;  // rows x rows
    const double* J_pose;      // rows x 6 row-major, or null
    const std::uint64_t* landmarks;
    Index count;
    const double* J_landmarks;  // rows x 3 count row-major
  };
  void update_linear(const Linear& linear);
  void update_position(const Vector3& position, const Matrix3& covariance, const Vector3& lever_arm);
  void update_attitude(const SO3& attitude, const Matrix3& covariance);
  void update_heading(double heading, double sigma);
  double* workspace() {
    return ekf_.scratch();
  }  // m^2 + cholesky_workspace(m) doubles, m = 3 max_observations; free between updates
  const Match* decisions() const { return matches_; }
  const UpdateReport& report() const { return report_; }

  void remove_landmark(std::uint64_t id);

  // --- queries ---
  SE3 pose() const { return ekf_.pose(); }
  Matrix6 pose_covariance() const { return ekf_.pose_covariance(); }
  double pose_nees(const SE3& truth) const { return ekf_.pose_nees(truth); }
  double smallest_pivot() { return ekf_.smallest_pivot(); }
  // Pose, then landmarks; square of 6 + 3 count.
  void pose_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const;

  // Landmarks
  std::size_t size() const override { return static_cast<std::size_t>(ekf_.size()); }
  std::uint64_t id(std::size_t index) const override { return ids_[index]; }
  std::uint64_t observations(std::size_t index) const override { return counts_[index]; }
  Vector3 position(std::size_t index) const override { return ekf_.landmark(static_cast<Index>(index)); }
  Matrix3 covariance(std::size_t index) const override { return ekf_.landmark_covariance(static_cast<Index>(index)); }
  bool find(std::uint64_t id, std::size_t& index) const override;
  void joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override;

 private:
  using AnySensorSlot = std::variant<StereoHead, StereoCamera, Cartesian, CustomSensor>;

  // A known landmark that this frame may update.
  struct Candidate {
    Index observation;
    Index slot;
    Matrix3 noise;
  };

  int add_sensor(const AnySensorSlot& sensor);
  AnySensorSlot& sensor_slot(int sensor);
  const Sensor& sensor_at(int sensor);
  void sort_out(const Sensor& sensor, Index count);
  Matrix3 noise_of(const Sensor& sensor, const Observation& observation) const;
  bool linearise(const Sensor& sensor, double* residual_only);
  void open_candidates(const Sensor& sensor);
  void gate_each();
  void gate_batch(const Sensor& sensor);
  template <class Linearise>
  void fill(Linearise&& linearise);
  template <class Linearise>
  void iterate(int iterations, bool relative, Linearise&& linearise);
  void place_new(const Sensor& sensor);
  template <class JPose>
  void add_pose_rows(Index rows, const JPose& J_pose, const double* covariance);
  template <class Linearise>
  void update_alone(Index rows, int iterations, std::uint64_t landmark, Linearise&& linearise);
  void start_report(Index count);
  void finish_report(Index count);
  double batch_threshold(Index rows);
  [[noreturn]] void throw_not_definite() const;
  void say(const char* format, ...) const __attribute__((format(printf, 2, 3)));

  FilterOptions options_;
  Ekf<SE3> ekf_;
  IdTable slots_;
  IdTable frame_ids_;
  std::uint64_t* ids_;
  std::uint64_t* counts_;

  unsigned char* sensor_storage_;
  int sensor_count_ = 0;
  Wheels wheels_;
  TwistNoise twist_noise_;

  Observation* observations_;
  Match* matches_;
  Match* next_matches_;
  Candidate* candidates_;
  Index candidate_count_ = 0;
  Index* window_slots_;
  Index* new_ones_;
  Index new_count_ = 0;
  double* residual_;
  double* thresholds_;  // chi-square bounds of a batch by its rows, filled as they are first asked for
  double gate_thresholds_[7] = {};
  UpdateReport report_, next_report_;
  Log log_ = nullptr;
  void* log_payload_ = nullptr;
};

}  // namespace cairn
