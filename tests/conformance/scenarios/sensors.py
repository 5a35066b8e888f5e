# SPDX-License-Identifier: BSD-3-Clause
"""Sensors that the library models, and motions: one filter for each."""

from .drive import Drive
from .scenario import Scenario, diagonal, pose, seen

START = diagonal(1e-4, 1e-4, 1e-4, 1e-5, 1e-5, 1e-5)


def ask(s, rover):
    """What a filter knows, and how it got there."""
    s.call("cairn_filter_pose", filter=rover)
    s.call("cairn_filter_last_update", filter=rover)
    s.call("cairn_filter_health", filter=rover)


def stereo_head():
    s = Scenario("stereo_head", "A stereo head that pans, on a rover with wheels and a gyro; a view, a loss, a log.")
    drive = Drive(1)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"max_landmarks": 60, "missed_frames": 3, "initial_covariance": START})
    s.call("cairn_filter_set_log", filter=rover, log="collect")
    s.call("cairn_filter_add_stereo_head", filter=rover,
           head={"range_sigma": 0.1, "azimuth_sigma": 0.01, "elevation_sigma": 0.01, "pan_sigma": 0.001,
                 "encoder_mode": "CAIRN_ENCODER_PER_FRAME"})
    s.call("cairn_filter_add_stereo_head", filter=rover, head={"platform": [0.5, 0.0, 1.0],
           "camera_quaternion": [0.9238795325112867, 0.0, 0.3826834323650898, 0.0], "max_elevation": 1.2,
           "encoder_mode": "CAIRN_ENCODER_PER_OBSERVATION"})
    s.call("cairn_filter_set_view", filter=rover, sensor=0, lower=[1.0, -1.0, "-inf"], upper=[9.0, 1.0, "inf"])
    s.call("cairn_filter_set_wheels", filter=rover, wheels={"rate_sigma": 0.02,
                                                            "yaw_sign": "CAIRN_YAW_RIGHT_MINUS_LEFT"})
    s.call("cairn_filter_set_twist_noise", filter=rover, noise={"rate_sigma": [0.002, 0.002, 0.004]})
    for step in range(6):
        drive.wheels(s, rover, 1.0, 0.08)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.head())
    s.call("cairn_filter_set_loss", filter=rover, sensor=0, loss="CAIRN_LOSS_HUBER", width=1.5)
    for step in range(3):
        speed, rate = drive.move(1.0, 0.08, 1.0)
        s.call("cairn_filter_predict_wheels_gyro", filter=rover, dt=1.0, left_rad_per_s=round(speed / 0.3, 4),
               right_rad_per_s=round(speed / 0.3, 4), rate=[0.0, 0.0, rate])
        pan = 0.1 * (step + 1)
        s.call("cairn_filter_point_head", filter=rover, sensor=0, pan=pan, stick=0.0)
        frame = drive.head()
        for observation in frame:
            observation["z"][1] = round(observation["z"][1] - pan, 4)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=frame)
    s.call("cairn_filter_set_loss", filter=rover, sensor=0, loss="CAIRN_LOSS_NONE", width=0.0)
    # Behind the lens, too near, and far off: refused one by one. A frame that sees nothing removes nothing at once.
    s.call("cairn_filter_point_head", filter=rover, sensor=0, pan=0.0, stick=0.0)
    s.call("cairn_filter_update", filter=rover, sensor=0,
           observations=[seen(90, 0.05, 0.0, 0.0), seen(91, 5.0, 0.0, 1.52)])
    frame = drive.head()
    frame[0]["z"][0] += 8.0
    s.call("cairn_filter_update", filter=rover, sensor=0, observations=frame)
    s.call("cairn_filter_update", filter=rover, sensor=0, observations=[])
    ask(s, rover)
    s.call("cairn_filter_sensor_health", filter=rover, sensor=0)
    s.call("cairn_filter_audit", filter=rover)
    s.call("cairn_filter_pose_nees", filter=rover, truth=drive.pose())
    s.call("cairn_filter_set_log", filter=rover)
    s.call("cairn_filter_required_bytes", gives={"bytes": "$bytes"}, options={"max_landmarks": 60})
    return s


def stereo_camera():
    s = Scenario("stereo_camera", "A stereo camera with a Cauchy loss, on a vehicle with the standard error.")
    drive = Drive(2)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"state_error": "CAIRN_STATE_ERROR_STANDARD", "iterations": 1, "max_observations": 16,
                            "error_persistence": 2.0, "initial_covariance": START})
    s.call("cairn_filter_add_stereo_camera", filter=rover, camera={"sigma": [0.5, 0.5, 0.5], "min_disparity": 2.0})
    s.call("cairn_filter_set_loss", filter=rover, sensor=0, loss="CAIRN_LOSS_CAUCHY", width=2.0)
    for _ in range(8):
        drive.twist(s, rover, 0.8, -0.05)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.camera())
    # No disparity, so no place.
    s.call("cairn_filter_update", filter=rover, sensor=0, observations=[seen(90, 320.0, 319.5, 240.0)])
    ask(s, rover)
    return s


