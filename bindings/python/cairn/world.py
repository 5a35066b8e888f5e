# SPDX-License-Identifier: BSD-3-Clause
"""Simulated worlds for tests of a filter (libcairn_sim): terrain, landmarks, a rover, noisy sensors, and the truth."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, Literal, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _structs
from ._library import ffi, lib
from ._pose_type import Pose
from ._simulation import Simulation
from .constants import Preset
from .error import call
from .structs import WorldStep

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .structs import StereoHead, Wheels, WorldOptions

Array = NDArray[np.float64]
Structs = NDArray[np.void]
PresetLike = Preset | Literal["paper", "row1", "row2", "row3", "row4"]


@dataclasses.dataclass
class Step(WorldStep):
    """One step of a world: number, time, truth and so on (cairn.WorldStep), its motions (an array of cairn.WORLD_MOTION:
    dt, velocity, rate, wheels, ...) and its observations (an array of cairn.OBSERVATION)."""

    motions: Structs
    observations: Structs


def _preset(preset: PresetLike, struct: Any) -> int:
    """Sets a struct of options to a preset. Returns the size of submaps that belongs to the preset."""
    submap_landmarks = ffi.new("uint32_t *")
    call(lib.cairn_world_options_preset, struct, _structs.constant("preset", "Preset", preset), submap_landmarks)
    return int(submap_landmarks[0])


def world_preset(preset: PresetLike, **options: Unpack[WorldOptions]) -> tuple[WorldOptions, int]:
    """The options of a preset, for World(**options), and the size of submaps that belongs to it. The preset replaces all
    options that are given, except the seed."""
    struct = _structs.new("cairn_world_options", options)
    submap_landmarks = _preset(preset, struct)
    return cast("WorldOptions", _structs.as_dict(struct[0])), submap_landmarks


class World(Simulation[Step]):
    """A rover that drives over rolling ground, and its measurements.

    Options are keyword arguments, those of cairn.WorldOptions: World(seed=3, course="laps", landmarks=500). `preset`
    names the set of defaults ("paper", "row1" ... "row4").

        for step in world:                        # each loop begins at the start
            for motion in step.motions:
                filter.predict_twist(motion["dt"], motion["velocity"], motion["rate"])
            filter.point_head(head, step.pan, step.stick)
            filter.update(head, step.observations)
    """

    WHAT = "world"

    def __init__(self, preset: PresetLike | None = None, **options: Unpack[WorldOptions]) -> None:
        struct = _structs.new("cairn_world_options", {})
        if preset is not None:
            _preset(preset, struct)
        _structs.set_fields(struct, ffi.typeof("cairn_world_options"), options)
        created = ffi.new("cairn_world **")
        call(lib.cairn_world_create, struct, created)
        super().__init__(created[0], lib.cairn_world_destroy)

    def _step(self, fields: dict[str, Any]) -> Step:
        return Step(**fields, motions=self.motions(), observations=self.observations())

    def motions(self) -> Structs:
        """The motion samples of the last step, in order: an array of cairn.WORLD_MOTION."""
        return self._filled("cairn_world_motion", lib.cairn_world_motions)

    def observations(self) -> Structs:
        """The observations of the last step's frame, by ascending id: an array of cairn.OBSERVATION."""
        return self._filled("cairn_observation", lib.cairn_world_observations)

    @property
    def most_observations(self) -> int:
        """An upper bound of the number of observations in a frame."""
        return int(self._ask("size_t *", lib.cairn_world_most_observations))

    def head(self) -> StereoHead:
        """The stereo head that makes the observations: filter.add_stereo_head(**world.head())."""
        return cast("StereoHead", self._report("cairn_stereo_head", lib.cairn_world_head))

    def wheels(self) -> Wheels:
        """The wheels of the rover: filter.set_wheels(**world.wheels())."""
        return cast("Wheels", self._report("cairn_wheels", lib.cairn_world_wheels))

    def pose(self, time: float) -> Pose:
        """True Pose of the body in the map at `time` (s)."""
        return Pose.of(self._ask("cairn_pose *", lib.cairn_world_pose, time))

    def contacts(self, time: float) -> Array:
        """The points where the wheels touch the ground at `time` (s): front left, front right, rear left, rear right
        (4 x 3, m)."""
        points = np.zeros((4, 3))
        self._call(lib.cairn_world_contacts, time, _structs.doubles(points))
        return points

    def height(self, x: ArrayLike, y: ArrayLike) -> Any:
        """Height of the ground, m, at x and y (m). Two arrays of the same shape give an array."""
        at = np.broadcast(x, y)
        heights = [self._ask("double *", lib.cairn_world_height, *map(float, pair)) for pair in at]
        return np.array(heights).reshape(at.shape)[()]

    def extent(self) -> tuple[Array, Array]:
        """The rectangle that holds the course and all landmarks: lower and upper corner (2 each, m)."""
        lower, upper = np.zeros(2), np.zeros(2)
        self._call(lib.cairn_world_extent, _structs.doubles(lower), _structs.doubles(upper))
        return lower, upper

    def landmark(self, id: int) -> Array:
        """True position (3, m) of a landmark."""
        position = np.zeros(3)
        self._call(lib.cairn_world_landmark, _structs.identifier("id", id), _structs.doubles(position))
        return position

    def landmarks(self) -> Array:
        """True positions of all landmarks (n x 3, m), by ascending id: row i is landmark i."""
        return self._points(3, lib.cairn_world_landmarks)
