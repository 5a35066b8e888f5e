# SPDX-License-Identifier: BSD-3-Clause
"""Calls of a filter that are wrong on purpose. Each leaves the filter as it was: its pose is asked before and after."""

from .scenario import Scenario, diagonal, pose, seen

ONES = diagonal(1, 1, 1)


def options():
    s = Scenario("filter_wrong_options", "Options that are out of range or contradict each other.")
    for wrong in (
            {"max_landmarks": 0}, {"max_landmarks": 30001, "join": "CAIRN_JOIN_DENSE"}, {"max_observations": 0},
            {"max_observations": 4097}, {"max_sensors": 257}, {"iterations": 51}, {"iteration_tolerance": 0.0},
            {"gate_probability": 0.0}, {"gate_probability": 1.1}, {"batch_gate_probability": "nan"},
            {"error_persistence": 0.5}, {"association_nodes": 0}, {"deferred_sightings": 0}, {"deferred_frames": 0},
            {"new_probability": 1.0}, {"submap_landmarks": 5000}, {"join_loss_width": 0.0},
            {"submap_distance": -1.0, "submap_landmarks": 10}, {"submap_extent": "inf", "submap_landmarks": 10},
            {"submap_sigma": -0.1, "submap_landmarks": 10}, {"trajectory_poses": 10000001},
            {"velocity_bias_sigma": [0.1, -0.1, 0.0]}, {"max_sensor_errors": 65},
            {"initial_pose": pose(quaternion=(0.0, 0.0, 0.0, 0.0))}, {"initial_pose": pose("nan")},
            {"initial_covariance": diagonal(-1, 1, 1, 1, 1, 1)},
            {"initial_covariance": diagonal(1, 1, 1, "nan", 1, 1)},
            {"initial_covariance": [1.0, 2.0] + diagonal(1, 1, 1, 1, 1, 1)[2:]},
            {"vehicle": "CAIRN_VEHICLE_PLANAR", "initial_pose": pose(0.0, 0.0, 1.0)},
            {"vehicle": "CAIRN_VEHICLE_PLANAR", "rate_bias_sigma": [0.1, 0.0, 0.0]}):
        s.wrong("ARGUMENT", "cairn_filter_create", options=wrong)
    s.wrong("ARGUMENT", "cairn_filter_required_bytes", options={"gate_probability": 0.0})
    return s


def sensors():
    s = Scenario("filter_wrong_sensors",
                 "Sensors with wrong descriptions, calls with a wrong sensor, too many sensors.")
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"}, options={"max_sensors": 2})
    for name, parameter, options in (
            ("stereo_head", "head", {"range_sigma": 0.0}), ("stereo_head", "head", {"azimuth_sigma": "nan"}),
            ("stereo_head", "head", {"pan_sigma": -0.1}), ("stereo_head", "head", {"max_elevation": 2.0}),
            ("stereo_head", "head", {"camera_quaternion": [0.0, 0.0, 0.0, 0.0]}),
            ("stereo_camera", "camera", {"baseline": 0.0}), ("stereo_camera", "camera", {"sigma": [1.0, -1.0, 1.0]}),
            ("stereo_camera", "camera", {"T_body_camera": pose("inf")}), ("stereo_camera", "camera", {"cu": "nan"}),
            ("stereo_camera", "camera", {"min_disparity": 0.0}),
            ("stereo_camera", "camera", {"min_disparity_sigmas": -1.0}),
            ("range_bearing", "radar", {}), ("cartesian", "cartesian", {"sigma": [0.1, 0.0, 0.1]}),
            ("cartesian", "cartesian", {"T_body_sensor": pose(quaternion=(0.0, 0.0, 0.0, 0.0))})):
        s.wrong("ARGUMENT", f"cairn_filter_add_{name}", filter=rover, **{parameter: options})
    for options in {"rows": 4}, {"rows": 0}, {"sigma": [0.0, 1.0, 1.0]}, {"angle_mask": 8}:
        s.wrong("ARGUMENT", "cairn_filter_add_custom", filter=rover, custom=options, predict="body_point")
    s.wrong("ARGUMENT", "cairn_filter_add_custom", filter=rover, custom={"rows": 2}, predict="body_point",
            place="body_point")
    s.call("cairn_filter_add_stereo_head", filter=rover, head={})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={})
    s.wrong("CAPACITY", "cairn_filter_add_cartesian", filter=rover, cartesian={})
    s.wrong("CAPACITY", "cairn_filter_add_custom", filter=rover, custom={}, predict="body_point", place="body_point")
    s.wrong("NOT_FOUND", "cairn_filter_point_head", filter=rover, sensor=2, pan=0.0, stick=0.0)
    s.wrong("ARGUMENT", "cairn_filter_point_head", filter=rover, sensor=1, pan=0.0, stick=0.0)
    s.wrong("ARGUMENT", "cairn_filter_point_head", filter=rover, sensor=0, pan="nan", stick=0.0)
    s.wrong("NOT_FOUND", "cairn_filter_set_loss", filter=rover, sensor=-1, loss="CAIRN_LOSS_HUBER", width=1.0)
    s.wrong("ARGUMENT", "cairn_filter_set_loss", filter=rover, sensor=0, loss="CAIRN_LOSS_CAUCHY", width=0.0)
    s.wrong("NOT_FOUND", "cairn_filter_set_view", filter=rover, sensor=7, lower=[0.0, 0.0, 0.0],
            upper=[1.0, 1.0, 1.0])
    s.wrong("ARGUMENT", "cairn_filter_set_view", filter=rover, sensor=0, lower=[0.0, 2.0, 0.0], upper=[1.0, 1.0, 1.0])
    s.wrong("ARGUMENT", "cairn_filter_set_view", filter=rover, sensor=0, lower=["nan", 0.0, 0.0],
            upper=[1.0, 1.0, 1.0])
    boat = s.call("cairn_filter_create", gives={"filter": "$boat"}, options={"vehicle": "CAIRN_VEHICLE_PLANAR"})
    s.wrong("ARGUMENT", "cairn_filter_add_stereo_head", filter=boat, head={})
    s.wrong("ARGUMENT", "cairn_filter_add_stereo_camera", filter=boat, camera={})
    s.wrong("ARGUMENT", "cairn_filter_add_range_bearing", filter=boat, radar={"bearing_sigma": -1.0})
    s.wrong("ARGUMENT", "cairn_filter_add_range_bearing", filter=boat, radar={"near_range": 0.0})
    s.wrong("ARGUMENT", "cairn_filter_add_range_bearing", filter=boat, radar={"T_body_sensor": pose(0.0, 0.0, 1.0)})
    return s


