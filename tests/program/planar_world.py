# SPDX-License-Identifier: BSD-3-Clause
"""A small drive in the plane, twice around a rectangle among posts, and its records in two formats."""
import math
import random

MOTION_SIGMA = (0.02, 0.02, 0.005)  # m, m, rad
RANGE_SIGMA, BEARING_SIGMA = 0.05, 0.01
POINT_SIGMA = 0.05
SIGHT = 8.0


def compose(a, b):
    c, s = math.cos(a[2]), math.sin(a[2])
    return (a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], math.remainder(a[2] + b[2], 2 * math.pi))


def inverse(a):
    c, s = math.cos(a[2]), math.sin(a[2])
    return (-c * a[0] - s * a[1], s * a[0] - c * a[1], -a[2])


class World:
    """`moves` and `seen` are true; step k is reached by moves[k - 1]. The start is the origin."""

    def __init__(self, seed=1, laps=2):
        self.draw = random.Random(seed)
        self.posts = {10 + i: (self.draw.uniform(-4, 14), self.draw.uniform(-4, 10)) for i in range(12)}
        side = lambda length: [(0.5, 0.0, 0.0)] * (2 * length) + [(0.1, 0.05, math.pi / 2)]
        self.moves = laps * (side(10) + side(6) + side(10) + side(6))
        self.poses = [(0.0, 0.0, 0.0)]
        for move in self.moves:
            self.poses.append(compose(self.poses[-1], move))
        self.seen = []  # for each step: id, place in the body frame
        for pose in self.poses:
            places = {name: compose(inverse(pose), (*post, 0.0))[:2] for name, post in self.posts.items()}
            self.seen.append({name: p for name, p in places.items() if math.hypot(*p) < SIGHT})

    def noisy(self, values, sigmas):
        return [value + self.draw.gauss(0, sigma) for value, sigma in zip(values, sigmas)]

    def neutral(self, truth=True):
        """A planar neutral log."""
        lines = ["N " + " ".join(map(str, (*MOTION_SIGMA, RANGE_SIGMA, BEARING_SIGMA)))]
        for k, (pose, seen) in enumerate(zip(self.poses, self.seen)):
            if truth:
                lines.append("T %d %.1f %.9f %.9f %.9f" % (k, 0.5 * k, *pose))
            if k > 0:
                lines.append("O %d %.9f %.9f %.9f" % (k, *self.noisy(self.moves[k - 1], MOTION_SIGMA)))
            for name, (x, y) in seen.items():
                values = self.noisy((math.hypot(x, y), math.atan2(y, x)), (RANGE_SIGMA, BEARING_SIGMA))
                lines.append("Z %d %d %.9f %.9f" % (k, name, *values))
        if truth:
            lines += ["L %d %.9f %.9f" % (name, *post) for name, post in self.posts.items()]
        return "".join(line + "\n" for line in lines)

    def isam(self, noise=True):
        """iSAM's text form; without noise it is the file of the true values."""
        lines = []
        for k, seen in enumerate(self.seen):
            if k > 0:
                move = self.noisy(self.moves[k - 1], MOTION_SIGMA) if noise else self.moves[k - 1]
                lines.append("EDGE2 %d %d %.9f %.9f %.9f 50 0 0 50 0 200" % (k - 1, k, *move))
            for name, place in seen.items():
                x, y = self.noisy(place, (POINT_SIGMA, POINT_SIGMA)) if noise else place
                lines.append("LANDMARK %d %d %.9f %.9f 20 0 20" % (k, name, x, y))
        return "".join(line + "\n" for line in lines)
