# SPDX-License-Identifier: BSD-3-Clause
"""The filter of one vehicle: create it, predict, update, query."""
import numpy as np

from . import _structs
from ._custom import Callbacks
from ._handle import Handle
from ._library import ffi, lib
from .error import check
from .map import Map
from .pose import Pose


class Filter(Handle):
    """One vehicle's pose and map, estimated together.

    Options are the fields of cairn_filter_options, by name: Filter(max_landmarks=500, submap_landmarks=60,
    error="standard", initial_pose=(position, quaternion), initial_covariance=six_by_six). Options that are not given
    have the library's defaults; an unknown name is a TypeError. All memory is allocated at creation. Use the filter in
    a with statement, or close() it.

    vehicle="planar" makes it a filter in the plane z = 0. Poses, covariances and Jacobians keep their spatial shapes.
    """

    WHAT = "filter"

    def __init__(self, **options):
        created = ffi.new("cairn_filter **")
        check(lib.cairn_filter_create(_structs.new("cairn_filter_options", options), created))
        self._callbacks = Callbacks()  # functions that the library may call; they must live as long as the filter
        super().__init__(created[0], lib.cairn_filter_destroy)

    @staticmethod
    def required_bytes(**options):
        """Bytes that a filter with these options needs."""
        needed = ffi.new("size_t *")
        check(lib.cairn_filter_required_bytes(_structs.new("cairn_filter_options", options), needed))
        return needed[0]

    def _call(self, function, *arguments):
        with self._use() as handle:
            status = function(handle, *arguments)
            self._callbacks.raise_pending()
            check(status)

    # Sensors. Each call returns the sensor's number for later calls.

    def _add(self, type_name, function, values):
        sensor = ffi.new("int32_t *")
        self._call(function, _structs.new(type_name, values), sensor)
        return sensor[0]

    def add_stereo_head(self, **description):
        """Adds a stereo head: observations are (range m, azimuth rad, elevation rad). Fields of cairn_stereo_head."""
        return self._add("cairn_stereo_head", lib.cairn_filter_add_stereo_head, description)

    def add_stereo_camera(self, **description):
        """Adds a stereo camera: observations are (u_left, u_right, v), pixels. Fields of cairn_stereo_camera."""
        return self._add("cairn_stereo_camera", lib.cairn_filter_add_stereo_camera, description)

    def add_range_bearing(self, **description):
        """Adds a radar, lidar or sonar to a planar vehicle: observations are (range m, bearing rad, left positive).
        Fields of cairn_range_bearing."""
        return self._add("cairn_range_bearing", lib.cairn_filter_add_range_bearing, description)

    def add_cartesian(self, **description):
        """Adds a sensor of points: observations are (x, y, z), m, in the sensor's frame; (x, y) for a planar vehicle.
        Fields of cairn_cartesian."""
        return self._add("cairn_cartesian", lib.cairn_filter_add_cartesian, description)

    def add_custom(self, predict, place=None, **description):
        """Adds a sensor that is defined by two functions. Fields of cairn_custom: rows, sigma, angle_mask, relative.

        predict(pose, landmark) returns (z (rows,), dz/d[dp; dtheta] (rows x 6), dz/dlandmark (rows x 3)), or None if
        the landmark cannot be seen from the pose. place(pose, z) returns (landmark (3,), its Jacobian by the pose (3 x 6),
        its Jacobian by z (3 x rows)), or None. Without `place` the sensor only observes landmarks that other
        sensors placed. An exception in either function is raised by update(), and no part of that frame counts.
        """
        struct = _structs.new("cairn_custom", description)
        self._callbacks.custom(struct, predict, place)
        sensor = ffi.new("int32_t *")
        self._call(lib.cairn_filter_add_custom, struct, sensor)
        return sensor[0]

    def point_head(self, sensor, pan, stick):
        """Sets the pan and stick angles of a stereo head, rad. They hold until the next call."""
        self._call(lib.cairn_filter_point_head, sensor, pan, stick)

    # Systematic errors.

    def calibrate_sensor(self, sensor, **calibration):
        """Makes systematic errors of a sensor states: fields of cairn_calibration. Before the first motion."""
        self._call(lib.cairn_filter_calibrate_sensor, sensor, _structs.new("cairn_calibration", calibration))

    def systematic_errors(self):
        """The estimates of all systematic errors that are states, as an array with the fields of
        cairn_systematic_error."""
        with self._use() as handle:
            return _structs.filled("cairn_systematic_error",
                                   lambda errors, capacity, needed: lib.cairn_filter_systematic_errors(
                                       handle, errors, ffi.NULL, capacity, needed))

    def systematic_covariance(self):
        """The joint covariance of systematic_errors(), n x n."""
        errors = self.systematic_errors()
        covariance = np.zeros((len(errors), len(errors)))
        if len(errors):
            self._call(lib.cairn_filter_systematic_errors,
                       ffi.from_buffer("cairn_systematic_error *", errors, require_writable=True),
                       _structs.doubles(covariance), len(errors), ffi.new("size_t *"))
        return covariance
    def set_loss(self, sensor, loss, width=1.5):
        """Sets the loss of a sensor's residuals: "none", "huber" or "cauchy". An observation with a large residual gets
        less weight. `width` is where the loss leaves the parabola, in standard deviations; "none" ignores it."""
        kind = _structs.constant("loss", loss) if isinstance(loss, str) else loss
        self._call(lib.cairn_filter_set_loss, sensor, kind, width)

    # Motion.

    def set_wheels(self, **description):
        """Describes the vehicle's wheels for predict_wheels. Fields of cairn_wheels."""
        self._call(lib.cairn_filter_set_wheels, _structs.new("cairn_wheels", description))

    def set_twist_noise(self, **description):
        """Sets the noise of predict_twist. Fields of cairn_twist_noise."""
        self._call(lib.cairn_filter_set_twist_noise, _structs.new("cairn_twist_noise", description))

    def predict_wheels(self, dt, left_rad_per_s, right_rad_per_s):
        """Moves the vehicle by the rates of its wheels (rad/s) over dt (s)."""
        self._call(lib.cairn_filter_predict_wheels, dt, left_rad_per_s, right_rad_per_s)

    def predict_wheels_gyro(self, dt, left_rad_per_s, right_rad_per_s, rate):
        """Moves the vehicle by the rates of its wheels (rad/s) and the body rate of a gyro (3, rad/s) over dt (s)."""
        rate = _structs.array("rate", rate, (3,))
        self._call(lib.cairn_filter_predict_wheels_gyro, dt, left_rad_per_s, right_rad_per_s, _structs.doubles(rate))

    def predict_twist(self, dt, velocity, rate):
        """Moves the vehicle by its body velocity (3, m/s) and body rate (3, rad/s) over dt (s)."""
        velocity, rate = _structs.array("velocity", velocity, (3,)), _structs.array("rate", rate, (3,))
        self._call(lib.cairn_filter_predict_twist, dt, _structs.doubles(velocity), _structs.doubles(rate))

    def predict_increment(self, T_before_after, covariance):
        """Moves the vehicle by a relative pose, (position, quaternion), with the covariance of its error (6 x 6)."""
        covariance = _structs.array("covariance", covariance, (6, 6))
        self._call(lib.cairn_filter_predict_increment, _structs.new_pose("T_before_after", T_before_after),
                   _structs.doubles(covariance))

    # Observations.

    def update(self, sensor, ids, z=None, covariance=None):
        """Updates with one frame of one sensor. All observations of the frame are one batch.

        ids: n landmark ids. z: n x 3 values in the sensor's units (custom: n x rows; planar vehicle: n x 2).
        covariance: the noise of each observation, n x 3 x 3 (custom: n x rows x rows; planar: n x 2 x 2); None means
        the sensor's default noise. `ids` may also be an array of observations with these three fields, such as a
        World's. Returns n matches: an array with the fields landmark, result (cairn.MATCHED, NEW, REJECTED), reason,
        distance and threshold (squared Mahalanobis distance and its bound).
        """
        frame = _structs.observations(ids, z, covariance)
        matches = np.zeros(len(frame), _structs.dtype("cairn_match"))
        self._call(lib.cairn_filter_update, sensor, ffi.from_buffer("cairn_observation *", frame), len(frame),
                   ffi.from_buffer("cairn_match *", matches))
        return matches

    def _update_alone(self, function, *arguments):
        match = np.zeros(1, _structs.dtype("cairn_match"))
        self._call(function, *arguments, ffi.from_buffer("cairn_match *", match))
        return match[0]

    def update_linear(self, residual, covariance, jacobian_pose=None, landmarks=(), jacobian_landmarks=None):
        """Updates with a measurement that the caller linearised: residual z - h (m,), its noise (m x m),
        dh/d[dp; dtheta] (m x 6, None means zero) and dh/d positions of n landmarks (m x 3n). Returns the match."""
        residual = _structs.array("residual", residual, (None,))
        rows, ids = len(residual), _structs.identifiers("landmarks", landmarks)
        covariance = _structs.array("covariance", covariance, (rows, rows))
        pose = None if jacobian_pose is None else _structs.array("jacobian_pose", jacobian_pose, (rows, 6))
        blocks = np.zeros((rows, 0)) if jacobian_landmarks is None else jacobian_landmarks
        blocks = _structs.array("jacobian_landmarks", blocks, (rows, 3 * len(ids)))
        return self._update_alone(
            lib.cairn_filter_update_linear, _structs.doubles(residual), rows, _structs.doubles(covariance),
            ffi.NULL if pose is None else _structs.doubles(pose), ffi.from_buffer("uint64_t *", ids), len(ids),
            _structs.doubles(blocks))

    def update_position(self, position, covariance, lever_arm=None):
        """Updates with an absolute position (GNSS), (3, m), and its covariance (3 x 3, m^2). lever_arm: the measured
        point in the body frame (3, m). Returns the match."""
        position, covariance = _structs.array("position", position, (3,)), _structs.array("covariance", covariance, (3, 3))
        lever = None if lever_arm is None else _structs.array("lever_arm", lever_arm, (3,))
        return self._update_alone(lib.cairn_filter_update_position, _structs.doubles(position),
                                  _structs.doubles(covariance), ffi.NULL if lever is None else _structs.doubles(lever))

    def update_attitude(self, quaternion, covariance):
        """Updates with an absolute attitude (star tracker): w x y z, body to map, and the covariance of its error
        dtheta (3 x 3, rad^2, axes of the map). Returns the match."""
        quaternion = _structs.array("quaternion", quaternion, (4,))
        covariance = _structs.array("covariance", covariance, (3, 3))
        return self._update_alone(lib.cairn_filter_update_attitude, _structs.doubles(quaternion),
                                  _structs.doubles(covariance))

    def update_heading(self, heading, sigma):
        """Updates with an absolute heading (sun sensor, compass) and its standard deviation, rad. Returns the match."""
        return self._update_alone(lib.cairn_filter_update_heading, heading, sigma)

    def last_update(self):
        """Report of the last update: cairn_update_report as a dictionary."""
        with self._use() as handle:
            return _structs.report("cairn_update_report", lambda report: lib.cairn_filter_last_update(handle, report))

    def remove_landmark(self, id):
        """Removes a landmark from the filter."""
        self._call(lib.cairn_filter_remove_landmark, int(_structs.identifiers("id", [id])[0]))

    # Estimates.

    def _pose(self, function):
        pose, covariance = ffi.new("cairn_pose *"), np.zeros((6, 6))
        self._call(function, pose, _structs.doubles(covariance))
        return (*Pose.of(pose), covariance)

    def pose(self):
        """Pose of the body in the map: position (3, m), quaternion (4, w x y z), covariance of [dp; dtheta] (6 x 6)."""
        return self._pose(lib.cairn_filter_pose)

    def local_pose(self):
        """Pose of the body in the open submap, in the form of pose()."""
        return self._pose(lib.cairn_filter_local_pose)

    def base_pose(self):
        """Pose of the open submap's origin in the map, in the form of pose()."""
        return self._pose(lib.cairn_filter_base_pose)

    @property
    def map(self):
        """The map. With submaps it holds the closed submaps only. It changes with the filter."""
        with self._use() as handle:
            return Map(lib.cairn_filter_map(handle), owner=self)

    @property
    def local_map(self):
        """The landmarks of the open submap, in the submap's frame. It changes with the filter."""
        with self._use() as handle:
            return Map(lib.cairn_filter_local_map(handle), owner=self)

    def joint_covariance(self, ids):
        """Joint covariance of the pose and chosen landmarks, (6 + 3n) x (6 + 3n): [dp; dtheta; positions of `ids`]."""
        ids = _structs.identifiers("ids", ids)
        side = 6 + 3 * len(ids)
        matrix = np.zeros((side, side))
        self._call(lib.cairn_filter_joint_covariance, ffi.from_buffer("uint64_t *", ids), len(ids),
                   _structs.doubles(matrix), matrix.size, ffi.new("size_t *"))
        return matrix

    def pose_nees(self, truth):
        """Normalised estimation error squared (NEES) against a true pose (position, quaternion). A consistent filter
        has 6 on average, a consistent planar filter 3."""
        nees = ffi.new("double *")
        self._call(lib.cairn_filter_pose_nees, _structs.new_pose("truth", truth), nees)
        return nees[0]

    def audit(self):
        """Smallest scaled pivot of the covariance's Cholesky factor: 0 or less if the covariance is not positive
        definite."""
        pivot = ffi.new("double *")
        self._call(lib.cairn_filter_audit, pivot)
        return pivot[0]

    def health(self):
        """How far to trust the filter after the last update: cairn_health as a dictionary. `verdict` is cairn.VERDICT_GOOD,
        VERDICT_DOUBTFUL or VERDICT_LOST, `reasons` has the bits cairn.DOUBT_...; `words` is the same in words: the
        verdict, then the reasons."""
        with self._use() as handle:
            health = _structs.report("cairn_health", lambda report: lib.cairn_filter_health(handle, report))
        reasons = [lib.cairn_doubt_text(1 << bit) for bit in range(32) if health["reasons"] >> bit & 1]
        health["words"] = [ffi.string(text).decode() for text in [lib.cairn_verdict_text(health["verdict"]), *reasons]]
        return health

    def sensor_health(self, sensor):
        """What the observations of one sensor show: cairn_sensor_health as a dictionary. `scale` is the factor of the
        stated standard deviations that explains the observations, `scale_sigma` its standard deviation."""
        with self._use() as handle:
            return _structs.report("cairn_sensor_health",
                                   lambda report: lib.cairn_filter_sensor_health(handle, sensor, report))

    def set_log(self, log):
        """From now on log(line) receives the filter's log lines; None switches the log off. `log` must not call this
        filter."""
        self._call(lib.cairn_filter_set_log, self._callbacks.log(log), ffi.NULL)

    # Trajectory: poses that a filter with trajectory_poses > 0 keeps, numbered from 0. Every update keeps one.

    def keep_pose(self):
        """Keeps the pose of the body now, for a step in which nothing was observed. Returns the pose's number."""
        number = ffi.new("uint64_t *")
        self._call(lib.cairn_filter_keep_pose, number)
        return number[0]

    def trajectory_range(self):
        """Numbers of the poses that are kept: the first one, and one behind the last one."""
        first, end = ffi.new("uint64_t *"), ffi.new("uint64_t *")
        self._call(lib.cairn_filter_trajectory_range, first, end)
        return first[0], end[0]

    def trajectory(self, first=None):
        """Poses of the body in the map as they are known now, from number `first` on; None means all that are kept.
        Returns an array with the fields position (3, m) and quaternion (4, w x y z)."""
        if first is None:
            first = self.trajectory_range()[0]
        with self._use() as handle:
            return _structs.filled("cairn_pose", lambda *buffer: lib.cairn_filter_trajectory(handle, first, *buffer))

    # Submaps.

    def close_submap(self):
        """Closes the open submap now and joins its landmarks to the map."""
        self._call(lib.cairn_filter_close_submap)

    def last_closing(self):
        """Report of the last attempt to close a submap: cairn_closing_report as a dictionary."""
        with self._use() as handle:
            return _structs.report("cairn_closing_report", lambda report: lib.cairn_filter_last_closing(handle, report))

    @property
    def submap_count(self):
        """Number of closed submaps."""
        count = ffi.new("size_t *")
        self._call(lib.cairn_filter_submap_count, count)
        return count[0]

    def submap(self, index):
        """Closed submap number `index`, from 0: its origin in the map (a Pose) and the ids of its landmarks (n,)."""
        base = ffi.new("cairn_pose *")
        with self._use() as handle:
            ids = _structs.filled("uint64_t", lambda *buffer: lib.cairn_filter_submap(handle, index, base, *buffer))
        return Pose.of(base), ids
