# SPDX-License-Identifier: BSD-3-Clause
"""A rover drives a small circle among rocks. This is examples/rover.c in Python; it prints the same figures."""
import math

import cairn
import numpy as np

DEGREE = math.pi / 180.0
ROCKS = {101: (6.0, 1.0, 0.4), 102: (9.0, 7.0, 0.2), 103: (4.0, 11.0, 0.7), 104: (-3.0, 12.0, 0.3), 105: (-8.0, 8.0, 0.5),
         106: (-9.0, 1.0, 0.1), 107: (-5.0, -4.0, 0.6), 108: (1.0, -5.0, 0.3), 109: (12.0, -2.0, 0.9),
         110: (15.0, 12.0, 1.2), 111: (0.5, 4.5, 0.2), 112: (-14.0, 14.0, 0.8), 113: (-12.0, -6.0, 0.4),
         114: (7.0, -11.0, 0.5)}
STEPS = 300


class Noise:
    """Roughly normal, the same in every run."""

    def __init__(self):
        self.state = 1

    def __call__(self, sigma):
        total = -6.0
        for _ in range(12):
            self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
            total += (self.state >> 11) / 9007199254740992.0
        return sigma * total


class Truth:
    """The true rover: wheels of 0.3 m radius, 1 m apart."""

    x = y = yaw = 0.0

    def drive(self, dt, left, right):
        speed, turn = 0.3 * (left + right) / 2.0, 0.3 * (right - left) / 1.0
        self.x += speed * dt * math.cos(self.yaw + turn * dt / 2.0)
        self.y += speed * dt * math.sin(self.yaw + turn * dt / 2.0)
        self.yaw += turn * dt

    def look(self, noise, range_sigma, angle_sigma):
        """Range, azimuth and elevation of every rock within 12 m and 60 degrees to either side."""
        ids, z = [], []
        for name, (x, y, height) in ROCKS.items():
            dx, dy = x - self.x, y - self.y
            forward = math.cos(self.yaw) * dx + math.sin(self.yaw) * dy
            left = math.cos(self.yaw) * dy - math.sin(self.yaw) * dx
            flat, azimuth = math.sqrt(dx * dx + dy * dy), math.atan2(left, forward)
            if flat > 12.0 or flat < 1.0 or abs(azimuth) > 60.0 * DEGREE:
                continue
            ids.append(name)
            z.append((math.sqrt(flat * flat + height * height) + noise(range_sigma), azimuth + noise(angle_sigma),
                      math.atan2(height, flat) + noise(angle_sigma)))
        return ids, z


def main():
    noise, truth = Noise(), Truth()
    with cairn.Filter(max_landmarks=100) as rover:  # all memory is allocated here
        camera = rover.add_stereo_head(range_sigma=0.1, azimuth_sigma=DEGREE, elevation_sigma=DEGREE)
        results = []
        for _ in range(STEPS):
            # The wheels turn. The encoders measure their rates with noise.
            dt, left, right = 0.2, 1.6, 2.0
            truth.drive(dt, left, right)
            right_noise, left_noise = noise(0.01), noise(0.01)  # GCC computes the arguments of the C program in this order
            rover.predict_wheels(dt, left + left_noise, right + right_noise)
            # One frame: all its observations go in together, and each gets its match.
            results.extend(rover.update(camera, *truth.look(noise, 0.1, DEGREE))["result"])

        position, quaternion, covariance = rover.pose()
        sigma = 3.0 * np.sqrt(np.diag(covariance))
        yaw = cairn.quaternion_to_euler(quaternion)[2]
        print(f"{STEPS} steps; {results.count(cairn.Result.MATCHED)} observations matched, {results.count(cairn.Result.NEW)} placed a rock,"
              f" {results.count(cairn.Result.REJECTED)} were rejected")
        print(f"pose    x {position[0]:6.2f} +- {sigma[0]:.2f} m   y {position[1]:6.2f} +- {sigma[1]:.2f} m   "
              f"yaw {yaw / DEGREE:6.1f} +- {sigma[5] / DEGREE:.1f} deg   (3 sigma)")
        print(f"truth   x {truth.x:6.2f}          y {truth.y:6.2f}          "
              f"yaw {math.atan2(math.sin(truth.yaw), math.cos(truth.yaw)) / DEGREE:6.1f}")
        for rock in rover.map.within(position, 30.0):  # nearest first
            at, spread = rock["position"], 3.0 * np.sqrt(np.diag(rock["covariance"]))
            print(f"rock {rock['id']:3d}  x {at[0]:6.2f} +- {spread[0]:.2f} m   y {at[1]:6.2f} +- {spread[1]:.2f} m   "
                  f"z {at[2]:5.2f} +- {spread[2]:.2f} m   seen {rock['observations']} times")


if __name__ == "__main__":
    main()
