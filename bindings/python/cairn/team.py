# SPDX-License-Identifier: BSD-3-Clause
"""One vehicle's view of a team of planar vehicles: report motion and scans, exchange packets, query estimates."""
import numpy as np

from . import _structs
from ._handle import Handle
from ._library import ffi, lib
from .error import check
from .map import Map
from .pose import Pose


class Team(Handle):
    """One vehicle's view of its team. Each vehicle has its own Team object. The vehicles exchange packets: bytes that
    any transport may carry, in any order and repeatedly.

    Options are the fields of cairn_team_options by name: Team(vehicle=1, mode="joint", baseline=1). `filter` holds
    fields of cairn_filter_options, with a planar vehicle by default. `radar` holds fields of cairn_range_bearing; the
    radar must be the same at all vehicles.

        boat = cairn.Team(vehicle=1, filter={"max_landmarks": 40, "initial_pose": start}, radar={"range_sigma": 30})
        boat.add(2, start=start_of_2)
        boat.predict_twist(5.0, (1.1, 0, 0), (0, 0, 0.004))
        boat.observe(5.0, (feature_ids, ranges_and_bearings), (boat_numbers, ranges_and_bearings))
        for packet in boat.packets():
            send(packet)                          # packets of teammates go to boat.receive(packet)
        position, quaternion, covariance = boat.pose()
    """

    WHAT = "team"

    def __init__(self, filter=None, radar=None, **options):
        settings = _structs.new("cairn_team_options", options)
        filter_settings = _structs.new("cairn_filter_options", {"vehicle": "planar", **(filter or {})})
        created = ffi.new("cairn_team **")
        check(lib.cairn_team_create(settings, filter_settings, _structs.new("cairn_range_bearing", radar or {}), created))
        self.vehicle = settings.vehicle  # number of this vehicle
        super().__init__(created[0], lib.cairn_team_destroy)

    def _call(self, function, *arguments):
        with self._use() as handle:
            check(function(handle, *arguments))

    # Members.

    def add(self, vehicle, start=None, covariance=None):
        """Adds a teammate. start: the teammate's initial pose (position, quaternion), the same that its own team uses.
        covariance: of the start's error [dp; dtheta], 6 x 6; without it the start is exact. Without a start, the
        teammate is found by the first mutual sightings."""
        if start is None and covariance is not None:
            raise TypeError("covariance: it belongs to `start`, which is not given")
        start = ffi.NULL if start is None else _structs.new_pose("start", start)
        covariance = None if covariance is None else _structs.array("covariance", covariance, (6, 6))
        self._call(lib.cairn_team_add, vehicle, start, ffi.NULL if covariance is None else _structs.doubles(covariance))

    def remove(self, vehicle):
        """Removes a teammate: its packets are no longer awaited or accepted. Its information stays in the estimate."""
        self._call(lib.cairn_team_remove, vehicle)

    def members(self):
        """Numbers of the team's vehicles; this vehicle is the first."""
        with self._use() as handle:
            return _structs.filled("uint64_t", lambda *buffer: lib.cairn_team_members(handle, *buffer))

    # This vehicle.

    def predict_increment(self, T_before_after, covariance):
        """Moves this vehicle by a relative pose, (position, quaternion), with the covariance of its error (6 x
        6)."""
        covariance = _structs.array("covariance", covariance, (6, 6))
        self._call(lib.cairn_team_predict_increment, _structs.new_pose("T_before_after", T_before_after),
                   _structs.doubles(covariance))

    def predict_twist(self, dt, velocity, rate, **noise):
        """Moves this vehicle by its body velocity (3, m/s) and body rate (3, rad/s) over dt (s). noise: fields of
        cairn_twist_noise."""
        velocity, rate = _structs.array("velocity", velocity, (3,)), _structs.array("rate", rate, (3,))
        self._call(lib.cairn_team_predict_twist, dt, _structs.doubles(velocity), _structs.doubles(rate),
                   _structs.new("cairn_twist_noise", noise))

    def observe(self, time, landmarks=None, vehicles=None):
        """Ends a step of this vehicle at `time` (s, on a clock that all vehicles share) with its scan. `landmarks`
        and `vehicles` are each None, (ids, z) or (ids, z, covariance) with z n x 2: range (m) and bearing (rad); or an
        array of observations, such as a Fleet's.

        Motion and scan become a packet. They are processed as soon as the packets of all teammates up to this time are
        there."""
        frames = []
        for name, seen in (("landmarks", landmarks), ("vehicles", vehicles)):
            if isinstance(seen, (tuple, list)) and not 2 <= len(seen) <= 3:
                raise TypeError(f"{name}: must be (ids, z) or (ids, z, covariance), and has {len(seen)} parts")
            parts = seen if isinstance(seen, (tuple, list)) else ((), ()) if seen is None else (seen, None)
            frames.append(_structs.observations(*parts))
        arguments = [part for frame in frames for part in (ffi.from_buffer("cairn_observation *", frame), len(frame))]
        self._call(lib.cairn_team_observe, time, *arguments)

    def decisions(self):
        """Matches of the last scan of this vehicle that was processed, as Filter.update gives them: landmarks, then vehicles."""
        with self._use() as handle:
            return _structs.filled("cairn_match", lambda *buffer: lib.cairn_team_decisions(handle, *buffer))

    def leave(self):
        """Leaves the team: makes a last packet, after which teammates no longer wait for this vehicle."""
        self._call(lib.cairn_team_leave)

    # Packets.

    def take_packet(self):
        """The next packet to send to all teammates, bytes; None if there is none."""
        needed = ffi.new("size_t *")
        with self._use() as handle:
            check(lib.cairn_team_take_packet(handle, ffi.NULL, 0, needed))
            if needed[0] == 0:
                return None
            packet = ffi.new("uint8_t[]", needed[0])
            check(lib.cairn_team_take_packet(handle, packet, needed[0], needed))
        return ffi.buffer(packet)[:]

    def packets(self):
        """Iterates over the packets to send until there is none."""
        return iter(self.take_packet, None)

    def receive(self, packet):
        """Receives a packet of a teammate (bytes). Packets may come late, in any order and repeatedly. Returns the
        result: cairn.PACKET_TAKEN, PACKET_WAITING, PACKET_CORRUPT, ... A refused packet changes nothing and is not an
        error."""
        result = ffi.new("int32_t *")
        content = ffi.from_buffer("uint8_t[]", packet)
        self._call(lib.cairn_team_receive, content, len(content), result)
        return result[0]

    def ask(self):
        """Asks the teammates for all missing packets: the next packets to send contain the requests."""
        self._call(lib.cairn_team_ask)

    # Estimates.

    def pose(self, vehicle=None):
        """Pose of a vehicle of the team, by default of this vehicle: position (3, m), quaternion (4, w x y z),
        covariance of [dp; dtheta] (6 x 6). Raises CairnError (CAIRN_ERROR_NOT_FOUND) if the pose is not known."""
        pose, covariance = ffi.new("cairn_pose *"), np.zeros((6, 6))
        self._call(lib.cairn_team_pose, self.vehicle if vehicle is None else vehicle, pose, _structs.doubles(covariance))
        return (*Pose.of(pose), covariance)

    def pose_nees(self, truth):
        """Normalised estimation error squared of this vehicle's pose against a true one, (position, quaternion):
        about 3 on average.
        CairnError (CAIRN_ERROR_NUMERICAL) where the covariance of this vehicle's pose is singular."""
        nees = ffi.new("double *")
        self._call(lib.cairn_team_pose_nees, _structs.new_pose("truth", truth), nees)
        return nees[0]

    @property
    def map(self):
        """The team's map. It changes with the team."""
        with self._use() as handle:
            return Map(lib.cairn_team_map(handle), owner=self)

    def score(self, truth):
        """Compares the present own pose with the true pose (position, quaternion). report() gives the means."""
        self._call(lib.cairn_team_score, _structs.new_pose("truth", truth))

    def report(self):
        """Report of the team so far: cairn_team_report as a dictionary."""
        with self._use() as handle:
            return _structs.report("cairn_team_report", lambda report: lib.cairn_team_last_report(handle, report))
