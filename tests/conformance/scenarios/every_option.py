# SPDX-License-Identifier: BSD-3-Clause
"""Every field of every struct of options has a value of its own, so that a binding that mixes up two fields is found.

The results depend on most of these values. Limits that are not reached change no result; other scenarios set them to
values that are refused, with a message that names the field."""

from .drive import Drive
from .scenario import Scenario, diagonal, pose
from .sensors import ask
from .worlds import steps

TILT = (0.98, 0.1, 0.1, 0.1)

FILTER = {
    "vehicle": "CAIRN_VEHICLE_SPATIAL", "state_error": "CAIRN_STATE_ERROR_STANDARD", "max_landmarks": 90,
    "max_observations": 31, "max_sensors": 5, "initial_pose": pose(1.0, 2.0, 3.0, TILT),
    "initial_covariance": diagonal(1e-3, 2e-3, 3e-3, 1e-5, 2e-5, 3e-5), "iterations": 4,
    "noise_learning": "CAIRN_NOISE_APPLIED", "iteration_tolerance": 0.01, "gate_probability": 0.9995,
    "batch_gate_probability": 0.99995, "error_persistence": 1.5, "association": "CAIRN_ASSOCIATION_JOINT",
    "association_distance": "CAIRN_DISTANCE_LIKELIHOOD", "association_nodes": 300, "deferred_sightings": 2,
    "deferred_frames": 7, "missed_frames": 5, "new_probability": 0.9995, "submap_landmarks": 14,
    "join": "CAIRN_JOIN_SPARSE", "join_loss": "CAIRN_LOSS_CAUCHY", "join_loss_width": 1.7, "trajectory_poses": 30,
    "submap_distance": 9.0, "submap_extent": 25.0, "submap_sigma": 2.0, "velocity_bias_sigma": [0.05, 0.06, 0.07],
    "velocity_bias_walk": [0.001, 0.002, 0.003], "rate_bias_sigma": [0.004, 0.005, 0.006],
    "rate_bias_walk": [0.0001, 0.0002, 0.0003], "wheel_scale_sigma": [0.02, 0.03],
    "wheel_scale_walk": [0.0002, 0.0003],
    "max_sensor_errors": 9,
}
HEAD = {"encoder_mode": "CAIRN_ENCODER_PER_FRAME", "platform": [0.1, 0.2, 0.3], "stick": [0.01, 0.02, 0.03],
        "camera_quaternion": list(TILT), "range_sigma": 0.2, "azimuth_sigma": 0.02, "elevation_sigma": 0.03,
        "pan_sigma": 0.004, "stick_sigma": 0.005, "near_range": 1.5, "max_elevation": 1.25}
CAMERA = {"fu": 510.0, "fv": 520.0, "cu": 330.0, "cv": 250.0, "baseline": 0.25,
          "T_body_camera": pose(0.1, 0.2, 0.3, (0.5, -0.5, 0.5, -0.5)), "sigma": [0.5, 0.6, 0.7], "near_depth": 1.5,
          "min_disparity": 4.0, "min_disparity_sigmas": 3.0}
CARTESIAN = {"T_body_sensor": pose(0.1, 0.2, 0.3, TILT), "sigma": [0.05, 0.06, 0.07]}
CALIBRATION = {"mount_shift_sigma": [0.1, 0.2, 0.3], "mount_shift_walk": [0.001, 0.002, 0.003],
               "mount_turn_sigma": [0.01, 0.02, 0.03], "mount_turn_walk": [0.0001, 0.0002, 0.0003],
               "offset_sigma": [0.04, 0.05, 0.06], "offset_walk": [0.0004, 0.0005, 0.0006]}
WHEELS = {"yaw_sign": "CAIRN_YAW_LEFT_MINUS_RIGHT", "radius": 0.25, "track": 0.9, "rate_sigma": 0.02,
          "slip_sigma": 0.03,
          "lateral_sigma": 0.04, "vertical_sigma": 0.05, "roll_rate_sigma": 0.06, "pitch_rate_sigma": 0.07}
