// SPDX-License-Identifier: BSD-3-Clause
// One vehicle's filter: motion, observations, submaps and queries. It calls its parts in their order
// (docs/architecture.md).
#pragma once

#include <memory>

#include "motion/motion.hpp"
#include "slam/frame_pipeline.hpp"
#include "slam/whole_batch.hpp"

namespace cairn {

template <class Pose>
class Filter {
 public:
  using PoseType = Pose;
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Rotation = typename Pose::Rotation;
  using Square = typename Pose::Square;
  using PointSquare = typename AbsoluteFix<Pose>::PointSquare;

  Filter(Arena& arena, const FilterOptions<Pose>& options);
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;
  static std::size_t arena_bytes(const FilterOptions<Pose>& options);     // of the arena that the constructor wants
  static std::size_t required_bytes(const FilterOptions<Pose>& options);  // of all memory that the filter needs
  // The vehicle's submaps join this map instead of one of the filter's own: for teams. Before the first motion.
  void use_map(std::unique_ptr<GlobalMap<Pose>> map) { submaps_.use_map(std::move(map)); }
  const FilterOptions<Pose>& options() const { return options_; }
  void set_log(Log::Function log, void* payload) { log_.set(log, payload); }

  // --- sensors --- numbered from 0 in the order in which they were added
  template <class AnySensor>
  int add(const AnySensor& sensor) {
    return sensors_.add(typename SensorRack<Pose>::Any(sensor));
  }
  int sensor_rows(int sensor) { return sensors_.at(sensor).rows(); }
  void check_sensor(int sensor) const { sensors_.check(sensor); }
  void point_head(int sensor, double pan, double stick) { sensors_.point_head(sensor, pan, stick); }
  // Sets the region in which the sensor detects every landmark: bounds on the predicted observation.
  void set_view(int sensor, const Vector3& lower, const Vector3& upper) { sensors_.set_view(sensor, {lower, upper}); }
  void set_loss(int sensor, const RobustLoss& loss) { sensors_.set_loss(sensor, loss); }
  void set_sighting(int sensor, const MutualSighting& sighting) { sensors_.set_sighting(sensor, sighting); }

  // Systematic errors of a sensor become states: a standard deviation (0: none) and a random walk for each number of
  // its calibration. Before the first motion and the first observation.
  void calibrate(int sensor, const Calibration<Pose>& sigma, const Calibration<Pose>& walk);

  // --- motion --- throws if the result is not finite, with nothing changed
  void set_wheels(const Wheels& wheels) { wheels_ = wheels; }
  void set_twist_noise(const TwistNoise& noise) { twist_noise_ = noise; }
  void predict_wheels(double dt, double left, double right);
  void predict_wheels_gyro(double dt, double left, double right, const Vector3& w);
  void predict_twist(double dt, const Vector3& v, const Vector3& w);
  void propagate(const Increment<Pose>& increment);  // refused if a bias of the twist is a state

  // --- observations --- each call throws with nothing changed; matches() holds one match an observation after it
  // First the observations of landmarks, then those of companions, which bring ids whatever the association is.
  void update(int sensor, const Observation* observations, Index landmarks, Index companions = 0);
  void update_linear(const LinearRows& rows) {
    started_ = true;
    log_.watch([&] { batches_.rows(rows); });
    submaps_.keep_pose();
  }
  void update_fix(const AbsoluteFix<Pose>& fix);
  void update_position(const Point& position, const PointSquare& covariance, const Point& lever_arm) {
    update_fix(AbsoluteFix<Pose>::position(position, covariance, lever_arm));
  }
  void update_attitude(const Rotation& attitude, const typename Rotation::Jacobian& covariance) {
    update_fix(AbsoluteFix<Pose>::attitude(attitude, covariance));
  }
  void update_heading(double heading, double sigma) { update_fix(AbsoluteFix<Pose>::heading(heading, sigma)); }
  // m^2 + cholesky_workspace(m) doubles, m = kDim max_observations; free between updates
  double* workspace() { return local_.state().scratch(); }
  const Match* matches() const { return report_.matches(); }
  const UpdateReport& report() const { return report_.last(); }
  const HealthMonitor<Pose>& health() const { return health_; }

