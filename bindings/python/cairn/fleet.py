# SPDX-License-Identifier: BSD-3-Clause
"""Simulated boats with radars for tests of a team (libcairn_sim): their measurements, and the truth."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from . import _structs
from ._frames import observations as observations_of
from ._library import ffi, lib
from ._pose_type import Pose
from ._simulation import Simulation
from .error import call
from .pose import planar_pose
from .structs import FleetStep as StepFields

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .structs import FleetOptions, RangeBearing, TwistNoise

Array = NDArray[np.float64]
Structs = NDArray[np.void]


@dataclasses.dataclass
class Boat:
    """One boat at the end of a step."""

    speed: float
    """Commanded speed of the step, m/s."""
    rate: float
    """Commanded rate of the step, rad/s."""
    truth: Pose
    features: Structs
    """The radar's observations of features: an array of cairn.OBSERVATION, for Team.observe."""
    vehicles: Structs
    """The radar's observations of other boats, in the same form."""


@dataclasses.dataclass
class FleetStep(StepFields):
    """One step of a fleet: number, time (s), dt (s, 0 at the start), and its boats."""

    vehicles: list[Boat]


class Fleet(Simulation[FleetStep]):
    """Boats in a square of sea. Features and boats are numbered from 1.

    Options are keyword arguments, those of cairn.FleetOptions: Fleet(seed=3, features=6, layout="coast").

        for step in fleet:                        # each loop begins at the start
            for team, boat in zip(teams, step.vehicles):
                if step.dt > 0:
                    team.predict_twist(step.dt, (boat.speed, 0, 0), (0, 0, boat.rate), **fleet.twist_noise())
                team.observe(step.time, boat.features, boat.vehicles)
    """

    WHAT = "fleet"

    def __init__(self, **options: Unpack[FleetOptions]) -> None:
        struct = _structs.new("cairn_fleet_options", options)
        created = ffi.new("cairn_fleet **")
        call(lib.cairn_fleet_create, struct, created)
        self._options = _structs.as_dict(struct[0])
        super().__init__(created[0], lib.cairn_fleet_destroy)

    def _step(self, fields: dict[str, Any]) -> FleetStep:
        boats = [self._boat(number, boat) for number, boat in enumerate(self.vehicles(), 1)]
        return FleetStep(**fields, vehicles=boats)

    def _boat(self, number: int, boat: Any) -> Boat:
        def observations(seen: Structs) -> Structs:
            return observations_of(seen["id"], np.column_stack([seen["range"], seen["bearing"]]))

        return Boat(float(boat["speed"]), float(boat["rate"]),
                    planar_pose(float(boat["x"]), float(boat["y"]), float(boat["heading"])),
                    observations(self.seen_features(number)), observations(self.seen_vehicles(number)))

    def vehicles(self) -> Structs:
        """The boats at the end of the last step, boat 1 first: an array of cairn.FLEET_VEHICLE."""
        return self._filled("cairn_fleet_vehicle", lib.cairn_fleet_vehicles)

    def seen_features(self, vehicle: int) -> Structs:
        """The features that a boat measured in the last step: an array of cairn.FLEET_SIGHTING."""
        number = _structs.identifier("vehicle", vehicle)
        return self._filled("cairn_fleet_sighting", lib.cairn_fleet_seen_features, number)

    def seen_vehicles(self, vehicle: int) -> Structs:
        """The other boats that a boat measured in the last step: an array of cairn.FLEET_SIGHTING."""
        number = _structs.identifier("vehicle", vehicle)
        return self._filled("cairn_fleet_sighting", lib.cairn_fleet_seen_vehicles, number)

    @property
    def options(self) -> FleetOptions:
        """All options of the fleet."""
        return cast("FleetOptions", dict(self._options))

    def radar(self) -> RangeBearing:
        """The radar of all boats: Team(radar=fleet.radar()), or filter.add_range_bearing(**fleet.radar())."""
        return {"range_sigma": self._options["range_sigma"], "bearing_sigma": self._options["bearing_sigma"]}

    def twist_noise(self) -> TwistNoise:
        """Noise of the commanded motion: team.predict_twist(..., **fleet.twist_noise())."""
        return {"velocity_sigma": (self._options["speed_sigma"], 0, 0), "rate_sigma": (0, 0, self._options["rate_sigma"])}

    def features(self) -> Array:
        """True positions of all features (n x 2, m): row i is feature i + 1."""
        return self._points(2, lib.cairn_fleet_features)

    def coast(self) -> Array:
        """The coast line from west to east (n x 2, m)."""
        return self._points(2, lib.cairn_fleet_coast)
