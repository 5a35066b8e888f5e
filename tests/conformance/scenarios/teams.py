# SPDX-License-Identifier: BSD-3-Clause
"""Teams: two boats that exchange packets, every mode, and packets that come late, twice, wrong or not at all."""

import math
import struct
import zlib

from .drive import Drive
from .scenario import Scenario, diagonal, pose, seen

FILTER = {"vehicle": "CAIRN_VEHICLE_PLANAR", "max_landmarks": 40, "max_observations": 20}
RADAR = {"range_sigma": 0.1, "bearing_sigma": 0.01}
NOISE = {"velocity_sigma": [0.02, 0.0, 0.0], "rate_sigma": [0.0, 0.0, 0.004]}


class Boat:
    """One vehicle: its true drive and its handle."""

    def __init__(self, s, number, y, mode, name=None, options=None, **more):
        self.s, self.number = s, number
        self.drive = Drive(41, landmarks=30, size=20.0, heights=False)
        self.drive.random.seed(number)
        self.drive.y = y
        self.team = s.call("cairn_team_create", gives={"team": name or f"$boat{number}"},
                           options={"mode": mode, "vehicle": str(number), **(options or {})},
                           filter={**FILTER, "initial_pose": self.start(), **more}, radar=RADAR)

    def start(self):
        return pose(0.0, self.drive.y)

    def step(self, time, others=(), increments=False):
        """Moves, observes landmarks and the other boats, and names the packet."""
        s, drive = self.s, self.drive
        if time > 0.0:
            if increments:
                speed, rate = drive.move(1.0, 0.08, 1.0)
                half = round(rate / 2, 6)
                s.call("cairn_team_predict_increment", team=self.team,
                       T_before_after=pose(speed, 0.0, 0.0, (math.sqrt(1 - half * half), 0.0, 0.0, half)),
                       covariance=diagonal(1e-3, 1e-4, 0.0, 0.0, 0.0, 1e-5))
            else:
                drive.twist(s, self.team, 1.0, 0.08, function="cairn_team_predict_twist", noise=NOISE)
        vehicles = []
        for other in others:
            x, y, _ = drive.body((other.drive.x, other.drive.y, 0.0))
            vehicles.append(seen(other.number, round(math.hypot(x, y), 3), round(math.atan2(y, x), 4)))
        s.call("cairn_team_observe", team=self.team, time=time, landmarks=drive.radar(most=5), vehicles=vehicles)
        return self.take()

    def take(self, name=None):
        return self.s.call("cairn_team_take_packet", gives={"packet": name or f"$packet{self.number}"},
                           team=self.team)

    def receive(self, packet):
        self.s.call("cairn_team_receive", team=self.team, packet=packet)

    def ask_all(self, *vehicles):
        s = self.s
        for vehicle in vehicles:
            s.call("cairn_team_pose", team=self.team, vehicle=str(vehicle))
        s.call("cairn_team_decisions", team=self.team)
        s.call("cairn_team_last_report", team=self.team)
        themap = s.call("cairn_team_map", gives={"return": f"$map{self.number}"}, team=self.team)
        s.call("cairn_map_landmarks", map=themap)


def pair(s, mode, one=None, two=None, **more):
    """Two boats that know where both start."""
    boats = Boat(s, 1, 0.0, mode, options=one, **more), Boat(s, 2, 6.0, mode, options=two, **more)
    for boat, other in boats, boats[::-1]:
        s.call("cairn_team_add", team=boat.team, vehicle=str(other.number), start=other.start())
    return boats


def together(name, about, mode, sight=True, **more):
    s = Scenario(name, about)
    a, b = pair(s, mode, one={"baseline": mode == "CAIRN_TEAM_JOINT"}, **more)
    for step in range(8):
        packets = [boat.step(float(step), [other] if sight else [], increments=step == 3)
                   for boat, other in ((a, b), (b, a))]
        a.receive(packets[1])
        b.receive(packets[0])
        if step > 2:
            s.call("cairn_team_score", team=a.team, truth=a.drive.pose())
    a.ask_all(1)
    b.ask_all(2)
    if mode in ("CAIRN_TEAM_JOINT", "CAIRN_TEAM_SUBMAPS"):
        s.call("cairn_team_pose", team=a.team, vehicle="2")
    else:
        s.wrong("NOT_FOUND", "cairn_team_pose", team=a.team, vehicle="2")
    s.call("cairn_team_pose_nees", team=b.team, truth=b.drive.pose())
    s.call("cairn_team_members", team=a.team)
    return s


def joint():
    return together("team_joint", "Both boats run one filter over both poses and all landmarks.", "CAIRN_TEAM_JOINT")


def mono():
    return together("team_mono", "Each boat by itself: packets are ignored.", "CAIRN_TEAM_MONO")


def eo_full():
    return together("team_eo_full", "Extended observations with full noise.", "CAIRN_TEAM_EO_FULL")


