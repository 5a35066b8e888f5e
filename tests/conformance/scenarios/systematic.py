# SPDX-License-Identifier: BSD-3-Clause
"""Systematic errors as states, and what a filter says about its noise."""

from .drive import Drive
from .scenario import Scenario
from .sensors import START, ask


def errors():
    s = Scenario("systematic", "Biases, wheel scales, a sensor's mount and offsets are states of the filter.")
    drive = Drive(31)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"velocity_bias_sigma": [0.1, 0.1, 0.0], "velocity_bias_walk": [0.001, 0.0, 0.0],
                            "rate_bias_sigma": [0.0, 0.0, 0.01], "rate_bias_walk": [0.0, 0.0, 0.0001],
                            "wheel_scale_sigma": [0.02, 0.02], "wheel_scale_walk": [0.0001, 0.0001],
                            "max_sensor_errors": 9, "initial_covariance": START})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={"sigma": [0.05, 0.05, 0.05]})
    s.call("cairn_filter_calibrate_sensor", filter=rover, sensor=0,
           calibration={"mount_shift_sigma": [0.1, 0.1, 0.0], "mount_shift_walk": [0.001, 0.0, 0.0],
                        "mount_turn_sigma": [0.0, 0.0, 0.02], "mount_turn_walk": [0.0, 0.0, 0.001],
                        "offset_sigma": [0.0, 0.0, 0.05], "offset_walk": [0.0, 0.0, 0.001]})
    s.wrong("STATE", "cairn_filter_calibrate_sensor", filter=rover, sensor=0, calibration={})
    s.call("cairn_filter_systematic_errors", filter=rover)
    for step in range(10):
        if step % 2:
            drive.wheels(s, rover, 1.05, 0.1)
        else:
            drive.twist(s, rover, 1.0, 0.1)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.cartesian())
    s.call("cairn_filter_systematic_errors", filter=rover)
    s.wrong("STATE", "cairn_filter_predict_increment", filter=rover,
            T_before_after={"position": [1.0, 0.0, 0.0], "quaternion": [1.0, 0.0, 0.0, 0.0]}, covariance=[0.0] * 36)
    ask(s, rover)
    return s


def none():
    s = Scenario("systematic_none",
                 "A filter has no systematic errors by default, and says what it cannot calibrate.")
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"}, options={"max_sensor_errors": 2})
    s.call("cairn_filter_systematic_errors", filter=rover)
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={})
    s.wrong("NOT_FOUND", "cairn_filter_calibrate_sensor", filter=rover, sensor=1, calibration={})
    s.wrong("CAPACITY", "cairn_filter_calibrate_sensor", filter=rover, sensor=0,
            calibration={"offset_sigma": [0.1, 0.1, 0.1]})
    s.wrong("ARGUMENT", "cairn_filter_calibrate_sensor", filter=rover, sensor=0,
            calibration={"offset_walk": [0.1, 0.0, 0.0]})
    s.wrong("ARGUMENT", "cairn_filter_calibrate_sensor", filter=rover, sensor=0,
            calibration={"mount_turn_sigma": ["nan", 0.0, 0.0]})
    s.wrong("ARGUMENT", "cairn_filter_create", options={"rate_bias_walk": [0.0, 0.0, 0.1]})
    s.wrong("ARGUMENT", "cairn_filter_create", options={"wheel_scale_sigma": [-0.1, 0.0]})
    return s


def health():
    s = Scenario("health",
                 "A drive whose observations are worse than stated: the verdict, its reasons, and the learned noise.")
    drive = Drive(32, noise=3.0)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"initial_covariance": START, "noise_learning": "CAIRN_NOISE_REPORTED"})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={"sigma": [0.05, 0.05, 0.05]})
    s.call("cairn_filter_health", filter=rover)
    for step in range(40):
        drive.twist(s, rover, 1.0, 0.1)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.cartesian())
        if step % 10 == 9:
            s.call("cairn_filter_health", filter=rover)
            s.call("cairn_filter_sensor_health", filter=rover, sensor=0)
    # Another place: nothing agrees any more.
    drive.x += 9.0
    drive.yaw += 1.0
    for _ in range(3):
        drive.twist(s, rover, 1.0, 0.1)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.cartesian())
        s.call("cairn_filter_health", filter=rover)
    s.wrong("NOT_FOUND", "cairn_filter_sensor_health", filter=rover, sensor=1)
    s.wrong("NOT_FOUND", "cairn_filter_sensor_health", filter=rover, sensor=-1)
    return s


SCENARIOS = [errors, none, health]
