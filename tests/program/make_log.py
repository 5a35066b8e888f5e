#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a small neutral text log to stdout: make_log.py LANDMARKS STEPS SEED

A vehicle goes round an ellipse over a bumpy floor, twice, among landmarks strewn over a square; it sees the nearest eight
within 15 m, all around. The noise is that which the reader assumes.
"""
import math
import random
import sys

HALF_SIDE = 25.0
SIGHT = 15.0
MOST_SEEN = 8
DEGREE = math.pi / 180


class Rotation:
    """A unit quaternion w x y z."""

    def __init__(self, w, x, y, z):
        n = math.sqrt(w * w + x * x + y * y + z * z)
        self.w, self.x, self.y, self.z = w / n, x / n, y / n, z / n

    @staticmethod
    def about(axis, angle):
        s = math.sin(angle / 2)
        return Rotation(math.cos(angle / 2), s * (axis == "x"), s * (axis == "y"), s * (axis == "z"))

    @staticmethod
    def from_euler(roll, pitch, yaw):
        return Rotation.about("z", yaw) * Rotation.about("y", pitch) * Rotation.about("x", roll)

    def __mul__(self, o):
        return Rotation(self.w * o.w - self.x * o.x - self.y * o.y - self.z * o.z,
                        self.w * o.x + self.x * o.w + self.y * o.z - self.z * o.y,
                        self.w * o.y - self.x * o.z + self.y * o.w + self.z * o.x,
                        self.w * o.z + self.x * o.y - self.y * o.x + self.z * o.w)

    def inverse(self):
        return Rotation(self.w, -self.x, -self.y, -self.z)

    def turn(self, v):
        ux, uy, uz = self.x, self.y, self.z
        cx, cy, cz = uy * v[2] - uz * v[1], uz * v[0] - ux * v[2], ux * v[1] - uy * v[0]
        tx, ty, tz = 2 * cx, 2 * cy, 2 * cz
        return (v[0] + self.w * tx + uy * tz - uz * ty, v[1] + self.w * ty + uz * tx - ux * tz,
                v[2] + self.w * tz + ux * ty - uy * tx)

    def euler(self):
        w, x, y, z = self.w, self.x, self.y, self.z
        return (math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
                math.asin(max(-1.0, min(1.0, 2 * (w * y - x * z)))),
                math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))


def true_pose(k, steps):
    phase = 4 * math.pi * k / steps
    x, y = 16 * math.cos(phase), 11 * math.sin(phase)
    heading = math.atan2(11 * math.cos(phase), -16 * math.sin(phase))
    position = (x, y, 0.4 * math.sin(3 * phase))
    return position, Rotation.from_euler(0.06 * math.sin(5 * phase), 0.05 * math.cos(4 * phase), heading)


def between(before, after):
    difference = [a - b for a, b in zip(after[0], before[0])]
    back = before[1].inverse()
    return back.turn(difference), back * after[1]


def numbers(values):
    return " ".join("%.9f" % value for value in values)


def write_log(landmark_count, steps, seed, out):
    draw = random.Random(seed)
    landmarks = {}
    for identity in range(1, landmark_count + 1):
        landmarks[identity] = (draw.uniform(-HALF_SIDE, HALF_SIDE), draw.uniform(-HALF_SIDE, HALF_SIDE),
                               draw.uniform(0.5, 3.0))
    before = None
    for k in range(steps + 1):
        pose = true_pose(k, steps)
        out.write("T %d %.3f %s %s\n" % (k, 0.25 * k, numbers(pose[0]), numbers(pose[1].euler())))
        if before:
            moved, turned = between(before, pose)
            moved = [value + draw.gauss(0, 0.02) for value in moved]
            turned = [value + draw.gauss(0, 0.1 * DEGREE) for value in turned.euler()]
            out.write("O %d %s %s\n" % (k, numbers(moved), numbers(turned)))
        before = pose
        seen = []
        for identity, landmark in landmarks.items():
            x, y, z = pose[1].inverse().turn([a - b for a, b in zip(landmark, pose[0])])
            distance = math.sqrt(x * x + y * y + z * z)
            if 1.0 < distance < SIGHT:
                seen.append((distance, identity, math.atan2(y, x), math.atan2(z, math.hypot(x, y))))
        for distance, identity, azimuth, elevation in sorted(seen)[:MOST_SEEN]:
            out.write("Z %d %d %s\n" % (k, identity, numbers((distance + draw.gauss(0, 0.1),
                                                              azimuth + draw.gauss(0, 0.5 * DEGREE),
                                                              elevation + draw.gauss(0, 0.5 * DEGREE)))))
    for identity, landmark in landmarks.items():
        out.write("L %d %s\n" % (identity, numbers(landmark)))


if __name__ == "__main__":
    write_log(int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.stdout)
