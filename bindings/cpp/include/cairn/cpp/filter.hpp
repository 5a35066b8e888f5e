// SPDX-License-Identifier: BSD-3-Clause
// The filter of one vehicle.
#ifndef CAIRN_CPP_FILTER_HPP
#define CAIRN_CPP_FILTER_HPP

#include <cairn/cpp/callback.hpp>
#include <cairn/cpp/map.hpp>

namespace cairn {

/// A closed submap.
struct ClosedSubmap {
  Pose base;                       ///< pose of its origin in the map
  std::vector<std::uint64_t> ids;  ///< its landmarks, in the order in which they were placed
};

/// The numbers of the poses of a trajectory: from `first` up to but not including `end`.
struct PoseNumbers {
  std::uint64_t first = 0, end = 0;
};

/// The components of systematic errors that are states, and their joint covariance, row-major.
struct SystematicErrors {
  std::vector<SystematicError> errors;
  std::vector<double> covariance;
};

namespace detail {

struct FilterKind {
  using Handle = cairn_filter;
  static constexpr const char* name = "filter";
  //~ cairn_filter_destroy
  /// Destroys a filter and the map that it owns.
  ///
  /// Complexity: O(memory).
  static void destroy(Handle* handle) noexcept { cairn_filter_destroy(handle); }
};

}  // namespace detail

//~ cairn_filter_required_bytes
/// Bytes that Filter::Filter will take with these options. Only closings of submaps take more: workspace while they
/// run, and with sparse joining the memory by which the map grows.
///
/// Throws Error: Status::kErrorArgument.
///
/// Complexity: O(1).
inline std::size_t required_bytes(const FilterOptions& options) {
  std::size_t bytes = 0;
  detail::call([&](cairn_error* error) { return cairn_filter_required_bytes(detail::as_c(&options), &bytes, error); });
  return bytes;
}

/// The filter of one vehicle: it is told how the vehicle moved and where it saw landmarks, and has pose and map.
class Filter : public detail::Owner<detail::FilterKind> {
 public:
  //~ cairn_filter_create
  /// Creates a filter.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorMemory.
  ///
  /// Complexity: O(memory).
  explicit Filter(const FilterOptions& options = {})
      : Owner([&](cairn_filter** filter, cairn_error* error) {
          return cairn_filter_create(detail::as_c(&options), filter, error);
        }) {}

  // Sensors and motion models.

  //~ cairn_filter_add_stereo_head
  /// Adds a stereo head.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorCapacity.
  ///
  /// Complexity: O(1).
  std::int32_t add_stereo_head(const StereoHead& head) { return add(cairn_filter_add_stereo_head, head); }

  //~ cairn_filter_add_stereo_camera
  /// Adds a stereo camera.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorCapacity.
  ///
  /// Complexity: O(1).
  std::int32_t add_stereo_camera(const StereoCamera& camera) { return add(cairn_filter_add_stereo_camera, camera); }

  //~ cairn_filter_add_range_bearing
  /// Adds a planar range-bearing sensor (radar, lidar, sonar).
  ///
  /// Throws Error: Status::kErrorArgument (also if the vehicle is spatial); Status::kErrorCapacity.
  ///
  /// Complexity: O(1).
  std::int32_t add_range_bearing(const RangeBearing& radar) { return add(cairn_filter_add_range_bearing, radar); }

  //~ cairn_filter_add_cartesian
  /// Adds a cartesian sensor, which gives points.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorCapacity.
  ///
  /// Complexity: O(1).
  std::int32_t add_cartesian(const Cartesian& cartesian) { return add(cairn_filter_add_cartesian, cartesian); }

  //~ cairn_filter_add_custom
  /// Adds a sensor of the caller's own. `predict` is required.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorCapacity.
  ///
  /// Complexity: O(1).
  //! `predict(const Pose& pose, Span<const double> landmark, Prediction& out)` and
  //! `place(const Pose& pose, Span<const double> z, Placement& out)` return true for an answer and false for "not
  //! visible". If one throws, the call of the filter is aborted, the filter stays as it was, and the exception goes on
  //! to the caller. Both live until the filter is destroyed.
  template <class Predict, class Place = NoPlace>
  std::int32_t add_custom(const Custom& custom, Predict predict, Place place = {}) {
    using Model = detail::Model<Predict, Place>;
    std::unique_ptr<Model> model(new Model{std::move(predict), std::move(place), custom.rows, &this->shared()->thrown});
    std::int32_t sensor = -1;
    change(cairn_filter_add_custom, detail::as_c(&custom), Model::c_predict, Model::place_function(),
           static_cast<void*>(model.get()), Model::c_release, &sensor);
    static_cast<void>(model.release());
    return sensor;
  }

