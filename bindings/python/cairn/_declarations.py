# SPDX-License-Identifier: BSD-3-Clause
# Written by generate.py from the description of the C interface: do not edit.
"""The C declarations for cffi, and what they do not say: which fields hold constants or booleans."""

VERSION = '0.2.0'
SONAMES: dict[str, str] = {
    "cairn": "libcairn.so.0.2",
    "cairn_sim": "libcairn_sim.so.0.2",
}
CDEF = """
typedef int32_t cairn_bool;
typedef int32_t cairn_status;
typedef int32_t cairn_map_form;
typedef int32_t cairn_merge_by;
typedef int32_t cairn_yaw;
typedef int32_t cairn_encoder;
typedef int32_t cairn_loss;
typedef int32_t cairn_result;
typedef int32_t cairn_reason;
typedef int32_t cairn_state_error;
typedef int32_t cairn_vehicle;
typedef int32_t cairn_join;
typedef int32_t cairn_association;
typedef int32_t cairn_distance;
typedef int32_t cairn_noise_learning;
typedef int32_t cairn_closed_by;
typedef int32_t cairn_verdict;
typedef uint32_t cairn_doubts;
typedef int32_t cairn_systematic;
typedef int32_t cairn_team_mode;
typedef int32_t cairn_packet;
typedef int32_t cairn_course;
typedef int32_t cairn_terrain;
typedef int32_t cairn_contact;
typedef int32_t cairn_drive;
typedef int32_t cairn_accelerometer;
typedef int32_t cairn_stick;
typedef int32_t cairn_preset;
typedef int32_t cairn_fleet_layout;
typedef struct cairn_map cairn_map;
typedef struct cairn_filter cairn_filter;
typedef struct cairn_team cairn_team;
typedef struct cairn_world cairn_world;
typedef struct cairn_fleet cairn_fleet;
typedef struct cairn_error { uint32_t struct_size; cairn_status status; char message[504]; } cairn_error;
typedef struct cairn_pose { double position[3]; double quaternion[4]; } cairn_pose;
typedef struct cairn_landmark { uint64_t id; uint64_t observations; double position[3]; double covariance[9]; }
  cairn_landmark;
typedef struct cairn_merge_options { uint32_t struct_size; cairn_merge_by association; double gate_probability; double
  joint_gate_probability; uint64_t max_landmarks; double max_tilt; cairn_bool has_transform; uint32_t reserved;
  cairn_pose T_map_other; double covariance[36]; } cairn_merge_options;
typedef struct cairn_merge_report { uint32_t struct_size; cairn_merge_by association; uint64_t common; uint64_t added;
  uint64_t rows; double distance; double threshold; cairn_pose T_map_other; double covariance[36]; uint64_t broken_id;
  uint64_t broken_other_id; } cairn_merge_report;
typedef struct cairn_merged_id { uint64_t other_id; uint64_t id; cairn_bool common; uint32_t reserved; }
  cairn_merged_id;
typedef struct cairn_wheels { uint32_t struct_size; cairn_yaw yaw_sign; double radius; double track; double rate_sigma;
  double slip_sigma; double lateral_sigma; double vertical_sigma; double roll_rate_sigma; double pitch_rate_sigma; }
  cairn_wheels;
typedef struct cairn_twist_noise { uint32_t struct_size; uint32_t reserved; double velocity_sigma[3]; double
  rate_sigma[3]; } cairn_twist_noise;
typedef struct cairn_stereo_head { uint32_t struct_size; cairn_encoder encoder_mode; double platform[3]; double
  stick[3]; double camera_quaternion[4]; double range_sigma; double azimuth_sigma; double elevation_sigma; double
  pan_sigma; double stick_sigma; double near_range; double max_elevation; } cairn_stereo_head;
typedef struct cairn_stereo_camera { uint32_t struct_size; uint32_t reserved; double fu; double fv; double cu; double
  cv; double baseline; cairn_pose T_body_camera; double sigma[3]; double near_depth; double min_disparity; double
  min_disparity_sigmas; } cairn_stereo_camera;
typedef struct cairn_range_bearing { uint32_t struct_size; uint32_t reserved; cairn_pose T_body_sensor; double
  range_sigma; double bearing_sigma; double near_range; } cairn_range_bearing;
typedef struct cairn_cartesian { uint32_t struct_size; uint32_t reserved; cairn_pose T_body_sensor; double sigma[3]; }
  cairn_cartesian;
typedef struct cairn_custom { uint32_t struct_size; uint32_t rows; uint32_t angle_mask; cairn_bool relative; double
  sigma[3]; } cairn_custom;
typedef struct cairn_observation { uint64_t id; double z[3]; double covariance[9]; } cairn_observation;
typedef struct cairn_match { uint64_t landmark; cairn_result result; cairn_reason reason; double distance; double
  threshold; } cairn_match;
typedef struct cairn_filter_options { uint32_t struct_size; cairn_vehicle vehicle; cairn_state_error state_error;
  uint32_t max_landmarks; uint32_t max_observations; uint32_t max_sensors; cairn_pose initial_pose; double
  initial_covariance[36]; uint32_t iterations; cairn_noise_learning noise_learning; double iteration_tolerance; double
  gate_probability; double batch_gate_probability; double error_persistence; cairn_association association;
  cairn_distance association_distance; uint32_t association_nodes; uint32_t deferred_sightings; uint32_t
  deferred_frames; uint32_t missed_frames; double new_probability; uint32_t submap_landmarks; cairn_join join;
  cairn_loss join_loss; uint32_t trajectory_poses; double join_loss_width; double submap_distance; double
  submap_extent; double submap_sigma; double velocity_bias_sigma[3]; double velocity_bias_walk[3]; double
  rate_bias_sigma[3]; double rate_bias_walk[3]; double wheel_scale_sigma[2]; double wheel_scale_walk[2]; uint32_t
  max_sensor_errors; uint32_t reserved; } cairn_filter_options;
typedef struct cairn_closing_report { uint32_t struct_size; cairn_status status; cairn_closed_by reason; uint32_t
  submaps; uint32_t landmarks; uint32_t landmarks_new; uint32_t landmarks_fused; uint32_t landmarks_refused; uint32_t
  landmarks_ambiguous; uint32_t rows; double distance; double threshold; double moved_max; double moved_rms; double
  widened_position; double widened_attitude; uint32_t association_nodes; cairn_bool association_exhausted; uint32_t
  relinearised; uint32_t refactored; uint32_t iterations; uint32_t reserved; double seconds; } cairn_closing_report;
typedef struct cairn_update_report { uint32_t struct_size; uint32_t matched; uint32_t placed; uint32_t placed_again;
  uint32_t rejected; uint32_t deferred; uint32_t removed; uint32_t rows; double nis; double nis_lower; double
  nis_upper; double widened_position; double widened_attitude; uint32_t iterations; uint32_t association_nodes;
  cairn_bool association_exhausted; uint32_t reserved; double association_seconds; } cairn_update_report;
typedef struct cairn_health { uint32_t struct_size; cairn_verdict verdict; cairn_doubts reasons; uint32_t
  blind_directions; uint32_t contradicting; uint32_t reserved; uint64_t updates; double good_share; double
  doubtful_share; double lost_share; double nis_per_row; double nis_lower; double nis_upper; double refused_share;
  uint64_t widenings; double last_widening; double motion_scale; double motion_scale_sigma; double bias_sigmas; double
  jump_sigmas; double pose_pivot; } cairn_health;
typedef struct cairn_sensor_health { uint32_t struct_size; uint32_t reserved; uint64_t compared; uint64_t refused;
  double nis_per_row; double nis_lower; double nis_upper; double scale; double scale_sigma; double persistence[4]; }
  cairn_sensor_health;
typedef struct cairn_calibration { uint32_t struct_size; uint32_t reserved; double mount_shift_sigma[3]; double
  mount_shift_walk[3]; double mount_turn_sigma[3]; double mount_turn_walk[3]; double offset_sigma[3]; double
  offset_walk[3]; } cairn_calibration;
typedef struct cairn_systematic_error { cairn_systematic kind; int32_t sensor; int32_t component; int32_t reserved;
  double value; double sigma; } cairn_systematic_error;
typedef struct cairn_team_options { uint32_t struct_size; cairn_team_mode mode; uint64_t vehicle; uint32_t
  max_vehicles; cairn_bool baseline; double max_lag; double time_tolerance; double max_jump; uint32_t max_waiting;
  uint32_t history; } cairn_team_options;
typedef struct cairn_team_report { uint32_t struct_size; uint32_t unsettled; cairn_bool interrupted; uint32_t reserved;
  uint64_t sent; uint64_t resent; uint64_t requested; uint64_t received; uint64_t taken; uint64_t reordered; uint64_t
  repeated; uint64_t own; uint64_t ignored; uint64_t unknown; uint64_t past; uint64_t ahead; uint64_t conflict;
  uint64_t full; uint64_t foreign; uint64_t version; uint64_t cut; uint64_t corrupt; uint64_t nonsense; uint64_t lost;
  uint64_t matched; uint64_t placed; uint64_t rejected; uint64_t sightings_used; uint64_t sightings_refused; uint64_t
  vehicles_found; uint64_t failed; uint64_t scored; uint64_t scored_nees; double position_rmse; double anees_per_dof;
  double claimed_improvement; double true_improvement; } cairn_team_report;
typedef struct cairn_world_options { uint32_t struct_size; cairn_course course; uint64_t seed; uint32_t landmarks;
  cairn_terrain terrain; cairn_contact contact; cairn_drive drive; cairn_accelerometer accelerometer; cairn_stick
  stick_noise; cairn_bool observe_at_start; cairn_bool traverse_closed; double speed; double laps; double centre[2];
  double radius; double start_azimuth; double round_length; double round_variation; double strip; double landmark_area;
  double landmark_height; double max_slope; double wavelength[2]; double start_height; double wheel_radius; double
  track; double wheelbase; double velocity_sigma; double rate_sigma; double gravity; double wheel_rate_sigma; double
  wheel_slip_sigma; double lateral_sigma; double vertical_sigma; double imu_period; double motion_period; double
  frame_period; double range_sigma; double azimuth_sigma; double stick_sigma; double image_sigma; double near_range;
  double far_range; double half_azimuth; double pan_amplitude; double pan_period; double stick_amplitude; double
  stick_period; double platform[3]; double stick[3]; double velocity_bias[3]; double rate_bias[3]; double
  wheel_scale[2]; double mount_turn[3]; double mount_shift[3]; double value_offset[3]; } cairn_world_options;
typedef struct cairn_world_motion { double dt; double velocity[3]; double rate[3]; double wheels[2]; double
  true_velocity[3]; double true_rate[3]; double true_wheels[2]; } cairn_world_motion;
typedef struct cairn_world_step { uint32_t struct_size; uint32_t reserved; uint64_t number; double time; cairn_pose
  truth; double velocity_sigma[3]; double rate_sigma[3]; double pan; double stick; uint64_t motion_count; uint64_t
  observation_count; } cairn_world_step;
typedef struct cairn_fleet_options { uint32_t struct_size; cairn_fleet_layout layout; uint64_t seed; uint32_t vehicles;
  uint32_t features; double area; double separation; double course_length; double duration; double period; double
  radar_range; double range_sigma; double bearing_sigma; double speed_sigma; double rate_sigma; double coast_distance;
  double coast_relief; double coast_strip; } cairn_fleet_options;
typedef struct cairn_fleet_sighting { uint64_t id; double range; double bearing; } cairn_fleet_sighting;
typedef struct cairn_fleet_vehicle { double speed; double rate; double x; double y; double heading; uint64_t
  feature_count; uint64_t vehicle_count; } cairn_fleet_vehicle;
typedef struct cairn_fleet_step { uint32_t struct_size; uint32_t reserved; uint64_t number; double time; double dt;
  uint64_t vehicle_count; } cairn_fleet_step;
typedef void (*cairn_release_fn)(void *user);
typedef int32_t (*cairn_custom_predict_fn)(void *user, const cairn_pose *pose, const double landmark[3], double *z,
  double *jacobian_pose, double *jacobian_landmark);
typedef int32_t (*cairn_custom_place_fn)(void *user, const cairn_pose *pose, const double *z, double landmark[3],
  double *jacobian_pose, double *jacobian_z);
typedef void (*cairn_log_fn)(void *payload, const char *line);
const char *cairn_status_name(cairn_status status);
const char *cairn_last_message(void);
const char *cairn_version(void);
uint32_t cairn_version_number(void);
cairn_bool cairn_has(const char *feature);
const char *cairn_build(void);
cairn_status cairn_pose_identity(cairn_pose *pose, cairn_error *error);
cairn_status cairn_pose_compose(const cairn_pose *T_a_b, const cairn_pose *T_b_c, cairn_pose *result, cairn_error
  *error);
cairn_status cairn_pose_inverse(const cairn_pose *T_a_b, cairn_pose *result, cairn_error *error);
cairn_status cairn_pose_apply(const cairn_pose *T_a_b, const double point_b[3], double point_a[3], cairn_error *error);
cairn_status cairn_quaternion_from_euler(double roll, double pitch, double yaw, double quaternion[4], cairn_error
  *error);
cairn_status cairn_quaternion_to_euler(const double quaternion[4], double *roll, double *pitch, double *yaw,
  cairn_error *error);
cairn_status cairn_quaternion_exp(const double rotation_vector[3], double quaternion[4], cairn_error *error);
cairn_status cairn_quaternion_log(const double quaternion[4], double rotation_vector[3], cairn_error *error);
cairn_status cairn_pose_error(const cairn_pose *truth, const cairn_pose *estimate, double difference[6], cairn_error
  *error);
cairn_status cairn_map_size(const cairn_map *map, size_t *count, cairn_error *error);
cairn_status cairn_map_landmark(const cairn_map *map, uint64_t id, cairn_landmark *landmark, cairn_error *error);
cairn_status cairn_map_landmarks(const cairn_map *map, cairn_landmark *landmarks, size_t capacity, size_t *needed,
  cairn_error *error);
cairn_status cairn_map_within(const cairn_map *map, const double centre[3], double radius, cairn_landmark *landmarks,
  size_t capacity, size_t *needed, cairn_error *error);
cairn_status cairn_map_nearest(const cairn_map *map, const double point[3], size_t count, cairn_landmark *landmarks,
  size_t capacity, size_t *needed, cairn_error *error);
cairn_status cairn_map_in_box(const cairn_map *map, const double lower[3], const double upper[3], cairn_landmark
  *landmarks, size_t capacity, size_t *needed, cairn_error *error);
cairn_status cairn_map_joint_covariance(const cairn_map *map, const uint64_t *ids, size_t count, double *matrix, size_t
  capacity, size_t *needed, cairn_error *error);
cairn_status cairn_map_kind(const cairn_map *map, cairn_map_form *kind, cairn_error *error);
cairn_status cairn_map_copy(const cairn_map *map, cairn_map **copy, cairn_error *error);
void cairn_map_destroy(cairn_map *map);
cairn_status cairn_merge_options_init(cairn_merge_options *options, size_t struct_size, cairn_error *error);
cairn_status cairn_map_merge(cairn_map *map, const cairn_map *other, const cairn_merge_options *options,
  cairn_merge_report *report, cairn_error *error);
cairn_status cairn_map_merged_ids(const cairn_map *map, cairn_merged_id *merged, size_t capacity, size_t *needed,
  cairn_error *error);
cairn_status cairn_wheels_init(cairn_wheels *wheels, size_t struct_size, cairn_error *error);
cairn_status cairn_twist_noise_init(cairn_twist_noise *noise, size_t struct_size, cairn_error *error);
uint64_t cairn_id_none(void);
cairn_status cairn_stereo_head_init(cairn_stereo_head *head, size_t struct_size, cairn_error *error);
cairn_status cairn_stereo_camera_init(cairn_stereo_camera *camera, size_t struct_size, cairn_error *error);
cairn_status cairn_range_bearing_init(cairn_range_bearing *radar, size_t struct_size, cairn_error *error);
cairn_status cairn_cartesian_init(cairn_cartesian *cartesian, size_t struct_size, cairn_error *error);
cairn_status cairn_custom_init(cairn_custom *custom, size_t struct_size, cairn_error *error);
cairn_status cairn_custom_check(const cairn_custom *custom, cairn_custom_predict_fn predict, cairn_custom_place_fn
  place, void *user, const cairn_pose *pose, const double landmark[3], double *worst, cairn_error *error);
cairn_status cairn_filter_options_init(cairn_filter_options *options, size_t struct_size, cairn_error *error);
cairn_status cairn_filter_required_bytes(const cairn_filter_options *options, size_t *bytes, cairn_error *error);
cairn_status cairn_filter_create(const cairn_filter_options *options, cairn_filter **filter, cairn_error *error);
void cairn_filter_destroy(cairn_filter *filter);
cairn_status cairn_filter_set_log(cairn_filter *filter, cairn_log_fn log, void *payload, cairn_release_fn release,
  cairn_error *error);
cairn_status cairn_filter_add_stereo_head(cairn_filter *filter, const cairn_stereo_head *head, int32_t *sensor,
  cairn_error *error);
cairn_status cairn_filter_add_stereo_camera(cairn_filter *filter, const cairn_stereo_camera *camera, int32_t *sensor,
  cairn_error *error);
cairn_status cairn_filter_add_range_bearing(cairn_filter *filter, const cairn_range_bearing *radar, int32_t *sensor,
  cairn_error *error);
cairn_status cairn_filter_add_cartesian(cairn_filter *filter, const cairn_cartesian *cartesian, int32_t *sensor,
  cairn_error *error);
cairn_status cairn_filter_add_custom(cairn_filter *filter, const cairn_custom *custom, cairn_custom_predict_fn predict,
  cairn_custom_place_fn place, void *user, cairn_release_fn release, int32_t *sensor, cairn_error *error);
cairn_status cairn_filter_point_head(cairn_filter *filter, int32_t sensor, double pan, double stick, cairn_error
  *error);
cairn_status cairn_filter_set_loss(cairn_filter *filter, int32_t sensor, cairn_loss loss, double width, cairn_error
  *error);
cairn_status cairn_filter_set_view(cairn_filter *filter, int32_t sensor, const double lower[3], const double upper[3],
  cairn_error *error);
cairn_status cairn_filter_set_wheels(cairn_filter *filter, const cairn_wheels *wheels, cairn_error *error);
cairn_status cairn_filter_set_twist_noise(cairn_filter *filter, const cairn_twist_noise *noise, cairn_error *error);
cairn_status cairn_filter_predict_wheels(cairn_filter *filter, double dt, double left_rad_per_s, double
  right_rad_per_s, cairn_error *error);
cairn_status cairn_filter_predict_wheels_gyro(cairn_filter *filter, double dt, double left_rad_per_s, double
  right_rad_per_s, const double rate[3], cairn_error *error);
cairn_status cairn_filter_predict_twist(cairn_filter *filter, double dt, const double velocity[3], const double
  rate[3], cairn_error *error);
cairn_status cairn_filter_predict_increment(cairn_filter *filter, const cairn_pose *T_before_after, const double
  covariance[36], cairn_error *error);
cairn_status cairn_filter_update(cairn_filter *filter, int32_t sensor, const cairn_observation *observations, size_t
  count, cairn_match *matches, cairn_error *error);
cairn_status cairn_filter_update_linear(cairn_filter *filter, const double *residual, size_t rows, const double
  *covariance, const double *jacobian_pose, const uint64_t *landmarks, size_t count, const double *jacobian_landmarks,
  cairn_match *match, cairn_error *error);
cairn_status cairn_filter_update_position(cairn_filter *filter, const double position[3], const double covariance[9],
  const double lever_arm[3], cairn_match *match, cairn_error *error);
cairn_status cairn_filter_update_attitude(cairn_filter *filter, const double quaternion[4], const double covariance[9],
  cairn_match *match, cairn_error *error);
cairn_status cairn_filter_update_heading(cairn_filter *filter, double heading, double sigma, cairn_match *match,
  cairn_error *error);
cairn_status cairn_filter_remove_landmark(cairn_filter *filter, uint64_t id, cairn_error *error);
cairn_status cairn_filter_merge_landmarks(cairn_filter *filter, uint64_t id, uint64_t other, cairn_match *match,
  cairn_error *error);
cairn_status cairn_filter_split_landmark(cairn_filter *filter, uint64_t id, uint64_t fresh, const double covariance[9],
  cairn_error *error);
cairn_status cairn_filter_close_submap(cairn_filter *filter, cairn_error *error);
cairn_status cairn_filter_last_closing(const cairn_filter *filter, cairn_closing_report *report, cairn_error *error);
cairn_status cairn_filter_local_pose(const cairn_filter *filter, cairn_pose *pose, double covariance[36], cairn_error
  *error);
cairn_status cairn_filter_base_pose(const cairn_filter *filter, cairn_pose *pose, double covariance[36], cairn_error
  *error);
cairn_status cairn_filter_submap_count(const cairn_filter *filter, size_t *count, cairn_error *error);
cairn_status cairn_filter_submap(const cairn_filter *filter, size_t index, cairn_pose *base, uint64_t *ids, size_t
  capacity, size_t *needed, cairn_error *error);
cairn_status cairn_filter_last_update(const cairn_filter *filter, cairn_update_report *report, cairn_error *error);
cairn_status cairn_filter_pose(const cairn_filter *filter, cairn_pose *pose, double covariance[36], cairn_error
  *error);
cairn_status cairn_filter_joint_covariance(const cairn_filter *filter, const uint64_t *ids, size_t count, double
  *matrix, size_t capacity, size_t *needed, cairn_error *error);
const cairn_map *cairn_filter_local_map(const cairn_filter *filter);
const cairn_map *cairn_filter_map(const cairn_filter *filter);
cairn_status cairn_filter_pose_nees(const cairn_filter *filter, const cairn_pose *truth, double *nees, cairn_error
  *error);
cairn_status cairn_filter_audit(cairn_filter *filter, double *min_pivot, cairn_error *error);
cairn_status cairn_filter_health(const cairn_filter *filter, cairn_health *health, cairn_error *error);
cairn_status cairn_filter_sensor_health(const cairn_filter *filter, int32_t sensor, cairn_sensor_health *health,
  cairn_error *error);
const char *cairn_verdict_text(cairn_verdict verdict);
const char *cairn_doubt_text(cairn_doubts reason);
cairn_status cairn_calibration_init(cairn_calibration *calibration, size_t struct_size, cairn_error *error);
cairn_status cairn_filter_calibrate_sensor(cairn_filter *filter, int32_t sensor, const cairn_calibration *calibration,
  cairn_error *error);
cairn_status cairn_filter_systematic_errors(const cairn_filter *filter, cairn_systematic_error *errors, double
  *covariance, size_t capacity, size_t *needed, cairn_error *error);
cairn_status cairn_team_options_init(cairn_team_options *options, size_t struct_size, cairn_error *error);
cairn_status cairn_team_create(const cairn_team_options *options, const cairn_filter_options *filter, const
  cairn_range_bearing *radar, cairn_team **team, cairn_error *error);
void cairn_team_destroy(cairn_team *team);
cairn_status cairn_team_add(cairn_team *team, uint64_t vehicle, const cairn_pose *start, const double covariance[36],
  cairn_error *error);
cairn_status cairn_team_remove(cairn_team *team, uint64_t vehicle, cairn_error *error);
cairn_status cairn_team_members(const cairn_team *team, uint64_t *vehicles, size_t capacity, size_t *needed,
  cairn_error *error);
cairn_status cairn_team_predict_increment(cairn_team *team, const cairn_pose *T_before_after, const double
  covariance[36], cairn_error *error);
cairn_status cairn_team_predict_twist(cairn_team *team, double dt, const double velocity[3], const double rate[3],
  const cairn_twist_noise *noise, cairn_error *error);
cairn_status cairn_team_observe(cairn_team *team, double time, const cairn_observation *landmarks, size_t
  landmark_count, const cairn_observation *vehicles, size_t vehicle_count, cairn_error *error);
cairn_status cairn_team_decisions(const cairn_team *team, cairn_match *matches, size_t capacity, size_t *needed,
  cairn_error *error);
cairn_status cairn_team_leave(cairn_team *team, cairn_error *error);
cairn_status cairn_team_take_packet(cairn_team *team, uint8_t *packet, size_t capacity, size_t *needed, cairn_error
  *error);
cairn_status cairn_team_ask(cairn_team *team, cairn_error *error);
cairn_status cairn_team_receive(cairn_team *team, const uint8_t *packet, size_t size, cairn_packet *result, cairn_error
  *error);
cairn_status cairn_team_pose(const cairn_team *team, uint64_t vehicle, cairn_pose *pose, double covariance[36],
  cairn_error *error);
cairn_status cairn_team_pose_nees(const cairn_team *team, const cairn_pose *truth, double *nees, cairn_error *error);
const cairn_map *cairn_team_map(const cairn_team *team);
cairn_status cairn_team_score(cairn_team *team, const cairn_pose *truth, cairn_error *error);
cairn_status cairn_team_last_report(const cairn_team *team, cairn_team_report *report, cairn_error *error);
cairn_status cairn_filter_keep_pose(cairn_filter *filter, uint64_t *number, cairn_error *error);
cairn_status cairn_filter_trajectory_range(const cairn_filter *filter, uint64_t *first, uint64_t *end, cairn_error
  *error);
cairn_status cairn_filter_trajectory(const cairn_filter *filter, uint64_t first, cairn_pose *poses, size_t capacity,
  size_t *needed, cairn_error *error);
cairn_status cairn_world_options_init(cairn_world_options *options, size_t struct_size, cairn_error *error);
cairn_status cairn_world_options_preset(cairn_world_options *options, cairn_preset preset, uint32_t *submap_landmarks,
  cairn_error *error);
cairn_status cairn_world_create(const cairn_world_options *options, cairn_world **world, cairn_error *error);
void cairn_world_destroy(cairn_world *world);
cairn_status cairn_world_next(cairn_world *world, cairn_world_step *step, cairn_error *error);
cairn_status cairn_world_motions(const cairn_world *world, cairn_world_motion *motions, size_t capacity, size_t
  *needed, cairn_error *error);
cairn_status cairn_world_observations(const cairn_world *world, cairn_observation *observations, size_t capacity,
  size_t *needed, cairn_error *error);
cairn_status cairn_world_rewind(cairn_world *world, cairn_error *error);
cairn_status cairn_world_steps(const cairn_world *world, size_t *steps, cairn_error *error);
cairn_status cairn_world_most_observations(const cairn_world *world, size_t *count, cairn_error *error);
cairn_status cairn_world_head(const cairn_world *world, cairn_stereo_head *head, cairn_error *error);
cairn_status cairn_world_wheels(const cairn_world *world, cairn_wheels *wheels, cairn_error *error);
cairn_status cairn_world_pose(const cairn_world *world, double time, cairn_pose *pose, cairn_error *error);
cairn_status cairn_world_contacts(const cairn_world *world, double time, double points[12], cairn_error *error);
cairn_status cairn_world_height(const cairn_world *world, double x, double y, double *height, cairn_error *error);
cairn_status cairn_world_extent(const cairn_world *world, double lower[2], double upper[2], cairn_error *error);
cairn_status cairn_world_landmark(const cairn_world *world, uint64_t id, double position[3], cairn_error *error);
cairn_status cairn_world_landmarks(const cairn_world *world, double *positions, size_t capacity, size_t *needed,
  cairn_error *error);
const char *cairn_sim_last_message(void);
cairn_status cairn_fleet_options_init(cairn_fleet_options *options, size_t struct_size, cairn_error *error);
cairn_status cairn_fleet_create(const cairn_fleet_options *options, cairn_fleet **fleet, cairn_error *error);
void cairn_fleet_destroy(cairn_fleet *fleet);
cairn_status cairn_fleet_next(cairn_fleet *fleet, cairn_fleet_step *step, cairn_error *error);
cairn_status cairn_fleet_vehicles(const cairn_fleet *fleet, cairn_fleet_vehicle *vehicles, size_t capacity, size_t
  *needed, cairn_error *error);
cairn_status cairn_fleet_seen_features(const cairn_fleet *fleet, uint64_t vehicle, cairn_fleet_sighting *features,
  size_t capacity, size_t *needed, cairn_error *error);
cairn_status cairn_fleet_seen_vehicles(const cairn_fleet *fleet, uint64_t vehicle, cairn_fleet_sighting *vehicles,
  size_t capacity, size_t *needed, cairn_error *error);
cairn_status cairn_fleet_rewind(cairn_fleet *fleet, cairn_error *error);
cairn_status cairn_fleet_steps(const cairn_fleet *fleet, size_t *steps, cairn_error *error);
cairn_status cairn_fleet_features(const cairn_fleet *fleet, double *positions, size_t capacity, size_t *needed,
  cairn_error *error);
cairn_status cairn_fleet_coast(const cairn_fleet *fleet, double *points, size_t capacity, size_t *needed, cairn_error
  *error);
"""

