# SPDX-License-Identifier: BSD-3-Clause
"""One vehicle's view of a team of planar vehicles: report motion and scans, exchange packets, query estimates."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _structs
from ._frames import observations as observations_of
from ._handle import Handle
from ._library import ffi, lib
from ._pose_type import PoseLike
from .constants import Packet
from .error import call
from .map import Map

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .structs import FilterOptions, RangeBearing, TeamOptions, TeamReport, TwistNoise

Array = NDArray[np.float64]
Structs = NDArray[np.void]
Scan = Structs | tuple[ArrayLike, ArrayLike] | tuple[ArrayLike, ArrayLike, ArrayLike]


class Team(Handle):
    """One vehicle's view of its team. Each vehicle has its own Team object. The vehicles exchange packets: bytes that
    any transport may carry, in any order and repeatedly.

    Options are keyword arguments, those of cairn.TeamOptions: Team(vehicle=1, mode="joint", baseline=True). `filter`
    holds options of the filter (cairn.FilterOptions), with a planar vehicle by default. `radar` holds options of the
    radar (cairn.RangeBearing), which must be the same at all vehicles.

        boat = cairn.Team(vehicle=1, filter={"max_landmarks": 40, "initial_pose": start}, radar={"range_sigma": 30})
        boat.add(2, start=start_of_2)
        boat.predict_twist(5.0, (1.1, 0, 0), (0, 0, 0.004))
        boat.observe(5.0, (feature_ids, ranges_and_bearings), (boat_numbers, ranges_and_bearings))
        for packet in boat.packets():
            send(packet)                          # packets of teammates go to boat.receive(packet)
        position, quaternion, covariance = boat.pose()
    """

    WHAT = "team"

    def __init__(self, filter: FilterOptions | None = None, radar: RangeBearing | None = None,
                 **options: Unpack[TeamOptions]) -> None:
        settings = _structs.new("cairn_team_options", options)
        filter_settings = _structs.new("cairn_filter_options", {"vehicle": "planar", **(filter or {})})
        created = ffi.new("cairn_team **")
        sensor = _structs.new("cairn_range_bearing", radar or {})
        call(lib.cairn_team_create, settings, filter_settings, sensor, created)
        self.vehicle = int(settings.vehicle)
        """Number of this vehicle."""
        super().__init__(created[0], lib.cairn_team_destroy)

    # Teammates.

    def add(self, vehicle: int, start: PoseLike | None = None, covariance: ArrayLike | None = None) -> None:
        """Adds a teammate before its first packet. start: its pose (position, quaternion) at its own start, as it uses
        it itself; covariance: of the error of `start` (6 x 6); without it `start` is exact. Without a start, the
        teammate is found by the first mutual sightings."""
        if start is None and covariance is not None:
            raise TypeError("covariance: it belongs to `start`, which is not given")
        self._call(lib.cairn_team_add, _structs.identifier("vehicle", vehicle),
                   ffi.NULL if start is None else _structs.new_pose("start", start),
                   _structs.optional_doubles("covariance", covariance, (6, 6)))

    def remove(self, vehicle: int) -> None:
        """Removes a teammate: its packets are no longer awaited or accepted. Its information stays in the estimate."""
        self._call(lib.cairn_team_remove, _structs.identifier("vehicle", vehicle))

    def members(self) -> NDArray[np.uint64]:
        """Numbers of the team's vehicles; this vehicle is the first."""
        return self._filled("uint64_t", lib.cairn_team_members)

    # This vehicle.

    def predict_increment(self, T_before_after: PoseLike, covariance: ArrayLike) -> None:
        """Moves this vehicle by a relative pose, (position, quaternion), with the covariance of its error (6 x
        6)."""
        self._call(lib.cairn_team_predict_increment, _structs.new_pose("T_before_after", T_before_after),
                   _structs.doubles(_structs.array("covariance", covariance, (6, 6))))

    def predict_twist(self, dt: float, velocity: ArrayLike, rate: ArrayLike, **noise: Unpack[TwistNoise]) -> None:
        """Moves this vehicle by its body velocity (3, m/s) and body rate (3, rad/s) over dt (s). Options:
        cairn.TwistNoise."""
        self._call(lib.cairn_team_predict_twist, dt, _structs.vector("velocity", velocity, 3),
                   _structs.vector("rate", rate, 3), _structs.new("cairn_twist_noise", noise) if noise else ffi.NULL)

    def observe(self, time: float, landmarks: Scan | None = None, vehicles: Scan | None = None) -> None:
        """Ends a step of this vehicle at `time` (s, on a clock that all vehicles share) with its scan. `landmarks`
        and `vehicles` are each None, (ids, z) or (ids, z, covariance) with z n x 2: range (m) and bearing (rad); or an
        array of cairn.OBSERVATION, such as a Fleet's.

        Motion and scan become a packet. They are processed as soon as the packets of all teammates up to this time are
        there."""
        frames: list[Structs] = []
        for name, seen in (("landmarks", landmarks), ("vehicles", vehicles)):
            if isinstance(seen, (tuple, list)) and not 2 <= len(seen) <= 3:
                raise TypeError(f"{name}: must be (ids, z) or (ids, z, covariance), and has {len(seen)} parts")
            parts: Any = seen if isinstance(seen, (tuple, list)) else ((), ()) if seen is None else (seen, None)
            frames.append(observations_of(*parts))
        arguments = [part for frame in frames for part in (_structs.pointer("cairn_observation *", frame), len(frame))]
        self._call(lib.cairn_team_observe, time, *arguments)

    def decisions(self) -> Structs:
        """Matches of the last scan of this vehicle that was processed, as Filter.update gives them: landmarks, then
        vehicles."""
        return self._filled("cairn_match", lib.cairn_team_decisions)

    def leave(self) -> None:
        """Leaves the team: makes a last packet, after which teammates no longer wait for this vehicle."""
        self._call(lib.cairn_team_leave)

    # Packets.

    def take_packet(self) -> bytes | None:
        """The next packet to send to all teammates; None if there is none."""
        needed = ffi.new("size_t *")
        with self._guard.lock:
            self._call(lib.cairn_team_take_packet, ffi.NULL, 0, needed)
            if needed[0] == 0:
                return None
            packet = ffi.new("uint8_t[]", needed[0])
            self._call(lib.cairn_team_take_packet, packet, needed[0], needed)
        return bytes(ffi.buffer(packet))

    def packets(self) -> Iterator[bytes]:
        """Iterates over the packets to send until there is none."""
        while (packet := self.take_packet()) is not None:
            yield packet

    def receive(self, packet: bytes | bytearray | memoryview) -> Packet:
        """Receives a packet of a teammate. Packets may come late, in any order and repeatedly. Returns the result:
        Packet.TAKEN, Packet.WAITING, Packet.CORRUPT, ... A refused packet changes nothing and is not an error."""
        content = ffi.from_buffer("uint8_t[]", packet)
        return Packet(self._ask("cairn_packet *", lib.cairn_team_receive, content, len(content)))

    def ask(self) -> None:
        """Asks the teammates for all missing packets: the next packets to send contain the requests."""
        self._call(lib.cairn_team_ask)

    # Estimates.

    def pose(self, vehicle: int | None = None) -> tuple[Array, Array, Array]:
        """Pose of a vehicle of the team, by default of this vehicle: position (3, m), quaternion (4, w x y z),
        covariance of [dp; dtheta] (6 x 6). Raises CairnError (Status.ERROR_NOT_FOUND) if the pose is not known."""
        number = self.vehicle if vehicle is None else _structs.identifier("vehicle", vehicle)
        pose, covariance = np.empty(7), np.empty((6, 6))
        self._call(lib.cairn_team_pose, number, _structs.pointer("cairn_pose *", pose), _structs.doubles(covariance))
        return pose[:3], pose[3:], covariance

    def pose_nees(self, truth: PoseLike) -> float:
        """Normalised estimation error squared of this vehicle's pose against a true one, (position, quaternion):
        about 3 on average. CairnError (Status.ERROR_NUMERICAL) where the covariance of this vehicle's pose is
        singular."""
        return float(self._ask("double *", lib.cairn_team_pose_nees, _structs.new_pose("truth", truth)))

    @property
    def map(self) -> Map:
        """The team's map. It changes with the team."""
        return Map(self._lend(lib.cairn_team_map), owner=self)

    def score(self, truth: PoseLike) -> None:
        """Compares the present own pose with the true pose (position, quaternion). report() gives the means."""
        self._call(lib.cairn_team_score, _structs.new_pose("truth", truth))

    def report(self) -> TeamReport:
        """Report of the team so far."""
        return cast("TeamReport", self._report("cairn_team_report", lib.cairn_team_last_report))