  //~ cairn_filter_point_head
  /// Sets the pan and stick angle (rad) of a stereo head from now on; both are 0 after it was added. Call this function
  /// before each frame that was taken at other angles.
  ///
  /// Throws Error: Status::kErrorArgument (not finite, or no stereo head); Status::kErrorNotFound.
  ///
  /// Complexity: O(1).
  void point_head(std::int32_t sensor, double pan, double stick) {
    change(cairn_filter_point_head, sensor, pan, stick);
  }

  //~ cairn_filter_set_loss
  /// Sets the loss of a sensor's residuals: an observation whose distance is large gets less weight, instead of being
  /// refused. `width` (> 0) is where the loss leaves the parabola, in standard deviations of the observation's noise.
  /// The weights are found in the iteration of the update, and the covariance is that of the robust estimate
  /// (docs/update.md, "Robust losses"). The chi-square gates stay; options with gate probabilities of 1 open them.
  /// Loss::kNone takes the loss away; `width` is then ignored. Allocates nothing.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound.
  ///
  /// Complexity: O(1).
  void set_loss(std::int32_t sensor, Loss loss, double width) {
    change(cairn_filter_set_loss, sensor, static_cast<cairn_loss>(loss), width);
  }

  //~ cairn_filter_set_view
  /// Sets the region in which a sensor detects every landmark: all observations between `lower` and `upper`, value by
  /// value, in the sensor's units. An infinite value is no bound. A sensor of fewer than 3 rows uses the first values.
  /// A frame has missed a landmark if its predicted observation lies inside the region by three standard deviations,
  /// and no observation of the frame was compared with the landmark (`missed_frames`).
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound.
  ///
  /// Complexity: O(1).
  void set_view(std::int32_t sensor, Vector<3> lower, Vector<3> upper) {
    change(cairn_filter_set_view, sensor, lower.get("lower"), upper.get("upper"));
  }

  //~ cairn_filter_set_wheels
  /// Sets the wheels for Filter::predict_wheels. Until then those of Wheels::Wheels are used.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  void set_wheels(const Wheels& wheels) { change(cairn_filter_set_wheels, detail::as_c(&wheels)); }

  //~ cairn_filter_set_twist_noise
  /// Sets the noise of Filter::predict_twist. Until then that of TwistNoise::TwistNoise is used.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  void set_twist_noise(const TwistNoise& noise) { change(cairn_filter_set_twist_noise, detail::as_c(&noise)); }

  //~ cairn_filter_calibrate_sensor
  /// Makes systematic errors of a sensor states of the filter. Call it after the sensor was added, before the first
  /// motion and the first observation, at most once for a sensor. All sensors together have at most max_sensor_errors
  /// of FilterOptions. Association (with unknown ids) uses the estimates, but leaves their uncertainty out of its
  /// gates.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound (sensor); Status::kErrorCapacity; Status::kErrorState
  /// (too late, or calibrated already); Status::kErrorMemory.
  ///
  /// Complexity: O(1).
  void calibrate_sensor(std::int32_t sensor, const Calibration& calibration) {
    change(cairn_filter_calibrate_sensor, sensor, detail::as_c(&calibration));
  }

  //~ cairn_filter_set_log
  /// Sets the receiver of this filter's log lines (refused batches, numerical refusals). The callback runs inside calls
  /// of the filter and must not call the same filter.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  //! `log(const char* line)`. What it throws is dropped, for a line has no part in the result of the call.
  template <class Log>
  void set_log(Log log) {
    using Receiver = detail::LogReceiver<Log>;
    std::unique_ptr<Receiver> receiver(new Receiver{std::move(log)});
    change(cairn_filter_set_log, Receiver::c_log, static_cast<void*>(receiver.get()), Receiver::c_release);
    static_cast<void>(receiver.release());
  }

