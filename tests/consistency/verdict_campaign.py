#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How often the verdict is right: false alarms on clean runs, and whether injected faults are found within 50 updates.

    verdict_campaign.py [--runs N] [--vehicle planar|spatial] [--map single|submaps] [--fault NAME ...] [--check]

The vehicle drives laps among landmarks. Its measurements have exactly the stated noise until the fault begins. --check
fails unless the figures hold that docs/trust.md promises. The table goes to stdout.
"""
import argparse
import os
import pickle
import sys

import numpy as np

import cairn

FRAMES, FAULT, WITHIN, MOTIONS, STEP = 300, 150, 50, 5, 0.2  # frames; motions of STEP seconds in a frame
SPEED, RADIUS, LANDMARKS, SIGHT = 2.0, 45.0, 150, 22.0
VELOCITY_SIGMA, RATE_SIGMA = 0.05, 0.005
SIGMA = {"planar": np.array([0.2, 0.02]), "spatial": np.array([0.2, 0.02, 0.02])}
FAULTS = ["clean", "bias", "sensor noise", "motion noise", "slip", "wrong pairing", "moved landmark", "kidnapping"]


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def exp(velocity, rate, dt):
    """The rotation and translation of a constant twist."""
    w, v = rate * dt, velocity * dt
    angle = np.linalg.norm(w)
    if angle < 1e-9:
        return np.eye(3) + skew(w), v
    K = skew(w / angle)
    R = np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
    V = np.eye(3) + (1 - np.cos(angle)) / angle * K + (angle - np.sin(angle)) / angle * K @ K
    return R, V @ v


class World:
    """A vehicle on a circle among landmarks. A spatial one pitches and rolls, and its landmarks have heights."""

    def __init__(self, vehicle, seed):
        self.random = np.random.default_rng(seed)
        self.planar = vehicle == "planar"
        self.sigma = SIGMA[vehicle].copy()
        self.motion_noise = 1.0
        self.bias = np.zeros(3)
        azimuth = self.random.uniform(0, 2 * np.pi, LANDMARKS)
        radius = RADIUS + self.random.uniform(-15, 15, LANDMARKS)
        height = np.zeros(LANDMARKS) if self.planar else self.random.uniform(-2, 4, LANDMARKS)
        self.landmarks = np.column_stack([radius * np.cos(azimuth), radius * np.sin(azimuth), height])
        self.names = np.arange(LANDMARKS)
        self.R, self.p, self.time = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]), np.array([RADIUS, 0.0, 0.0]), 0.0

    def start(self):
        half = np.pi / 4
        return self.p.copy(), np.array([np.cos(half), 0, 0, np.sin(half)])

    def move(self, slip=0.0):
        """Drives for one motion and returns what the odometry measures."""
        self.time += STEP
        rate = np.array([0, 0, SPEED / RADIUS])
        if not self.planar:
            rate[:2] = 0.05 * np.cos(0.4 * self.time), 0.04 * np.cos(0.3 * self.time)
        velocity = np.array([SPEED, 0, 0])
        R, t = exp(velocity, rate, STEP)
        self.R, self.p = self.R @ R, self.p + self.R @ t
        noise = self.motion_noise * self.random.normal(size=6)
        measured = velocity + self.bias + VELOCITY_SIGMA * noise[:3] + np.array([slip / STEP, 0, 0])
        turned = rate + RATE_SIGMA * noise[3:]
        if self.planar:
            measured[2] = turned[0] = turned[1] = 0
        return measured, turned

    def look(self):
        y = (self.landmarks - self.p) @ self.R
        horizontal, distance = np.hypot(y[:, 0], y[:, 1]), np.linalg.norm(y, axis=1)
        azimuth = np.arctan2(y[:, 1], y[:, 0])
        seen = np.flatnonzero((distance < SIGHT) & (horizontal > 2) & (np.abs(azimuth) < 1.3))[:32]
        z = np.column_stack([distance, azimuth] + ([] if self.planar else [np.arctan2(y[:, 2], horizontal)]))[seen]
        return seen, z + self.sigma * self.random.normal(size=z.shape)

    def fail(self, fault):
        """From now on something is wrong."""
        seen, _ = self.look()
        direction = self.random.uniform(0, 2 * np.pi)
        away = np.array([np.cos(direction), np.sin(direction), 0])
        if fault == "bias":
            self.bias = 0.15 * away
        elif fault == "sensor noise":
            self.sigma *= 3
        elif fault == "motion noise":
            self.motion_noise = 3.0
        elif fault in ("wrong pairing", "moved landmark"):
            # Landmarks that stay in sight for a while: ahead of the vehicle.
            ahead = seen[np.argsort(-((self.landmarks[seen] - self.p) @ self.R)[:, 0])][len(seen) // 4:]
            if fault == "moved landmark":
                self.landmarks[ahead[0]] += 3.0 * away
            else:
                apart = np.linalg.norm(self.landmarks[ahead] - self.landmarks[ahead[0]], axis=1)
                other = ahead[np.flatnonzero(apart > 2.0)[0]]
                self.names[ahead[0]], self.names[other] = other, ahead[0]
        elif fault == "kidnapping":
            R, _ = exp(np.zeros(3), np.array([0, 0, 0.3]), 1.0)
            self.R, self.p = self.R @ R, self.p + 5.0 * away


def make_filter(vehicle, kind, world, **options):
    own = dict(max_landmarks=LANDMARKS + 20, max_observations=32, vehicle=vehicle, initial_pose=world.start())
    if kind == "submaps":
        own.update(submap_landmarks=40)
    own.update(options)
    filter = cairn.Filter(**own)
    filter.set_twist_noise(velocity_sigma=[VELOCITY_SIGMA] * 3, rate_sigma=[RATE_SIGMA] * 3)
    sigma = SIGMA[vehicle]
    if vehicle == "planar":
        sensor = filter.add_range_bearing(range_sigma=sigma[0], bearing_sigma=sigma[1])
    else:
        sensor = filter.add_stereo_head(range_sigma=sigma[0], azimuth_sigma=sigma[1], elevation_sigma=sigma[2])
    return filter, sensor


class Vehicle:
    """A filter in its world."""

    def __init__(self, vehicle, kind, seed):
        self.world = World(vehicle, seed)
        self.filter, self.sensor = make_filter(vehicle, kind, self.world)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.filter.close()

    def drive(self, frames, fault="clean"):
        """Yields the health after each frame. The fault begins with the first one."""
        if fault != "clean":
            self.world.fail(fault)
        for frame in range(frames):
            for motion in range(MOTIONS):
                slip = 1.0 if fault == "slip" and frame == motion == 0 else 0.0
                self.filter.predict_twist(STEP, *self.world.move(slip))
            seen, z = self.world.look()
            self.filter.update(self.sensor, self.world.names[seen], z)
            yield self.filter.health()


def in_copy(compute):
    """What compute() returns in a copy of this process. The world and the filter of this one stay as they are."""
    result, told = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.write(told, pickle.dumps(compute()))
        finally:
            os._exit(0)
    os.close(told)
    with os.fdopen(result, "rb") as stream:
        text = stream.read()
    os.waitpid(child, 0)
    return pickle.loads(text)


def bad(health):
    return health["verdict"] != cairn.Verdict.GOOD


def updates_until_found(vehicle, fault):
    """Updates after which the fault was found; None: not within WITHIN."""
    return next((update for update, health in enumerate(vehicle.drive(WITHIN + 1, fault)) if bad(health)), None)


def run(vehicle, kind, faults, seed):
    """For each fault: updates until it was found (None: never). For "clean": the share of updates with an alarm. All
    faults begin from the same first FAULT frames."""
    with Vehicle(vehicle, kind, seed) as driven:
        alarms = [bad(health) for health in driven.drive(FAULT)]
        found = {fault: in_copy(lambda: updates_until_found(driven, fault)) for fault in faults if fault != "clean"}
        if "clean" in faults:
            found["clean"] = np.mean(alarms + [bad(health) for health in driven.drive(FRAMES - FAULT)])
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--seed", type=int, default=0, help="of the first run")
    parser.add_argument("--vehicle", choices=["planar", "spatial"], action="append")
    parser.add_argument("--map", choices=["single", "submaps"], action="append")
    parser.add_argument("--fault", choices=FAULTS, action="append")
    parser.add_argument("--check", action="store_true")
    chosen = parser.parse_args()
    missed = []
    print("| vehicle | map | " + " | ".join(chosen.fault or FAULTS) + " |")
    print("|---|---|" + "---|" * len(chosen.fault or FAULTS))
    for vehicle in chosen.vehicle or ["planar", "spatial"]:
        for kind in chosen.map or ["single", "submaps"]:
            cells = []
            runs = [run(vehicle, kind, chosen.fault or FAULTS, chosen.seed + k) for k in range(chosen.runs)]
            for fault in chosen.fault or FAULTS:
                results = [one[fault] for one in runs]
                if fault == "clean":
                    cells.append(f"{100 * np.mean(results):.2f} %")
                    right = np.mean(results) <= 0.01
                else:
                    found = [after for after in results if after is not None]
                    cells.append(f"{100 * len(found) / len(results):.0f} % after {np.median(found or [np.nan]):.0f}")
                    right = len(found) >= 0.95 * len(results)
                if not right:
                    missed.append(f"{vehicle}, {kind}, {fault}: {cells[-1]}")
            print(f"| {vehicle} | {kind} | " + " | ".join(cells) + " |", flush=True)
    if chosen.check and missed:
        sys.exit("\n".join(missed))


if __name__ == "__main__":
    main()
