#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Noise of an MRCLAM folder, estimated from the recordings as docs/mrclam.md derives it. mrclam_noise.py FOLDER [UNTIL]

Parts A and B compare odometry and sightings with the truth, part C needs no truth. UNTIL limits the recordings to their
first seconds.
"""
import glob
import os
import re
import sys

import numpy as np

GRID = 0.05                                       # s, of the windows' ends
WINDOWS = (0.2, 0.3, 0.5, 1, 2, 5, 10, 20, 30, 60)  # s
PATH_WINDOW, TURN_WINDOW = 10, 10                 # s: that of the path's density, the longest of the turn's
LAGS = np.array([0, 0.5, 1, 2, 3, 5, 8, 12, 20, 30])  # s, of the persistence of errors


def wrap(angle):
    return (angle + np.pi) % (2 * np.pi) - np.pi


def rms(values):
    return np.sqrt(np.mean(np.square(values)))


class Robot:
    def __init__(self, folder, number, barcodes, until):
        odometry, seen, truth = (np.loadtxt(os.path.join(folder, f"Robot{number}_{name}.dat"))
                                 for name in ("Odometry", "Measurement", "Groundtruth"))
        self.number, self.end = number, min(odometry[-1, 0], odometry[0, 0] + until)
        self.odometry, self.truth = odometry[odometry[:, 0] <= self.end], truth
        self.seen = seen[(seen[:, 0] <= self.end) & (seen[:, 0] > odometry[0, 0] + 0.5)]
        self.subject = np.array([barcodes.get(int(code), -1) for code in self.seen[:, 1]])

    def pose(self, time):
        """True x, y and heading, n x 3."""
        return np.stack([np.interp(time, self.truth[:, 0], self.truth[:, i]) for i in (1, 2)]
                        + [np.interp(time, self.truth[:, 0], np.unwrap(self.truth[:, 3]))], 1)

    def reckoned(self, delay=0.0):
        """Path, turned angle, x and y by odometry only, as functions of time."""
        time = self.odometry[:, 0] + delay
        dt, speed, rate = np.diff(time), self.odometry[:-1, 1], self.odometry[:-1, 2]
        middle = np.concatenate([[0], np.cumsum(rate * dt)])[:-1] + 0.5 * rate * dt
        return [lambda at, sums=np.concatenate([[0], np.cumsum(value * dt)]): np.interp(at, time, sums)
                for value in (speed, rate, np.cos(middle) * speed, np.sin(middle) * speed)]


def read(folder, until):
    def table(name):
        return np.loadtxt(os.path.join(folder, name), ndmin=2)

    barcodes = {int(code): int(subject) for subject, code in table("Barcodes.dat")}
    landmarks = {int(row[0]): row[1:3] for row in table("Landmark_Groundtruth.dat")}
    numbers = sorted(int(re.search(r"Robot(\d+)_", path)[1]) for path in glob.glob(os.path.join(folder, "Robot*_Odometry.dat")))
    if not numbers:
        sys.exit(f"{folder}: there is no RobotN_Odometry.dat")
    return {number: Robot(folder, number, barcodes, until) for number in numbers}, landmarks


def window_errors(robot, window, delay=0.0):
    """Truth minus odometry over windows: path along the robot's axis, turned angle, sideways; and the path by odometry."""
    time = np.arange(robot.odometry[0, 0] + 1, robot.odometry[-1, 0] - 1, GRID)
    pose, (path, turn, _, _) = robot.pose(time), robot.reckoned(delay)
    step, heading = np.diff(pose[:, :2], axis=0), 0.5 * (pose[1:, 2] + pose[:-1, 2])
    ahead = np.concatenate([[0], np.cumsum(np.cos(heading) * step[:, 0] + np.sin(heading) * step[:, 1])])
    aside = np.concatenate([[0], np.cumsum(-np.sin(heading) * step[:, 0] + np.cos(heading) * step[:, 1])])
    count = int(round(window / GRID))
    begin = np.arange(0, len(time) - count, max(1, count // 3))
    end = begin + count
    return np.stack([total[end] - total[begin] for total in (ahead - path(time), pose[:, 2] - turn(time), aside,
                                                                    path(time))], 1)


def odometry(robots):
    print("A. Odometry against the truth, by the length T of a window")
    print("   T s | path rms m, m/sqrt(s) | angle rms rad, rad/sqrt(s), 0.2 s later | sideways m/sqrt(s)")
    density = {}
    for window in WINDOWS:
        error = np.concatenate([window_errors(robot, window) for robot in robots.values()])
        later = np.concatenate([window_errors(robot, window, 0.2) for robot in robots.values()])
        density[window] = [rms(column) / np.sqrt(window) for column in error.T[:3]]
        print(f"{window:6g} | {rms(error[:, 0]):.4f}  {density[window][0]:.4f} | {rms(error[:, 1]):.4f}  "
              f"{density[window][1]:.4f}  {rms(later[:, 1]) / np.sqrt(window):.4f} | {density[window][2]:.4f}")
    for robot in robots.values():
        slow, quick = window_errors(robot, 10), window_errors(robot, 0.3)
        print(f"   robot {robot.number}: {rms(slow[:, 0]) / np.sqrt(10):.4f} m/sqrt(s) at 10 s, "
              f"{rms(quick[:, 1]) / np.sqrt(0.3):.4f} rad/sqrt(s) at 0.3 s; path {slow[:, 0].sum() / slow[:, 3].sum():+.1%}")
    return density[PATH_WINDOW][0], max(density[window][1] for window in WINDOWS if window <= TURN_WINDOW)


def sightings(robots, landmarks):
    """Rows of robot, subject, time, true range, errors of range and bearing. Misread barcodes are left out."""
    rows = []
    for robot in robots.values():
        time, pose = robot.seen[:, 0], robot.pose(robot.seen[:, 0])
        place = np.full((len(time), 2), np.nan)
        for subject in np.unique(robot.subject):
            of = robot.subject == subject
            if subject in landmarks:
                place[of] = landmarks[subject]
            elif subject in robots and subject != robot.number:
                place[of] = robots[subject].pose(time[of])[:, :2]
        off = place - pose[:, :2]
        distance = np.hypot(off[:, 0], off[:, 1])
        rows.append(np.stack([np.full(len(time), robot.number), robot.subject, time, distance, robot.seen[:, 2] - distance,
                              wrap(robot.seen[:, 3] - np.arctan2(off[:, 1], off[:, 0]) + pose[:, 2])], 1))
    rows = np.concatenate(rows)
    rows = rows[np.isfinite(rows[:, 3])]
    good = (abs(rows[:, 5]) < 0.1) & (abs(rows[:, 4]) < 0.8)
    print(f"\nB. {len(rows)} sightings against the truth; {np.mean(~good):.2%} off by 0.1 rad or 0.8 m are left out")
    return rows[good]


def persistence(error, rows, name):
    """Persistence of the errors of sightings: 1 + 2 (sum of the correlations with later sightings of the same subject by the
    same robot, up to 30 s)."""
    total, pairs = np.zeros(len(LAGS) - 1), np.zeros(len(LAGS) - 1)
    for key in np.unique(rows[:, :2], axis=0):
        of = (rows[:, :2] == key).all(axis=1)
        i, j = np.triu_indices(of.sum(), 1)
        bin_of = np.digitize(rows[of, 2][j] - rows[of, 2][i], LAGS) - 1
        near = bin_of < len(total)
        np.add.at(total, bin_of[near], (error[of][i] * error[of][j])[near])
        np.add.at(pairs, bin_of[near], 1)
    variance = np.mean(error**2)
    factor = 1 + 2 * total.sum() / len(error) / variance
    correlation = total / np.maximum(pairs, 1) / variance
    told = ", ".join(f"{a:g}-{b:g} s {c:.2f}" for a, b, c in zip(LAGS, LAGS[1:], correlation))
    print(f"   correlation of the error of {name}: {told}; integral {correlation @ np.diff(LAGS):.1f} s, N = {factor:.1f}")
    return factor


def radar(robots, landmarks):
    rows = sightings(robots, landmarks)
    print("   range m |     n | range mean, rms m, rms/range | bearing rms rad")
    for low, high in ((1, 1.5), (1.5, 2), (2, 3), (3, 4), (4, 5), (5, 6), (6, 8)):
        of = rows[(rows[:, 3] >= low) & (rows[:, 3] < high)]
        if len(of):
            print(f"   {low:3g}-{high:3g} | {len(of):5d} | {of[:, 4].mean():+.3f}  {rms(of[:, 4]):.3f}  "
                  f"{rms(of[:, 4] / of[:, 3]):.3f} | {rms(of[:, 5]):.4f}")
    share = rows[:, 4] / rows[:, 3]
    factors = persistence(share, rows, "range / range"), persistence(rows[:, 5], rows, "bearing")
    once = rms(share), rms(rows[:, 5])
    print(f"   one sighting: {once[0]:.4f} of the range, {once[1]:.4f} rad")
    return tuple(one * np.sqrt(factor) for one, factor in zip(once, factors))


def carried(robot, landmarks, low, high, delay=0.0):
    """Landmarks seen twice, `low` to `high` seconds apart: bearing of the second sighting minus the bearing predicted from the
    first, the same for the range, time gap, range, both bearings."""
    _, turn, x, y = robot.reckoned(delay)
    time, out = robot.seen[:, 0], [np.zeros((0, 6))]
    for subject in sorted(set(robot.subject.tolist()) & set(landmarks)):
        of = np.flatnonzero(robot.subject == subject)
        then = np.searchsorted(time[of], time[of] + low)
        fits = then < len(of)
        a, b = of[fits], of[then[fits]]
        a, b = a[time[b] - time[a] < high], b[time[b] - time[a] < high]
        z, ahead = robot.seen, turn(time[a]) + robot.seen[a, 3]
        dx = x(time[a]) + z[a, 2] * np.cos(ahead) - x(time[b])
        dy = y(time[a]) + z[a, 2] * np.sin(ahead) - y(time[b])
        out.append(np.stack([wrap(z[b, 3] - np.arctan2(dy, dx) + turn(time[b])), z[b, 2] - np.hypot(dx, dy),
                             time[b] - time[a], z[b, 2], z[a, 3], z[b, 3]], 1))
    rows = np.concatenate(out)
    return rows[(abs(rows[:, 0]) < 0.5) & (abs(rows[:, 1]) < 1)]


def without_truth(robots, landmarks):
    print("\nC. Without truth: a landmark seen twice, carried along by dead reckoning")
    for low, high in ((0.2, 0.5), (0.5, 1), (1, 1.5), (2, 3), (4, 6)):
        rows = np.concatenate([carried(robot, landmarks, low, high) for robot in robots.values()])
        print(f"   {low:g}-{high:g} s: bearing {rms(rows[:, 0]) / np.sqrt(rows[:, 2].mean()):.4f} rad/sqrt(s) (n {len(rows)})")
    for low, high in ((8, 12), (12, 20)):
        rows = np.concatenate([carried(robot, landmarks, low, high) for robot in robots.values()])
        rows = rows[(abs(rows[:, 4:]) < 0.2).all(axis=1) & (rows[:, 3] < 3)]
        print(f"   {low:g}-{high:g} s: range of what is ahead and nearer than 3 m "
              f"{rms(rows[:, 1]) / np.sqrt(rows[:, 2].mean()):.4f} m/sqrt(s) (n {len(rows)})")


def main(arguments):
    if not 1 <= len(arguments) <= 2:
        sys.exit(__doc__.splitlines()[0])
    robots, landmarks = read(arguments[0], float(arguments[1]) if len(arguments) == 2 else np.inf)
    speed, rate = odometry(robots)
    distance, bearing = radar(robots, landmarks)
    without_truth(robots, landmarks)
    print(f"\nspeed {speed:.4f} m/s/sqrt(Hz), rate {rate:.4f} rad/s/sqrt(Hz), range {distance:.3f} of it, "
          f"bearing {bearing:.4f} rad")


if __name__ == "__main__":
    main(sys.argv[1:])