  /// Ends the log.
  void clear_log() { change(cairn_filter_set_log, cairn_log_fn{}, static_cast<void*>(nullptr), cairn_release_fn{}); }

  // Motion.

  //~ cairn_filter_predict_wheels
  /// Moves the vehicle by the turning rates of its left and right wheels (rad/s) over `dt` seconds (> 0). Mars paper,
  /// eq. 1 and 2.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNumerical.
  ///
  /// Complexity: O(1).
  void predict_wheels(double dt, double left_rad_per_s, double right_rad_per_s) {
    change(cairn_filter_predict_wheels, dt, left_rad_per_s, right_rad_per_s);
  }

  //~ cairn_filter_predict_wheels_gyro
  /// Moves the vehicle by the turning rates of its left and right wheels (rad/s) and the body rate of a gyro (rad/s)
  /// over `dt` seconds (> 0): the velocity is that of Filter::predict_wheels, with its noise, and the rate has the
  /// noise of Filter::set_twist_noise. A planar vehicle reads only the rate about z.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNumerical.
  ///
  /// Complexity: O(1).
  void predict_wheels_gyro(double dt, double left_rad_per_s, double right_rad_per_s, Vector<3> rate) {
    change(cairn_filter_predict_wheels_gyro, dt, left_rad_per_s, right_rad_per_s, rate.get("rate"));
  }

  //~ cairn_filter_predict_twist
  /// Moves the vehicle by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0). Mars paper, eq. 2.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNumerical.
  ///
  /// Complexity: O(1).
  void predict_twist(double dt, Vector<3> velocity, Vector<3> rate) {
    change(cairn_filter_predict_twist, dt, velocity.get("velocity"), rate.get("rate"));
  }

  //~ cairn_filter_predict_increment
  /// Moves the vehicle by a relative pose, `T_map_body <- T_map_body T_before_after`, with the covariance (6x6
  /// row-major, symmetric, positive semidefinite) of its error [dp; dtheta] in the axes of the body before the motion.
  /// An increment has no duration: a filter that estimates a velocity or rate bias refuses it, and no random walk goes
  /// on.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNumerical; Status::kErrorState (a bias is a state).
  ///
  /// Complexity: O(1).
  void predict_increment(const Pose& T_before_after, Symmetric<6> covariance) {
    change(cairn_filter_predict_increment, detail::as_c(&T_before_after), covariance.get("covariance"));
  }

  // Observations.

  //~ cairn_filter_update
  /// Updates the filter by one frame of one sensor. The observations of known landmarks update the state together. An
  /// observation with an unknown id places a new landmark, with all its correlations. `matches` (room for `count`) gets
  /// the match of each observation. `count` may be 0. Allocates nothing.
  ///
  /// Throws Error: Status::kErrorArgument (also an id twice, kIdNone, noise that is not a covariance);
  /// Status::kErrorNotFound (sensor); Status::kErrorCapacity (more than max_observations); Status::kErrorNumerical;
  /// Status::kErrorCallback (a custom sensor's function aborted).
  ///
  /// Complexity: O(n^2 m) for n states and m rows.
  std::vector<Match> update(std::int32_t sensor, Input<Observation> observations) {
    std::vector<Match> matches(observations.size());
    update_into(sensor, observations, matches);
    return matches;
  }

  /// The same into an array of the caller, which has as many elements as there are observations. Allocates nothing.
  void update_into(std::int32_t sensor, Input<Observation> observations, Span<Match> matches) {
    if (matches.size() != observations.size()) detail::wrong_size("matches", observations.size(), matches.size());
    change(cairn_filter_update, sensor, detail::as_c(observations.data()), observations.size(),
           detail::as_c(matches.data()));
  }