  // --- landmarks ---
  void remove_landmark(std::uint64_t id) { submaps_.remove_landmark(id); }
  // The next two functions change landmarks of the open submap or the single map. Merging tells the filter that two
  // landmarks are one. It is gated like an observation; if the gate accepts it, `other` is removed. Splitting undoes
  // such a mistake: the landmark `fresh` is placed at the position of `id`, with an additional error.
  void merge_landmarks(std::uint64_t id, std::uint64_t other) {
    log_.watch([&] { batches_.merge(id, other); });
  }
  void split_landmark(std::uint64_t id, std::uint64_t fresh, const PointSquare& covariance);

  // --- companions --- other vehicles, by the caller's names for them; only with a single map. Motion and observations
  // are those of the active vehicle: at first the filter's own vehicle; look_from() activates another one.
  void name_vehicle(std::uint64_t id) { local_.table().name_vehicle(id); }  // its own, before there are others
  void add_vehicle(std::uint64_t id, const Pose& pose, const Square& covariance) {
    add_vehicle(id, pose, Square::Zero(), covariance);
  }
  // The companion's error is J_pose times the error of the active vehicle, plus noise.
  void add_vehicle(std::uint64_t id, const Pose& pose, const Square& J_pose, const Square& noise);
  void remove_vehicle(std::uint64_t id) { local_.remove_vehicle(id); }  // not the active one
  void look_from(std::uint64_t id);
  bool has_vehicle(std::uint64_t id) const { return local_.has_vehicle(id); }
  Pose vehicle_pose(std::uint64_t id) const;
  Square vehicle_covariance(std::uint64_t id) const;

  // --- submaps --- throws with nothing changed
  void close_submap();
  const ClosingReport& closing() const { return submaps_.closing(); }

  // --- trajectory --- every update adds its pose
  void keep_pose() { submaps_.keep_pose(); }  // adds the present pose
  const Trajectory<Pose>& trajectory() const { return trajectory_; }
  typename Trajectory<Pose>::Open open_submap() const { return submaps_.open_submap(); }
  Pose trajectory_pose(std::uint64_t number, const typename Trajectory<Pose>::Open& open) const {
    return trajectory_.pose(number, submaps_.map(), open);
  }

  // --- queries ---
  using Estimate = typename SubmapKeeper<Pose>::Estimate;
  Estimate vehicle() const { return submaps_.vehicle(); }
  Pose pose() const { return vehicle().pose; }
  Square pose_covariance() const { return vehicle().covariance; }
  // Systematic errors that are states, in the order of SystematicErrors; the covariance has both triangles.
  const SystematicErrors& systematic() const { return local_.systematic(); }
  void systematic_errors(double* values, double* covariance) const { submaps_.systematic(values, covariance); }
  Pose local_pose() const { return local_.state().pose(); }
  Square local_pose_covariance() const { return local_.state().pose_covariance(); }
  double pose_nees(const Pose& truth) const { return submaps_.pose_nees(truth); }
  double smallest_pivot() { return local_.state().smallest_pivot(); }
  const GlobalMap<Pose>* map() const { return submaps_.map(); }        // null: a single map
  const Landmarks& landmarks() const { return submaps_.landmarks(); }  // the map that the caller sees
  const Landmarks& local_landmarks() const { return local_; }          // of the open submap or the single map
  // Covariance of [pose; landmarks of landmarks()], in space: 6 + 3 count on a side.
  void pose_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
    submaps_.pose_joint_covariance(indices, count, matrix);
  }

 private:
  void begin();
  void move(const CorrectedStep<Pose>& step, double dt);
  void move(const Increment<Pose>& increment, const MotionCoupling<Pose>* coupling = nullptr);
  void note_closing();

  FilterOptions<Pose> options_;
  Log log_;
  Wheels wheels_;
  TwistNoise twist_noise_;
  SensorRack<Pose> sensors_;
  LocalMap<Pose> local_;
  Thresholds thresholds_;
  FrameReport report_;
  Trajectory<Pose> trajectory_;
  SubmapKeeper<Pose> submaps_;
  MotionTrust<Pose> trust_;
  HealthMonitor<Pose> health_;
  std::size_t closings_ = 0;  // that the health monitor knows of
  FramePipeline<Pose> frames_;
  WholeBatchUpdate<Pose> batches_;
  bool started_ = false;  // something was estimated: no systematic error can be added any more
};

extern template class Filter<SE2>;
extern template class Filter<SE3>;

}  // namespace cairn