# Fields that hold a constant (the name of its type) or a yes or no.
TYPED_FIELDS: dict[str, dict[str, str]] = {
    "cairn_error": {"status": "Status"},
    "cairn_merge_options": {"association": "MergeBy", "has_transform": "bool"},
    "cairn_merge_report": {"association": "MergeBy"},
    "cairn_merged_id": {"common": "bool"},
    "cairn_wheels": {"yaw_sign": "Yaw"},
    "cairn_stereo_head": {"encoder_mode": "Encoder"},
    "cairn_custom": {"relative": "bool"},
    "cairn_match": {"result": "Result", "reason": "Reason"},
    "cairn_filter_options": {"vehicle": "Vehicle", "state_error": "StateError", "noise_learning": "NoiseLearning",
        "association": "Association", "association_distance": "Distance", "join": "Join", "join_loss": "Loss"},
    "cairn_closing_report": {"status": "Status", "reason": "ClosedBy", "association_exhausted": "bool"},
    "cairn_update_report": {"association_exhausted": "bool"},
    "cairn_health": {"verdict": "Verdict", "reasons": "Doubts"},
    "cairn_systematic_error": {"kind": "Systematic"},
    "cairn_team_options": {"mode": "TeamMode", "baseline": "bool"},
    "cairn_team_report": {"interrupted": "bool"},
    "cairn_world_options": {"course": "Course", "terrain": "Terrain", "contact": "Contact", "drive": "Drive",
        "accelerometer": "Accelerometer", "stick_noise": "Stick", "observe_at_start": "bool", "traverse_closed":
        "bool"},
    "cairn_fleet_options": {"layout": "FleetLayout"},
}
OPTIONS: dict[str, str] = {
    "MergeOptions": "cairn_merge_options",
    "Wheels": "cairn_wheels",
    "TwistNoise": "cairn_twist_noise",
    "StereoHead": "cairn_stereo_head",
    "StereoCamera": "cairn_stereo_camera",
    "RangeBearing": "cairn_range_bearing",
    "Cartesian": "cairn_cartesian",
    "Custom": "cairn_custom",
    "FilterOptions": "cairn_filter_options",
    "Calibration": "cairn_calibration",
    "TeamOptions": "cairn_team_options",
    "WorldOptions": "cairn_world_options",
    "FleetOptions": "cairn_fleet_options",
}
FUNCTIONS: dict[str, list[str]] = {
    "cairn": ["cairn_status_name", "cairn_last_message", "cairn_version", "cairn_version_number", "cairn_has",
        "cairn_build", "cairn_pose_identity", "cairn_pose_compose", "cairn_pose_inverse", "cairn_pose_apply",
        "cairn_quaternion_from_euler", "cairn_quaternion_to_euler", "cairn_quaternion_exp", "cairn_quaternion_log",
        "cairn_pose_error", "cairn_map_size", "cairn_map_landmark", "cairn_map_landmarks", "cairn_map_within",
        "cairn_map_nearest", "cairn_map_in_box", "cairn_map_joint_covariance", "cairn_map_kind", "cairn_map_copy",
        "cairn_map_destroy", "cairn_merge_options_init", "cairn_map_merge", "cairn_map_merged_ids", "cairn_wheels_init",
        "cairn_twist_noise_init", "cairn_id_none", "cairn_stereo_head_init", "cairn_stereo_camera_init",
        "cairn_range_bearing_init", "cairn_cartesian_init", "cairn_custom_init", "cairn_custom_check",
        "cairn_filter_options_init", "cairn_filter_required_bytes", "cairn_filter_create", "cairn_filter_destroy",
        "cairn_filter_set_log", "cairn_filter_add_stereo_head", "cairn_filter_add_stereo_camera",
        "cairn_filter_add_range_bearing", "cairn_filter_add_cartesian", "cairn_filter_add_custom",
        "cairn_filter_point_head", "cairn_filter_set_loss", "cairn_filter_set_view", "cairn_filter_set_wheels",
        "cairn_filter_set_twist_noise", "cairn_filter_predict_wheels", "cairn_filter_predict_wheels_gyro",
        "cairn_filter_predict_twist", "cairn_filter_predict_increment", "cairn_filter_update",
        "cairn_filter_update_linear", "cairn_filter_update_position", "cairn_filter_update_attitude",
        "cairn_filter_update_heading", "cairn_filter_remove_landmark", "cairn_filter_merge_landmarks",
        "cairn_filter_split_landmark", "cairn_filter_close_submap", "cairn_filter_last_closing",
        "cairn_filter_local_pose", "cairn_filter_base_pose", "cairn_filter_submap_count", "cairn_filter_submap",
        "cairn_filter_last_update", "cairn_filter_pose", "cairn_filter_joint_covariance", "cairn_filter_local_map",
        "cairn_filter_map", "cairn_filter_pose_nees", "cairn_filter_audit", "cairn_filter_health",
        "cairn_filter_sensor_health", "cairn_verdict_text", "cairn_doubt_text", "cairn_calibration_init",
        "cairn_filter_calibrate_sensor", "cairn_filter_systematic_errors", "cairn_team_options_init",
        "cairn_team_create", "cairn_team_destroy", "cairn_team_add", "cairn_team_remove", "cairn_team_members",
        "cairn_team_predict_increment", "cairn_team_predict_twist", "cairn_team_observe", "cairn_team_decisions",
        "cairn_team_leave", "cairn_team_take_packet", "cairn_team_ask", "cairn_team_receive", "cairn_team_pose",
        "cairn_team_pose_nees", "cairn_team_map", "cairn_team_score", "cairn_team_last_report",
        "cairn_filter_keep_pose", "cairn_filter_trajectory_range", "cairn_filter_trajectory"],
    "cairn_sim": ["cairn_world_options_init", "cairn_world_options_preset", "cairn_world_create", "cairn_world_destroy",
        "cairn_world_next", "cairn_world_motions", "cairn_world_observations", "cairn_world_rewind",
        "cairn_world_steps", "cairn_world_most_observations", "cairn_world_head", "cairn_world_wheels",
        "cairn_world_pose", "cairn_world_contacts", "cairn_world_height", "cairn_world_extent", "cairn_world_landmark",
        "cairn_world_landmarks", "cairn_sim_last_message", "cairn_fleet_options_init", "cairn_fleet_create",
        "cairn_fleet_destroy", "cairn_fleet_next", "cairn_fleet_vehicles", "cairn_fleet_seen_features",
        "cairn_fleet_seen_vehicles", "cairn_fleet_rewind", "cairn_fleet_steps", "cairn_fleet_features",
        "cairn_fleet_coast"],
}
