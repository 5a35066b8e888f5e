# SPDX-License-Identifier: BSD-3-Clause
"""Simulated boats with radars for tests of a team (libcairn_sim): their measurements, and the truth."""
import types

import numpy as np

from . import _structs
from ._library import ffi, lib
from ._simulation import Simulation, check_sim
from .pose import planar_pose


class Boat(types.SimpleNamespace):
    """One boat at the end of a step: the commanded speed (m/s) and rate (rad/s) of the step, truth (a Pose), and the
    radar's observations of features and of other boats (vehicles): arrays of observations for Team.observe."""


class FleetStep(types.SimpleNamespace):
    """One step of a fleet: number, time (s), dt (s, 0 at the start) and vehicles, a list of Boat."""


class Fleet(Simulation):
    """Boats in a square of sea. Features and boats are numbered from 1.

    Options are the fields of cairn_fleet_options, by name: Fleet(seed=3, features=6, layout="coast").

        for step in fleet:                        # each loop begins at the start
            for team, boat in zip(teams, step.vehicles):
                if step.dt > 0:
                    team.predict_twist(step.dt, (boat.speed, 0, 0), (0, 0, boat.rate), **fleet.twist_noise())
                team.observe(step.time, boat.features, boat.vehicles)
    """

    WHAT = "fleet"

    def __init__(self, **options):
        struct = _structs.new("cairn_fleet_options", options)
        created = ffi.new("cairn_fleet **")
        check_sim(lib.cairn_fleet_create(struct, created))
        self.options = _structs.as_dict(struct[0])
        super().__init__(created[0], lib.cairn_fleet_destroy)

    def _step(self, struct):
        boats = [self._boat(struct.vehicles[i]) for i in range(struct.vehicle_count)]
        return FleetStep(number=struct.number, time=struct.time, dt=struct.dt, vehicles=boats)

    @staticmethod
    def _boat(boat):
        def observations(sightings, count):
            seen = [sightings[i] for i in range(count)]
            return _structs.observations([s.id for s in seen], np.reshape([(s.range, s.bearing) for s in seen], (-1, 2)))

        return Boat(speed=boat.speed, rate=boat.rate, truth=planar_pose(boat.x, boat.y, boat.heading),
                    features=observations(boat.features, boat.feature_count),
                    vehicles=observations(boat.vehicles, boat.vehicle_count))

    def radar(self):
        """The radar of all boats: Team(radar=fleet.radar()), or filter.add_range_bearing(**fleet.radar())."""
        return {"range_sigma": self.options["range_sigma"], "bearing_sigma": self.options["bearing_sigma"]}

    def twist_noise(self):
        """Noise of the commanded motion: team.predict_twist(..., **fleet.twist_noise())."""
        return {"velocity_sigma": (self.options["speed_sigma"], 0, 0), "rate_sigma": (0, 0, self.options["rate_sigma"])}

    def _points(self, function):
        needed = ffi.new("size_t *")
        with self._use() as handle:
            check_sim(function(handle, ffi.NULL, 0, needed))
            points = np.zeros((needed[0], 2))
            if len(points):
                check_sim(function(handle, _structs.doubles(points), len(points), needed))
        return points

    def features(self):
        """True positions of all features (n x 2, m): row i is feature i + 1."""
        return self._points(lib.cairn_fleet_features)

    def coast(self):
        """The coast line from west to east (n x 2, m)."""
        return self._points(lib.cairn_fleet_coast)