def cartesian():
    s = Scenario("cartesian",
                 "A sensor of points: noise of an observation, landmarks removed, merged and split; marginals.")
    drive = Drive(3)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"state_error": "CAIRN_STATE_ERROR_INVARIANT", "vehicle": "CAIRN_VEHICLE_SPATIAL",
                            "initial_pose": pose(1.0, 2.0, 0.5, (0.8, 0.0, 0.0, 0.6)), "max_landmarks": 12,
                            "initial_covariance": START})
    s.call("cairn_filter_add_cartesian", filter=rover,
           cartesian={"sigma": [0.05, 0.05, 0.05], "T_body_sensor": pose(0.0, 0.0, 0.0)})
    for _ in range(4):
        drive.twist(s, rover, 1.0, 0.1)
        frame = drive.cartesian(most=5)
        frame[0]["covariance"] = diagonal(0.01, 0.02, 0.04)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=frame)
    themap = s.call("cairn_filter_map", gives={"return": "$map"}, filter=rover)
    first, second = (int(o["id"]) for o in frame[:2])
    s.call("cairn_filter_split_landmark", filter=rover, id=str(first), fresh="100",
           covariance=diagonal(0.04, 0.04, 0.04))
    s.call("cairn_map_joint_covariance", map=themap, ids=[str(first), "100"])
    s.call("cairn_filter_merge_landmarks", filter=rover, id=str(first), other="100")
    s.call("cairn_filter_remove_landmark", filter=rover, id=str(second))
    s.call("cairn_filter_joint_covariance", filter=rover, ids=[str(first)])
    s.call("cairn_filter_joint_covariance", filter=rover, ids=[])
    s.call("cairn_map_landmark", map=themap, id=str(first))
    s.call("cairn_map_size", map=themap)
    # More landmarks than there is room for.
    drive.twist(s, rover, 1.0, 0.1)
    s.call("cairn_filter_update", filter=rover, sensor=0,
           observations=[seen(200 + i, 3.0 + i, 1.0 - i, 0.5) for i in range(14)])
    ask(s, rover)
    return s


def absolute():
    s = Scenario("absolute",
                 "Absolute positions, attitudes and headings, increments, and observations that the caller linearised.")
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"initial_covariance": diagonal(4.0, 4.0, 4.0, 0.01, 0.01, 0.09)})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={})
    s.call("cairn_filter_update_position", filter=rover, position=[0.5, -0.3, 0.1],
           covariance=diagonal(0.04, 0.04, 0.09))
    s.call("cairn_filter_update_position", filter=rover, position=[0.6, -0.2, 1.1],
           covariance=diagonal(0.04, 0.04, 0.09),
           lever_arm=[0.0, 0.0, 1.0])
    s.call("cairn_filter_update_attitude", filter=rover, quaternion=[0.999, 0.01, -0.02, 0.03],
           covariance=diagonal(1e-4, 1e-4, 1e-3))
    s.call("cairn_filter_update_heading", filter=rover, heading=0.08, sigma=0.02)
    s.call("cairn_filter_predict_increment", filter=rover, T_before_after=pose(1.0, 0.1, 0.0, (0.99, 0.0, 0.0, 0.1)),
           covariance=diagonal(1e-2, 1e-3, 1e-3, 1e-5, 1e-5, 1e-4))
    s.call("cairn_filter_update", filter=rover, sensor=0,
           observations=[seen(1, 4.0, 1.0, 0.2), seen(2, 3.0, -2.0, 0.4)])
    s.call("cairn_filter_update_linear", filter=rover, residual=[0.02], covariance=[0.01],
           jacobian_pose=[0.0, 0.0, 0.0, 0.0, 0.0, 0.0], landmarks=["1"], jacobian_landmarks=[1.0, 0.0, 0.0])
    s.call("cairn_filter_update_linear", filter=rover, residual=[0.02, -0.01], covariance=[0.01, 0.002, 0.002, 0.01],
           landmarks=["1", "2"], jacobian_landmarks=[1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0])
    s.call("cairn_filter_update_linear", filter=rover, residual=[0.1], covariance=[0.01],
           jacobian_pose=[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], landmarks=[], jacobian_landmarks=[])
    # Refused by the gate, which is no error.
    s.call("cairn_filter_update_position", filter=rover, position=[50.0, 0.0, 0.0],
           covariance=diagonal(0.04, 0.04, 0.09))
    ask(s, rover)
    return s


def planar():
    s = Scenario("planar", "A planar vehicle with a radar: the wheels' yaw rate has the other sign.")
    drive = Drive(4, heights=False)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"vehicle": "CAIRN_VEHICLE_PLANAR", "gate_probability": 1.0, "batch_gate_probability": 1.0,
                            "noise_learning": "CAIRN_NOISE_APPLIED", "max_sensors": 2})
    s.call("cairn_filter_add_range_bearing", filter=rover, radar={"range_sigma": 0.1, "bearing_sigma": 0.01})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={"T_body_sensor": pose(0.5, 0.0, 0.0)})
    s.call("cairn_filter_set_wheels", filter=rover, wheels={"yaw_sign": "CAIRN_YAW_LEFT_MINUS_RIGHT", "track": 0.8})
    for _ in range(12):
        drive.wheels(s, rover, 1.0, -0.1, track=-0.8)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.radar())
    ask(s, rover)
    s.call("cairn_filter_pose_nees", filter=rover, truth=drive.pose())
    return s


SCENARIOS = [stereo_head, stereo_camera, cartesian, absolute, planar]
