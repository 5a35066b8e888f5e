# SPDX-License-Identifier: BSD-3-Clause
"""Simulated worlds for tests of a filter (libcairn_sim): terrain, landmarks, a rover, noisy sensors, and the truth."""
import types

import numpy as np

from . import _structs
from ._library import ffi, lib
from ._simulation import Simulation, check_sim
from .pose import Pose


class Step(types.SimpleNamespace):
    """One step of a world: number, time (s), truth (a Pose), velocity_sigma and rate_sigma (3 each), pan and stick
    (rad), motions (an array with the fields dt, velocity, rate, wheels, ...) and observations (id, z, covariance)."""


class World(Simulation):
    """A rover that drives over rolling ground, and its measurements.

    Options are the fields of cairn_world_options, by name: World(seed=3, course="laps", landmarks=500). `preset` names
    the set of defaults ("paper", "row1" ... "row4").

        for step in world:                        # each loop begins at the start
            for motion in step.motions:
                filter.predict_twist(motion["dt"], motion["velocity"], motion["rate"])
            filter.point_head(head, step.pan, step.stick)
            filter.update(head, step.observations)
    """

    WHAT = "world"

    def __init__(self, preset=None, **options):
        struct = _structs.new("cairn_world_options", {})
        if preset is not None:
            number = _structs.constant("preset", preset) if isinstance(preset, str) else preset
            check_sim(lib.cairn_world_options_preset(struct, number, ffi.NULL))
        _structs.set_fields(struct, ffi.typeof("cairn_world_options"), options)
        created = ffi.new("cairn_world **")
        check_sim(lib.cairn_world_create(struct, created))
        super().__init__(created[0], lib.cairn_world_destroy)

    def _ask(self, type_name, function, *arguments):
        """The value that a function writes to its last argument."""
        answer = ffi.new(type_name)
        with self._use() as handle:
            check_sim(function(handle, *arguments, answer))
        return answer

    def _step(self, struct):
        step = _structs.as_dict(struct[0])
        for name, type_name in (("motions", "cairn_world_motion"), ("observations", "cairn_observation")):
            layout, count = _structs.dtype(type_name), step.pop(name[:-1] + "_count")
            copied = ffi.buffer(getattr(struct, name), count * layout.itemsize)[:] if count else b""
            step[name] = np.frombuffer(copied, layout).copy()
        return Step(**step)

    @property
    def most_observations(self):
        """An upper bound of the number of observations in a frame."""
        return self._ask("size_t *", lib.cairn_world_most_observations)[0]

    def _description(self, type_name, function):
        struct = _structs.sized(type_name)
        with self._use() as handle:
            check_sim(function(handle, struct))
        return _structs.as_dict(struct[0])

    def head(self):
        """The stereo head that makes the observations: filter.add_stereo_head(**world.head())."""
        return self._description("cairn_stereo_head", lib.cairn_world_head)

    def wheels(self):
        """The wheels of the rover: filter.set_wheels(**world.wheels())."""
        return self._description("cairn_wheels", lib.cairn_world_wheels)

    def pose(self, time):
        """True Pose of the body in the map at `time` (s)."""
        return Pose.of(self._ask("cairn_pose *", lib.cairn_world_pose, time))

    def contacts(self, time):
        """The points where the wheels touch the ground at `time` (s): front left, front right, rear left, rear right
        (4 x 3, m)."""
        return np.array(list(self._ask("double[12]", lib.cairn_world_contacts, time))).reshape(4, 3)

    def height(self, x, y):
        """Height of the ground, m, at x and y (m). Two arrays of the same shape give an array."""
        at = np.broadcast(x, y)
        heights = [self._ask("double *", lib.cairn_world_height, *map(float, pair))[0] for pair in at]
        return np.array(heights).reshape(at.shape)[()]

    def extent(self):
        """The rectangle that holds the course and all landmarks: lower and upper corner (2 each, m)."""
        lower, upper = np.zeros(2), np.zeros(2)
        with self._use() as handle:
            check_sim(lib.cairn_world_extent(handle, _structs.doubles(lower), _structs.doubles(upper)))
        return lower, upper

    def landmark(self, id):
        """True position (3, m) of a landmark."""
        number = int(_structs.identifiers("id", [id])[0])
        return np.array(list(self._ask("double[3]", lib.cairn_world_landmark, number)))

    def landmarks(self):
        """True positions of all landmarks (n x 3, m), by ascending id: row i is landmark i."""
        needed = ffi.new("size_t *")
        with self._use() as handle:
            check_sim(lib.cairn_world_landmarks(handle, ffi.NULL, 0, needed))
            positions = np.zeros((needed[0], 3))
            if len(positions):
                check_sim(lib.cairn_world_landmarks(handle, _structs.doubles(positions), len(positions), needed))
        return positions