  //~ cairn_filter_update_linear
  /// Updates the filter by an observation that the caller has linearised: `residual = z - h` (rows values),
  /// `covariance` of the noise (rows x rows), `jacobian_pose` = dh/[dp; dtheta] (rows x 6, none for zero) and
  /// `jacobian_landmarks` = dh/d positions (rows x 3 count, columns in the order of `landmarks`); all row-major. With
  /// submaps, pose and landmarks are those of the open submap, in its frame. The observation is gated as one of that
  /// many rows (gate_probability) and is not iterated. `match` gets the match; its landmark is the first one, or
  /// kIdNone. rows is 1 to 3 max_observations (planar: 2), count at most max_observations.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound; Status::kErrorCapacity; Status::kErrorNumerical.
  ///
  /// Complexity: O(n^2 rows).
  //! `jacobian_pose` may be an empty array: zeros.
  Match update_linear(Vector<0> residual, Symmetric<0> covariance, Vector<0> jacobian_pose,
                      Input<std::uint64_t> landmarks, Vector<0> jacobian_landmarks) {
    const std::size_t rows = residual.size(), count = landmarks.size();
    const bool moves = jacobian_pose.size() != 0;
    return update_one(cairn_filter_update_linear, residual.data(), rows, covariance.get("covariance", rows * rows),
                      moves ? jacobian_pose.get("jacobian_pose", 6 * rows) : nullptr, landmarks.data(), count,
                      jacobian_landmarks.get("jacobian_landmarks", 3 * rows * count));
  }

  //~ cairn_filter_update_position
  /// Updates the filter by an absolute position (GNSS): `z = p + R lever_arm` in the map frame, m; 3x3 `covariance`,
  /// positive definite. `lever_arm` (body frame, m) may be none: zero. `match` gets the match.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNumerical.
  ///
  /// Complexity: O(n^2).
  Match update_position(Vector<3> position, Symmetric<3> covariance, Vector<3> lever_arm = {}) {
    return update_one(cairn_filter_update_position, position.get("position"), covariance.get("covariance"),
                      lever_arm.get_optional("lever_arm"));
  }

  //~ cairn_filter_update_attitude
  /// Updates the filter by an absolute attitude (star tracker): quaternion w x y z from body to map; 3x3 `covariance`
  /// (rad^2, positive definite) of its error dtheta in the map's axes. `match` gets the match.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNumerical.
  ///
  /// Complexity: O(n^2).
  Match update_attitude(Vector<4> quaternion, Symmetric<3> covariance) {
    return update_one(cairn_filter_update_attitude, quaternion.get("quaternion"), covariance.get("covariance"));
  }

  //~ cairn_filter_update_heading
  /// Updates the filter by an absolute heading (sun sensor, compass): the yaw of the body's x axis in the map, rad,
  /// with its standard deviation (> 0). A tilted body adds noise of second order (docs/sensors.md). The heading is
  /// refused (Reason::kNoImage) if the x axis is within three standard deviations of the tilt of the vertical. `match`
  /// gets the match.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNumerical.
  ///
  /// Complexity: O(n^2).
  Match update_heading(double heading, double sigma) { return update_one(cairn_filter_update_heading, heading, sigma); }

  // Landmarks.

  //~ cairn_filter_remove_landmark
  /// Removes a landmark from the map and from the open submap. The information that it gave about other states stays.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound.
  ///
  /// Complexity: O(n).
  void remove_landmark(std::uint64_t id) { change(cairn_filter_remove_landmark, id); }

  //~ cairn_filter_merge_landmarks
  /// Merges two landmarks of the open submap, or of the single map, that are in truth one. The filter observes that
  /// their difference is zero; this observation is gated like any other (gate_probability). If it passes, `other` is
  /// removed, and `id` stays with the observations of both. `match` gets the match.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound; Status::kErrorCapacity (max_observations is 1);
  /// Status::kErrorNumerical.
  ///
  /// Complexity: O(n^2).
  Match merge_landmarks(std::uint64_t id, std::uint64_t other) {
    return update_one(cairn_filter_merge_landmarks, id, other);
  }

  //~ cairn_filter_split_landmark
  /// Splits a landmark that is in truth two landmarks. The new landmark `fresh` gets the position of `id` plus an
  /// independent error with this 3x3 covariance (positive definite; it says how far apart the two may be). Later
  /// observations separate the two.
  ///
  /// Throws Error: Status::kErrorArgument (also if `fresh` exists, or if the filter names landmarks itself and `fresh`
  /// is 2^63 or more); Status::kErrorNotFound; Status::kErrorCapacity.
  ///
  /// Complexity: O(n).
  void split_landmark(std::uint64_t id, std::uint64_t fresh, Symmetric<3> covariance) {
    change(cairn_filter_split_landmark, id, fresh, covariance.get("covariance"));
  }