def eo_diagonal():
    return together("team_eo_diagonal", "Extended observations as printed in the paper.", "CAIRN_TEAM_EO_DIAGONAL")


def submaps():
    return together("team_submaps", "Each boat in its own submaps, fused by their common landmarks.",
                    "CAIRN_TEAM_SUBMAPS",
                    sight=False, submap_landmarks=6, join="CAIRN_JOIN_SPARSE")


def sealed(version=1, kind=1, size=None, body=bytes(40), damage=0):
    """Bytes that begin as a packet, with a checksum."""
    size = 12 + len(body) + 4 if size is None else size
    packet = b"CRNP" + struct.pack("<HHI", version, kind, size) + body
    return "bytes:" + (packet + struct.pack("<I", zlib.crc32(packet) ^ damage)).hex()


def packets():
    s = Scenario("team_packets",
                 "Packets that are late, repeated, own, foreign, damaged, contradicting, ahead of time, too many.")
    a, b = pair(s, "CAIRN_TEAM_JOINT", one={"max_waiting": 3})
    impostor = Boat(s, 2, 6.0, "CAIRN_TEAM_JOINT", name="$impostor")
    stranger = Boat(s, 7, 9.0, "CAIRN_TEAM_JOINT", name="$stranger")
    s.call("cairn_team_take_packet", team=a.team)  # none yet: no bytes
    names = {}
    for step in range(6):
        own = a.step(float(step))
        for boat, key in ((b, "b"), (impostor, "i")):
            names[key, step] = f"${key}{step}"
            time = float(step) if key == "b" or step == 0 else step / 10
            boat.step(time)
            s.calls[-1]["gives"] = {"packet": names[key, step]}
    a.receive(own)                                  # own
    a.receive(names["b", 1])                        # waiting: 0 is missing
    a.receive(names["b", 1])                        # repeated
    a.receive(names["b", 2])                        # waiting
    a.receive(names["b", 0])                        # taken
    a.receive(names["i", 1])                        # conflict
    a.receive(names["i", 3])                        # past: number 3, and earlier than number 2
    stranger.step(0.0)
    a.receive("$packet7")                           # unknown
    for wrong in ("bytes:00ff10", sealed(version=99), sealed(size=4000), sealed(damage=1), sealed(kind=77)):
        a.receive(wrong)                            # foreign, another version, cut, corrupt, nonsense
    s.call("cairn_team_ask", team=a.team)
    a.take("$request")
    # Three packets of a boat that was out of reach, then its farewell; another boat has a wrong clock.
    for step in 3, 4, 5:
        a.receive(names["b", step])
    s.call("cairn_team_leave", team=b.team)
    a.receive(b.take())                             # leave
    s.call("cairn_team_members", team=a.team)
    narrow = Boat(s, 9, 0.0, "CAIRN_TEAM_JOINT", options={"max_waiting": 1})
    s.call("cairn_team_add", team=narrow.team, vehicle="2", start=b.start())
    narrow.receive(names["b", 1])                   # waiting
    narrow.receive(names["b", 2])                   # full
    late = Boat(s, 3, -5.0, "CAIRN_TEAM_JOINT", options={"max_jump": 1000.0})
    s.call("cairn_team_add", team=a.team, vehicle="3", start=late.start(),
           covariance=diagonal(0.01, 0.01, 0, 0, 0, 0.001))
    a.receive(late.step(6.0))
    a.receive(late.step(500.0))                     # ahead
    s.call("cairn_team_remove", team=a.team, vehicle="3")
    s.call("cairn_team_members", team=a.team)
    a.ask_all(1)
    alone = Boat(s, 8, 0.0, "CAIRN_TEAM_MONO")
    s.call("cairn_team_add", team=alone.team, vehicle="2")
    alone.receive(names["b", 0])                    # ignored
    s.call("cairn_team_destroy", team=alone.team)
    return s


def lost_packets():
    s = Scenario("team_lost", "Packets are lost; the boat asks for them, and gets them again.")
    a, b = pair(s, "CAIRN_TEAM_JOINT")
    for step in range(5):
        b.step(float(step), [a])
        if step in (0, 4):
            a.receive("$packet2")
        a.step(float(step), [b])
    s.call("cairn_team_last_report", team=a.team)
    s.call("cairn_team_ask", team=a.team)
    a.take("$asked")
    b.receive("$asked")                             # request
    for _ in range(3):
        a.receive(b.take("$again"))
    a.ask_all(1, 2)
    return s


