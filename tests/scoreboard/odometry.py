# SPDX-License-Identifier: BSD-3-Clause
"""Odometry alone: the poses that the motions give without any observation, from the true start on."""
import numpy as np

import recordings
import settings


def planar(log):
    return recordings.chain(log.steps)


def arc(speed, rate, dt):
    """Pose after dt seconds at constant speed and rate of turn."""
    angle = rate * dt
    half = 0.5 * angle
    chord = speed * dt * np.sinc(half / np.pi)
    return np.array([chord * np.cos(half), chord * np.sin(half), angle])


def _step_covariance(total, step, dt):
    """Covariance, in the axes of the start, of a motion that this step extends."""
    c, s = np.cos(total[2]), np.sin(total[2])
    after = np.array([[1, 0, -s * step[0] - c * step[1]], [0, 1, c * step[0] - s * step[1]], [0, 0, 1]])
    own = np.array([[c, -s * step[0] / 2], [s, c * step[0] / 2], [0, 1]])  # by path and turn
    noise = np.diag([settings.SPEED ** 2 * dt, settings.TURN ** 2 * dt])
    return after, own @ noise @ own.T


def motion(robot, start, end):
    """The pose at `end` relative to that at `start`, and its covariance in the axes of the start. A record of the
    odometry holds until the next one."""
    rows = robot.odometry
    total, covariance, now = np.zeros(3), np.zeros((3, 3)), start
    k = max(0, int(np.searchsorted(rows[:, 0], start, side="right")) - 1)
    while now < end:
        until = end if k + 1 == len(rows) else min(end, rows[k + 1, 0])
        if until > now:
            step = arc(rows[k, 1], rows[k, 2], until - now)
            after, own = _step_covariance(total, step, until - now)
            covariance = after @ covariance @ after.T + own
            total = recordings.compose(total, step)
            now = until
        k += 1
    return total, covariance


def along(robot, times, nodes=None):
    """Poses at `times`, each by odometry from the last node before it. `nodes`: times and poses; None: the true
    start."""
    start = robot.odometry[0, 0]
    if nodes is None:
        nodes = np.array([start]), robot.true_pose(np.array([start]))
    poses, pose, now, k = [], nodes[1][0], nodes[0][0], 0
    for time in times:
        while k + 1 < len(nodes[0]) and nodes[0][k + 1] <= time:
            k += 1
            pose, now = nodes[1][k], nodes[0][k]
        if time > now:
            pose, now = recordings.compose(pose, motion(robot, now, time)[0]), time
        poses.append(pose)
    return np.array(poses)


def robots(data):
    """Root mean square errors of the robots, m."""
    errors = []
    for robot in data.robots:
        times = data.times[data.times >= robot.odometry[0, 0]]
        errors.append(recordings.rmse(along(robot, times)[:, :2], robot.true_pose(times)[:, :2]))
    return errors
