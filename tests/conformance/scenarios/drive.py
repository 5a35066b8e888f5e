# SPDX-License-Identifier: BSD-3-Clause
"""A small simulated drive, whose measurements are the literal inputs of scenarios.

The rover drives in the plane among points that stand at several heights. Measurements are rounded to a few digits: the
files stay short, and do not depend on the last digits of Python's functions."""

import math
import random

from .scenario import seen


def rounded(value):
    return round(value, 4)


class Drive:
    """True pose and landmarks, and the noise of the measurements."""

    def __init__(self, seed, landmarks=40, size=30.0, noise=1.0, heights=True):
        self.random = random.Random(seed)
        self.x = self.y = self.yaw = 0.0
        self.noise = noise
        uniform = self.random.uniform
        self.landmarks = {
            number: (uniform(-size, size), uniform(-size, size), uniform(-1.0, 2.0) if heights else 0.0)
            for number in range(1, landmarks + 1)
        }

    def gauss(self, sigma):
        return self.random.gauss(0.0, sigma) * self.noise

    def move(self, speed, rate, dt):
        """Moves the rover. Returns the measured speed and rate."""
        angle = rate * dt
        chord = speed * dt * (math.sin(angle / 2) / (angle / 2) if angle else 1.0)
        self.x += chord * math.cos(self.yaw + angle / 2)
        self.y += chord * math.sin(self.yaw + angle / 2)
        self.yaw += angle
        return rounded(speed + self.gauss(0.02)), rounded(rate + self.gauss(0.004))

    def twist(self, s, handle, speed, rate, dt=1.0, function="cairn_filter_predict_twist", **more):
        """A call that predicts by the measured twist."""
        speed, rate = self.move(speed, rate, dt)
        name = function.split("_")[1]
        s.call(function, **{name: handle}, dt=dt, velocity=[speed, 0.0, 0.0], rate=[0.0, 0.0, rate], **more)

    def wheels(self, s, handle, speed, rate, dt=1.0, radius=0.3, track=1.0):
        """A call that predicts by the turning rates of the wheels."""
        speed, rate = self.move(speed, rate, dt)
        left, right = (speed - rate * track / 2) / radius, (speed + rate * track / 2) / radius
        s.call("cairn_filter_predict_wheels", filter=handle, dt=dt, left_rad_per_s=rounded(left),
               right_rad_per_s=rounded(right))

    def body(self, landmark):
        """A landmark in the body."""
        dx, dy = landmark[0] - self.x, landmark[1] - self.y
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        return cos * dx + sin * dy, -sin * dx + cos * dy, landmark[2]

    def near(self, reach, most, ahead=False):
        """Numbers and body points of the nearest landmarks, by number."""
        points = {number: self.body(point) for number, point in self.landmarks.items()}
        inside = sorted((math.hypot(*p), number) for number, p in points.items()
                        if 1.0 < math.hypot(*p) < reach and (p[0] > 1.0 or not ahead))
        return [(number, points[number]) for number in sorted(number for _, number in inside[:most])]

    def cartesian(self, reach=15.0, most=6, sigma=0.05, rows=3):
        """A frame of points in the body."""
        return [seen(number, *(rounded(value + self.gauss(sigma)) for value in point[:rows]))
                for number, point in self.near(reach, most)]

    def head(self, reach=15.0, most=6, sigma=(0.1, 0.01, 0.01)):
        """A frame of a stereo head at the origin of the body: range, azimuth, elevation."""
        frame = []
        for number, (x, y, z) in self.near(reach, most, ahead=True):
            values = math.hypot(x, y, z), math.atan2(y, x), math.atan2(z, math.hypot(x, y))
            frame.append(seen(number, *(rounded(v + self.gauss(s)) for v, s in zip(values, sigma))))
        return frame

    def camera(self, reach=12.0, most=6, fu=500.0, centre=(320.0, 240.0), baseline=0.2, sigma=0.5):
        """A frame of a stereo camera at the origin of the body that looks along x: u left, u right, v."""
        frame = []
        for number, (x, y, z) in self.near(reach, most, ahead=True):
            values = -fu * y / x + centre[0], fu * (-y - baseline) / x + centre[0], -fu * z / x + centre[1]
            frame.append(seen(number, *(round(value + self.gauss(sigma), 2) for value in values)))
        return frame

    def radar(self, reach=20.0, most=8, sigma=(0.1, 0.01)):
        """A frame of ranges and bearings in the plane."""
        frame = []
        for number, (x, y, _) in self.near(reach, most):
            values = math.hypot(x, y), math.atan2(y, x)
            frame.append(seen(number, *(rounded(v + self.gauss(s)) for v, s in zip(values, sigma))))
        return frame

    def pose(self):
        """The true pose."""
        half = self.yaw / 2
        return {"position": [rounded(self.x), rounded(self.y), 0.0],
                "quaternion": [rounded(math.cos(half)), 0.0, 0.0, rounded(math.sin(half))]}