  // Submaps.

  //~ cairn_filter_close_submap
  /// Closes the open submap now. Allocates. A call that fails leaves the filter as it was, with the submap open.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorState (a single map, or the submap holds no landmark);
  /// Status::kErrorCapacity (max_landmarks); Status::kErrorNumerical; Status::kErrorMemory.
  ///
  /// Complexity: dense O(n^2) for n states of the map; sparse: the part of the factor that the closing affects.
  void close_submap() { change(cairn_filter_close_submap); }

  //~ cairn_filter_last_closing
  /// Reports on the last attempt to close a submap; zeros before the first attempt.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  ClosingReport last_closing() const { return get<ClosingReport>(cairn_filter_last_closing); }

  //~ cairn_filter_local_pose
  /// Pose of the body in the open submap, and the covariance of its error [dp; dtheta] (6x6 row-major). With a single
  /// map: in the map.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  PoseEstimate local_pose() const { return estimate(cairn_filter_local_pose); }

  //~ cairn_filter_base_pose
  /// Pose of the open submap's origin in the map, and the covariance of its error [dp; dtheta] (6x6 row-major). That is
  /// what the closed submaps tell: landmarks that the open submap sees again, and fixes in it, correct Filter::pose at
  /// once and the origin at the closing. With a single map: identity and zero.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  PoseEstimate base_pose() const { return estimate(cairn_filter_base_pose); }

  //~ cairn_filter_submap_count
  /// Number of submaps closed so far.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  std::size_t submap_count() const { return get<std::size_t>(cairn_filter_submap_count); }

  //~ cairn_filter_submap
  /// A closed submap, counted from 0: the pose of its origin in the map as known now (dense: as known at its closing),
  /// and the ids of its landmarks in the order in which they were placed. Of a submap that a sparse map has fused with
  /// others of its place they are the ids of this place.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound; Status::kErrorBuffer.
  ///
  /// Complexity: O(landmarks of the submap).
  ClosedSubmap submap(std::size_t index) const {
    ClosedSubmap submap;
    submap.ids = list<std::uint64_t>(cairn_filter_submap, index, detail::as_c(&submap.base));
    return submap;
  }

  // Estimates.

  //~ cairn_filter_pose
  /// Pose of the body in the map, and the covariance of its error [dp; dtheta] (6x6 row-major). With submaps the pose
  /// knows what the open submap has seen again of the map, before the submap is closed.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1); with submaps O(d^3) for d landmarks that the open submap and the map have in common, and once
  /// after d has changed what MapView::joint_covariance of them costs.
  PoseEstimate pose() const { return estimate(cairn_filter_pose); }

  //~ cairn_filter_map
  /// The filter's map. With submaps it holds the landmarks of the closed submaps; the landmarks of the open submap join
  /// it when this submap is closed. The filter owns this map; it lives as long as the filter and follows it.
  ///
  /// Complexity: O(1).
  MapView map() const { return {shared(), lend(cairn_filter_map), detail::FilterKind::name}; }

  //~ cairn_filter_local_map
  /// The landmarks of the open submap, in its frame; with a single map the same as Filter::map. The filter owns this
  /// map; it lives as long as the filter and follows it.
  ///
  /// Complexity: O(1).
  MapView local_map() const { return {shared(), lend(cairn_filter_local_map), detail::FilterKind::name}; }

  //~ cairn_filter_joint_covariance
  /// Joint covariance of the pose's error [dp; dtheta] and the positions of chosen landmarks, in this order, row-major,
  /// with 6 + 3 count rows and columns.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound; Status::kErrorBuffer.
  ///
  /// Complexity: O(count^2).
  std::vector<double> joint_covariance(Input<std::uint64_t> ids) const {
    return list<double>(cairn_filter_joint_covariance, ids.data(), ids.size());
  }

