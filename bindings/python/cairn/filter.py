# SPDX-License-Identifier: BSD-3-Clause
"""The filter of one vehicle: create, predict, update, ask."""
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
    error="standard", initial_pose=(position, quaternion), initial_covariance=six_by_six). What is not given has the
    library's default; an unknown name is a TypeError. All memory is taken now. Use it in a with statement, or close() it.

    vehicle="planar" makes it a filter in the plane z = 0. Poses, covariances and Jacobians keep the shapes of space.
    """

    WHAT = "filter"

    def __init__(self, **options):
        created = ffi.new("cairn_filter **")
        check(lib.cairn_filter_create(_structs.new("cairn_filter_options", options), created))
        self._callbacks = Callbacks()  # the functions that the library may call; they live as long as the filter
        super().__init__(created[0], lib.cairn_filter_destroy)

    @staticmethod
    def required_bytes(**options):
        """Bytes that a filter with these options takes."""
        needed = ffi.new("size_t *")
        check(lib.cairn_filter_required_bytes(_structs.new("cairn_filter_options", options), needed))
        return needed[0]

    def _call(self, function, *arguments):
        with self._use() as handle:
            status = function(handle, *arguments)
            self._callbacks.raise_pending()
            check(status)

    # Sensors. Each call gives the sensor's number for later calls.

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
        """Adds a sensor of points: observations are (x, y, z), m, in its frame; of a planar vehicle (x, y). Fields of
        cairn_cartesian."""
        return self._add("cairn_cartesian", lib.cairn_filter_add_cartesian, description)

    def add_custom(self, predict, place=None, **description):
        """Adds a sensor of your own. Fields of cairn_custom: rows, sigma, angle_mask, relative.

        predict(pose, landmark) -> (z (rows,), dz/d[dp; dtheta] (rows x 6), dz/dlandmark (rows x 3)), or None where the
        landmark can't be seen from there. place(pose, z) -> (landmark (3,), its Jacobian by the pose (3 x 6), by z
        (3 x rows)), or None; without it the sensor only observes what others placed. What they raise comes out of update.
        """
        struct = _structs.new("cairn_custom", description)
        self._callbacks.custom(struct, predict, place)
        sensor = ffi.new("int32_t *")
        self._call(lib.cairn_filter_add_custom, struct, sensor)
        return sensor[0]

    def point_head(self, sensor, pan, stick):
        """Tells how a stereo head stands from now on: pan and stick angle, rad."""
        self._call(lib.cairn_filter_point_head, sensor, pan, stick)

    # Motion.

    def set_wheels(self, **description):
        """The vehicle's wheels, for predict_wheels. Fields of cairn_wheels."""
        self._call(lib.cairn_filter_set_wheels, _structs.new("cairn_wheels", description))

    def set_twist_noise(self, **description):
        """The noise of predict_twist. Fields of cairn_twist_noise."""
        self._call(lib.cairn_filter_set_twist_noise, _structs.new("cairn_twist_noise", description))

    def predict_wheels(self, dt, left_rad_per_s, right_rad_per_s):
        """Moves the vehicle by its wheels' turning rates (rad/s) over dt (s)."""
        self._call(lib.cairn_filter_predict_wheels, dt, left_rad_per_s, right_rad_per_s)

    def predict_twist(self, dt, velocity, rate):
        """Moves the vehicle by its body velocity (3, m/s) and body rate (3, rad/s) over dt (s)."""
        velocity, rate = _structs.array("velocity", velocity, (3,)), _structs.array("rate", rate, (3,))
        self._call(lib.cairn_filter_predict_twist, dt, _structs.doubles(velocity), _structs.doubles(rate))

    def predict_increment(self, T_before_after, covariance):
        """Moves the vehicle by a relative pose, (position, quaternion), with its error's covariance (6 x 6)."""
        covariance = _structs.array("covariance", covariance, (6, 6))
        self._call(lib.cairn_filter_predict_increment, _structs.new_pose("T_before_after", T_before_after),
                   _structs.doubles(covariance))

    # Observations.

    def update(self, sensor, ids, z=None, covariance=None):
        """Takes in one frame of one sensor; all of it is one batch.

        ids: n landmark ids. z: n x 3 values in the sensor's units (custom: n x rows; of a planar vehicle n x 2).
        covariance: the noise of each observation, n x 3 x 3 (custom: n x rows x rows; planar: n x 2 x 2); None: the
        sensor's own. Or, all in one, an array of observations with these three as fields, as a World hands them out.
        Gives n decisions: an array with the fields landmark, result (cairn.MATCHED, NEW, REJECTED), reason, distance and
        threshold (squared Mahalanobis distance and its bound).
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
        """Updates by what the caller linearised: residual z - h (m,), its noise (m x m), dh/d[dp; dtheta] (m x 6, None:
        zero) and dh/d positions of n landmarks (m x 3n). Gives the decision."""
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
        """Updates by an absolute position (GNSS), (3, m), with its covariance (3 x 3, m^2); lever_arm: where in the body
        it was measured (3, m). Gives the decision."""
        position, covariance = _structs.array("position", position, (3,)), _structs.array("covariance", covariance, (3, 3))
        lever = None if lever_arm is None else _structs.array("lever_arm", lever_arm, (3,))
        return self._update_alone(lib.cairn_filter_update_position, _structs.doubles(position),
                                  _structs.doubles(covariance), ffi.NULL if lever is None else _structs.doubles(lever))

    def update_attitude(self, quaternion, covariance):
        """Updates by an absolute attitude (star tracker): w x y z, body to map, with the covariance of its error dtheta
        (3 x 3, rad^2, map's axes). Gives the decision."""
        quaternion = _structs.array("quaternion", quaternion, (4,))
        covariance = _structs.array("covariance", covariance, (3, 3))
        return self._update_alone(lib.cairn_filter_update_attitude, _structs.doubles(quaternion),
                                  _structs.doubles(covariance))

    def update_heading(self, heading, sigma):
        """Updates by an absolute heading (sun sensor, compass) and its standard deviation, rad. Gives the decision."""
        return self._update_alone(lib.cairn_filter_update_heading, heading, sigma)

    def last_update(self):
        """What the last update did: cairn_update_report as a dictionary."""
        with self._use() as handle:
            return _structs.report("cairn_update_report", lambda report: lib.cairn_filter_last_update(handle, report))

    def remove_landmark(self, id):
        """Forgets a landmark."""
        self._call(lib.cairn_filter_remove_landmark, int(_structs.identifiers("id", [id])[0]))

    # What it knows.

    def _pose(self, function):
        pose, covariance = ffi.new("cairn_pose *"), np.zeros((6, 6))
        self._call(function, pose, _structs.doubles(covariance))
        return (*Pose.of(pose), covariance)

    def pose(self):
        """Body in the map: position (3, m), quaternion (4, w x y z), covariance of [dp; dtheta] (6 x 6)."""
        return self._pose(lib.cairn_filter_pose)

    def local_pose(self):
        """Body in the open submap, as pose() gives it."""
        return self._pose(lib.cairn_filter_local_pose)

    def base_pose(self):
        """The open submap's origin in the map, as pose() gives it."""
        return self._pose(lib.cairn_filter_base_pose)

    @property
    def map(self):
        """The map, of the closed submaps where there are any. It follows the filter."""
        with self._use() as handle:
            return Map(lib.cairn_filter_map(handle), owner=self)

    @property
    def local_map(self):
        """The landmarks of the open submap, in its frame. It follows the filter."""
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
        """Normalised estimation error squared against a true pose (position, quaternion): about 6 on average, of a planar
        vehicle 3."""
        nees = ffi.new("double *")
        self._call(lib.cairn_filter_pose_nees, _structs.new_pose("truth", truth), nees)
        return nees[0]

    def audit(self):
        """Smallest pivot of the covariance's Cholesky factor, scaled: 0 or less where it is not positive definite."""
        pivot = ffi.new("double *")
        self._call(lib.cairn_filter_audit, pivot)
        return pivot[0]

    def set_log(self, log):
        """log(line) gets the filter's log lines from now on; None: silence. It must not call this filter."""
        self._call(lib.cairn_filter_set_log, self._callbacks.log(log), ffi.NULL)

    # Submaps.

    def close_submap(self):
        """Closes the open submap now: its landmarks join the map."""
        self._call(lib.cairn_filter_close_submap)

    def last_closing(self):
        """What the last attempt to close a submap did: cairn_closing_report as a dictionary."""
        with self._use() as handle:
            return _structs.report("cairn_closing_report", lambda report: lib.cairn_filter_last_closing(handle, report))

    @property
    def submap_count(self):
        """Number of closed submaps."""
        count = ffi.new("size_t *")
        self._call(lib.cairn_filter_submap_count, count)
        return count[0]

    def submap(self, index):
        """A closed submap, counted from 0: its origin in the map (a Pose) and the ids of its landmarks (n,)."""
        base = ffi.new("cairn_pose *")
        with self._use() as handle:
            ids = _structs.filled("uint64_t", lambda *buffer: lib.cairn_filter_submap(handle, index, base, *buffer))
        return Pose.of(base), ids