def unknown_start():
    s = Scenario("team_unknown_start", "The start of a teammate is unknown: the first mutual sighting solves it.")
    a = Boat(s, 1, 0.0, "CAIRN_TEAM_JOINT")
    b = Boat(s, 2, 6.0, "CAIRN_TEAM_JOINT")
    for boat, other in (a, b), (b, a):
        s.call("cairn_team_add", team=boat.team, vehicle=str(other.number))
    s.wrong("NOT_FOUND", "cairn_team_pose", team=a.team, vehicle="2")
    for step in range(3):
        packets = a.step(float(step), [b]), b.step(float(step), [a])
        a.receive(packets[1])
        b.receive(packets[0])
    a.ask_all(1, 2)
    return s


def wrong():
    s = Scenario("team_wrong", "What a team refuses: numbers, times, options, and its own steps after it has left.")
    planar = {"vehicle": "CAIRN_VEHICLE_PLANAR"}
    s.wrong("ARGUMENT", "cairn_team_create", options={}, filter={}, radar=RADAR)
    s.wrong("ARGUMENT", "cairn_team_create", options={"mode": "CAIRN_TEAM_SUBMAPS"}, filter=planar, radar=RADAR)
    s.wrong("ARGUMENT", "cairn_team_create", options={}, filter={**planar, "submap_landmarks": 10}, radar=RADAR)
    s.wrong("ARGUMENT", "cairn_team_create", options={"vehicle": "18446744073709551615"}, filter=planar, radar=RADAR)
    s.wrong("ARGUMENT", "cairn_team_create", options={"max_lag": 0.0}, filter=planar, radar=RADAR)
    s.wrong("ARGUMENT", "cairn_team_create", options={"time_tolerance": -1.0}, filter=planar, radar=RADAR)
    s.wrong("ARGUMENT", "cairn_team_create", options={"max_jump": "nan"}, filter=planar, radar=RADAR)
    s.wrong("ARGUMENT", "cairn_team_create", options={"max_vehicles": 0}, filter=planar, radar=RADAR)
    s.wrong("ARGUMENT", "cairn_team_create", options={"max_waiting": 0}, filter=planar, radar=RADAR)
    s.wrong("ARGUMENT", "cairn_team_create", options={"history": 0}, filter=planar, radar=RADAR)
    s.wrong("ARGUMENT", "cairn_team_create", options={}, filter=planar, radar={"range_sigma": 0.0})
    a = Boat(s, 1, 0.0, "CAIRN_TEAM_JOINT", options={"max_vehicles": 2})
    team = a.team
    s.wrong("ARGUMENT", "cairn_team_add", team=team, vehicle="1", start=pose(1.0))
    s.wrong("ARGUMENT", "cairn_team_add", team=team, vehicle="2", start=pose(1.0),
            covariance=diagonal(-1, 1, 0, 0, 0, 1))
    s.call("cairn_team_add", team=team, vehicle="2", start=pose(1.0))
    s.wrong("ARGUMENT", "cairn_team_add", team=team, vehicle="2", start=pose(1.0))
    s.wrong("CAPACITY", "cairn_team_add", team=team, vehicle="3", start=pose(1.0))
    s.wrong("NOT_FOUND", "cairn_team_remove", team=team, vehicle="3")
    s.wrong("ARGUMENT", "cairn_team_remove", team=team, vehicle="1")
    s.wrong("NOT_FOUND", "cairn_team_pose", team=team, vehicle="3")
    s.wrong("ARGUMENT", "cairn_team_predict_twist", team=team, dt=0.0, velocity=[1.0, 0.0, 0.0], rate=[0.0, 0.0, 0.0])
    s.wrong("ARGUMENT", "cairn_team_predict_increment", team=team,
            T_before_after=pose(quaternion=(0.0, 0.0, 0.0, 0.0)),
            covariance=[0.0] * 36)
    s.wrong("NUMERICAL", "cairn_team_pose_nees", team=team, truth=pose())
    s.wrong("ARGUMENT", "cairn_team_score", team=team, truth=pose("nan"))
    a.step(1.0)
    s.wrong("ARGUMENT", "cairn_team_observe", team=team, time=0.5, landmarks=[], vehicles=[])
    s.wrong("ARGUMENT", "cairn_team_observe", team=team, time="nan", landmarks=[], vehicles=[])
    s.wrong("ARGUMENT", "cairn_team_observe", team=team, time=2.0, landmarks=[seen(1, 5.0, 0.0), seen(1, 6.0, 0.0)],
            vehicles=[])
    s.wrong("ARGUMENT", "cairn_team_observe", team=team, time=2.0, landmarks=[], vehicles=[seen(1, 5.0, 0.0)])
    s.wrong("ARGUMENT", "cairn_team_observe", team=team, time=1000.0, landmarks=[], vehicles=[])
    s.call("cairn_team_leave", team=team)
    s.wrong("STATE", "cairn_team_leave", team=team)
    s.wrong("STATE", "cairn_team_observe", team=team, time=3.0, landmarks=[], vehicles=[])
    return s


SCENARIOS = [joint, mono, eo_full, eo_diagonal, submaps, packets, lost_packets, unknown_start, wrong]
