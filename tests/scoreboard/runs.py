# SPDX-License-Identifier: BSD-3-Clause
"""One recording of the scoreboard: Cairn, odometry alone and the smoothers over it. Every function returns a dictionary
of figures; a figure that is not known is absent."""
import csv
import json
import os
import subprocess
import tempfile

import numpy as np

import odometry
import recordings
import settings


class Failure(Exception):
    """A program that ended with an error; the text is its last line."""


def program(path, *arguments):
    done = subprocess.run([path, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise Failure((done.stderr.strip().splitlines() or [f"exit status {done.returncode}"])[-1])
    return done.stdout


def _rows(folder, name):
    with open(os.path.join(folder, name), newline="") as file:
        return list(csv.DictReader(file))


def cairn(path, recording, kind):
    """The summary, with the positions of the map by id under `map` and, for robots, their poses under `poses`."""
    with tempfile.TemporaryDirectory() as folder:
        text = program(path, "run", recording, *kind.options, "--summary", "json", "--quiet", "--output", folder)
        figures = json.loads(text)
        team = os.path.exists(os.path.join(folder, "team_landmarks.csv"))
        if not team:
            rows = _rows(folder, "landmarks.csv")
            figures["map"] = {int(row["id"]): np.array([float(row["x_m"]), float(row["y_m"])]) for row in rows}
            return figures
        rows = _rows(folder, "team_landmarks.csv")
        first = rows[0]["vehicle"] if rows else None
        figures["map"] = {int(row["id"]): np.array([float(row["x"]), float(row["y"])])
                          for row in rows if row["vehicle"] == first}
        figures["poses"] = {}
        for row in _rows(folder, "team_trajectories.csv"):
            pose = [float(row[name]) for name in ("time", "x", "y", "heading")]
            figures["poses"].setdefault(int(row["vehicle"]), []).append(pose)
        return figures


def odometry_error(path, recording, kind):
    """Error of odometry alone, m; None if there is no truth."""
    if kind.freedoms == 6:
        return json.loads(program(path, "run", recording, *settings.NO_LANDMARKS, "--summary", "json", "--quiet")).get(
            "pose_rmse_m")
    if kind.name == "robots":
        return float(np.mean(odometry.robots(recordings.read_robots(recording))))
    log = recordings.read_planar(recording)
    return None if log.truth is None else recordings.rmse(odometry.planar(log)[:, :2], log.truth[:, :2])


def smoothers(recording, kind, figures):
    """iSAM2 and batch. Needs GTSAM."""
    import smoothers as gtsam_runs
    if kind.freedoms == 6:
        return gtsam_runs.stereo(recordings.read_stereo(recording))
    if kind.name != "robots":
        return gtsam_runs.planar(recordings.read_planar(recording))
    data = recordings.read_robots(recording)
    first = {}
    for robot in data.robots:
        rows = np.array(figures.get("poses", {}).get(robot.number, []))
        if len(rows) > 0:  # the online poses of Cairn, whose time counts from the first step
            first[robot.number] = data.times[0] + rows[:, 0], rows[:, 1:]
        else:
            first[robot.number] = data.times, odometry.along(robot, data.times)
    return gtsam_runs.robots(data, first)


def distance_to_batch(figures, batch):
    """Root mean square distance between the landmarks of Cairn's map and those of the batch, m."""
    common = [id for id in figures.get("map", {}) if id in batch]
    if not common:
        return None
    return float(np.sqrt(np.mean([np.sum((figures["map"][id] - batch[id]) ** 2) for id in common])))
