# SPDX-License-Identifier: BSD-3-Clause
# Written by generate.py from the description of the C interface: do not edit.
"""The numpy types of the structs that arrays hold: frames, matches, landmarks. They have the layout of C, so
that no array is copied."""

from __future__ import annotations

from typing import Any

import numpy as np

__all__ = ["FLEET_SIGHTING", "FLEET_VEHICLE", "LANDMARK", "MATCH", "MERGED_ID", "OBSERVATION", "POSE",
           "SYSTEMATIC_ERROR", "WORLD_MOTION"]

Layout = np.dtype[Any]

POSE: Layout = np.dtype({
    "names": ["position", "quaternion"],
    "formats": [("f8", (3,)), ("f8", (4,))],
    "offsets": [0, 24], "itemsize": 56})
"""Pose of a frame b in a frame a: `p_a = R(quaternion) p_b + position`. SI units, Hamilton quaternion, w first.  The
error of a pose is `[dp; dtheta]` (m, rad), both in the axes of the parent frame a: `position_true = position + dp`,
`R_true = Exp(dtheta) R`. Every 6x6 covariance of a pose in this interface is the covariance of this error, row-major.
Layout frozen. Fields: position: origin of b in a, m; quaternion: rotation from b to a: w x y z, unit length."""

LANDMARK: Layout = np.dtype({
    "names": ["id", "observations", "position", "covariance"],
    "formats": ["u8", "u8", ("f8", (3,)), ("f8", (3, 3))],
    "offsets": [0, 8, 16, 40], "itemsize": 112})
"""A landmark. Layout frozen. Fields: id: the caller's id, or the assigned one; it never changes; observations:
observations that placed or updated it; position: in the map frame, m; covariance: covariance of the position, 3x3
row-major, m^2."""

MERGED_ID: Layout = np.dtype({
    "names": ["other_id", "id", "common"],
    "formats": ["u8", "u8", "i4"],
    "offsets": [0, 8, 16], "itemsize": 24})
"""Where a landmark of the other map is after a merge. Layout frozen. Fields: other_id: its id in the other map; id: its
id in the merged map; common: 1: the map held this landmark before; 0: it was added."""

OBSERVATION: Layout = np.dtype({
    "names": ["id", "z", "covariance"],
    "formats": ["u8", ("f8", (3,)), ("f8", (3, 3))],
    "offsets": [0, 8, 32], "itemsize": 104})
"""One observation of one landmark by one sensor. Layout frozen. Fields: id: the caller's id of the landmark; not
ID_NONE; once in a frame. Any value if the filter's `association` is not Association.KNOWN; z: values in the sensor's
units; a custom sensor of fewer rows uses the first; covariance: noise of this observation, 3x3 row-major (custom: rows
x rows, packed); all zero: the sensor's noise."""

MATCH: Layout = np.dtype({
    "names": ["landmark", "result", "reason", "distance", "threshold"],
    "formats": ["u8", "i4", "i4", "f8", "f8"],
    "offsets": [0, 8, 12, 16, 24], "itemsize": 32})
"""Match of one observation: what it was paired with, and whether it was used. Layout frozen. Fields: landmark: landmark
that the observation was compared with or that it placed; ID_NONE if there is none; result: Result.MATCHED, Result.NEW
or Result.REJECTED; reason: one of the CAIRN_REASON_ constants; distance: squared Mahalanobis distance of the innovation
(Reason.BATCH_GATE: that of the whole batch when this observation was removed); 0 if there is none; threshold:
chi-square bound that `distance` was compared with (infinity at a gate probability of 1); 0 if there is none."""

SYSTEMATIC_ERROR: Layout = np.dtype({
    "names": ["kind", "sensor", "component", "value", "sigma"],
    "formats": ["i4", "i4", "i4", "f8", "f8"],
    "offsets": [0, 4, 8, 16, 24], "itemsize": 32})
"""The estimate of one component of a systematic error. Layout frozen. Fields: kind: Systematic.VELOCITY_BIAS and so on;
sensor: the sensor whose error it is; -1: of the motion; component: counted from 0; value: in the units of its kind;
sigma: its standard deviation now, in the same units."""

WORLD_MOTION: Layout = np.dtype({
    "names": ["dt", "velocity", "rate", "wheels", "true_velocity", "true_rate", "true_wheels"],
    "formats": ["f8", ("f8", (3,)), ("f8", (3,)), ("f8", (2,)), ("f8", (3,)), ("f8", (3,)), ("f8", (2,))],
    "offsets": [0, 8, 32, 56, 72, 96, 120], "itemsize": 136})
"""A motion sample: measured and true motion of the rover during `dt` seconds. Layout frozen. Fields: dt: s; velocity:
measured velocity, body axes, m/s (`drive`); rate: measured rate, body axes, rad/s; wheels: measured turning rates of
the left and the right wheels, rad/s: means over dt; true_velocity: true velocity, m/s. With true_rate it leads from the
true pose before to the true pose after: T <- T Exp([v; w] dt); true_rate: true rate, rad/s; true_wheels: true turning
rates, rad/s: those that follow from eq. 1 of the paper."""

FLEET_SIGHTING: Layout = np.dtype({
    "names": ["id", "range", "bearing"],
    "formats": ["u8", "f8", "f8"],
    "offsets": [0, 8, 16], "itemsize": 24})
"""Radar measurement of a feature or of a boat. Layout frozen. Fields: id: number of the feature or of the boat; both
count from 1; range: m, > 0: noise that would make it 0 or less is drawn again; bearing: in the frame of the boat that
measures, rad."""

FLEET_VEHICLE: Layout = np.dtype({
    "names": ["speed", "rate", "x", "y", "heading", "feature_count", "vehicle_count"],
    "formats": ["f8", "f8", "f8", "f8", "f8", "u8", "u8"],
    "offsets": [0, 8, 16, 24, 32, 40, 48], "itemsize": 56})
"""A boat at the end of a step. Layout frozen. Fields: speed: commanded speed during the step, m/s: the input of a
filter; 0 at step 0; rate: commanded rate during the step, rad/s; 0 at step 0; x: true position, east, m; y: true
position, north, m; heading: true heading, rad; feature_count: measured features, for Fleet.seen_features;
vehicle_count: measured other boats, for Fleet.seen_vehicles."""

# By the names of C.
OF_STRUCT: dict[str, Layout] = {"cairn_pose": POSE, "cairn_landmark": LANDMARK, "cairn_merged_id": MERGED_ID,
    "cairn_observation": OBSERVATION, "cairn_match": MATCH, "cairn_systematic_error": SYSTEMATIC_ERROR,
    "cairn_world_motion": WORLD_MOTION, "cairn_fleet_sighting": FLEET_SIGHTING, "cairn_fleet_vehicle": FLEET_VEHICLE}