TWIST = {"velocity_sigma": [0.03, 0.04, 0.05], "rate_sigma": [0.003, 0.004, 0.005]}
RADAR = {"T_body_sensor": pose(0.3, 0.1, 0.0, (0.8, 0.0, 0.0, 0.6)), "range_sigma": 0.2, "bearing_sigma": 0.03,
         "near_range": 2.0}
CUSTOM = {"rows": 2, "angle_mask": 2, "relative": True, "sigma": [0.2, 0.3, 0.4]}
TEAM = {"mode": "CAIRN_TEAM_JOINT", "vehicle": "5", "max_vehicles": 3, "baseline": True, "max_lag": 2.5,
        "time_tolerance": 0.05, "max_jump": 7.0, "max_waiting": 11, "history": 13}
MERGE = {"association": "CAIRN_MERGE_BY_GEOMETRY", "gate_probability": 0.9995, "joint_gate_probability": 0.9996,
         "max_landmarks": "60", "max_tilt": 0.5, "has_transform": True, "T_map_other": pose(0.02, -0.01, 0.0),
         "covariance": diagonal(1e-3, 2e-3, 3e-3, 1e-5, 2e-5, 3e-5)}
WORLD = {
    "course": "CAIRN_COURSE_CIRCLE", "seed": "11", "landmarks": 30, "terrain": "CAIRN_TERRAIN_ROLLING",
    "contact": "CAIRN_CONTACT_WHEELS", "drive": "CAIRN_DRIVE_WHEELS_GYRO",
    "accelerometer": "CAIRN_ACCELEROMETER_ACCELERATION", "stick_noise": "CAIRN_STICK_PER_FRAME",
    "observe_at_start": True,
    "traverse_closed": False, "speed": 1.3, "laps": 0.5, "centre": [3.0, -4.0], "radius": 20.0, "start_azimuth": 0.4,
    "round_length": 900.0, "round_variation": 0.2, "strip": 15.0, "landmark_area": 120.0, "landmark_height": 2.5,
    "max_slope": 0.2, "wavelength": [20.0, 120.0], "start_height": 0.5, "wheel_radius": 0.25, "track": 0.9,
    "wheelbase": 1.1, "velocity_sigma": 0.003, "rate_sigma": 0.0004, "gravity": 9.81, "wheel_rate_sigma": 0.02,
    "wheel_slip_sigma": 0.03, "lateral_sigma": 0.04, "vertical_sigma": 0.05, "imu_period": 0.1, "motion_period": 0.5,
    "frame_period": 1.0, "range_sigma": 0.8, "azimuth_sigma": 0.04, "stick_sigma": 0.03, "image_sigma": 0.01,
    "near_range": 3.0, "far_range": 35.0, "half_azimuth": 1.5, "pan_amplitude": 0.3, "pan_period": 15.0,
    "stick_amplitude": 0.1, "stick_period": 17.0, "platform": [0.1, 0.2, 1.0], "stick": [0.05, 0.06, 0.07],
    "velocity_bias": [0.01, 0.02, 0.03], "rate_bias": [0.001, 0.002, 0.003], "wheel_scale": [0.01, -0.02],
    "mount_turn": [0.01, 0.02, 0.03], "mount_shift": [0.1, 0.2, 0.3], "value_offset": [0.1, 0.02, 0.03],
}
FLEET = {"layout": "CAIRN_FLEET_COAST", "seed": "12", "vehicles": 3, "features": 9, "area": 9000.0,
         "separation": 1400.0,
         "course_length": 1600.0, "duration": 1400.0, "period": 4.0, "radar_range": 3000.0, "range_sigma": 20.0,
         "bearing_sigma": 0.006, "speed_sigma": 0.3, "rate_sigma": 0.002, "coast_distance": 0.3, "coast_relief": 0.06,
         "coast_strip": 0.04}