def motions():
    s = Scenario("filter_wrong_motions", "Motions that are refused, and the pose before and after.")
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"initial_covariance": diagonal(1, 1, 1, 0, 0, 0)})
    s.call("cairn_filter_pose", filter=rover)
    still = [0.0, 0.0, 0.0]
    for dt in 0.0, -1.0, "nan", "inf":
        s.wrong("ARGUMENT", "cairn_filter_predict_wheels", filter=rover, dt=dt, left_rad_per_s=1.0,
                right_rad_per_s=1.0)
        s.wrong("ARGUMENT", "cairn_filter_predict_twist", filter=rover, dt=dt, velocity=still, rate=still)
    s.wrong("ARGUMENT", "cairn_filter_predict_wheels", filter=rover, dt=1.0, left_rad_per_s="nan",
            right_rad_per_s=1.0)
    s.wrong("ARGUMENT", "cairn_filter_predict_wheels_gyro", filter=rover, dt=1.0, left_rad_per_s=1.0,
            right_rad_per_s="inf", rate=still)
    s.wrong("ARGUMENT", "cairn_filter_predict_wheels_gyro", filter=rover, dt=1.0, left_rad_per_s=1.0,
            right_rad_per_s=1.0,
            rate=[0.0, 0.0, "nan"])
    s.wrong("ARGUMENT", "cairn_filter_predict_twist", filter=rover, dt=1.0, velocity=[1.0, "-inf", 0.0], rate=still)
    s.wrong("ARGUMENT", "cairn_filter_predict_increment", filter=rover,
            T_before_after=pose(quaternion=(0.0, 0.0, 0.0, 0.0)),
            covariance=[0.0] * 36)
    s.wrong("ARGUMENT", "cairn_filter_predict_increment", filter=rover, T_before_after=pose(),
            covariance=diagonal(-1, 1, 1, 1, 1, 1))
    s.wrong("NUMERICAL", "cairn_filter_predict_increment", filter=rover, T_before_after=pose(2e9),
            covariance=[0.0] * 36)
    s.wrong("ARGUMENT", "cairn_filter_set_wheels", filter=rover, wheels={"radius": 0.0})
    s.wrong("ARGUMENT", "cairn_filter_set_wheels", filter=rover, wheels={"slip_sigma": -0.1})
    s.wrong("ARGUMENT", "cairn_filter_set_twist_noise", filter=rover, noise={"velocity_sigma": [0.1, -0.1, 0.1]})
    s.call("cairn_filter_pose", filter=rover)
    s.wrong("NUMERICAL", "cairn_filter_pose_nees", filter=rover, truth=pose())
    s.wrong("ARGUMENT", "cairn_filter_pose_nees", filter=rover, truth=pose(quaternion=(0.0, 0.0, 0.0, 0.0)))
    return s