  //~ cairn_filter_systematic_errors
  /// The estimates of all components that are states, those of the motion first, then sensor by sensor in the order of
  /// their calibration, each in the order of kinds and components. `needed` is their number.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(1).
  SystematicErrors systematic_errors() const {
    SystematicErrors result;
    const auto function = [&](const cairn_filter* filter, cairn_systematic_error* errors, std::size_t capacity,
                              std::size_t* needed, cairn_error* error) {
      result.covariance.resize(capacity * capacity);
      return cairn_filter_systematic_errors(filter, errors, result.covariance.data(), capacity, needed, error);
    };
    result.errors = list<SystematicError>(function);
    return result;
  }

  //~ cairn_filter_keep_pose
  /// Keeps the pose of the body now, as an update does: for a step in which nothing was observed. `number` gets the
  /// number of the pose.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorState (`trajectory_poses` is 0).
  ///
  /// Complexity: O(1); allocates nothing.
  std::uint64_t keep_pose() {
    std::uint64_t number = 0;
    change(cairn_filter_keep_pose, &number);
    return number;
  }

  //~ cairn_filter_trajectory_range
  /// The numbers of the poses that are kept: from `first` up to but not including `end`. `end` is the number of poses
  /// so far.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorState (`trajectory_poses` is 0).
  ///
  /// Complexity: O(1).
  PoseNumbers trajectory_range() const {
    PoseNumbers numbers;
    query(cairn_filter_trajectory_range, &numbers.first, &numbers.end);
    return numbers;
  }

  //~ cairn_filter_trajectory
  /// The poses of the body in the map, as they are known now, from the number `first` to the newest one. Close the open
  /// submap first to have its last corrections.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorState (`trajectory_poses` is 0); Status::kErrorCapacity (the
  /// trajectory has become longer than `trajectory_poses`, and the pose `first` was dropped); Status::kErrorNotFound
  /// (`first` is greater than the number of poses so far); Status::kErrorBuffer.
  ///
  /// Complexity: O(poses); allocates nothing.
  std::vector<Pose> trajectory(std::uint64_t first = 0) const { return list<Pose>(cairn_filter_trajectory, first); }

  // How far to trust them.

  //~ cairn_filter_last_update
  /// Reports on the last successful update of any kind; zeros before the first update.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  UpdateReport last_update() const { return get<UpdateReport>(cairn_filter_last_update); }

  //~ cairn_filter_health
  /// The verdict on a filter. All of it is what the last update left: the call computes nothing.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  Health health() const { return get<Health>(cairn_filter_health); }

  //~ cairn_filter_sensor_health
  /// What the observations of one sensor show.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound (sensor).
  ///
  /// Complexity: O(1).
  SensorHealth sensor_health(std::int32_t sensor) const {
    return get<SensorHealth>(cairn_filter_sensor_health, sensor);
  }

  //~ cairn_filter_pose_nees
  /// Normalised estimation error squared (NEES) of the pose against the true pose, in the error coordinates of the
  /// filter. A consistent filter has 6 on average, for a planar vehicle 3.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNumerical (the covariance of the pose is singular, as at a
  /// known start).
  ///
  /// Complexity: O(1).
  double pose_nees(const Pose& truth) const { return get<double>(cairn_filter_pose_nees, detail::as_c(&truth)); }

  //~ cairn_filter_audit
  /// Checks the whole covariance (with submaps, that of the open submap): `min_pivot` gets the smallest pivot of its
  /// Cholesky factor after scaling to unit diagonal. It is 0 or less if the covariance is not positive definite. States
  /// that are known exactly (zero variance) are left out.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(n^3).
  double audit() {
    double min_pivot = 0.0;
    change(cairn_filter_audit, &min_pivot);
    return min_pivot;
  }

 private:
  template <class Function, class Options>
  std::int32_t add(Function function, const Options& options) {
    std::int32_t sensor = -1;
    change(function, detail::as_c(&options), &sensor);
    return sensor;
  }

  template <class Function, class... Arguments>
  Match update_one(Function function, Arguments... arguments) {
    Match match;
    change(function, arguments..., detail::as_c(&match));
    return match;
  }

  template <class Function>
  PoseEstimate estimate(Function function) const {
    PoseEstimate result;
    query(function, detail::as_c(&result.pose), result.covariance.data());
    return result;
  }
};

}  // namespace cairn

#endif
