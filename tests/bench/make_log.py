#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a neutral log for the benchmarks to stdout: make_log.py LANDMARKS STEPS SEED

A vehicle drives two laps of a circle over hilly ground; its z axis is the normal of the ground. Landmarks lie in a ring
around the circle, up to 3 m above the ground. The vehicle sees the 12 nearest ones ahead of it, within 30 m and 70
degrees to either side. The noise is 2 cm and 0.1 degree on an increment, 0.1 m and 0.5 degree on an observation. log.hpp
describes the records.
"""
import math
import random
import sys

RADIUS = 80.0
RING = 25.0
REACH = 30.0
MOST_SEEN = 12
STEP_SECONDS = 0.2
DEGREE = math.pi / 180.0
HALF_VIEW = 70.0 * DEGREE


def ground(x, y):
    return 1.2 * math.sin(x / 21.0) + 1.1 * math.cos(y / 18.0)


def slope(x, y):
    return 1.2 / 21.0 * math.cos(x / 21.0), -1.1 / 18.0 * math.sin(y / 18.0)


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(p / length for p in a)


def euler(axes):
    """Roll, pitch and yaw of a body with these x, y and z axes."""
    x, y, z = axes
    return math.atan2(y[2], z[2]), math.asin(max(-1.0, min(1.0, -x[2]))), math.atan2(x[1], x[0])


class Vehicle:
    """Position and axes of the vehicle in the map."""

    def __init__(self, phase):
        x, y = RADIUS * math.cos(phase), RADIUS * math.sin(phase)
        rise_x, rise_y = slope(x, y)
        up = unit((-rise_x, -rise_y, 1.0))
        heading = (-math.sin(phase), math.cos(phase), 0.0)
        forward = unit(tuple(h - dot(heading, up) * u for h, u in zip(heading, up)))
        self.position = (x, y, ground(x, y))
        self.axes = (forward, cross(up, forward), up)

    def to_body(self, point):
        offset = tuple(p - q for p, q in zip(point, self.position))
        return tuple(dot(offset, axis) for axis in self.axes)

    def turn_to(self, other):
        """Axes of another pose in the axes of this one."""
        return tuple(tuple(dot(axis, own) for own in self.axes) for axis in other.axes)


def sight(vehicle, point):
    """Range, azimuth and elevation."""
    x, y, z = vehicle.to_body(point)
    return math.sqrt(x * x + y * y + z * z), math.atan2(y, x), math.atan2(z, math.hypot(x, y))


def place_landmarks(count, draw):
    landmarks = []
    for _ in range(count):
        bearing, distance = draw.uniform(-math.pi, math.pi), RADIUS + draw.uniform(-RING, RING)
        x, y = distance * math.cos(bearing), distance * math.sin(bearing)
        landmarks.append((x, y, ground(x, y) + draw.uniform(0.0, 3.0)))
    return landmarks


def write_log(count, steps, seed, out):
    draw = random.Random(seed)
    landmarks = place_landmarks(count, draw)

    def record(kind, *fields):
        out.write(" ".join([kind] + [f"{f:.9f}" if isinstance(f, float) else str(f) for f in fields]) + "\n")

    before = None
    for step in range(steps + 1):
        vehicle = Vehicle(4.0 * math.pi * step / steps)
        record("T", step, STEP_SECONDS * step, *vehicle.position, *euler(vehicle.axes))
        if before is not None:
            moved = [value + draw.gauss(0.0, 0.02) for value in before.to_body(vehicle.position)]
            turned = [value + draw.gauss(0.0, 0.1 * DEGREE) for value in euler(before.turn_to(vehicle))]
            record("O", step, *moved, *turned)
        before = vehicle
        seen = []
        for number, landmark in enumerate(landmarks):
            distance, azimuth, elevation = sight(vehicle, landmark)
            if distance < REACH and abs(azimuth) < HALF_VIEW:
                seen.append((distance, number, azimuth, elevation))
        for distance, number, azimuth, elevation in sorted(seen)[:MOST_SEEN]:
            record("Z", step, number, distance + draw.gauss(0.0, 0.1), azimuth + draw.gauss(0.0, 0.5 * DEGREE),
                   elevation + draw.gauss(0.0, 0.5 * DEGREE))
    for number, landmark in enumerate(landmarks):
        record("L", number, *landmark)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit("usage: make_log.py LANDMARKS STEPS SEED")
    write_log(int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.stdout)