def updates():
    s = Scenario("filter_wrong_updates", "Observations that are refused as a call, and landmarks that do not exist.")
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"max_observations": 3, "initial_covariance": diagonal(1, 1, 1, 0.01, 0.01, 0.01)})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={})
    s.call("cairn_filter_update", filter=rover, sensor=0,
           observations=[seen(1, 4.0, 1.0, 0.2), seen(2, 3.0, -2.0, 0.4)])
    s.call("cairn_filter_pose", filter=rover)
    update = {"function": "cairn_filter_update", "filter": rover}
    s.wrong("NOT_FOUND", **update, sensor=1, observations=[seen(1, 4.0, 1.0, 0.2)])
    s.wrong("ARGUMENT", **update, sensor=0, observations=[seen(1, 4.0, 1.0, 0.2), seen(1, 4.0, 1.0, 0.2)])
    s.wrong("ARGUMENT", **update, sensor=0, observations=[seen("18446744073709551615", 4.0, 1.0, 0.2)])
    s.wrong("ARGUMENT", **update, sensor=0, observations=[seen(1, 4.0, "nan", 0.2)])
    s.wrong("ARGUMENT", **update, sensor=0, observations=[{**seen(1, 4.0, 1.0, 0.2),
                                                           "covariance": diagonal(1, 1, -1)}])
    s.wrong("ARGUMENT", **update, sensor=0,
            observations=[{**seen(1, 4.0, 1.0, 0.2), "covariance": [1.0, 0.5] + ONES[2:]}])
    s.wrong("CAPACITY", **update, sensor=0, observations=[seen(n, 4.0, 1.0, 0.2) for n in range(4)])
    linear = {"function": "cairn_filter_update_linear", "filter": rover}
    s.wrong("NOT_FOUND", **linear, residual=[0.0], covariance=[1.0], landmarks=["3"],
            jacobian_landmarks=[1.0, 0.0, 0.0])
    s.wrong("ARGUMENT", **linear, residual=[0.0], covariance=[0.0], landmarks=["1"],
            jacobian_landmarks=[1.0, 0.0, 0.0])
    s.wrong("ARGUMENT", **linear, residual=["nan"], covariance=[1.0], landmarks=["1"],
            jacobian_landmarks=[1.0, 0.0, 0.0])
    s.wrong("ARGUMENT", **linear, residual=[0.0], covariance=[1.0], landmarks=["1", "1"],
            jacobian_landmarks=[1.0, 0.0, 0.0, 1.0, 0.0, 0.0])
    s.wrong("ARGUMENT", **linear, residual=[0.0], covariance=[1.0], landmarks=[], jacobian_landmarks=[])
    s.wrong("CAPACITY", **linear, residual=[0.0] * 10, covariance=[0.0] * 100, landmarks=["1"],
            jacobian_landmarks=[0.0] * 30)
    position = {"function": "cairn_filter_update_position", "filter": rover}
    s.wrong("ARGUMENT", **position, position=[0.0, "nan", 0.0], covariance=ONES)
    s.wrong("ARGUMENT", **position, position=[0.0, 0.0, 0.0], covariance=[0.0] * 9)
    s.wrong("ARGUMENT", **position, position=[0.0, 0.0, 0.0], covariance=ONES, lever_arm=["inf", 0.0, 0.0])
    s.wrong("ARGUMENT", "cairn_filter_update_attitude", filter=rover, quaternion=[0.0, 0.0, 0.0, 0.0],
            covariance=ONES)
    s.wrong("ARGUMENT", "cairn_filter_update_attitude", filter=rover, quaternion=[1.0, 0.0, 0.0, 0.0],
            covariance=diagonal(1, 0, 1))
    s.wrong("ARGUMENT", "cairn_filter_update_heading", filter=rover, heading=0.1, sigma=0.0)
    s.wrong("ARGUMENT", "cairn_filter_update_heading", filter=rover, heading="nan", sigma=0.1)
    s.wrong("NOT_FOUND", "cairn_filter_remove_landmark", filter=rover, id="3")
    s.wrong("NOT_FOUND", "cairn_filter_merge_landmarks", filter=rover, id="1", other="3")
    s.wrong("ARGUMENT", "cairn_filter_merge_landmarks", filter=rover, id="1", other="1")
    s.wrong("NOT_FOUND", "cairn_filter_split_landmark", filter=rover, id="3", fresh="4", covariance=ONES)
    s.wrong("ARGUMENT", "cairn_filter_split_landmark", filter=rover, id="1", fresh="2", covariance=ONES)
    s.wrong("ARGUMENT", "cairn_filter_split_landmark", filter=rover, id="1", fresh="4", covariance=diagonal(1, 1, 0))
    s.wrong("NOT_FOUND", "cairn_filter_joint_covariance", filter=rover, ids=["1", "3"])
    s.wrong("ARGUMENT", "cairn_filter_joint_covariance", filter=rover, ids=["1", "1"])
    s.call("cairn_filter_pose", filter=rover)
    s.call("cairn_filter_last_update", filter=rover)
    return s


SCENARIOS = [options, sensors, motions, updates]
