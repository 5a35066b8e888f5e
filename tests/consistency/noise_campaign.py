#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How well the filter learns the noise: the stated noise of sensor or motion is wrong by a factor, for 500 updates.

    noise_campaign.py [--runs N] [--vehicle planar|spatial] [--map single|submaps] [--outliers SHARE] [--check]

The table holds the mean of the reported scale over the true one, and the largest error of a run. --check fails if a run
misses by more than 15 %.
"""
import argparse
import sys

import numpy as np

import verdict_campaign as campaign

FRAMES = 500
CASES = {"as stated": (1, 1), "sensor x 3": (3, 1), "sensor / 3": (1 / 3, 1), "motion x 3": (1, 3),
         "motion / 3": (1, 1 / 3), "both x 3": (3, 3)}


def learned(vehicle, kind, sensor_scale, motion_scale, outliers, seed):
    """The reported scales of sensor and motion, each over the true one, and their standard deviations."""
    world = campaign.World(vehicle, seed)
    world.sigma *= sensor_scale
    world.motion_noise = motion_scale
    filter, sensor = campaign.make_filter(vehicle, kind, world)
    with filter:
        for _ in range(FRAMES):
            for _ in range(campaign.MOTIONS):
                filter.predict_twist(campaign.STEP, *world.move())
            seen, z = world.look()
            wrong = world.random.uniform(size=len(seen)) < outliers
            z[wrong, 0] = world.random.uniform(2, campaign.SIGHT, wrong.sum())
            z[wrong, 1] = world.random.uniform(-1.3, 1.3, wrong.sum())
            filter.update(sensor, world.names[seen], z)
        of_sensor, of_motion = filter.sensor_health(sensor), filter.health()
    return np.array([of_sensor["scale"] / sensor_scale, of_motion["motion_scale"] / motion_scale,
                     of_sensor["scale_sigma"] / sensor_scale, of_motion["motion_scale_sigma"] / motion_scale])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--vehicle", choices=["planar", "spatial"], action="append")
    parser.add_argument("--map", choices=["single", "submaps"], action="append")
    parser.add_argument("--outliers", type=float, default=0.0)
    parser.add_argument("--check", action="store_true")
    chosen = parser.parse_args()
    missed = []
    print("| vehicle | map | stated noise | sensor: mean, worst | motion: mean, worst |\n|---|---|---|---|---|")
    for vehicle in chosen.vehicle or ["planar", "spatial"]:
        for kind in chosen.map or ["single", "submaps"]:
            for name, (sensor_scale, motion_scale) in CASES.items():
                runs = np.array([learned(vehicle, kind, sensor_scale, motion_scale, chosen.outliers, seed)
                                 for seed in range(chosen.runs)])
                worst = np.abs(runs[:, :2] - 1).max(axis=0)
                print(f"| {vehicle} | {kind} | {name} | {runs[:, 0].mean():.3f}, {100 * worst[0]:.0f} % "
                      f"(sigma {100 * runs[:, 2].mean():.0f} %) | {runs[:, 1].mean():.3f}, {100 * worst[1]:.0f} % "
                      f"(sigma {100 * runs[:, 3].mean():.0f} %) |", flush=True)
                if worst.max() > 0.15:
                    missed.append(f"{vehicle}, {kind}, {name}: {worst}")
    if chosen.check and missed:
        sys.exit("\n".join(missed))


if __name__ == "__main__":
    main()