def every_option():
    s = Scenario("every_option", "A filter in space whose every option has a value of its own, with every sensor.")
    drive = Drive(51, landmarks=30, size=15.0)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"}, options=FILTER)
    s.call("cairn_filter_required_bytes", gives={"bytes": "$bytes"}, options=FILTER)
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian=CARTESIAN)
    s.call("cairn_filter_add_stereo_head", filter=rover, head=HEAD)
    s.call("cairn_filter_add_stereo_camera", filter=rover, camera=CAMERA)
    s.call("cairn_filter_add_custom", filter=rover, custom=CUSTOM, predict="body_point")
    s.call("cairn_filter_calibrate_sensor", filter=rover, sensor=0, calibration=CALIBRATION)
    s.call("cairn_filter_set_wheels", filter=rover, wheels=WHEELS)
    s.call("cairn_filter_set_twist_noise", filter=rover, noise=TWIST)
    s.call("cairn_filter_set_view", filter=rover, sensor=0, lower=[-6.0, -5.0, -4.0], upper=[5.0, 6.0, 7.0])
    s.call("cairn_filter_set_loss", filter=rover, sensor=0, loss="CAIRN_LOSS_HUBER", width=2.5)
    for step in range(20):
        if step % 3:
            drive.twist(s, rover, 1.0, 0.1)
        else:
            drive.wheels(s, rover, 1.0, -0.1, radius=0.25, track=-0.9)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.cartesian())
        s.call("cairn_filter_update", filter=rover, sensor=1, observations=drive.head(most=4))
        s.call("cairn_filter_update", filter=rover, sensor=2, observations=drive.camera(most=4))
        s.call("cairn_filter_update", filter=rover, sensor=3, observations=drive.cartesian(rows=2, most=2))
    ask(s, rover)
    s.call("cairn_filter_systematic_errors", filter=rover)
    s.call("cairn_filter_last_closing", filter=rover)
    s.call("cairn_filter_trajectory_range", filter=rover)
    themap = s.call("cairn_filter_map", gives={"return": "$map"}, filter=rover)
    s.call("cairn_map_landmarks", map=themap)
    return s


def every_option_of_others():
    s = Scenario("every_option_of_others", "Every option of a team, a radar, a merge, a world and a fleet.")
    drive = Drive(52, heights=False)
    team = s.call("cairn_team_create", gives={"team": "$team"}, options=TEAM,
                  filter={"vehicle": "CAIRN_VEHICLE_PLANAR"},
                  radar=RADAR)
    for time in range(3):
        s.call("cairn_team_observe", team=team, time=float(time), landmarks=drive.radar(), vehicles=[])
        drive.twist(s, team, 1.0, 0.1, function="cairn_team_predict_twist")
    s.call("cairn_team_pose", team=team, vehicle="5")
    s.call("cairn_team_last_report", team=team)
    drive = Drive(53, landmarks=20, size=9.0)
    for name in "$one", "$other":
        rover = s.call("cairn_filter_create", gives={"filter": name}, options={})
        s.call("cairn_filter_add_cartesian", filter=rover, cartesian=CARTESIAN)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.cartesian(reach=12.0, most=12))
        s.call("cairn_filter_map", gives={"return": name + "_map"}, filter=rover)
    s.call("cairn_map_copy", gives={"copy": "$merged"}, map="$one_map")
    s.call("cairn_map_merge", map="$merged", other="$other_map", options=MERGE)
    world = s.call("cairn_world_create", gives={"world": "$world"}, options=WORLD)
    steps(s, world, 4)
    s.call("cairn_world_head", world=world)
    s.call("cairn_world_wheels", world=world)
    s.call("cairn_world_pose", world=world, time=5.0)
    closed = s.call("cairn_world_create", gives={"world": "$closed"}, options={
        "course": "CAIRN_COURSE_TRAVERSE", "landmarks": 2400, "traverse_closed": True, "round_length": 1200.0,
        "round_variation": 0.2, "landmark_area": 150.0})
    s.call("cairn_world_extent", world=closed)
    s.call("cairn_world_pose", world=closed, time=1000.0)
    fleet = s.call("cairn_fleet_create", gives={"fleet": "$fleet"}, options=FLEET)
    for _ in range(3):
        s.call("cairn_fleet_next", fleet=fleet)
        s.call("cairn_fleet_vehicles", fleet=fleet)
        s.call("cairn_fleet_seen_features", fleet=fleet, vehicle="2")
        s.call("cairn_fleet_seen_vehicles", fleet=fleet, vehicle="2")
    s.call("cairn_fleet_steps", fleet=fleet)
    return s


SCENARIOS = [every_option, every_option_of_others]
