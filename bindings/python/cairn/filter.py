# SPDX-License-Identifier: BSD-3-Clause
"""The filter of one vehicle: create it, predict, update, query."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _custom, _structs
from ._custom import Place, Predict
from ._frames import observations
from ._handle import Guard, Handle
from ._library import ffi, lib
from ._pose_type import Pose, PoseLike
from ._structs import Ids
from .constants import Loss
from .error import call
from .layouts import MATCH, OBSERVATION
from .library import doubt_texts, verdict_text
from .map import Map
from .structs import Health

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .structs import (
        Calibration, Cartesian, ClosingReport, Custom, FilterOptions, RangeBearing, SensorHealth, StereoCamera, StereoHead,
        TwistNoise, UpdateReport, Wheels)

Array = NDArray[np.float64]
Structs = NDArray[np.void]
PoseEstimate = tuple[Array, Array, Array]

try:
    _fast_update: Any = importlib.import_module("cairn._fast").update
except ImportError:  # it is not compiled: cffi does the same, more slowly
    _fast_update = None
_ndarray = np.ndarray
_empty = np.empty


class HealthReport(Health):
    """cairn.Health, and the same in words."""

    words: list[str]
    """The verdict, then its reasons."""


class Filter(Handle):
    """One vehicle's pose and map, estimated together.

    Options are keyword arguments, those of cairn.FilterOptions: Filter(max_landmarks=500, submap_landmarks=60,
    state_error="standard", initial_pose=(position, quaternion), initial_covariance=six_by_six). Options that are not
    given have the library's defaults; an unknown name is a TypeError. All memory is allocated at creation. The memory is
    freed when nothing refers to the filter any more, or at the end of a with statement, or by close().

    vehicle="planar" makes it a filter in the plane z = 0. Poses, covariances and Jacobians keep their spatial shapes.
    """

    WHAT = "filter"

    def __init__(self, **options: Unpack[FilterOptions]) -> None:
        created = ffi.new("cairn_filter **")
        call(lib.cairn_filter_create, _structs.new("cairn_filter_options", options), created)
        super().__init__(created[0], lib.cairn_filter_destroy)
        self._addresses = tuple(int(ffi.cast("uintptr_t", of)) for of in (
            lib.cairn_filter_update, self._pointer, self._guard.error))

    @staticmethod
    def required_bytes(**options: Unpack[FilterOptions]) -> int:
        """Bytes that a filter with these options needs."""
        needed = ffi.new("size_t *")
        call(lib.cairn_filter_required_bytes, _structs.new("cairn_filter_options", options), needed)
        return int(needed[0])

    # Sensors. Each call returns the sensor's number for later calls.

    def _add(self, struct_name: str, function: Any, values: Any) -> int:
        return int(self._ask("int32_t *", function, _structs.new(struct_name, values)))

    def add_stereo_head(self, **description: Unpack[StereoHead]) -> int:
        """Adds a stereo head: observations are (range m, azimuth rad, elevation rad). Options: cairn.StereoHead."""
        return self._add("cairn_stereo_head", lib.cairn_filter_add_stereo_head, description)

    def add_stereo_camera(self, **description: Unpack[StereoCamera]) -> int:
        """Adds a stereo camera: observations are (u_left, u_right, v), pixels. Options: cairn.StereoCamera."""
        return self._add("cairn_stereo_camera", lib.cairn_filter_add_stereo_camera, description)

    def add_range_bearing(self, **description: Unpack[RangeBearing]) -> int:
        """Adds a radar, lidar or sonar to a planar vehicle: observations are (range m, bearing rad, left positive).
        Options: cairn.RangeBearing."""
        return self._add("cairn_range_bearing", lib.cairn_filter_add_range_bearing, description)

    def add_cartesian(self, **description: Unpack[Cartesian]) -> int:
        """Adds a sensor of points: observations are (x, y, z), m, in the sensor's frame; (x, y) for a planar vehicle.
        Options: cairn.Cartesian."""
        return self._add("cairn_cartesian", lib.cairn_filter_add_cartesian, description)

    def add_custom(self, predict: Predict, place: Place | None = None, **description: Unpack[Custom]) -> int:
        """Adds a sensor that is defined by two functions. Options: cairn.Custom (rows, sigma, angle_mask, relative).

        predict(pose, landmark) returns (z (rows,), dz/d[dp; dtheta] (rows x 6), dz/dlandmark (rows x 3)), or None if
        the landmark cannot be seen from the pose. place(pose, z) returns (landmark (3,), its Jacobian by the pose (3 x 6),
        its Jacobian by z (3 x rows)), or None. Without `place` the sensor only observes landmarks that other
        sensors placed. An exception in either function is raised by update(), and no part of that frame counts. The
        functions must not call this filter. check_custom() compares the Jacobians with numerical ones.
        """
        struct = _structs.new("cairn_custom", description)
        served = _custom.Sensor(int(struct.rows), predict, place, self._guard).served()
        try:
            return int(self._ask("int32_t *", lib.cairn_filter_add_custom, struct, _custom.PREDICT,
                                 ffi.NULL if place is None else _custom.PLACE, served, _custom.release))
        except BaseException:
            _custom.release(served)  # a call that fails leaves it with the caller
            raise

    def point_head(self, sensor: int, pan: float, stick: float) -> None:
        """Sets the pan and stick angles of a stereo head, rad. They hold until the next call."""
        self._call(lib.cairn_filter_point_head, sensor, pan, stick)

    def set_view(self, sensor: int, lower: ArrayLike, upper: ArrayLike) -> None:
        """Sets the region in which a sensor detects every landmark: observations between `lower` and `upper` (3 each, in
        the sensor's units; infinity is no bound). Landmarks that are missed there are removed (missed_frames)."""
        self._call(lib.cairn_filter_set_view, sensor, _structs.vector("lower", lower, 3),
                   _structs.vector("upper", upper, 3))

    def set_loss(self, sensor: int, loss: Loss | Literal["none", "huber", "cauchy"], width: float = 1.5) -> None:
        """Sets the loss of a sensor's residuals: "none", "huber" or "cauchy". An observation with a large residual gets
        less weight. `width` is where the loss leaves the parabola, in standard deviations; "none" ignores it."""
        self._call(lib.cairn_filter_set_loss, sensor, _structs.constant("loss", "Loss", loss), width)

    # Systematic errors.

    def calibrate_sensor(self, sensor: int, **calibration: Unpack[Calibration]) -> None:
        """Makes systematic errors of a sensor states. Options: cairn.Calibration. Before the first motion."""
        self._call(lib.cairn_filter_calibrate_sensor, sensor, _structs.new("cairn_calibration", calibration))

    def _systematic(self) -> tuple[Structs, Array]:
        needed = ffi.new("size_t *")
        with self._guard.lock:
            errors = self._filled("cairn_systematic_error", _without_covariance)
            covariance = np.zeros((len(errors), len(errors)))
            if len(errors):
                self._call(lib.cairn_filter_systematic_errors, _structs.pointer("cairn_systematic_error *", errors),
                           _structs.doubles(covariance), len(errors), needed)
        return errors, covariance

    def systematic_errors(self) -> Structs:
        """The estimates of all systematic errors that are states: an array of cairn.SYSTEMATIC_ERROR."""
        return self._systematic()[0]

    def systematic_covariance(self) -> Array:
        """The joint covariance of systematic_errors(), n x n."""
        return self._systematic()[1]

    # Motion.

    def set_wheels(self, **description: Unpack[Wheels]) -> None:
        """Describes the vehicle's wheels for predict_wheels. Options: cairn.Wheels."""
        self._call(lib.cairn_filter_set_wheels, _structs.new("cairn_wheels", description))

    def set_twist_noise(self, **description: Unpack[TwistNoise]) -> None:
        """Sets the noise of predict_twist. Options: cairn.TwistNoise."""
        self._call(lib.cairn_filter_set_twist_noise, _structs.new("cairn_twist_noise", description))

    def predict_wheels(self, dt: float, left_rad_per_s: float, right_rad_per_s: float) -> None:
        """Moves the vehicle by the rates of its wheels (rad/s) over dt (s)."""
        self._call(lib.cairn_filter_predict_wheels, dt, left_rad_per_s, right_rad_per_s)

    def predict_wheels_gyro(self, dt: float, left_rad_per_s: float, right_rad_per_s: float, rate: ArrayLike) -> None:
        """Moves the vehicle by the rates of its wheels (rad/s) and the body rate of a gyro (3, rad/s) over dt (s)."""
        self._call(lib.cairn_filter_predict_wheels_gyro, dt, left_rad_per_s, right_rad_per_s,
                   _structs.vector("rate", rate, 3))

    def predict_twist(self, dt: float, velocity: ArrayLike, rate: ArrayLike) -> None:
        """Moves the vehicle by its body velocity (3, m/s) and body rate (3, rad/s) over dt (s)."""
        self._call(lib.cairn_filter_predict_twist, dt, _structs.vector("velocity", velocity, 3),
                   _structs.vector("rate", rate, 3))

    def predict_increment(self, T_before_after: PoseLike, covariance: ArrayLike) -> None:
        """Moves the vehicle by a relative pose, (position, quaternion), with the covariance of its error (6 x 6)."""
        self._call(lib.cairn_filter_predict_increment, _structs.new_pose("T_before_after", T_before_after),
                   _structs.doubles(_structs.array("covariance", covariance, (6, 6))))

    # Observations.

    def update(self, sensor: int, ids: Ids, z: ArrayLike | None = None,
               covariance: ArrayLike | None = None) -> Structs:
        """Updates with one frame of one sensor. All observations of the frame are one batch.

        ids: n landmark ids. z: n x 3 values in the sensor's units (custom: n x rows; planar vehicle: n x 2).
        covariance: the noise of each observation, n x 3 x 3 (custom: n x rows x rows; planar: n x 2 x 2); None means
        the sensor's default noise. `ids` may also be an array of cairn.OBSERVATION, such as a World's: it goes to the
        library as it is, without a copy. Returns n matches: an array of cairn.MATCH with the fields landmark, result
        (cairn.Result), reason (cairn.Reason), distance and threshold (squared Mahalanobis distance and its bound).
        """
        if _fast_update is not None and covariance is None:
            matches = self._update_fast(sensor, ids, z)
            if matches is not None:
                return matches
        frame = observations(ids, z, covariance)
        count = len(frame)
        matches = _empty(count, MATCH)
        self._call(lib.cairn_filter_update, sensor, _structs.pointer("cairn_observation *", frame), count,
                   _structs.pointer("cairn_match *", matches))
        return matches

    def _update_fast(self, sensor: int, ids: Any, z: Any) -> Structs | None:
        """The same by the compiled module. None: it does not take these arguments."""
        if type(ids) is _ndarray:
            if ids.ndim != 1 or (z is None and ids.dtype != OBSERVATION):
                return None
        elif type(ids) is not list or z is None:
            return None
        matches: Structs = _empty(len(cast("list[int]", ids)), MATCH)
        guard = self._guard
        with guard.lock:
            if guard.blocked:
                self._refuse()
            guard.blocked = True
            try:
                status = _fast_update(*self._addresses, sensor, ids, z, matches)
            finally:
                guard.blocked = False
            if status:
                self._fail(status)
        return None if status is None else matches

    def _update_alone(self, function: Any, *arguments: Any) -> np.void:
        match = np.zeros(1, MATCH)
        self._call(function, *arguments, _structs.pointer("cairn_match *", match))
        return cast(np.void, match[0])

    def update_linear(self, residual: ArrayLike, covariance: ArrayLike, jacobian_pose: ArrayLike | None = None,
                      landmarks: Ids = (), jacobian_landmarks: ArrayLike | None = None) -> np.void:
        """Updates with a measurement that the caller linearised: residual z - h (m,), its noise (m x m),
        dh/d[dp; dtheta] (m x 6, None means zero) and dh/d positions of n landmarks (m x 3n). Returns the match."""
        residual = _structs.array("residual", residual, (None,))
        rows, ids = len(residual), _structs.identifiers("landmarks", landmarks)
        blocks = np.zeros((rows, 0)) if jacobian_landmarks is None else jacobian_landmarks
        return self._update_alone(
            lib.cairn_filter_update_linear, _structs.doubles(residual), rows,
            _structs.doubles(_structs.array("covariance", covariance, (rows, rows))),
            _structs.optional_doubles("jacobian_pose", jacobian_pose, (rows, 6)),
            _structs.pointer("uint64_t *", ids), len(ids),
            _structs.doubles(_structs.array("jacobian_landmarks", blocks, (rows, 3 * len(ids)))))

    def update_position(self, position: ArrayLike, covariance: ArrayLike, lever_arm: ArrayLike | None = None) -> np.void:
        """Updates with an absolute position (GNSS), (3, m), and its covariance (3 x 3, m^2). lever_arm: the measured
        point in the body frame (3, m). Returns the match."""
        return self._update_alone(lib.cairn_filter_update_position, _structs.vector("position", position, 3),
                                  _structs.doubles(_structs.array("covariance", covariance, (3, 3))),
                                  _structs.optional_doubles("lever_arm", lever_arm, (3,)))

    def update_attitude(self, quaternion: ArrayLike, covariance: ArrayLike) -> np.void:
        """Updates with an absolute attitude (star tracker): w x y z, body to map, and the covariance of its error
        dtheta (3 x 3, rad^2, axes of the map). Returns the match."""
        return self._update_alone(lib.cairn_filter_update_attitude, _structs.vector("quaternion", quaternion, 4),
                                  _structs.doubles(_structs.array("covariance", covariance, (3, 3))))

    def update_heading(self, heading: float, sigma: float) -> np.void:
        """Updates with an absolute heading (sun sensor, compass) and its standard deviation, rad. Returns the match."""
        return self._update_alone(lib.cairn_filter_update_heading, heading, sigma)

    def last_update(self) -> UpdateReport:
        """Report of the last update."""
        return cast("UpdateReport", self._report("cairn_update_report", lib.cairn_filter_last_update))

    # Landmarks.

    def remove_landmark(self, id: int) -> None:
        """Removes a landmark from the filter."""
        self._call(lib.cairn_filter_remove_landmark, _structs.identifier("id", id))

    def merge_landmarks(self, id: int, other: int) -> np.void:
        """Merges two landmarks that are in truth one, if the estimates do not contradict that: `other` is removed, and
        `id` stays with the observations of both. Returns the match."""
        return self._update_alone(lib.cairn_filter_merge_landmarks, _structs.identifier("id", id),
                                  _structs.identifier("other", other))

    def split_landmark(self, id: int, fresh: int, covariance: ArrayLike) -> None:
        """Splits a landmark that is in truth two: the new landmark `fresh` gets the position of `id` plus an independent
        error with this covariance (3 x 3, m^2), which says how far apart the two may be."""
        self._call(lib.cairn_filter_split_landmark, _structs.identifier("id", id), _structs.identifier("fresh", fresh),
                   _structs.doubles(_structs.array("covariance", covariance, (3, 3))))

    # Estimates.

    def _pose(self, function: Any) -> PoseEstimate:
        pose, covariance = _empty(7), _empty((6, 6))
        self._call(function, _structs.pointer("cairn_pose *", pose), _structs.doubles(covariance))
        return pose[:3], pose[3:], covariance

    def pose(self) -> PoseEstimate:
        """Pose of the body in the map: position (3, m), quaternion (4, w x y z), covariance of [dp; dtheta] (6 x 6)."""
        return self._pose(lib.cairn_filter_pose)

    def local_pose(self) -> PoseEstimate:
        """Pose of the body in the open submap, in the form of pose()."""
        return self._pose(lib.cairn_filter_local_pose)

    def base_pose(self) -> PoseEstimate:
        """Pose of the open submap's origin in the map, in the form of pose()."""
        return self._pose(lib.cairn_filter_base_pose)

    @property
    def map(self) -> Map:
        """The map. With submaps it holds the closed submaps only. It changes with the filter."""
        return Map(self._lend(lib.cairn_filter_map), owner=self)

    @property
    def local_map(self) -> Map:
        """The landmarks of the open submap, in the submap's frame. It changes with the filter."""
        return Map(self._lend(lib.cairn_filter_local_map), owner=self)

    def joint_covariance(self, ids: Ids) -> Array:
        """Joint covariance of the pose and chosen landmarks, (6 + 3n) x (6 + 3n): [dp; dtheta; positions of `ids`]."""
        names = _structs.identifiers("ids", ids)
        side = 6 + 3 * len(names)
        matrix = np.zeros((side, side))
        self._call(lib.cairn_filter_joint_covariance, _structs.pointer("uint64_t *", names), len(names),
                   _structs.doubles(matrix), matrix.size, ffi.new("size_t *"))
        return matrix

    def pose_nees(self, truth: PoseLike) -> float:
        """Normalised estimation error squared (NEES) against a true pose (position, quaternion). A consistent filter
        has 6 on average, a consistent planar filter 3."""
        return float(self._ask("double *", lib.cairn_filter_pose_nees, _structs.new_pose("truth", truth)))

    def audit(self) -> float:
        """Smallest scaled pivot of the covariance's Cholesky factor: 0 or less if the covariance is not positive
        definite."""
        return float(self._ask("double *", lib.cairn_filter_audit))

    def health(self) -> HealthReport:
        """How far to trust the filter after the last update. `verdict` is a cairn.Verdict, `reasons` are bits of
        cairn.Doubts; `words` is the same in words: the verdict, then the reasons."""
        health = cast(HealthReport, self._report("cairn_health", lib.cairn_filter_health))
        health["words"] = [verdict_text(health["verdict"]), *doubt_texts(health["reasons"])]
        return health

    def sensor_health(self, sensor: int) -> SensorHealth:
        """What the observations of one sensor show. `scale` is the factor of the stated standard deviations that explains
        the observations, `scale_sigma` its standard deviation."""
        return cast("SensorHealth", self._report("cairn_sensor_health", lib.cairn_filter_sensor_health, sensor))

    def set_log(self, log: Callable[[str], object] | None) -> None:
        """From now on log(line) receives the filter's log lines; None switches the log off. `log` must not call this
        filter. An exception in `log` goes to sys.unraisablehook."""
        if log is None:
            self._call(lib.cairn_filter_set_log, ffi.NULL, ffi.NULL, ffi.NULL)
            return
        served = _custom.Log(log).served()
        try:
            self._call(lib.cairn_filter_set_log, _custom.LOG, served, _custom.release)
        except BaseException:
            _custom.release(served)
            raise

    # Trajectory: poses that a filter with trajectory_poses > 0 keeps, numbered from 0. Every update keeps one.

    def keep_pose(self) -> int:
        """Keeps the pose of the body now, for a step in which nothing was observed. Returns the pose's number."""
        return int(self._ask("uint64_t *", lib.cairn_filter_keep_pose))

    def trajectory_range(self) -> tuple[int, int]:
        """Numbers of the poses that are kept: the first one, and one behind the last one."""
        first, end = ffi.new("uint64_t *"), ffi.new("uint64_t *")
        self._call(lib.cairn_filter_trajectory_range, first, end)
        return int(first[0]), int(end[0])

    def trajectory(self, first: int | None = None) -> Structs:
        """Poses of the body in the map as they are known now, from number `first` on; None means all that are kept.
        Returns an array of cairn.POSE: the fields position (3, m) and quaternion (4, w x y z)."""
        with self._guard.lock:
            if first is None:
                first = self.trajectory_range()[0]
            return self._filled("cairn_pose", lib.cairn_filter_trajectory, first)

    # Submaps.

    def close_submap(self) -> None:
        """Closes the open submap now and joins its landmarks to the map."""
        self._call(lib.cairn_filter_close_submap)

    def last_closing(self) -> ClosingReport:
        """Report of the last attempt to close a submap."""
        return cast("ClosingReport", self._report("cairn_closing_report", lib.cairn_filter_last_closing))

    @property
    def submap_count(self) -> int:
        """Number of closed submaps."""
        return int(self._ask("size_t *", lib.cairn_filter_submap_count))

    def submap(self, index: int) -> tuple[Pose, NDArray[np.uint64]]:
        """Closed submap number `index`, from 0: its origin in the map (a Pose) and the ids of its landmarks (n,)."""
        base = ffi.new("cairn_pose *")
        ids = self._filled("uint64_t", lib.cairn_filter_submap, index, base)
        return Pose.of(base), ids


def _without_covariance(handle: Any, errors: Any, capacity: int, needed: Any, error: Any) -> int:
    """cairn_filter_systematic_errors in the form of other functions that fill an array."""
    return int(lib.cairn_filter_systematic_errors(handle, errors, ffi.NULL, capacity, needed, error))


def check_custom(predict: Predict, place: Place | None, pose: PoseLike, landmark: ArrayLike,
                 **description: Unpack[Custom]) -> float:
    """Compares the Jacobians of a custom sensor's functions (Filter.add_custom) with numerical ones at one pose and
    landmark (3, m). Returns the largest difference, relative to max(1, |numerical value|): about 1e-6 or less if the
    Jacobians are right."""
    struct, worst, guard = _structs.new("cairn_custom", description), ffi.new("double *"), Guard()
    served = _custom.Sensor(int(struct.rows), predict, place, guard).served()
    try:
        call(lib.cairn_custom_check, struct, _custom.PREDICT, ffi.NULL if place is None else _custom.PLACE, served,
             _structs.new_pose("pose", pose), _structs.vector("landmark", landmark, 3), worst)
    except Exception:
        if guard.raised is not None:
            raise guard.raised from None
        raise
    finally:
        _custom.release(served)
    return float(worst[0])
