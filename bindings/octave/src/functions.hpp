// SPDX-License-Identifier: BSD-3-Clause
// Written by generate.py from the description of the C interface: do not edit.
// clang-format off
#pragma once

#include "callbacks.hpp"

#include <cstddef>
#include <iterator>
#include <string_view>

namespace cairn_octave {

static_assert(CAIRN_VERSION == 200, "headers of another version");

constexpr Constant values_status[] = {{"OK", CAIRN_OK}, {"ERROR_ARGUMENT", CAIRN_ERROR_ARGUMENT}, {"ERROR_BUFFER",
  CAIRN_ERROR_BUFFER}, {"ERROR_CAPACITY", CAIRN_ERROR_CAPACITY}, {"ERROR_NOT_FOUND", CAIRN_ERROR_NOT_FOUND},
  {"ERROR_NUMERICAL", CAIRN_ERROR_NUMERICAL}, {"ERROR_MEMORY", CAIRN_ERROR_MEMORY}, {"ERROR_STATE", CAIRN_ERROR_STATE},
  {"ERROR_INTERNAL", CAIRN_ERROR_INTERNAL}, {"ERROR_CALLBACK", CAIRN_ERROR_CALLBACK}};
constexpr Enum enum_status{"CAIRN_", values_status, std::size(values_status)};
constexpr Constant values_map_form[] = {{"DENSE", CAIRN_MAP_DENSE}, {"SPARSE", CAIRN_MAP_SPARSE}};
constexpr Enum enum_map_form{"CAIRN_MAP_", values_map_form, std::size(values_map_form)};
constexpr Constant values_merge_by[] = {{"ID", CAIRN_MERGE_BY_ID}, {"GEOMETRY", CAIRN_MERGE_BY_GEOMETRY}};
constexpr Enum enum_merge_by{"CAIRN_MERGE_BY_", values_merge_by, std::size(values_merge_by)};
constexpr Constant values_yaw[] = {{"RIGHT_MINUS_LEFT", CAIRN_YAW_RIGHT_MINUS_LEFT}, {"LEFT_MINUS_RIGHT",
  CAIRN_YAW_LEFT_MINUS_RIGHT}};
constexpr Enum enum_yaw{"CAIRN_YAW_", values_yaw, std::size(values_yaw)};
constexpr Constant values_encoder[] = {{"OBSERVATION", CAIRN_ENCODER_PER_OBSERVATION}, {"FRAME",
  CAIRN_ENCODER_PER_FRAME}};
constexpr Enum enum_encoder{"CAIRN_ENCODER_PER_", values_encoder, std::size(values_encoder)};
constexpr Constant values_loss[] = {{"NONE", CAIRN_LOSS_NONE}, {"HUBER", CAIRN_LOSS_HUBER}, {"CAUCHY",
  CAIRN_LOSS_CAUCHY}};
constexpr Enum enum_loss{"CAIRN_LOSS_", values_loss, std::size(values_loss)};
constexpr Constant values_result[] = {{"MATCHED", CAIRN_RESULT_MATCHED}, {"NEW", CAIRN_RESULT_NEW}, {"REJECTED",
  CAIRN_RESULT_REJECTED}};
constexpr Enum enum_result{"CAIRN_RESULT_", values_result, std::size(values_result)};
constexpr Constant values_reason[] = {{"NONE", CAIRN_REASON_NONE}, {"GATE", CAIRN_REASON_GATE}, {"BATCH_GATE",
  CAIRN_REASON_BATCH_GATE}, {"NO_IMAGE", CAIRN_REASON_NO_IMAGE}, {"NO_PLACE", CAIRN_REASON_NO_PLACE}, {"AMBIGUOUS",
  CAIRN_REASON_AMBIGUOUS}, {"NO_ROOM", CAIRN_REASON_NO_ROOM}, {"CONTRADICTED", CAIRN_REASON_CONTRADICTED}};
constexpr Enum enum_reason{"CAIRN_REASON_", values_reason, std::size(values_reason)};
constexpr Constant values_state_error[] = {{"INVARIANT", CAIRN_STATE_ERROR_INVARIANT}, {"STANDARD",
  CAIRN_STATE_ERROR_STANDARD}};
constexpr Enum enum_state_error{"CAIRN_STATE_ERROR_", values_state_error, std::size(values_state_error)};
constexpr Constant values_vehicle[] = {{"SPATIAL", CAIRN_VEHICLE_SPATIAL}, {"PLANAR", CAIRN_VEHICLE_PLANAR}};
constexpr Enum enum_vehicle{"CAIRN_VEHICLE_", values_vehicle, std::size(values_vehicle)};
constexpr Constant values_join[] = {{"AUTO", CAIRN_JOIN_AUTO}, {"DENSE", CAIRN_JOIN_DENSE}, {"SPARSE",
  CAIRN_JOIN_SPARSE}};
constexpr Enum enum_join{"CAIRN_JOIN_", values_join, std::size(values_join)};
constexpr Constant values_association[] = {{"KNOWN", CAIRN_ASSOCIATION_KNOWN}, {"NEAREST", CAIRN_ASSOCIATION_NEAREST},
  {"JOINT", CAIRN_ASSOCIATION_JOINT}};
constexpr Enum enum_association{"CAIRN_ASSOCIATION_", values_association, std::size(values_association)};
constexpr Constant values_distance[] = {{"MAHALANOBIS", CAIRN_DISTANCE_MAHALANOBIS}, {"LIKELIHOOD",
  CAIRN_DISTANCE_LIKELIHOOD}};
constexpr Enum enum_distance{"CAIRN_DISTANCE_", values_distance, std::size(values_distance)};
constexpr Constant values_noise_learning[] = {{"REPORTED", CAIRN_NOISE_REPORTED}, {"APPLIED", CAIRN_NOISE_APPLIED}};
constexpr Enum enum_noise_learning{"CAIRN_NOISE_", values_noise_learning, std::size(values_noise_learning)};
constexpr Constant values_closed_by[] = {{"NONE", CAIRN_CLOSED_BY_NONE}, {"CALLER", CAIRN_CLOSED_BY_CALLER},
  {"LANDMARKS", CAIRN_CLOSED_BY_LANDMARKS}, {"DISTANCE", CAIRN_CLOSED_BY_DISTANCE}, {"EXTENT", CAIRN_CLOSED_BY_EXTENT},
  {"SIGMA", CAIRN_CLOSED_BY_SIGMA}, {"FIX", CAIRN_CLOSED_BY_FIX}};
constexpr Enum enum_closed_by{"CAIRN_CLOSED_BY_", values_closed_by, std::size(values_closed_by)};
constexpr Constant values_verdict[] = {{"GOOD", CAIRN_VERDICT_GOOD}, {"DOUBTFUL", CAIRN_VERDICT_DOUBTFUL}, {"LOST",
  CAIRN_VERDICT_LOST}};
constexpr Enum enum_verdict{"CAIRN_VERDICT_", values_verdict, std::size(values_verdict)};
constexpr Constant values_doubts[] = {{"NIS", CAIRN_DOUBT_NIS}, {"REFUSALS", CAIRN_DOUBT_REFUSALS}, {"WIDENED",
  CAIRN_DOUBT_WIDENED}, {"SENSOR_NOISE", CAIRN_DOUBT_SENSOR_NOISE}, {"MOTION_NOISE", CAIRN_DOUBT_MOTION_NOISE}, {"BIAS",
  CAIRN_DOUBT_BIAS}, {"JUMP", CAIRN_DOUBT_JUMP}, {"LANDMARKS", CAIRN_DOUBT_LANDMARKS}, {"CLOSING", CAIRN_DOUBT_CLOSING},
  {"BLIND", CAIRN_DOUBT_BLIND}, {"DEFINITE", CAIRN_DOUBT_DEFINITE}};
constexpr Enum enum_doubts{"CAIRN_DOUBT_", values_doubts, std::size(values_doubts)};
constexpr Constant values_systematic[] = {{"VELOCITY_BIAS", CAIRN_SYSTEMATIC_VELOCITY_BIAS}, {"RATE_BIAS",
  CAIRN_SYSTEMATIC_RATE_BIAS}, {"WHEEL_SCALE", CAIRN_SYSTEMATIC_WHEEL_SCALE}, {"MOUNT_SHIFT",
  CAIRN_SYSTEMATIC_MOUNT_SHIFT}, {"MOUNT_TURN", CAIRN_SYSTEMATIC_MOUNT_TURN}, {"OFFSET", CAIRN_SYSTEMATIC_OFFSET}};
constexpr Enum enum_systematic{"CAIRN_SYSTEMATIC_", values_systematic, std::size(values_systematic)};
constexpr Constant values_team_mode[] = {{"MONO", CAIRN_TEAM_MONO}, {"EO_DIAGONAL", CAIRN_TEAM_EO_DIAGONAL}, {"EO_FULL",
  CAIRN_TEAM_EO_FULL}, {"JOINT", CAIRN_TEAM_JOINT}, {"SUBMAPS", CAIRN_TEAM_SUBMAPS}};
constexpr Enum enum_team_mode{"CAIRN_TEAM_", values_team_mode, std::size(values_team_mode)};
constexpr Constant values_packet[] = {{"TAKEN", CAIRN_PACKET_TAKEN}, {"WAITING", CAIRN_PACKET_WAITING}, {"REQUEST",
  CAIRN_PACKET_REQUEST}, {"LEAVE", CAIRN_PACKET_LEAVE}, {"REPEATED", CAIRN_PACKET_REPEATED}, {"OWN", CAIRN_PACKET_OWN},
  {"IGNORED", CAIRN_PACKET_IGNORED}, {"UNKNOWN", CAIRN_PACKET_UNKNOWN}, {"PAST", CAIRN_PACKET_PAST}, {"CONFLICT",
  CAIRN_PACKET_CONFLICT}, {"FULL", CAIRN_PACKET_FULL}, {"FOREIGN", CAIRN_PACKET_FOREIGN}, {"VERSION",
  CAIRN_PACKET_VERSION}, {"CUT", CAIRN_PACKET_CUT}, {"CORRUPT", CAIRN_PACKET_CORRUPT}, {"NONSENSE",
  CAIRN_PACKET_NONSENSE}, {"AHEAD", CAIRN_PACKET_AHEAD}};
constexpr Enum enum_packet{"CAIRN_PACKET_", values_packet, std::size(values_packet)};
constexpr Constant values_course[] = {{"CIRCLE", CAIRN_COURSE_CIRCLE}, {"LAPS", CAIRN_COURSE_LAPS}, {"TRAVERSE",
  CAIRN_COURSE_TRAVERSE}};
constexpr Enum enum_course{"CAIRN_COURSE_", values_course, std::size(values_course)};
constexpr Constant values_terrain[] = {{"ROLLING", CAIRN_TERRAIN_ROLLING}, {"WAVES", CAIRN_TERRAIN_WAVES}, {"FLAT",
  CAIRN_TERRAIN_FLAT}};
constexpr Enum enum_terrain{"CAIRN_TERRAIN_", values_terrain, std::size(values_terrain)};
constexpr Constant values_contact[] = {{"WHEELS", CAIRN_CONTACT_WHEELS}, {"POINT", CAIRN_CONTACT_POINT}};
constexpr Enum enum_contact{"CAIRN_CONTACT_", values_contact, std::size(values_contact)};
constexpr Constant values_drive[] = {{"TWIST", CAIRN_DRIVE_TWIST}, {"WHEELS_GYRO", CAIRN_DRIVE_WHEELS_GYRO}};
constexpr Enum enum_drive{"CAIRN_DRIVE_", values_drive, std::size(values_drive)};
constexpr Constant values_accelerometer[] = {{"VELOCITY", CAIRN_ACCELEROMETER_VELOCITY}, {"ACCELERATION",
  CAIRN_ACCELEROMETER_ACCELERATION}};
constexpr Enum enum_accelerometer{"CAIRN_ACCELEROMETER_", values_accelerometer, std::size(values_accelerometer)};
constexpr Constant values_stick[] = {{"OBSERVATION", CAIRN_STICK_PER_OBSERVATION}, {"FRAME", CAIRN_STICK_PER_FRAME}};
constexpr Enum enum_stick{"CAIRN_STICK_PER_", values_stick, std::size(values_stick)};
constexpr Constant values_preset[] = {{"PAPER", CAIRN_PRESET_PAPER}, {"ROW1", CAIRN_PRESET_ROW1}, {"ROW2",
  CAIRN_PRESET_ROW2}, {"ROW3", CAIRN_PRESET_ROW3}, {"ROW4", CAIRN_PRESET_ROW4}};
constexpr Enum enum_preset{"CAIRN_PRESET_", values_preset, std::size(values_preset)};
constexpr Constant values_fleet_layout[] = {{"UNIFORM", CAIRN_FLEET_UNIFORM}, {"COAST", CAIRN_FLEET_COAST}};
constexpr Enum enum_fleet_layout{"CAIRN_FLEET_", values_fleet_layout, std::size(values_fleet_layout)};
constexpr Field fields_pose[] = {
    {"position", Kind::number, offsetof(cairn_pose, position), 3, 0, nullptr, nullptr},
    {"quaternion", Kind::number, offsetof(cairn_pose, quaternion), 4, 0, nullptr, nullptr},
};
constexpr Struct struct_pose{"pose", sizeof(cairn_pose), fields_pose, std::size(fields_pose)};
constexpr Field fields_landmark[] = {
    {"id", Kind::id, offsetof(cairn_landmark, id), 1, 0, nullptr, nullptr},
    {"observations", Kind::id, offsetof(cairn_landmark, observations), 1, 0, nullptr, nullptr},
    {"position", Kind::number, offsetof(cairn_landmark, position), 3, 0, nullptr, nullptr},
    {"covariance", Kind::number, offsetof(cairn_landmark, covariance), 9, 3, nullptr, nullptr},
};
constexpr Struct struct_landmark{"landmark", sizeof(cairn_landmark), fields_landmark, std::size(fields_landmark)};
constexpr Field fields_merge_options[] = {
    {"association", Kind::constant, offsetof(cairn_merge_options, association), 1, 0, &enum_merge_by, nullptr},
    {"gate_probability", Kind::number, offsetof(cairn_merge_options, gate_probability), 1, 0, nullptr, nullptr},
    {"joint_gate_probability", Kind::number, offsetof(cairn_merge_options, joint_gate_probability), 1, 0, nullptr,
      nullptr},
    {"max_landmarks", Kind::id, offsetof(cairn_merge_options, max_landmarks), 1, 0, nullptr, nullptr},
    {"max_tilt", Kind::number, offsetof(cairn_merge_options, max_tilt), 1, 0, nullptr, nullptr},
    {"has_transform", Kind::boolean, offsetof(cairn_merge_options, has_transform), 1, 0, nullptr, nullptr},
    {"T_map_other", Kind::object, offsetof(cairn_merge_options, T_map_other), 1, 0, nullptr, &struct_pose},
    {"covariance", Kind::number, offsetof(cairn_merge_options, covariance), 36, 6, nullptr, nullptr},
};
constexpr Struct struct_merge_options{"merge_options", sizeof(cairn_merge_options), fields_merge_options,
  std::size(fields_merge_options)};
constexpr Field fields_merge_report[] = {
    {"association", Kind::constant, offsetof(cairn_merge_report, association), 1, 0, &enum_merge_by, nullptr},
    {"common", Kind::id, offsetof(cairn_merge_report, common), 1, 0, nullptr, nullptr},
    {"added", Kind::id, offsetof(cairn_merge_report, added), 1, 0, nullptr, nullptr},
    {"rows", Kind::id, offsetof(cairn_merge_report, rows), 1, 0, nullptr, nullptr},
    {"distance", Kind::number, offsetof(cairn_merge_report, distance), 1, 0, nullptr, nullptr},
    {"threshold", Kind::number, offsetof(cairn_merge_report, threshold), 1, 0, nullptr, nullptr},
    {"T_map_other", Kind::object, offsetof(cairn_merge_report, T_map_other), 1, 0, nullptr, &struct_pose},
    {"covariance", Kind::number, offsetof(cairn_merge_report, covariance), 36, 6, nullptr, nullptr},
    {"broken_id", Kind::id, offsetof(cairn_merge_report, broken_id), 1, 0, nullptr, nullptr},
    {"broken_other_id", Kind::id, offsetof(cairn_merge_report, broken_other_id), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_merge_report{"merge_report", sizeof(cairn_merge_report), fields_merge_report,
  std::size(fields_merge_report)};
constexpr Field fields_merged_id[] = {
    {"other_id", Kind::id, offsetof(cairn_merged_id, other_id), 1, 0, nullptr, nullptr},
    {"id", Kind::id, offsetof(cairn_merged_id, id), 1, 0, nullptr, nullptr},
    {"common", Kind::boolean, offsetof(cairn_merged_id, common), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_merged_id{"merged_id", sizeof(cairn_merged_id), fields_merged_id, std::size(fields_merged_id)};
constexpr Field fields_wheels[] = {
    {"yaw_sign", Kind::constant, offsetof(cairn_wheels, yaw_sign), 1, 0, &enum_yaw, nullptr},
    {"radius", Kind::number, offsetof(cairn_wheels, radius), 1, 0, nullptr, nullptr},
    {"track", Kind::number, offsetof(cairn_wheels, track), 1, 0, nullptr, nullptr},
    {"rate_sigma", Kind::number, offsetof(cairn_wheels, rate_sigma), 1, 0, nullptr, nullptr},
    {"slip_sigma", Kind::number, offsetof(cairn_wheels, slip_sigma), 1, 0, nullptr, nullptr},
    {"lateral_sigma", Kind::number, offsetof(cairn_wheels, lateral_sigma), 1, 0, nullptr, nullptr},
    {"vertical_sigma", Kind::number, offsetof(cairn_wheels, vertical_sigma), 1, 0, nullptr, nullptr},
    {"roll_rate_sigma", Kind::number, offsetof(cairn_wheels, roll_rate_sigma), 1, 0, nullptr, nullptr},
    {"pitch_rate_sigma", Kind::number, offsetof(cairn_wheels, pitch_rate_sigma), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_wheels{"wheels", sizeof(cairn_wheels), fields_wheels, std::size(fields_wheels)};
constexpr Field fields_twist_noise[] = {
    {"velocity_sigma", Kind::number, offsetof(cairn_twist_noise, velocity_sigma), 3, 0, nullptr, nullptr},
    {"rate_sigma", Kind::number, offsetof(cairn_twist_noise, rate_sigma), 3, 0, nullptr, nullptr},
};
constexpr Struct struct_twist_noise{"twist_noise", sizeof(cairn_twist_noise), fields_twist_noise,
  std::size(fields_twist_noise)};
constexpr Field fields_stereo_head[] = {
    {"encoder_mode", Kind::constant, offsetof(cairn_stereo_head, encoder_mode), 1, 0, &enum_encoder, nullptr},
    {"platform", Kind::number, offsetof(cairn_stereo_head, platform), 3, 0, nullptr, nullptr},
    {"stick", Kind::number, offsetof(cairn_stereo_head, stick), 3, 0, nullptr, nullptr},
    {"camera_quaternion", Kind::number, offsetof(cairn_stereo_head, camera_quaternion), 4, 0, nullptr, nullptr},
    {"range_sigma", Kind::number, offsetof(cairn_stereo_head, range_sigma), 1, 0, nullptr, nullptr},
    {"azimuth_sigma", Kind::number, offsetof(cairn_stereo_head, azimuth_sigma), 1, 0, nullptr, nullptr},
    {"elevation_sigma", Kind::number, offsetof(cairn_stereo_head, elevation_sigma), 1, 0, nullptr, nullptr},
    {"pan_sigma", Kind::number, offsetof(cairn_stereo_head, pan_sigma), 1, 0, nullptr, nullptr},
    {"stick_sigma", Kind::number, offsetof(cairn_stereo_head, stick_sigma), 1, 0, nullptr, nullptr},
    {"near_range", Kind::number, offsetof(cairn_stereo_head, near_range), 1, 0, nullptr, nullptr},
    {"max_elevation", Kind::number, offsetof(cairn_stereo_head, max_elevation), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_stereo_head{"stereo_head", sizeof(cairn_stereo_head), fields_stereo_head,
  std::size(fields_stereo_head)};
constexpr Field fields_stereo_camera[] = {
    {"fu", Kind::number, offsetof(cairn_stereo_camera, fu), 1, 0, nullptr, nullptr},
    {"fv", Kind::number, offsetof(cairn_stereo_camera, fv), 1, 0, nullptr, nullptr},
    {"cu", Kind::number, offsetof(cairn_stereo_camera, cu), 1, 0, nullptr, nullptr},
    {"cv", Kind::number, offsetof(cairn_stereo_camera, cv), 1, 0, nullptr, nullptr},
    {"baseline", Kind::number, offsetof(cairn_stereo_camera, baseline), 1, 0, nullptr, nullptr},
    {"T_body_camera", Kind::object, offsetof(cairn_stereo_camera, T_body_camera), 1, 0, nullptr, &struct_pose},
    {"sigma", Kind::number, offsetof(cairn_stereo_camera, sigma), 3, 0, nullptr, nullptr},
    {"near_depth", Kind::number, offsetof(cairn_stereo_camera, near_depth), 1, 0, nullptr, nullptr},
    {"min_disparity", Kind::number, offsetof(cairn_stereo_camera, min_disparity), 1, 0, nullptr, nullptr},
    {"min_disparity_sigmas", Kind::number, offsetof(cairn_stereo_camera, min_disparity_sigmas), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_stereo_camera{"stereo_camera", sizeof(cairn_stereo_camera), fields_stereo_camera,
  std::size(fields_stereo_camera)};
constexpr Field fields_range_bearing[] = {
    {"T_body_sensor", Kind::object, offsetof(cairn_range_bearing, T_body_sensor), 1, 0, nullptr, &struct_pose},
    {"range_sigma", Kind::number, offsetof(cairn_range_bearing, range_sigma), 1, 0, nullptr, nullptr},
    {"bearing_sigma", Kind::number, offsetof(cairn_range_bearing, bearing_sigma), 1, 0, nullptr, nullptr},
    {"near_range", Kind::number, offsetof(cairn_range_bearing, near_range), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_range_bearing{"range_bearing", sizeof(cairn_range_bearing), fields_range_bearing,
  std::size(fields_range_bearing)};
constexpr Field fields_cartesian[] = {
    {"T_body_sensor", Kind::object, offsetof(cairn_cartesian, T_body_sensor), 1, 0, nullptr, &struct_pose},
    {"sigma", Kind::number, offsetof(cairn_cartesian, sigma), 3, 0, nullptr, nullptr},
};
constexpr Struct struct_cartesian{"cartesian", sizeof(cairn_cartesian), fields_cartesian, std::size(fields_cartesian)};
constexpr Field fields_custom[] = {
    {"rows", Kind::uint32, offsetof(cairn_custom, rows), 1, 0, nullptr, nullptr},
    {"angle_mask", Kind::uint32, offsetof(cairn_custom, angle_mask), 1, 0, nullptr, nullptr},
    {"relative", Kind::boolean, offsetof(cairn_custom, relative), 1, 0, nullptr, nullptr},
    {"sigma", Kind::number, offsetof(cairn_custom, sigma), 3, 0, nullptr, nullptr},
};
constexpr Struct struct_custom{"custom", sizeof(cairn_custom), fields_custom, std::size(fields_custom)};
constexpr Field fields_observation[] = {
    {"id", Kind::id, offsetof(cairn_observation, id), 1, 0, nullptr, nullptr},
    {"z", Kind::number, offsetof(cairn_observation, z), 3, 0, nullptr, nullptr},
    {"covariance", Kind::number, offsetof(cairn_observation, covariance), 9, 3, nullptr, nullptr},
};
constexpr Struct struct_observation{"observation", sizeof(cairn_observation), fields_observation,
  std::size(fields_observation)};
constexpr Field fields_match[] = {
    {"landmark", Kind::id, offsetof(cairn_match, landmark), 1, 0, nullptr, nullptr},
    {"result", Kind::constant, offsetof(cairn_match, result), 1, 0, &enum_result, nullptr},
    {"reason", Kind::constant, offsetof(cairn_match, reason), 1, 0, &enum_reason, nullptr},
    {"distance", Kind::number, offsetof(cairn_match, distance), 1, 0, nullptr, nullptr},
    {"threshold", Kind::number, offsetof(cairn_match, threshold), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_match{"match", sizeof(cairn_match), fields_match, std::size(fields_match)};
constexpr Field fields_filter_options[] = {
    {"vehicle", Kind::constant, offsetof(cairn_filter_options, vehicle), 1, 0, &enum_vehicle, nullptr},
    {"state_error", Kind::constant, offsetof(cairn_filter_options, state_error), 1, 0, &enum_state_error, nullptr},
    {"max_landmarks", Kind::uint32, offsetof(cairn_filter_options, max_landmarks), 1, 0, nullptr, nullptr},
    {"max_observations", Kind::uint32, offsetof(cairn_filter_options, max_observations), 1, 0, nullptr, nullptr},
    {"max_sensors", Kind::uint32, offsetof(cairn_filter_options, max_sensors), 1, 0, nullptr, nullptr},
    {"initial_pose", Kind::object, offsetof(cairn_filter_options, initial_pose), 1, 0, nullptr, &struct_pose},
    {"initial_covariance", Kind::number, offsetof(cairn_filter_options, initial_covariance), 36, 6, nullptr, nullptr},
    {"iterations", Kind::uint32, offsetof(cairn_filter_options, iterations), 1, 0, nullptr, nullptr},
    {"noise_learning", Kind::constant, offsetof(cairn_filter_options, noise_learning), 1, 0, &enum_noise_learning,
      nullptr},
    {"iteration_tolerance", Kind::number, offsetof(cairn_filter_options, iteration_tolerance), 1, 0, nullptr, nullptr},
    {"gate_probability", Kind::number, offsetof(cairn_filter_options, gate_probability), 1, 0, nullptr, nullptr},
    {"batch_gate_probability", Kind::number, offsetof(cairn_filter_options, batch_gate_probability), 1, 0, nullptr,
      nullptr},
    {"error_persistence", Kind::number, offsetof(cairn_filter_options, error_persistence), 1, 0, nullptr, nullptr},
    {"association", Kind::constant, offsetof(cairn_filter_options, association), 1, 0, &enum_association, nullptr},
    {"association_distance", Kind::constant, offsetof(cairn_filter_options, association_distance), 1, 0, &enum_distance,
      nullptr},
    {"association_nodes", Kind::uint32, offsetof(cairn_filter_options, association_nodes), 1, 0, nullptr, nullptr},
    {"deferred_sightings", Kind::uint32, offsetof(cairn_filter_options, deferred_sightings), 1, 0, nullptr, nullptr},
    {"deferred_frames", Kind::uint32, offsetof(cairn_filter_options, deferred_frames), 1, 0, nullptr, nullptr},
    {"missed_frames", Kind::uint32, offsetof(cairn_filter_options, missed_frames), 1, 0, nullptr, nullptr},
    {"new_probability", Kind::number, offsetof(cairn_filter_options, new_probability), 1, 0, nullptr, nullptr},
    {"submap_landmarks", Kind::uint32, offsetof(cairn_filter_options, submap_landmarks), 1, 0, nullptr, nullptr},
    {"join", Kind::constant, offsetof(cairn_filter_options, join), 1, 0, &enum_join, nullptr},
    {"join_loss", Kind::constant, offsetof(cairn_filter_options, join_loss), 1, 0, &enum_loss, nullptr},
    {"trajectory_poses", Kind::uint32, offsetof(cairn_filter_options, trajectory_poses), 1, 0, nullptr, nullptr},
    {"join_loss_width", Kind::number, offsetof(cairn_filter_options, join_loss_width), 1, 0, nullptr, nullptr},
    {"submap_distance", Kind::number, offsetof(cairn_filter_options, submap_distance), 1, 0, nullptr, nullptr},
    {"submap_extent", Kind::number, offsetof(cairn_filter_options, submap_extent), 1, 0, nullptr, nullptr},
    {"submap_sigma", Kind::number, offsetof(cairn_filter_options, submap_sigma), 1, 0, nullptr, nullptr},
    {"velocity_bias_sigma", Kind::number, offsetof(cairn_filter_options, velocity_bias_sigma), 3, 0, nullptr, nullptr},
    {"velocity_bias_walk", Kind::number, offsetof(cairn_filter_options, velocity_bias_walk), 3, 0, nullptr, nullptr},
    {"rate_bias_sigma", Kind::number, offsetof(cairn_filter_options, rate_bias_sigma), 3, 0, nullptr, nullptr},
    {"rate_bias_walk", Kind::number, offsetof(cairn_filter_options, rate_bias_walk), 3, 0, nullptr, nullptr},
    {"wheel_scale_sigma", Kind::number, offsetof(cairn_filter_options, wheel_scale_sigma), 2, 0, nullptr, nullptr},
    {"wheel_scale_walk", Kind::number, offsetof(cairn_filter_options, wheel_scale_walk), 2, 0, nullptr, nullptr},
    {"max_sensor_errors", Kind::uint32, offsetof(cairn_filter_options, max_sensor_errors), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_filter_options{"filter_options", sizeof(cairn_filter_options), fields_filter_options,
  std::size(fields_filter_options)};
constexpr Field fields_closing_report[] = {
    {"status", Kind::constant, offsetof(cairn_closing_report, status), 1, 0, &enum_status, nullptr},
    {"reason", Kind::constant, offsetof(cairn_closing_report, reason), 1, 0, &enum_closed_by, nullptr},
    {"submaps", Kind::uint32, offsetof(cairn_closing_report, submaps), 1, 0, nullptr, nullptr},
    {"landmarks", Kind::uint32, offsetof(cairn_closing_report, landmarks), 1, 0, nullptr, nullptr},
    {"landmarks_new", Kind::uint32, offsetof(cairn_closing_report, landmarks_new), 1, 0, nullptr, nullptr},
    {"landmarks_fused", Kind::uint32, offsetof(cairn_closing_report, landmarks_fused), 1, 0, nullptr, nullptr},
    {"landmarks_refused", Kind::uint32, offsetof(cairn_closing_report, landmarks_refused), 1, 0, nullptr, nullptr},
    {"landmarks_ambiguous", Kind::uint32, offsetof(cairn_closing_report, landmarks_ambiguous), 1, 0, nullptr, nullptr},
    {"rows", Kind::uint32, offsetof(cairn_closing_report, rows), 1, 0, nullptr, nullptr},
    {"distance", Kind::number, offsetof(cairn_closing_report, distance), 1, 0, nullptr, nullptr},
    {"threshold", Kind::number, offsetof(cairn_closing_report, threshold), 1, 0, nullptr, nullptr},
    {"moved_max", Kind::number, offsetof(cairn_closing_report, moved_max), 1, 0, nullptr, nullptr},
    {"moved_rms", Kind::number, offsetof(cairn_closing_report, moved_rms), 1, 0, nullptr, nullptr},
    {"widened_position", Kind::number, offsetof(cairn_closing_report, widened_position), 1, 0, nullptr, nullptr},
    {"widened_attitude", Kind::number, offsetof(cairn_closing_report, widened_attitude), 1, 0, nullptr, nullptr},
    {"association_nodes", Kind::uint32, offsetof(cairn_closing_report, association_nodes), 1, 0, nullptr, nullptr},
    {"association_exhausted", Kind::boolean, offsetof(cairn_closing_report, association_exhausted), 1, 0, nullptr,
      nullptr},
    {"relinearised", Kind::uint32, offsetof(cairn_closing_report, relinearised), 1, 0, nullptr, nullptr},
    {"refactored", Kind::uint32, offsetof(cairn_closing_report, refactored), 1, 0, nullptr, nullptr},
    {"iterations", Kind::uint32, offsetof(cairn_closing_report, iterations), 1, 0, nullptr, nullptr},
    {"seconds", Kind::number, offsetof(cairn_closing_report, seconds), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_closing_report{"closing_report", sizeof(cairn_closing_report), fields_closing_report,
  std::size(fields_closing_report)};
constexpr Field fields_update_report[] = {
    {"matched", Kind::uint32, offsetof(cairn_update_report, matched), 1, 0, nullptr, nullptr},
    {"placed", Kind::uint32, offsetof(cairn_update_report, placed), 1, 0, nullptr, nullptr},
    {"placed_again", Kind::uint32, offsetof(cairn_update_report, placed_again), 1, 0, nullptr, nullptr},
    {"rejected", Kind::uint32, offsetof(cairn_update_report, rejected), 1, 0, nullptr, nullptr},
    {"deferred", Kind::uint32, offsetof(cairn_update_report, deferred), 1, 0, nullptr, nullptr},
    {"removed", Kind::uint32, offsetof(cairn_update_report, removed), 1, 0, nullptr, nullptr},
    {"rows", Kind::uint32, offsetof(cairn_update_report, rows), 1, 0, nullptr, nullptr},
    {"nis", Kind::number, offsetof(cairn_update_report, nis), 1, 0, nullptr, nullptr},
    {"nis_lower", Kind::number, offsetof(cairn_update_report, nis_lower), 1, 0, nullptr, nullptr},
    {"nis_upper", Kind::number, offsetof(cairn_update_report, nis_upper), 1, 0, nullptr, nullptr},
    {"widened_position", Kind::number, offsetof(cairn_update_report, widened_position), 1, 0, nullptr, nullptr},
    {"widened_attitude", Kind::number, offsetof(cairn_update_report, widened_attitude), 1, 0, nullptr, nullptr},
    {"iterations", Kind::uint32, offsetof(cairn_update_report, iterations), 1, 0, nullptr, nullptr},
    {"association_nodes", Kind::uint32, offsetof(cairn_update_report, association_nodes), 1, 0, nullptr, nullptr},
    {"association_exhausted", Kind::boolean, offsetof(cairn_update_report, association_exhausted), 1, 0, nullptr,
      nullptr},
    {"association_seconds", Kind::number, offsetof(cairn_update_report, association_seconds), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_update_report{"update_report", sizeof(cairn_update_report), fields_update_report,
  std::size(fields_update_report)};
constexpr Field fields_health[] = {
    {"verdict", Kind::constant, offsetof(cairn_health, verdict), 1, 0, &enum_verdict, nullptr},
    {"reasons", Kind::bits, offsetof(cairn_health, reasons), 1, 0, &enum_doubts, nullptr},
    {"blind_directions", Kind::uint32, offsetof(cairn_health, blind_directions), 1, 0, nullptr, nullptr},
    {"contradicting", Kind::uint32, offsetof(cairn_health, contradicting), 1, 0, nullptr, nullptr},
    {"updates", Kind::id, offsetof(cairn_health, updates), 1, 0, nullptr, nullptr},
    {"good_share", Kind::number, offsetof(cairn_health, good_share), 1, 0, nullptr, nullptr},
    {"doubtful_share", Kind::number, offsetof(cairn_health, doubtful_share), 1, 0, nullptr, nullptr},
    {"lost_share", Kind::number, offsetof(cairn_health, lost_share), 1, 0, nullptr, nullptr},
    {"nis_per_row", Kind::number, offsetof(cairn_health, nis_per_row), 1, 0, nullptr, nullptr},
    {"nis_lower", Kind::number, offsetof(cairn_health, nis_lower), 1, 0, nullptr, nullptr},
    {"nis_upper", Kind::number, offsetof(cairn_health, nis_upper), 1, 0, nullptr, nullptr},
    {"refused_share", Kind::number, offsetof(cairn_health, refused_share), 1, 0, nullptr, nullptr},
    {"widenings", Kind::id, offsetof(cairn_health, widenings), 1, 0, nullptr, nullptr},
    {"last_widening", Kind::number, offsetof(cairn_health, last_widening), 1, 0, nullptr, nullptr},
    {"motion_scale", Kind::number, offsetof(cairn_health, motion_scale), 1, 0, nullptr, nullptr},
    {"motion_scale_sigma", Kind::number, offsetof(cairn_health, motion_scale_sigma), 1, 0, nullptr, nullptr},
    {"bias_sigmas", Kind::number, offsetof(cairn_health, bias_sigmas), 1, 0, nullptr, nullptr},
    {"jump_sigmas", Kind::number, offsetof(cairn_health, jump_sigmas), 1, 0, nullptr, nullptr},
    {"pose_pivot", Kind::number, offsetof(cairn_health, pose_pivot), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_health{"health", sizeof(cairn_health), fields_health, std::size(fields_health)};
constexpr Field fields_sensor_health[] = {
    {"compared", Kind::id, offsetof(cairn_sensor_health, compared), 1, 0, nullptr, nullptr},
    {"refused", Kind::id, offsetof(cairn_sensor_health, refused), 1, 0, nullptr, nullptr},
    {"nis_per_row", Kind::number, offsetof(cairn_sensor_health, nis_per_row), 1, 0, nullptr, nullptr},
    {"nis_lower", Kind::number, offsetof(cairn_sensor_health, nis_lower), 1, 0, nullptr, nullptr},
    {"nis_upper", Kind::number, offsetof(cairn_sensor_health, nis_upper), 1, 0, nullptr, nullptr},
    {"scale", Kind::number, offsetof(cairn_sensor_health, scale), 1, 0, nullptr, nullptr},
    {"scale_sigma", Kind::number, offsetof(cairn_sensor_health, scale_sigma), 1, 0, nullptr, nullptr},
    {"persistence", Kind::number, offsetof(cairn_sensor_health, persistence), 4, 0, nullptr, nullptr},
};
constexpr Struct struct_sensor_health{"sensor_health", sizeof(cairn_sensor_health), fields_sensor_health,
  std::size(fields_sensor_health)};
constexpr Field fields_calibration[] = {
    {"mount_shift_sigma", Kind::number, offsetof(cairn_calibration, mount_shift_sigma), 3, 0, nullptr, nullptr},
    {"mount_shift_walk", Kind::number, offsetof(cairn_calibration, mount_shift_walk), 3, 0, nullptr, nullptr},
    {"mount_turn_sigma", Kind::number, offsetof(cairn_calibration, mount_turn_sigma), 3, 0, nullptr, nullptr},
    {"mount_turn_walk", Kind::number, offsetof(cairn_calibration, mount_turn_walk), 3, 0, nullptr, nullptr},
    {"offset_sigma", Kind::number, offsetof(cairn_calibration, offset_sigma), 3, 0, nullptr, nullptr},
    {"offset_walk", Kind::number, offsetof(cairn_calibration, offset_walk), 3, 0, nullptr, nullptr},
};
constexpr Struct struct_calibration{"calibration", sizeof(cairn_calibration), fields_calibration,
  std::size(fields_calibration)};
constexpr Field fields_systematic_error[] = {
    {"kind", Kind::constant, offsetof(cairn_systematic_error, kind), 1, 0, &enum_systematic, nullptr},
    {"sensor", Kind::int32, offsetof(cairn_systematic_error, sensor), 1, 0, nullptr, nullptr},
    {"component", Kind::int32, offsetof(cairn_systematic_error, component), 1, 0, nullptr, nullptr},
    {"value", Kind::number, offsetof(cairn_systematic_error, value), 1, 0, nullptr, nullptr},
    {"sigma", Kind::number, offsetof(cairn_systematic_error, sigma), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_systematic_error{"systematic_error", sizeof(cairn_systematic_error), fields_systematic_error,
  std::size(fields_systematic_error)};
constexpr Field fields_team_options[] = {
    {"mode", Kind::constant, offsetof(cairn_team_options, mode), 1, 0, &enum_team_mode, nullptr},
    {"vehicle", Kind::id, offsetof(cairn_team_options, vehicle), 1, 0, nullptr, nullptr},
    {"max_vehicles", Kind::uint32, offsetof(cairn_team_options, max_vehicles), 1, 0, nullptr, nullptr},
    {"baseline", Kind::boolean, offsetof(cairn_team_options, baseline), 1, 0, nullptr, nullptr},
    {"max_lag", Kind::number, offsetof(cairn_team_options, max_lag), 1, 0, nullptr, nullptr},
    {"time_tolerance", Kind::number, offsetof(cairn_team_options, time_tolerance), 1, 0, nullptr, nullptr},
    {"max_jump", Kind::number, offsetof(cairn_team_options, max_jump), 1, 0, nullptr, nullptr},
    {"max_waiting", Kind::uint32, offsetof(cairn_team_options, max_waiting), 1, 0, nullptr, nullptr},
    {"history", Kind::uint32, offsetof(cairn_team_options, history), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_team_options{"team_options", sizeof(cairn_team_options), fields_team_options,
  std::size(fields_team_options)};
constexpr Field fields_team_report[] = {
    {"unsettled", Kind::uint32, offsetof(cairn_team_report, unsettled), 1, 0, nullptr, nullptr},
    {"interrupted", Kind::boolean, offsetof(cairn_team_report, interrupted), 1, 0, nullptr, nullptr},
    {"sent", Kind::id, offsetof(cairn_team_report, sent), 1, 0, nullptr, nullptr},
    {"resent", Kind::id, offsetof(cairn_team_report, resent), 1, 0, nullptr, nullptr},
    {"requested", Kind::id, offsetof(cairn_team_report, requested), 1, 0, nullptr, nullptr},
    {"received", Kind::id, offsetof(cairn_team_report, received), 1, 0, nullptr, nullptr},
    {"taken", Kind::id, offsetof(cairn_team_report, taken), 1, 0, nullptr, nullptr},
    {"reordered", Kind::id, offsetof(cairn_team_report, reordered), 1, 0, nullptr, nullptr},
    {"repeated", Kind::id, offsetof(cairn_team_report, repeated), 1, 0, nullptr, nullptr},
    {"own", Kind::id, offsetof(cairn_team_report, own), 1, 0, nullptr, nullptr},
    {"ignored", Kind::id, offsetof(cairn_team_report, ignored), 1, 0, nullptr, nullptr},
    {"unknown", Kind::id, offsetof(cairn_team_report, unknown), 1, 0, nullptr, nullptr},
    {"past", Kind::id, offsetof(cairn_team_report, past), 1, 0, nullptr, nullptr},
    {"ahead", Kind::id, offsetof(cairn_team_report, ahead), 1, 0, nullptr, nullptr},
    {"conflict", Kind::id, offsetof(cairn_team_report, conflict), 1, 0, nullptr, nullptr},
    {"full", Kind::id, offsetof(cairn_team_report, full), 1, 0, nullptr, nullptr},
    {"foreign", Kind::id, offsetof(cairn_team_report, foreign), 1, 0, nullptr, nullptr},
    {"version", Kind::id, offsetof(cairn_team_report, version), 1, 0, nullptr, nullptr},
    {"cut", Kind::id, offsetof(cairn_team_report, cut), 1, 0, nullptr, nullptr},
    {"corrupt", Kind::id, offsetof(cairn_team_report, corrupt), 1, 0, nullptr, nullptr},
    {"nonsense", Kind::id, offsetof(cairn_team_report, nonsense), 1, 0, nullptr, nullptr},
    {"lost", Kind::id, offsetof(cairn_team_report, lost), 1, 0, nullptr, nullptr},
    {"matched", Kind::id, offsetof(cairn_team_report, matched), 1, 0, nullptr, nullptr},
    {"placed", Kind::id, offsetof(cairn_team_report, placed), 1, 0, nullptr, nullptr},
    {"rejected", Kind::id, offsetof(cairn_team_report, rejected), 1, 0, nullptr, nullptr},
    {"sightings_used", Kind::id, offsetof(cairn_team_report, sightings_used), 1, 0, nullptr, nullptr},
    {"sightings_refused", Kind::id, offsetof(cairn_team_report, sightings_refused), 1, 0, nullptr, nullptr},
    {"vehicles_found", Kind::id, offsetof(cairn_team_report, vehicles_found), 1, 0, nullptr, nullptr},
    {"failed", Kind::id, offsetof(cairn_team_report, failed), 1, 0, nullptr, nullptr},
    {"scored", Kind::id, offsetof(cairn_team_report, scored), 1, 0, nullptr, nullptr},
    {"scored_nees", Kind::id, offsetof(cairn_team_report, scored_nees), 1, 0, nullptr, nullptr},
    {"position_rmse", Kind::number, offsetof(cairn_team_report, position_rmse), 1, 0, nullptr, nullptr},
    {"anees_per_dof", Kind::number, offsetof(cairn_team_report, anees_per_dof), 1, 0, nullptr, nullptr},
    {"claimed_improvement", Kind::number, offsetof(cairn_team_report, claimed_improvement), 1, 0, nullptr, nullptr},
    {"true_improvement", Kind::number, offsetof(cairn_team_report, true_improvement), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_team_report{"team_report", sizeof(cairn_team_report), fields_team_report,
  std::size(fields_team_report)};
constexpr Field fields_world_options[] = {
    {"course", Kind::constant, offsetof(cairn_world_options, course), 1, 0, &enum_course, nullptr},
    {"seed", Kind::id, offsetof(cairn_world_options, seed), 1, 0, nullptr, nullptr},
    {"landmarks", Kind::uint32, offsetof(cairn_world_options, landmarks), 1, 0, nullptr, nullptr},
    {"terrain", Kind::constant, offsetof(cairn_world_options, terrain), 1, 0, &enum_terrain, nullptr},
    {"contact", Kind::constant, offsetof(cairn_world_options, contact), 1, 0, &enum_contact, nullptr},
    {"drive", Kind::constant, offsetof(cairn_world_options, drive), 1, 0, &enum_drive, nullptr},
    {"accelerometer", Kind::constant, offsetof(cairn_world_options, accelerometer), 1, 0, &enum_accelerometer, nullptr},
    {"stick_noise", Kind::constant, offsetof(cairn_world_options, stick_noise), 1, 0, &enum_stick, nullptr},
    {"observe_at_start", Kind::boolean, offsetof(cairn_world_options, observe_at_start), 1, 0, nullptr, nullptr},
    {"traverse_closed", Kind::boolean, offsetof(cairn_world_options, traverse_closed), 1, 0, nullptr, nullptr},
    {"speed", Kind::number, offsetof(cairn_world_options, speed), 1, 0, nullptr, nullptr},
    {"laps", Kind::number, offsetof(cairn_world_options, laps), 1, 0, nullptr, nullptr},
    {"centre", Kind::number, offsetof(cairn_world_options, centre), 2, 0, nullptr, nullptr},
    {"radius", Kind::number, offsetof(cairn_world_options, radius), 1, 0, nullptr, nullptr},
    {"start_azimuth", Kind::number, offsetof(cairn_world_options, start_azimuth), 1, 0, nullptr, nullptr},
    {"round_length", Kind::number, offsetof(cairn_world_options, round_length), 1, 0, nullptr, nullptr},
    {"round_variation", Kind::number, offsetof(cairn_world_options, round_variation), 1, 0, nullptr, nullptr},
    {"strip", Kind::number, offsetof(cairn_world_options, strip), 1, 0, nullptr, nullptr},
    {"landmark_area", Kind::number, offsetof(cairn_world_options, landmark_area), 1, 0, nullptr, nullptr},
    {"landmark_height", Kind::number, offsetof(cairn_world_options, landmark_height), 1, 0, nullptr, nullptr},
    {"max_slope", Kind::number, offsetof(cairn_world_options, max_slope), 1, 0, nullptr, nullptr},
    {"wavelength", Kind::number, offsetof(cairn_world_options, wavelength), 2, 0, nullptr, nullptr},
    {"start_height", Kind::number, offsetof(cairn_world_options, start_height), 1, 0, nullptr, nullptr},
    {"wheel_radius", Kind::number, offsetof(cairn_world_options, wheel_radius), 1, 0, nullptr, nullptr},
    {"track", Kind::number, offsetof(cairn_world_options, track), 1, 0, nullptr, nullptr},
    {"wheelbase", Kind::number, offsetof(cairn_world_options, wheelbase), 1, 0, nullptr, nullptr},
    {"velocity_sigma", Kind::number, offsetof(cairn_world_options, velocity_sigma), 1, 0, nullptr, nullptr},
    {"rate_sigma", Kind::number, offsetof(cairn_world_options, rate_sigma), 1, 0, nullptr, nullptr},
    {"gravity", Kind::number, offsetof(cairn_world_options, gravity), 1, 0, nullptr, nullptr},
    {"wheel_rate_sigma", Kind::number, offsetof(cairn_world_options, wheel_rate_sigma), 1, 0, nullptr, nullptr},
    {"wheel_slip_sigma", Kind::number, offsetof(cairn_world_options, wheel_slip_sigma), 1, 0, nullptr, nullptr},
    {"lateral_sigma", Kind::number, offsetof(cairn_world_options, lateral_sigma), 1, 0, nullptr, nullptr},
    {"vertical_sigma", Kind::number, offsetof(cairn_world_options, vertical_sigma), 1, 0, nullptr, nullptr},
    {"imu_period", Kind::number, offsetof(cairn_world_options, imu_period), 1, 0, nullptr, nullptr},
    {"motion_period", Kind::number, offsetof(cairn_world_options, motion_period), 1, 0, nullptr, nullptr},
    {"frame_period", Kind::number, offsetof(cairn_world_options, frame_period), 1, 0, nullptr, nullptr},
    {"range_sigma", Kind::number, offsetof(cairn_world_options, range_sigma), 1, 0, nullptr, nullptr},
    {"azimuth_sigma", Kind::number, offsetof(cairn_world_options, azimuth_sigma), 1, 0, nullptr, nullptr},
    {"stick_sigma", Kind::number, offsetof(cairn_world_options, stick_sigma), 1, 0, nullptr, nullptr},
    {"image_sigma", Kind::number, offsetof(cairn_world_options, image_sigma), 1, 0, nullptr, nullptr},
    {"near_range", Kind::number, offsetof(cairn_world_options, near_range), 1, 0, nullptr, nullptr},
    {"far_range", Kind::number, offsetof(cairn_world_options, far_range), 1, 0, nullptr, nullptr},
    {"half_azimuth", Kind::number, offsetof(cairn_world_options, half_azimuth), 1, 0, nullptr, nullptr},
    {"pan_amplitude", Kind::number, offsetof(cairn_world_options, pan_amplitude), 1, 0, nullptr, nullptr},
    {"pan_period", Kind::number, offsetof(cairn_world_options, pan_period), 1, 0, nullptr, nullptr},
    {"stick_amplitude", Kind::number, offsetof(cairn_world_options, stick_amplitude), 1, 0, nullptr, nullptr},
    {"stick_period", Kind::number, offsetof(cairn_world_options, stick_period), 1, 0, nullptr, nullptr},
    {"platform", Kind::number, offsetof(cairn_world_options, platform), 3, 0, nullptr, nullptr},
    {"stick", Kind::number, offsetof(cairn_world_options, stick), 3, 0, nullptr, nullptr},
    {"velocity_bias", Kind::number, offsetof(cairn_world_options, velocity_bias), 3, 0, nullptr, nullptr},
    {"rate_bias", Kind::number, offsetof(cairn_world_options, rate_bias), 3, 0, nullptr, nullptr},
    {"wheel_scale", Kind::number, offsetof(cairn_world_options, wheel_scale), 2, 0, nullptr, nullptr},
    {"mount_turn", Kind::number, offsetof(cairn_world_options, mount_turn), 3, 0, nullptr, nullptr},
    {"mount_shift", Kind::number, offsetof(cairn_world_options, mount_shift), 3, 0, nullptr, nullptr},
    {"value_offset", Kind::number, offsetof(cairn_world_options, value_offset), 3, 0, nullptr, nullptr},
};
constexpr Struct struct_world_options{"world_options", sizeof(cairn_world_options), fields_world_options,
  std::size(fields_world_options)};
constexpr Field fields_world_motion[] = {
    {"dt", Kind::number, offsetof(cairn_world_motion, dt), 1, 0, nullptr, nullptr},
    {"velocity", Kind::number, offsetof(cairn_world_motion, velocity), 3, 0, nullptr, nullptr},
    {"rate", Kind::number, offsetof(cairn_world_motion, rate), 3, 0, nullptr, nullptr},
    {"wheels", Kind::number, offsetof(cairn_world_motion, wheels), 2, 0, nullptr, nullptr},
    {"true_velocity", Kind::number, offsetof(cairn_world_motion, true_velocity), 3, 0, nullptr, nullptr},
    {"true_rate", Kind::number, offsetof(cairn_world_motion, true_rate), 3, 0, nullptr, nullptr},
    {"true_wheels", Kind::number, offsetof(cairn_world_motion, true_wheels), 2, 0, nullptr, nullptr},
};
constexpr Struct struct_world_motion{"world_motion", sizeof(cairn_world_motion), fields_world_motion,
  std::size(fields_world_motion)};
constexpr Field fields_world_step[] = {
    {"number", Kind::id, offsetof(cairn_world_step, number), 1, 0, nullptr, nullptr},
    {"time", Kind::number, offsetof(cairn_world_step, time), 1, 0, nullptr, nullptr},
    {"truth", Kind::object, offsetof(cairn_world_step, truth), 1, 0, nullptr, &struct_pose},
    {"velocity_sigma", Kind::number, offsetof(cairn_world_step, velocity_sigma), 3, 0, nullptr, nullptr},
    {"rate_sigma", Kind::number, offsetof(cairn_world_step, rate_sigma), 3, 0, nullptr, nullptr},
    {"pan", Kind::number, offsetof(cairn_world_step, pan), 1, 0, nullptr, nullptr},
    {"stick", Kind::number, offsetof(cairn_world_step, stick), 1, 0, nullptr, nullptr},
    {"motion_count", Kind::id, offsetof(cairn_world_step, motion_count), 1, 0, nullptr, nullptr},
    {"observation_count", Kind::id, offsetof(cairn_world_step, observation_count), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_world_step{"world_step", sizeof(cairn_world_step), fields_world_step,
  std::size(fields_world_step)};
constexpr Field fields_fleet_options[] = {
    {"layout", Kind::constant, offsetof(cairn_fleet_options, layout), 1, 0, &enum_fleet_layout, nullptr},
    {"seed", Kind::id, offsetof(cairn_fleet_options, seed), 1, 0, nullptr, nullptr},
    {"vehicles", Kind::uint32, offsetof(cairn_fleet_options, vehicles), 1, 0, nullptr, nullptr},
    {"features", Kind::uint32, offsetof(cairn_fleet_options, features), 1, 0, nullptr, nullptr},
    {"area", Kind::number, offsetof(cairn_fleet_options, area), 1, 0, nullptr, nullptr},
    {"separation", Kind::number, offsetof(cairn_fleet_options, separation), 1, 0, nullptr, nullptr},
    {"course_length", Kind::number, offsetof(cairn_fleet_options, course_length), 1, 0, nullptr, nullptr},
    {"duration", Kind::number, offsetof(cairn_fleet_options, duration), 1, 0, nullptr, nullptr},
    {"period", Kind::number, offsetof(cairn_fleet_options, period), 1, 0, nullptr, nullptr},
    {"radar_range", Kind::number, offsetof(cairn_fleet_options, radar_range), 1, 0, nullptr, nullptr},
    {"range_sigma", Kind::number, offsetof(cairn_fleet_options, range_sigma), 1, 0, nullptr, nullptr},
    {"bearing_sigma", Kind::number, offsetof(cairn_fleet_options, bearing_sigma), 1, 0, nullptr, nullptr},
    {"speed_sigma", Kind::number, offsetof(cairn_fleet_options, speed_sigma), 1, 0, nullptr, nullptr},
    {"rate_sigma", Kind::number, offsetof(cairn_fleet_options, rate_sigma), 1, 0, nullptr, nullptr},
    {"coast_distance", Kind::number, offsetof(cairn_fleet_options, coast_distance), 1, 0, nullptr, nullptr},
    {"coast_relief", Kind::number, offsetof(cairn_fleet_options, coast_relief), 1, 0, nullptr, nullptr},
    {"coast_strip", Kind::number, offsetof(cairn_fleet_options, coast_strip), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_fleet_options{"fleet_options", sizeof(cairn_fleet_options), fields_fleet_options,
  std::size(fields_fleet_options)};
constexpr Field fields_fleet_sighting[] = {
    {"id", Kind::id, offsetof(cairn_fleet_sighting, id), 1, 0, nullptr, nullptr},
    {"range", Kind::number, offsetof(cairn_fleet_sighting, range), 1, 0, nullptr, nullptr},
    {"bearing", Kind::number, offsetof(cairn_fleet_sighting, bearing), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_fleet_sighting{"fleet_sighting", sizeof(cairn_fleet_sighting), fields_fleet_sighting,
  std::size(fields_fleet_sighting)};
constexpr Field fields_fleet_vehicle[] = {
    {"speed", Kind::number, offsetof(cairn_fleet_vehicle, speed), 1, 0, nullptr, nullptr},
    {"rate", Kind::number, offsetof(cairn_fleet_vehicle, rate), 1, 0, nullptr, nullptr},
    {"x", Kind::number, offsetof(cairn_fleet_vehicle, x), 1, 0, nullptr, nullptr},
    {"y", Kind::number, offsetof(cairn_fleet_vehicle, y), 1, 0, nullptr, nullptr},
    {"heading", Kind::number, offsetof(cairn_fleet_vehicle, heading), 1, 0, nullptr, nullptr},
    {"feature_count", Kind::id, offsetof(cairn_fleet_vehicle, feature_count), 1, 0, nullptr, nullptr},
    {"vehicle_count", Kind::id, offsetof(cairn_fleet_vehicle, vehicle_count), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_fleet_vehicle{"fleet_vehicle", sizeof(cairn_fleet_vehicle), fields_fleet_vehicle,
  std::size(fields_fleet_vehicle)};
constexpr Field fields_fleet_step[] = {
    {"number", Kind::id, offsetof(cairn_fleet_step, number), 1, 0, nullptr, nullptr},
    {"time", Kind::number, offsetof(cairn_fleet_step, time), 1, 0, nullptr, nullptr},
    {"dt", Kind::number, offsetof(cairn_fleet_step, dt), 1, 0, nullptr, nullptr},
    {"vehicle_count", Kind::id, offsetof(cairn_fleet_step, vehicle_count), 1, 0, nullptr, nullptr},
};
constexpr Struct struct_fleet_step{"fleet_step", sizeof(cairn_fleet_step), fields_fleet_step,
  std::size(fields_fleet_step)};
constexpr HandleType handle_map{"map", [](void *handle) { cairn_map_destroy(static_cast<cairn_map *>(handle)); }};
constexpr HandleType handle_filter{"filter", [](void *handle) { cairn_filter_destroy(static_cast<cairn_filter
  *>(handle)); }};
constexpr HandleType handle_team{"team", [](void *handle) { cairn_team_destroy(static_cast<cairn_team *>(handle)); }};
constexpr HandleType handle_world{"world", [](void *handle) { cairn_world_destroy(static_cast<cairn_world *>(handle));
  }};
constexpr HandleType handle_fleet{"fleet", [](void *handle) { cairn_fleet_destroy(static_cast<cairn_fleet *>(handle));
  }};
inline const Struct *const callbacks::pose_type = &struct_pose;

inline void run_status_name(Call &call) {
  const auto status = call.constant<cairn_status>("status", enum_status);
  call.give(mxCreateString(cairn_status_name(status)));
}

inline void run_version(Call &call) {
  call.give(mxCreateString(cairn_version()));
}

inline void run_version_number(Call &call) {
  call.give(number(static_cast<double>(cairn_version_number())));
}

inline void run_has(Call &call) {
  const std::optional<std::string> feature = call.text("feature", true);
  call.give(mxCreateLogicalScalar(cairn_has(feature ? feature->c_str() : nullptr) != 0));
}

inline void run_build(Call &call) {
  call.give(mxCreateString(cairn_build()));
}

inline void run_pose_identity(Call &call) {
  cairn_pose pose{};
  call.check(cairn_pose_identity(&pose, &call.error));
  call.give(write_object(struct_pose, &pose, sizeof pose, 1));
}

inline void run_pose_compose(Call &call) {
  cairn_pose T_a_b{};
  call.object("T_a_b", struct_pose, &T_a_b, false);
  cairn_pose T_b_c{};
  call.object("T_b_c", struct_pose, &T_b_c, false);
  cairn_pose result{};
  call.check(cairn_pose_compose(&T_a_b, &T_b_c, &result, &call.error));
  call.give(write_object(struct_pose, &result, sizeof result, 1));
}

inline void run_pose_inverse(Call &call) {
  cairn_pose T_a_b{};
  call.object("T_a_b", struct_pose, &T_a_b, false);
  cairn_pose result{};
  call.check(cairn_pose_inverse(&T_a_b, &result, &call.error));
  call.give(write_object(struct_pose, &result, sizeof result, 1));
}

inline void run_pose_apply(Call &call) {
  cairn_pose T_a_b{};
  call.object("T_a_b", struct_pose, &T_a_b, false);
  double point_b[3];
  call.matrix("point_b", point_b, 3, 1, false);
  double point_a[3];
  call.check(cairn_pose_apply(&T_a_b, point_b, point_a, &call.error));
  call.give(write_matrix(point_a, 3, 1));
}

inline void run_quaternion_from_euler(Call &call) {
  const auto roll = call.scalar<double>("roll");
  const auto pitch = call.scalar<double>("pitch");
  const auto yaw = call.scalar<double>("yaw");
  double quaternion[4];
  call.check(cairn_quaternion_from_euler(roll, pitch, yaw, quaternion, &call.error));
  call.give(write_matrix(quaternion, 4, 1));
}

inline void run_quaternion_to_euler(Call &call) {
  double quaternion[4];
  call.matrix("quaternion", quaternion, 4, 1, false);
  double roll{};
  double pitch{};
  double yaw{};
  call.check(cairn_quaternion_to_euler(quaternion, &roll, &pitch, &yaw, &call.error));
  call.give(number(static_cast<double>(roll)));
  call.give(number(static_cast<double>(pitch)));
  call.give(number(static_cast<double>(yaw)));
}

inline void run_quaternion_exp(Call &call) {
  double rotation_vector[3];
  call.matrix("rotation_vector", rotation_vector, 3, 1, false);
  double quaternion[4];
  call.check(cairn_quaternion_exp(rotation_vector, quaternion, &call.error));
  call.give(write_matrix(quaternion, 4, 1));
}

inline void run_quaternion_log(Call &call) {
  double quaternion[4];
  call.matrix("quaternion", quaternion, 4, 1, false);
  double rotation_vector[3];
  call.check(cairn_quaternion_log(quaternion, rotation_vector, &call.error));
  call.give(write_matrix(rotation_vector, 3, 1));
}

inline void run_pose_error(Call &call) {
  cairn_pose truth{};
  call.object("truth", struct_pose, &truth, false);
  cairn_pose estimate{};
  call.object("estimate", struct_pose, &estimate, false);
  double difference[6];
  call.check(cairn_pose_error(&truth, &estimate, difference, &call.error));
  call.give(write_matrix(difference, 6, 1));
}

inline void run_map_size(Call &call) {
  auto *map = call.handle<cairn_map>("map", handle_map);
  size_t count{};
  call.check(cairn_map_size(map, &count, &call.error));
  call.give(number(static_cast<double>(count)));
}

inline void run_map_landmark(Call &call) {
  auto *map = call.handle<cairn_map>("map", handle_map);
  const auto id = call.scalar<uint64_t>("id");
  cairn_landmark landmark{};
  call.check(cairn_map_landmark(map, id, &landmark, &call.error));
  call.give(write_object(struct_landmark, &landmark, sizeof landmark, 1));
}

inline void run_map_landmarks(Call &call) {
  auto *map = call.handle<cairn_map>("map", handle_map);
  size_t needed = 0;
  call.check(cairn_map_landmarks(map, nullptr, 0, &needed, &call.error));
  std::vector<cairn_landmark> landmarks(needed);
  call.check(cairn_map_landmarks(map, landmarks.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_landmark, landmarks));
}

inline void run_map_within(Call &call) {
  auto *map = call.handle<cairn_map>("map", handle_map);
  double centre[3];
  call.matrix("centre", centre, 3, 1, false);
  const auto radius = call.scalar<double>("radius");
  size_t needed = 0;
  call.check(cairn_map_within(map, centre, radius, nullptr, 0, &needed, &call.error));
  std::vector<cairn_landmark> landmarks(needed);
  call.check(cairn_map_within(map, centre, radius, landmarks.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_landmark, landmarks));
}

inline void run_map_nearest(Call &call) {
  auto *map = call.handle<cairn_map>("map", handle_map);
  double point[3];
  call.matrix("point", point, 3, 1, false);
  const auto count = call.scalar<size_t>("count");
  size_t needed = 0;
  call.check(cairn_map_nearest(map, point, count, nullptr, 0, &needed, &call.error));
  std::vector<cairn_landmark> landmarks(needed);
  call.check(cairn_map_nearest(map, point, count, landmarks.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_landmark, landmarks));
}

inline void run_map_in_box(Call &call) {
  auto *map = call.handle<cairn_map>("map", handle_map);
  double lower[3];
  call.matrix("lower", lower, 3, 1, false);
  double upper[3];
  call.matrix("upper", upper, 3, 1, false);
  size_t needed = 0;
  call.check(cairn_map_in_box(map, lower, upper, nullptr, 0, &needed, &call.error));
  std::vector<cairn_landmark> landmarks(needed);
  call.check(cairn_map_in_box(map, lower, upper, landmarks.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_landmark, landmarks));
}

inline void run_map_joint_covariance(Call &call) {
  auto *map = call.handle<cairn_map>("map", handle_map);
  const auto ids = call.vector<uint64_t>("ids");
  const size_t count = ids.size();
  size_t needed = 0;
  call.check(cairn_map_joint_covariance(map, ids.data(), count, nullptr, 0, &needed, &call.error));
  std::vector<double> matrix(needed);
  call.check(cairn_map_joint_covariance(map, ids.data(), count, matrix.data(), needed, &needed, &call.error));
  const auto matrix_side = static_cast<size_t>(std::lround(std::sqrt(double(needed))));
  call.give(write_matrix(matrix.data(), matrix_side, matrix_side));
}

inline void run_map_kind(Call &call) {
  auto *map = call.handle<cairn_map>("map", handle_map);
  cairn_map_form kind{};
  call.check(cairn_map_kind(map, &kind, &call.error));
  call.give(number(static_cast<double>(kind)));
}

inline void run_map_copy(Call &call) {
  auto *map = call.handle<cairn_map>("map", handle_map);
  cairn_map *copy = nullptr;
  call.check(cairn_map_copy(map, &copy, &call.error));
  call.give_owned(handle_map, copy);
}

inline void run_merge_options_init(Call &call) {
  cairn_merge_options options{};
  call.check(cairn_merge_options_init(&options, sizeof options, &call.error));
  call.check(cairn_merge_options_init(&options, sizeof options, &call.error));
  call.give(write_object(struct_merge_options, &options, sizeof options, 1));
}

inline void run_map_merge(Call &call) {
  auto *map = call.handle<cairn_map>("map", handle_map);
  auto *other = call.handle<cairn_map>("other", handle_map);
  cairn_merge_options options{};
  call.check(cairn_merge_options_init(&options, sizeof options, &call.error));
  const bool has_options = call.object("options", struct_merge_options, &options, true);
  cairn_merge_report report{};
  report.struct_size = sizeof report;
  call.check(cairn_map_merge(map, other, has_options ? &options : nullptr, call.wanted(0) ? &report : nullptr,
    &call.error));
  call.give(write_object(struct_merge_report, &report, sizeof report, 1));
}

inline void run_map_merged_ids(Call &call) {
  auto *map = call.handle<cairn_map>("map", handle_map);
  size_t needed = 0;
  call.check(cairn_map_merged_ids(map, nullptr, 0, &needed, &call.error));
  std::vector<cairn_merged_id> merged(needed);
  call.check(cairn_map_merged_ids(map, merged.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_merged_id, merged));
}

inline void run_wheels_init(Call &call) {
  cairn_wheels wheels{};
  call.check(cairn_wheels_init(&wheels, sizeof wheels, &call.error));
  call.check(cairn_wheels_init(&wheels, sizeof wheels, &call.error));
  call.give(write_object(struct_wheels, &wheels, sizeof wheels, 1));
}

inline void run_twist_noise_init(Call &call) {
  cairn_twist_noise noise{};
  call.check(cairn_twist_noise_init(&noise, sizeof noise, &call.error));
  call.check(cairn_twist_noise_init(&noise, sizeof noise, &call.error));
  call.give(write_object(struct_twist_noise, &noise, sizeof noise, 1));
}

inline void run_id_none(Call &call) {
  call.give(Call::write_number(cairn_id_none()));
}

inline void run_stereo_head_init(Call &call) {
  cairn_stereo_head head{};
  call.check(cairn_stereo_head_init(&head, sizeof head, &call.error));
  call.check(cairn_stereo_head_init(&head, sizeof head, &call.error));
  call.give(write_object(struct_stereo_head, &head, sizeof head, 1));
}

inline void run_stereo_camera_init(Call &call) {
  cairn_stereo_camera camera{};
  call.check(cairn_stereo_camera_init(&camera, sizeof camera, &call.error));
  call.check(cairn_stereo_camera_init(&camera, sizeof camera, &call.error));
  call.give(write_object(struct_stereo_camera, &camera, sizeof camera, 1));
}

inline void run_range_bearing_init(Call &call) {
  cairn_range_bearing radar{};
  call.check(cairn_range_bearing_init(&radar, sizeof radar, &call.error));
  call.check(cairn_range_bearing_init(&radar, sizeof radar, &call.error));
  call.give(write_object(struct_range_bearing, &radar, sizeof radar, 1));
}

inline void run_cartesian_init(Call &call) {
  cairn_cartesian cartesian{};
  call.check(cairn_cartesian_init(&cartesian, sizeof cartesian, &call.error));
  call.check(cairn_cartesian_init(&cartesian, sizeof cartesian, &call.error));
  call.give(write_object(struct_cartesian, &cartesian, sizeof cartesian, 1));
}

inline void run_custom_init(Call &call) {
  cairn_custom custom{};
  call.check(cairn_custom_init(&custom, sizeof custom, &call.error));
  call.check(cairn_custom_init(&custom, sizeof custom, &call.error));
  call.give(write_object(struct_custom, &custom, sizeof custom, 1));
}

inline void run_custom_check(Call &call) {
  cairn_custom custom{};
  call.check(cairn_custom_init(&custom, sizeof custom, &call.error));
  call.object("custom", struct_custom, &custom, true);
  const mxArray *predict = call.function("predict", false);
  const mxArray *place = call.function("place", true);
  auto user = std::make_unique<Callbacks>(custom.rows, Functions{predict, place});
  cairn_pose pose{};
  call.object("pose", struct_pose, &pose, false);
  double landmark[3];
  call.matrix("landmark", landmark, 3, 1, false);
  double worst{};
  call.check(cairn_custom_check(&custom, predict ? callbacks::cairn_custom_predict_fn : nullptr, place ?
    callbacks::cairn_custom_place_fn : nullptr, user.get(), &pose, landmark, &worst, &call.error));
  call.give(number(static_cast<double>(worst)));
}

inline void run_filter_options_init(Call &call) {
  cairn_filter_options options{};
  call.check(cairn_filter_options_init(&options, sizeof options, &call.error));
  call.check(cairn_filter_options_init(&options, sizeof options, &call.error));
  call.give(write_object(struct_filter_options, &options, sizeof options, 1));
}

inline void run_filter_required_bytes(Call &call) {
  cairn_filter_options options{};
  call.check(cairn_filter_options_init(&options, sizeof options, &call.error));
  call.object("options", struct_filter_options, &options, true);
  size_t bytes{};
  call.check(cairn_filter_required_bytes(&options, &bytes, &call.error));
  call.give(number(static_cast<double>(bytes)));
}

inline void run_filter_create(Call &call) {
  cairn_filter_options options{};
  call.check(cairn_filter_options_init(&options, sizeof options, &call.error));
  call.object("options", struct_filter_options, &options, true);
  cairn_filter *filter = nullptr;
  call.check(cairn_filter_create(&options, &filter, &call.error));
  call.give_owned(handle_filter, filter);
}

inline void run_filter_set_log(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const mxArray *log = call.function("log", true);
  auto payload = std::make_unique<Callbacks>(0, Functions{log});
  if (!log) payload.reset();
  call.check(cairn_filter_set_log(filter, log ? callbacks::cairn_log_fn : nullptr, payload.get(), payload ?
    Callbacks::release : nullptr, &call.error));
  payload.release();
}

inline void run_filter_add_stereo_head(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_stereo_head head{};
  call.check(cairn_stereo_head_init(&head, sizeof head, &call.error));
  call.object("head", struct_stereo_head, &head, true);
  int32_t sensor{};
  call.check(cairn_filter_add_stereo_head(filter, &head, &sensor, &call.error));
  call.give(number(static_cast<double>(sensor)));
}

inline void run_filter_add_stereo_camera(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_stereo_camera camera{};
  call.check(cairn_stereo_camera_init(&camera, sizeof camera, &call.error));
  call.object("camera", struct_stereo_camera, &camera, true);
  int32_t sensor{};
  call.check(cairn_filter_add_stereo_camera(filter, &camera, &sensor, &call.error));
  call.give(number(static_cast<double>(sensor)));
}

inline void run_filter_add_range_bearing(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_range_bearing radar{};
  call.check(cairn_range_bearing_init(&radar, sizeof radar, &call.error));
  call.object("radar", struct_range_bearing, &radar, true);
  int32_t sensor{};
  call.check(cairn_filter_add_range_bearing(filter, &radar, &sensor, &call.error));
  call.give(number(static_cast<double>(sensor)));
}

inline void run_filter_add_cartesian(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_cartesian cartesian{};
  call.check(cairn_cartesian_init(&cartesian, sizeof cartesian, &call.error));
  call.object("cartesian", struct_cartesian, &cartesian, true);
  int32_t sensor{};
  call.check(cairn_filter_add_cartesian(filter, &cartesian, &sensor, &call.error));
  call.give(number(static_cast<double>(sensor)));
}

inline void run_filter_add_custom(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_custom custom{};
  call.check(cairn_custom_init(&custom, sizeof custom, &call.error));
  call.object("custom", struct_custom, &custom, true);
  const mxArray *predict = call.function("predict", false);
  const mxArray *place = call.function("place", true);
  auto user = std::make_unique<Callbacks>(custom.rows, Functions{predict, place});
  int32_t sensor{};
  call.check(cairn_filter_add_custom(filter, &custom, predict ? callbacks::cairn_custom_predict_fn : nullptr, place ?
    callbacks::cairn_custom_place_fn : nullptr, user.get(), user ? Callbacks::release : nullptr, &sensor, &call.error));
  user.release();
  call.give(number(static_cast<double>(sensor)));
}

inline void run_filter_point_head(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto sensor = call.scalar<int32_t>("sensor");
  const auto pan = call.scalar<double>("pan");
  const auto stick = call.scalar<double>("stick");
  call.check(cairn_filter_point_head(filter, sensor, pan, stick, &call.error));
}

inline void run_filter_set_loss(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto sensor = call.scalar<int32_t>("sensor");
  const auto loss = call.constant<cairn_loss>("loss", enum_loss);
  const auto width = call.scalar<double>("width");
  call.check(cairn_filter_set_loss(filter, sensor, loss, width, &call.error));
}

inline void run_filter_set_view(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto sensor = call.scalar<int32_t>("sensor");
  double lower[3];
  call.matrix("lower", lower, 3, 1, false);
  double upper[3];
  call.matrix("upper", upper, 3, 1, false);
  call.check(cairn_filter_set_view(filter, sensor, lower, upper, &call.error));
}

inline void run_filter_set_wheels(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_wheels wheels{};
  call.check(cairn_wheels_init(&wheels, sizeof wheels, &call.error));
  call.object("wheels", struct_wheels, &wheels, true);
  call.check(cairn_filter_set_wheels(filter, &wheels, &call.error));
}

inline void run_filter_set_twist_noise(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_twist_noise noise{};
  call.check(cairn_twist_noise_init(&noise, sizeof noise, &call.error));
  call.object("noise", struct_twist_noise, &noise, true);
  call.check(cairn_filter_set_twist_noise(filter, &noise, &call.error));
}

inline void run_filter_predict_wheels(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto dt = call.scalar<double>("dt");
  const auto left_rad_per_s = call.scalar<double>("left_rad_per_s");
  const auto right_rad_per_s = call.scalar<double>("right_rad_per_s");
  call.check(cairn_filter_predict_wheels(filter, dt, left_rad_per_s, right_rad_per_s, &call.error));
}

inline void run_filter_predict_wheels_gyro(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto dt = call.scalar<double>("dt");
  const auto left_rad_per_s = call.scalar<double>("left_rad_per_s");
  const auto right_rad_per_s = call.scalar<double>("right_rad_per_s");
  double rate[3];
  call.matrix("rate", rate, 3, 1, false);
  call.check(cairn_filter_predict_wheels_gyro(filter, dt, left_rad_per_s, right_rad_per_s, rate, &call.error));
}

inline void run_filter_predict_twist(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto dt = call.scalar<double>("dt");
  double velocity[3];
  call.matrix("velocity", velocity, 3, 1, false);
  double rate[3];
  call.matrix("rate", rate, 3, 1, false);
  call.check(cairn_filter_predict_twist(filter, dt, velocity, rate, &call.error));
}

inline void run_filter_predict_increment(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_pose T_before_after{};
  call.object("T_before_after", struct_pose, &T_before_after, false);
  double covariance[36];
  call.matrix("covariance", covariance, 6, 6, false);
  call.check(cairn_filter_predict_increment(filter, &T_before_after, covariance, &call.error));
}

inline void run_filter_update(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto sensor = call.scalar<int32_t>("sensor");
  const auto observations = call.objects<cairn_observation>("observations", struct_observation);
  const size_t count = observations.size();
  std::vector<cairn_match> matches(call.wanted(0) ? count : 0);
  call.check(cairn_filter_update(filter, sensor, observations.data(), count, call.wanted(0) ? matches.data() : nullptr,
    &call.error));
  call.give(write_objects(struct_match, matches));
}

inline void run_filter_update_linear(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto residual = call.vector<double>("residual");
  const size_t rows = residual.size();
  std::vector<double> covariance(rows * rows);
  call.matrix("covariance", covariance.data(), rows, rows, false);
  std::vector<double> jacobian_pose(rows * 6);
  const bool has_jacobian_pose = call.matrix("jacobian_pose", jacobian_pose.data(), rows, 6, true);
  const auto landmarks = call.vector<uint64_t>("landmarks");
  const size_t count = landmarks.size();
  std::vector<double> jacobian_landmarks(rows * 3 * count);
  call.matrix("jacobian_landmarks", jacobian_landmarks.data(), rows, 3 * count, false);
  cairn_match match{};
  call.check(cairn_filter_update_linear(filter, residual.data(), rows, covariance.data(), has_jacobian_pose ?
    jacobian_pose.data() : nullptr, landmarks.data(), count, jacobian_landmarks.data(), call.wanted(0) ? &match :
    nullptr, &call.error));
  call.give(write_object(struct_match, &match, sizeof match, 1));
}

inline void run_filter_update_position(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  double position[3];
  call.matrix("position", position, 3, 1, false);
  double covariance[9];
  call.matrix("covariance", covariance, 3, 3, false);
  double lever_arm[3];
  const bool has_lever_arm = call.matrix("lever_arm", lever_arm, 3, 1, true);
  cairn_match match{};
  call.check(cairn_filter_update_position(filter, position, covariance, has_lever_arm ? lever_arm : nullptr,
    call.wanted(0) ? &match : nullptr, &call.error));
  call.give(write_object(struct_match, &match, sizeof match, 1));
}

inline void run_filter_update_attitude(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  double quaternion[4];
  call.matrix("quaternion", quaternion, 4, 1, false);
  double covariance[9];
  call.matrix("covariance", covariance, 3, 3, false);
  cairn_match match{};
  call.check(cairn_filter_update_attitude(filter, quaternion, covariance, call.wanted(0) ? &match : nullptr,
    &call.error));
  call.give(write_object(struct_match, &match, sizeof match, 1));
}

inline void run_filter_update_heading(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto heading = call.scalar<double>("heading");
  const auto sigma = call.scalar<double>("sigma");
  cairn_match match{};
  call.check(cairn_filter_update_heading(filter, heading, sigma, call.wanted(0) ? &match : nullptr, &call.error));
  call.give(write_object(struct_match, &match, sizeof match, 1));
}

inline void run_filter_remove_landmark(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto id = call.scalar<uint64_t>("id");
  call.check(cairn_filter_remove_landmark(filter, id, &call.error));
}

inline void run_filter_merge_landmarks(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto id = call.scalar<uint64_t>("id");
  const auto other = call.scalar<uint64_t>("other");
  cairn_match match{};
  call.check(cairn_filter_merge_landmarks(filter, id, other, call.wanted(0) ? &match : nullptr, &call.error));
  call.give(write_object(struct_match, &match, sizeof match, 1));
}

inline void run_filter_split_landmark(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto id = call.scalar<uint64_t>("id");
  const auto fresh = call.scalar<uint64_t>("fresh");
  double covariance[9];
  call.matrix("covariance", covariance, 3, 3, false);
  call.check(cairn_filter_split_landmark(filter, id, fresh, covariance, &call.error));
}

inline void run_filter_close_submap(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  call.check(cairn_filter_close_submap(filter, &call.error));
}

inline void run_filter_last_closing(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_closing_report report{};
  report.struct_size = sizeof report;
  call.check(cairn_filter_last_closing(filter, &report, &call.error));
  call.give(write_object(struct_closing_report, &report, sizeof report, 1));
}

inline void run_filter_local_pose(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_pose pose{};
  double covariance[36];
  call.check(cairn_filter_local_pose(filter, call.wanted(0) ? &pose : nullptr, call.wanted(1) ? covariance : nullptr,
    &call.error));
  call.give(write_object(struct_pose, &pose, sizeof pose, 1));
  call.give(write_matrix(covariance, 6, 6));
}

inline void run_filter_base_pose(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_pose pose{};
  double covariance[36];
  call.check(cairn_filter_base_pose(filter, call.wanted(0) ? &pose : nullptr, call.wanted(1) ? covariance : nullptr,
    &call.error));
  call.give(write_object(struct_pose, &pose, sizeof pose, 1));
  call.give(write_matrix(covariance, 6, 6));
}

inline void run_filter_submap_count(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  size_t count{};
  call.check(cairn_filter_submap_count(filter, &count, &call.error));
  call.give(number(static_cast<double>(count)));
}

inline void run_filter_submap(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto index = call.scalar<size_t>("index");
  cairn_pose base{};
  size_t needed = 0;
  call.check(cairn_filter_submap(filter, index, call.wanted(0) ? &base : nullptr, nullptr, 0, &needed, &call.error));
  std::vector<uint64_t> ids(needed);
  call.check(cairn_filter_submap(filter, index, call.wanted(0) ? &base : nullptr, ids.data(), needed, &needed,
    &call.error));
  call.give(write_object(struct_pose, &base, sizeof base, 1));
  call.give(write_ids(ids.data(), needed));
}

inline void run_filter_last_update(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_update_report report{};
  report.struct_size = sizeof report;
  call.check(cairn_filter_last_update(filter, &report, &call.error));
  call.give(write_object(struct_update_report, &report, sizeof report, 1));
}

inline void run_filter_pose(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_pose pose{};
  double covariance[36];
  call.check(cairn_filter_pose(filter, call.wanted(0) ? &pose : nullptr, call.wanted(1) ? covariance : nullptr,
    &call.error));
  call.give(write_object(struct_pose, &pose, sizeof pose, 1));
  call.give(write_matrix(covariance, 6, 6));
}

inline void run_filter_joint_covariance(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto ids = call.vector<uint64_t>("ids");
  const size_t count = ids.size();
  size_t needed = 0;
  call.check(cairn_filter_joint_covariance(filter, ids.data(), count, nullptr, 0, &needed, &call.error));
  std::vector<double> matrix(needed);
  call.check(cairn_filter_joint_covariance(filter, ids.data(), count, matrix.data(), needed, &needed, &call.error));
  const auto matrix_side = static_cast<size_t>(std::lround(std::sqrt(double(needed))));
  call.give(write_matrix(matrix.data(), matrix_side, matrix_side));
}

inline void run_filter_local_map(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  call.give_lent(handle_map, cairn_filter_local_map(filter));
}

inline void run_filter_map(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  call.give_lent(handle_map, cairn_filter_map(filter));
}

inline void run_filter_pose_nees(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_pose truth{};
  call.object("truth", struct_pose, &truth, false);
  double nees{};
  call.check(cairn_filter_pose_nees(filter, &truth, &nees, &call.error));
  call.give(number(static_cast<double>(nees)));
}

inline void run_filter_audit(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  double min_pivot{};
  call.check(cairn_filter_audit(filter, &min_pivot, &call.error));
  call.give(number(static_cast<double>(min_pivot)));
}

inline void run_filter_health(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  cairn_health health{};
  health.struct_size = sizeof health;
  call.check(cairn_filter_health(filter, &health, &call.error));
  call.give(write_object(struct_health, &health, sizeof health, 1));
}

inline void run_filter_sensor_health(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto sensor = call.scalar<int32_t>("sensor");
  cairn_sensor_health health{};
  health.struct_size = sizeof health;
  call.check(cairn_filter_sensor_health(filter, sensor, &health, &call.error));
  call.give(write_object(struct_sensor_health, &health, sizeof health, 1));
}

inline void run_verdict_text(Call &call) {
  const auto verdict = call.constant<cairn_verdict>("verdict", enum_verdict);
  call.give(mxCreateString(cairn_verdict_text(verdict)));
}

inline void run_doubt_text(Call &call) {
  const auto reason = call.constant<cairn_doubts>("reason", enum_doubts);
  call.give(mxCreateString(cairn_doubt_text(reason)));
}

inline void run_calibration_init(Call &call) {
  cairn_calibration calibration{};
  call.check(cairn_calibration_init(&calibration, sizeof calibration, &call.error));
  call.check(cairn_calibration_init(&calibration, sizeof calibration, &call.error));
  call.give(write_object(struct_calibration, &calibration, sizeof calibration, 1));
}

inline void run_filter_calibrate_sensor(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto sensor = call.scalar<int32_t>("sensor");
  cairn_calibration calibration{};
  call.check(cairn_calibration_init(&calibration, sizeof calibration, &call.error));
  call.object("calibration", struct_calibration, &calibration, true);
  call.check(cairn_filter_calibrate_sensor(filter, sensor, &calibration, &call.error));
}

inline void run_filter_systematic_errors(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  size_t needed = 0;
  call.check(cairn_filter_systematic_errors(filter, nullptr, nullptr, 0, &needed, &call.error));
  std::vector<cairn_systematic_error> errors(needed);
  std::vector<double> covariance(needed * needed);
  call.check(cairn_filter_systematic_errors(filter, errors.data(), covariance.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_systematic_error, errors));
  call.give(write_matrix(covariance.data(), needed, needed));
}

inline void run_team_options_init(Call &call) {
  cairn_team_options options{};
  call.check(cairn_team_options_init(&options, sizeof options, &call.error));
  call.check(cairn_team_options_init(&options, sizeof options, &call.error));
  call.give(write_object(struct_team_options, &options, sizeof options, 1));
}

inline void run_team_create(Call &call) {
  cairn_team_options options{};
  call.check(cairn_team_options_init(&options, sizeof options, &call.error));
  call.object("options", struct_team_options, &options, true);
  cairn_filter_options filter{};
  call.check(cairn_filter_options_init(&filter, sizeof filter, &call.error));
  call.object("filter", struct_filter_options, &filter, true);
  cairn_range_bearing radar{};
  call.check(cairn_range_bearing_init(&radar, sizeof radar, &call.error));
  call.object("radar", struct_range_bearing, &radar, true);
  cairn_team *team = nullptr;
  call.check(cairn_team_create(&options, &filter, &radar, &team, &call.error));
  call.give_owned(handle_team, team);
}

inline void run_team_add(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  const auto vehicle = call.scalar<uint64_t>("vehicle");
  cairn_pose start{};
  const bool has_start = call.object("start", struct_pose, &start, true);
  double covariance[36];
  const bool has_covariance = call.matrix("covariance", covariance, 6, 6, true);
  call.check(cairn_team_add(team, vehicle, has_start ? &start : nullptr, has_covariance ? covariance : nullptr,
    &call.error));
}

inline void run_team_remove(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  const auto vehicle = call.scalar<uint64_t>("vehicle");
  call.check(cairn_team_remove(team, vehicle, &call.error));
}

inline void run_team_members(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  size_t needed = 0;
  call.check(cairn_team_members(team, nullptr, 0, &needed, &call.error));
  std::vector<uint64_t> vehicles(needed);
  call.check(cairn_team_members(team, vehicles.data(), needed, &needed, &call.error));
  call.give(write_ids(vehicles.data(), needed));
}

inline void run_team_predict_increment(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  cairn_pose T_before_after{};
  call.object("T_before_after", struct_pose, &T_before_after, false);
  double covariance[36];
  call.matrix("covariance", covariance, 6, 6, false);
  call.check(cairn_team_predict_increment(team, &T_before_after, covariance, &call.error));
}

inline void run_team_predict_twist(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  const auto dt = call.scalar<double>("dt");
  double velocity[3];
  call.matrix("velocity", velocity, 3, 1, false);
  double rate[3];
  call.matrix("rate", rate, 3, 1, false);
  cairn_twist_noise noise{};
  call.check(cairn_twist_noise_init(&noise, sizeof noise, &call.error));
  const bool has_noise = call.object("noise", struct_twist_noise, &noise, true);
  call.check(cairn_team_predict_twist(team, dt, velocity, rate, has_noise ? &noise : nullptr, &call.error));
}

inline void run_team_observe(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  const auto time = call.scalar<double>("time");
  const auto landmarks = call.objects<cairn_observation>("landmarks", struct_observation);
  const size_t landmark_count = landmarks.size();
  const auto vehicles = call.objects<cairn_observation>("vehicles", struct_observation);
  const size_t vehicle_count = vehicles.size();
  call.check(cairn_team_observe(team, time, landmarks.data(), landmark_count, vehicles.data(), vehicle_count,
    &call.error));
}

inline void run_team_decisions(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  size_t needed = 0;
  call.check(cairn_team_decisions(team, nullptr, 0, &needed, &call.error));
  std::vector<cairn_match> matches(needed);
  call.check(cairn_team_decisions(team, matches.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_match, matches));
}

inline void run_team_leave(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  call.check(cairn_team_leave(team, &call.error));
}

inline void run_team_take_packet(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  size_t needed = 0;
  call.check(cairn_team_take_packet(team, nullptr, 0, &needed, &call.error));
  std::vector<uint8_t> packet(needed);
  call.check(cairn_team_take_packet(team, packet.data(), needed, &needed, &call.error));
  call.give(write_bytes(packet.data(), needed));
}

inline void run_team_ask(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  call.check(cairn_team_ask(team, &call.error));
}

inline void run_team_receive(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  const auto packet = call.vector<uint8_t>("packet");
  const size_t size = packet.size();
  cairn_packet result{};
  call.check(cairn_team_receive(team, packet.data(), size, call.wanted(0) ? &result : nullptr, &call.error));
  call.give(number(static_cast<double>(result)));
}

inline void run_team_pose(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  const auto vehicle = call.scalar<uint64_t>("vehicle");
  cairn_pose pose{};
  double covariance[36];
  call.check(cairn_team_pose(team, vehicle, call.wanted(0) ? &pose : nullptr, call.wanted(1) ? covariance : nullptr,
    &call.error));
  call.give(write_object(struct_pose, &pose, sizeof pose, 1));
  call.give(write_matrix(covariance, 6, 6));
}

inline void run_team_pose_nees(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  cairn_pose truth{};
  call.object("truth", struct_pose, &truth, false);
  double nees{};
  call.check(cairn_team_pose_nees(team, &truth, &nees, &call.error));
  call.give(number(static_cast<double>(nees)));
}

inline void run_team_map(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  call.give_lent(handle_map, cairn_team_map(team));
}

inline void run_team_score(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  cairn_pose truth{};
  call.object("truth", struct_pose, &truth, false);
  call.check(cairn_team_score(team, &truth, &call.error));
}

inline void run_team_last_report(Call &call) {
  auto *team = call.handle<cairn_team>("team", handle_team);
  cairn_team_report report{};
  report.struct_size = sizeof report;
  call.check(cairn_team_last_report(team, &report, &call.error));
  call.give(write_object(struct_team_report, &report, sizeof report, 1));
}

inline void run_filter_keep_pose(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  uint64_t number{};
  call.check(cairn_filter_keep_pose(filter, call.wanted(0) ? &number : nullptr, &call.error));
  call.give(Call::write_number(number));
}

inline void run_filter_trajectory_range(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  uint64_t first{};
  uint64_t end_{};
  call.check(cairn_filter_trajectory_range(filter, call.wanted(0) ? &first : nullptr, call.wanted(1) ? &end_ : nullptr,
    &call.error));
  call.give(Call::write_number(first));
  call.give(Call::write_number(end_));
}

inline void run_filter_trajectory(Call &call) {
  auto *filter = call.handle<cairn_filter>("filter", handle_filter);
  const auto first = call.scalar<uint64_t>("first");
  size_t needed = 0;
  call.check(cairn_filter_trajectory(filter, first, nullptr, 0, &needed, &call.error));
  std::vector<cairn_pose> poses(needed);
  call.check(cairn_filter_trajectory(filter, first, poses.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_pose, poses));
}

inline void run_world_options_init(Call &call) {
  cairn_world_options options{};
  call.check(cairn_world_options_init(&options, sizeof options, &call.error));
  call.check(cairn_world_options_init(&options, sizeof options, &call.error));
  call.give(write_object(struct_world_options, &options, sizeof options, 1));
}

inline void run_world_options_preset(Call &call) {
  cairn_world_options options{};
  call.check(cairn_world_options_init(&options, sizeof options, &call.error));
  call.object("options", struct_world_options, &options, true);
  const auto preset = call.constant<cairn_preset>("preset", enum_preset);
  uint32_t submap_landmarks{};
  call.check(cairn_world_options_preset(&options, preset, call.wanted(1) ? &submap_landmarks : nullptr, &call.error));
  call.give(write_object(struct_world_options, &options, sizeof options, 1));
  call.give(number(static_cast<double>(submap_landmarks)));
}

inline void run_world_create(Call &call) {
  cairn_world_options options{};
  call.check(cairn_world_options_init(&options, sizeof options, &call.error));
  call.object("options", struct_world_options, &options, true);
  cairn_world *world = nullptr;
  call.check(cairn_world_create(&options, &world, &call.error));
  call.give_owned(handle_world, world);
}

inline void run_world_next(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  cairn_world_step step{};
  step.struct_size = sizeof step;
  call.check(cairn_world_next(world, &step, &call.error));
  call.give(write_object(struct_world_step, &step, sizeof step, 1));
}

inline void run_world_motions(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  size_t needed = 0;
  call.check(cairn_world_motions(world, nullptr, 0, &needed, &call.error));
  std::vector<cairn_world_motion> motions(needed);
  call.check(cairn_world_motions(world, motions.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_world_motion, motions));
}

inline void run_world_observations(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  size_t needed = 0;
  call.check(cairn_world_observations(world, nullptr, 0, &needed, &call.error));
  std::vector<cairn_observation> observations(needed);
  call.check(cairn_world_observations(world, observations.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_observation, observations));
}

inline void run_world_rewind(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  call.check(cairn_world_rewind(world, &call.error));
}

inline void run_world_steps(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  size_t steps{};
  call.check(cairn_world_steps(world, &steps, &call.error));
  call.give(number(static_cast<double>(steps)));
}

inline void run_world_most_observations(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  size_t count{};
  call.check(cairn_world_most_observations(world, &count, &call.error));
  call.give(number(static_cast<double>(count)));
}

inline void run_world_head(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  cairn_stereo_head head{};
  call.check(cairn_stereo_head_init(&head, sizeof head, &call.error));
  call.check(cairn_world_head(world, &head, &call.error));
  call.give(write_object(struct_stereo_head, &head, sizeof head, 1));
}

inline void run_world_wheels(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  cairn_wheels wheels{};
  call.check(cairn_wheels_init(&wheels, sizeof wheels, &call.error));
  call.check(cairn_world_wheels(world, &wheels, &call.error));
  call.give(write_object(struct_wheels, &wheels, sizeof wheels, 1));
}

inline void run_world_pose(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  const auto time = call.scalar<double>("time");
  cairn_pose pose{};
  call.check(cairn_world_pose(world, time, &pose, &call.error));
  call.give(write_object(struct_pose, &pose, sizeof pose, 1));
}

inline void run_world_contacts(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  const auto time = call.scalar<double>("time");
  double points[12];
  call.check(cairn_world_contacts(world, time, points, &call.error));
  call.give(write_matrix(points, 12, 1));
}

inline void run_world_height(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  const auto x = call.scalar<double>("x");
  const auto y = call.scalar<double>("y");
  double height{};
  call.check(cairn_world_height(world, x, y, &height, &call.error));
  call.give(number(static_cast<double>(height)));
}

inline void run_world_extent(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  double lower[2];
  double upper[2];
  call.check(cairn_world_extent(world, lower, upper, &call.error));
  call.give(write_matrix(lower, 2, 1));
  call.give(write_matrix(upper, 2, 1));
}

inline void run_world_landmark(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  const auto id = call.scalar<uint64_t>("id");
  double position[3];
  call.check(cairn_world_landmark(world, id, position, &call.error));
  call.give(write_matrix(position, 3, 1));
}

inline void run_world_landmarks(Call &call) {
  auto *world = call.handle<cairn_world>("world", handle_world);
  size_t needed = 0;
  call.check(cairn_world_landmarks(world, nullptr, 0, &needed, &call.error));
  std::vector<double> positions(3 * needed);
  call.check(cairn_world_landmarks(world, positions.data(), needed, &needed, &call.error));
  call.give(write_columns(positions.data(), 3, needed));
}

inline void run_fleet_options_init(Call &call) {
  cairn_fleet_options options{};
  call.check(cairn_fleet_options_init(&options, sizeof options, &call.error));
  call.check(cairn_fleet_options_init(&options, sizeof options, &call.error));
  call.give(write_object(struct_fleet_options, &options, sizeof options, 1));
}

inline void run_fleet_create(Call &call) {
  cairn_fleet_options options{};
  call.check(cairn_fleet_options_init(&options, sizeof options, &call.error));
  call.object("options", struct_fleet_options, &options, true);
  cairn_fleet *fleet = nullptr;
  call.check(cairn_fleet_create(&options, &fleet, &call.error));
  call.give_owned(handle_fleet, fleet);
}

inline void run_fleet_next(Call &call) {
  auto *fleet = call.handle<cairn_fleet>("fleet", handle_fleet);
  cairn_fleet_step step{};
  step.struct_size = sizeof step;
  call.check(cairn_fleet_next(fleet, &step, &call.error));
  call.give(write_object(struct_fleet_step, &step, sizeof step, 1));
}

inline void run_fleet_vehicles(Call &call) {
  auto *fleet = call.handle<cairn_fleet>("fleet", handle_fleet);
  size_t needed = 0;
  call.check(cairn_fleet_vehicles(fleet, nullptr, 0, &needed, &call.error));
  std::vector<cairn_fleet_vehicle> vehicles(needed);
  call.check(cairn_fleet_vehicles(fleet, vehicles.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_fleet_vehicle, vehicles));
}

inline void run_fleet_seen_features(Call &call) {
  auto *fleet = call.handle<cairn_fleet>("fleet", handle_fleet);
  const auto vehicle = call.scalar<uint64_t>("vehicle");
  size_t needed = 0;
  call.check(cairn_fleet_seen_features(fleet, vehicle, nullptr, 0, &needed, &call.error));
  std::vector<cairn_fleet_sighting> features(needed);
  call.check(cairn_fleet_seen_features(fleet, vehicle, features.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_fleet_sighting, features));
}

inline void run_fleet_seen_vehicles(Call &call) {
  auto *fleet = call.handle<cairn_fleet>("fleet", handle_fleet);
  const auto vehicle = call.scalar<uint64_t>("vehicle");
  size_t needed = 0;
  call.check(cairn_fleet_seen_vehicles(fleet, vehicle, nullptr, 0, &needed, &call.error));
  std::vector<cairn_fleet_sighting> vehicles(needed);
  call.check(cairn_fleet_seen_vehicles(fleet, vehicle, vehicles.data(), needed, &needed, &call.error));
  call.give(write_objects(struct_fleet_sighting, vehicles));
}

inline void run_fleet_rewind(Call &call) {
  auto *fleet = call.handle<cairn_fleet>("fleet", handle_fleet);
  call.check(cairn_fleet_rewind(fleet, &call.error));
}

inline void run_fleet_steps(Call &call) {
  auto *fleet = call.handle<cairn_fleet>("fleet", handle_fleet);
  size_t steps{};
  call.check(cairn_fleet_steps(fleet, &steps, &call.error));
  call.give(number(static_cast<double>(steps)));
}

inline void run_fleet_features(Call &call) {
  auto *fleet = call.handle<cairn_fleet>("fleet", handle_fleet);
  size_t needed = 0;
  call.check(cairn_fleet_features(fleet, nullptr, 0, &needed, &call.error));
  std::vector<double> positions(2 * needed);
  call.check(cairn_fleet_features(fleet, positions.data(), needed, &needed, &call.error));
  call.give(write_columns(positions.data(), 2, needed));
}

inline void run_fleet_coast(Call &call) {
  auto *fleet = call.handle<cairn_fleet>("fleet", handle_fleet);
  size_t needed = 0;
  call.check(cairn_fleet_coast(fleet, nullptr, 0, &needed, &call.error));
  std::vector<double> points(2 * needed);
  call.check(cairn_fleet_coast(fleet, points.data(), needed, &needed, &call.error));
  call.give(write_columns(points.data(), 2, needed));
}

struct Function {
  const char *short_name;
  void (*run)(Call &);
  int inputs;
  int outputs;
};

inline const std::unordered_map<std::string_view, Function> functions{
  {"status_name", {"status_name", run_status_name, 1, 1}},
  {"version", {"version", run_version, 0, 1}},
  {"version_number", {"version_number", run_version_number, 0, 1}},
  {"has", {"has", run_has, 1, 1}},
  {"build", {"build", run_build, 0, 1}},
  {"pose_identity", {"pose_identity", run_pose_identity, 0, 1}},
  {"pose_compose", {"pose_compose", run_pose_compose, 2, 1}},
  {"pose_inverse", {"pose_inverse", run_pose_inverse, 1, 1}},
  {"pose_apply", {"pose_apply", run_pose_apply, 2, 1}},
  {"quaternion_from_euler", {"quaternion_from_euler", run_quaternion_from_euler, 3, 1}},
  {"quaternion_to_euler", {"quaternion_to_euler", run_quaternion_to_euler, 1, 3}},
  {"quaternion_exp", {"quaternion_exp", run_quaternion_exp, 1, 1}},
  {"quaternion_log", {"quaternion_log", run_quaternion_log, 1, 1}},
  {"pose_error", {"pose_error", run_pose_error, 2, 1}},
  {"map_size", {"count", run_map_size, 1, 1}},
  {"map_landmark", {"landmark", run_map_landmark, 2, 1}},
  {"map_landmarks", {"landmarks", run_map_landmarks, 1, 1}},
  {"map_within", {"within", run_map_within, 3, 1}},
  {"map_nearest", {"nearest", run_map_nearest, 3, 1}},
  {"map_in_box", {"in_box", run_map_in_box, 3, 1}},
  {"map_joint_covariance", {"joint_covariance", run_map_joint_covariance, 2, 1}},
  {"map_kind", {"kind", run_map_kind, 1, 1}},
  {"map_copy", {"copy", run_map_copy, 1, 1}},
  {"merge_options_init", {"merge_options", run_merge_options_init, 0, 1}},
  {"map_merge", {"merge", run_map_merge, 3, 1}},
  {"map_merged_ids", {"merged_ids", run_map_merged_ids, 1, 1}},
  {"wheels_init", {"wheels", run_wheels_init, 0, 1}},
  {"twist_noise_init", {"twist_noise", run_twist_noise_init, 0, 1}},
  {"id_none", {"id_none", run_id_none, 0, 1}},
  {"stereo_head_init", {"stereo_head", run_stereo_head_init, 0, 1}},
  {"stereo_camera_init", {"stereo_camera", run_stereo_camera_init, 0, 1}},
  {"range_bearing_init", {"range_bearing", run_range_bearing_init, 0, 1}},
  {"cartesian_init", {"cartesian", run_cartesian_init, 0, 1}},
  {"custom_init", {"custom", run_custom_init, 0, 1}},
  {"custom_check", {"custom_check", run_custom_check, 5, 1}},
  {"filter_options_init", {"filter_options", run_filter_options_init, 0, 1}},
  {"filter_required_bytes", {"filter_required_bytes", run_filter_required_bytes, 1, 1}},
  {"filter_create", {"Filter", run_filter_create, 1, 1}},
  {"filter_set_log", {"set_log", run_filter_set_log, 2, 0}},
  {"filter_add_stereo_head", {"add_stereo_head", run_filter_add_stereo_head, 2, 1}},
  {"filter_add_stereo_camera", {"add_stereo_camera", run_filter_add_stereo_camera, 2, 1}},
  {"filter_add_range_bearing", {"add_range_bearing", run_filter_add_range_bearing, 2, 1}},
  {"filter_add_cartesian", {"add_cartesian", run_filter_add_cartesian, 2, 1}},
  {"filter_add_custom", {"add_custom", run_filter_add_custom, 4, 1}},
  {"filter_point_head", {"point_head", run_filter_point_head, 4, 0}},
  {"filter_set_loss", {"set_loss", run_filter_set_loss, 4, 0}},
  {"filter_set_view", {"set_view", run_filter_set_view, 4, 0}},
  {"filter_set_wheels", {"set_wheels", run_filter_set_wheels, 2, 0}},
  {"filter_set_twist_noise", {"set_twist_noise", run_filter_set_twist_noise, 2, 0}},
  {"filter_predict_wheels", {"predict_wheels", run_filter_predict_wheels, 4, 0}},
  {"filter_predict_wheels_gyro", {"predict_wheels_gyro", run_filter_predict_wheels_gyro, 5, 0}},
  {"filter_predict_twist", {"predict_twist", run_filter_predict_twist, 4, 0}},
  {"filter_predict_increment", {"predict_increment", run_filter_predict_increment, 3, 0}},
  {"filter_update", {"update", run_filter_update, 3, 1}},
  {"filter_update_linear", {"update_linear", run_filter_update_linear, 6, 1}},
  {"filter_update_position", {"update_position", run_filter_update_position, 4, 1}},
  {"filter_update_attitude", {"update_attitude", run_filter_update_attitude, 3, 1}},
  {"filter_update_heading", {"update_heading", run_filter_update_heading, 3, 1}},
  {"filter_remove_landmark", {"remove_landmark", run_filter_remove_landmark, 2, 0}},
  {"filter_merge_landmarks", {"merge_landmarks", run_filter_merge_landmarks, 3, 1}},
  {"filter_split_landmark", {"split_landmark", run_filter_split_landmark, 4, 0}},
  {"filter_close_submap", {"close_submap", run_filter_close_submap, 1, 0}},
  {"filter_last_closing", {"last_closing", run_filter_last_closing, 1, 1}},
  {"filter_local_pose", {"local_pose", run_filter_local_pose, 1, 2}},
  {"filter_base_pose", {"base_pose", run_filter_base_pose, 1, 2}},
  {"filter_submap_count", {"submap_count", run_filter_submap_count, 1, 1}},
  {"filter_submap", {"submap", run_filter_submap, 2, 2}},
  {"filter_last_update", {"last_update", run_filter_last_update, 1, 1}},
  {"filter_pose", {"pose", run_filter_pose, 1, 2}},
  {"filter_joint_covariance", {"joint_covariance", run_filter_joint_covariance, 2, 1}},
  {"filter_local_map", {"local_map", run_filter_local_map, 1, 1}},
  {"filter_map", {"map", run_filter_map, 1, 1}},
  {"filter_pose_nees", {"pose_nees", run_filter_pose_nees, 2, 1}},
  {"filter_audit", {"audit", run_filter_audit, 1, 1}},
  {"filter_health", {"health", run_filter_health, 1, 1}},
  {"filter_sensor_health", {"sensor_health", run_filter_sensor_health, 2, 1}},
  {"verdict_text", {"verdict_text", run_verdict_text, 1, 1}},
  {"doubt_text", {"doubt_text", run_doubt_text, 1, 1}},
  {"calibration_init", {"calibration", run_calibration_init, 0, 1}},
  {"filter_calibrate_sensor", {"calibrate_sensor", run_filter_calibrate_sensor, 3, 0}},
  {"filter_systematic_errors", {"systematic_errors", run_filter_systematic_errors, 1, 2}},
  {"team_options_init", {"team_options", run_team_options_init, 0, 1}},
  {"team_create", {"Team", run_team_create, 3, 1}},
  {"team_add", {"add", run_team_add, 4, 0}},
  {"team_remove", {"remove", run_team_remove, 2, 0}},
  {"team_members", {"members", run_team_members, 1, 1}},
  {"team_predict_increment", {"predict_increment", run_team_predict_increment, 3, 0}},
  {"team_predict_twist", {"predict_twist", run_team_predict_twist, 5, 0}},
  {"team_observe", {"observe", run_team_observe, 4, 0}},
  {"team_decisions", {"decisions", run_team_decisions, 1, 1}},
  {"team_leave", {"leave", run_team_leave, 1, 0}},
  {"team_take_packet", {"take_packet", run_team_take_packet, 1, 1}},
  {"team_ask", {"ask", run_team_ask, 1, 0}},
  {"team_receive", {"receive", run_team_receive, 2, 1}},
  {"team_pose", {"pose", run_team_pose, 2, 2}},
  {"team_pose_nees", {"pose_nees", run_team_pose_nees, 2, 1}},
  {"team_map", {"map", run_team_map, 1, 1}},
  {"team_score", {"score", run_team_score, 2, 0}},
  {"team_last_report", {"last_report", run_team_last_report, 1, 1}},
  {"filter_keep_pose", {"keep_pose", run_filter_keep_pose, 1, 1}},
  {"filter_trajectory_range", {"trajectory_range", run_filter_trajectory_range, 1, 2}},
  {"filter_trajectory", {"trajectory", run_filter_trajectory, 2, 1}},
  {"world_options_init", {"world_options", run_world_options_init, 0, 1}},
  {"world_options_preset", {"world_options_preset", run_world_options_preset, 2, 2}},
  {"world_create", {"World", run_world_create, 1, 1}},
  {"world_next", {"next", run_world_next, 1, 1}},
  {"world_motions", {"motions", run_world_motions, 1, 1}},
  {"world_observations", {"observations", run_world_observations, 1, 1}},
  {"world_rewind", {"rewind", run_world_rewind, 1, 0}},
  {"world_steps", {"steps", run_world_steps, 1, 1}},
  {"world_most_observations", {"most_observations", run_world_most_observations, 1, 1}},
  {"world_head", {"head", run_world_head, 1, 1}},
  {"world_wheels", {"wheels", run_world_wheels, 1, 1}},
  {"world_pose", {"pose", run_world_pose, 2, 1}},
  {"world_contacts", {"contacts", run_world_contacts, 2, 1}},
  {"world_height", {"height", run_world_height, 3, 1}},
  {"world_extent", {"extent", run_world_extent, 1, 2}},
  {"world_landmark", {"landmark", run_world_landmark, 2, 1}},
  {"world_landmarks", {"landmarks", run_world_landmarks, 1, 1}},
  {"fleet_options_init", {"fleet_options", run_fleet_options_init, 0, 1}},
  {"fleet_create", {"Fleet", run_fleet_create, 1, 1}},
  {"fleet_next", {"next", run_fleet_next, 1, 1}},
  {"fleet_vehicles", {"vehicles", run_fleet_vehicles, 1, 1}},
  {"fleet_seen_features", {"seen_features", run_fleet_seen_features, 2, 1}},
  {"fleet_seen_vehicles", {"seen_vehicles", run_fleet_seen_vehicles, 2, 1}},
  {"fleet_rewind", {"rewind", run_fleet_rewind, 1, 0}},
  {"fleet_steps", {"steps", run_fleet_steps, 1, 1}},
  {"fleet_features", {"features", run_fleet_features, 1, 1}},
  {"fleet_coast", {"coast", run_fleet_coast, 1, 1}},
};

}  // namespace cairn_octave
// clang-format on
