# SPDX-License-Identifier: BSD-3-Clause
"""GTSAM over the recordings: iSAM2, which answers online, and a batch over the whole recording. Each function returns
a dictionary: isam2 and batch hold the error of the poses (m), isam2_map and batch_map that of the landmarks where the
truth is known, isam2_s and batch_s the time (s), and landmarks the positions of the batch by id."""
import time

import gtsam
import numpy as np
from gtsam.symbol_shorthand import L, X

import odometry
import recordings
import settings

KNOWN = 1e-6  # standard deviation of what is known exactly


def _isam2():
    parameters = gtsam.ISAM2Params()
    parameters.setRelinearizeThreshold(0.05)
    parameters.relinearizeSkip = 1
    return gtsam.ISAM2(parameters)


def _batch(graph, values, iterations=60):
    parameters = gtsam.LevenbergMarquardtParams()
    parameters.setMaxIterations(iterations)
    return gtsam.LevenbergMarquardtOptimizer(graph, values, parameters).optimize()


def _map_error(positions, truth):
    common = [id for id in positions if id in truth]
    return float(np.sqrt(np.mean([np.sum((positions[id] - truth[id]) ** 2) for id in common]))) if common else None


class _Timer:
    def __enter__(self):
        self.start = time.perf_counter()
        return self

    def __exit__(self, *_):
        self.seconds = time.perf_counter() - self.start


def _xy(pose):
    return np.array([pose.x(), pose.y()])


# --- Planar logs ---

def _planar_factors(log, k, guess, placed):
    """The factors and first values that pose k brings."""
    graph, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
    values.insert(X(k), gtsam.Pose2(*guess))
    if k == 0:
        graph.add(gtsam.PriorFactorPose2(X(0), gtsam.Pose2(), gtsam.noiseModel.Isotropic.Sigma(3, KNOWN)))
    else:
        noise = gtsam.noiseModel.Gaussian.SqrtInformation(log.roots[k - 1])
        graph.add(gtsam.BetweenFactorPose2(X(k - 1), X(k), gtsam.Pose2(*log.steps[k - 1]), noise))
    for id, dx, dy, root in log.sightings[k]:
        # From dx, dy to bearing and range: the columns are the derivatives of dx, dy.
        distance, bearing = np.hypot(dx, dy), np.arctan2(dy, dx)
        by_polar = np.array([[-dy, dx / distance], [dx, dy / distance]])
        noise = gtsam.noiseModel.Gaussian.Information((root @ by_polar).T @ (root @ by_polar))
        graph.add(gtsam.BearingRangeFactor2D(X(k), L(id), gtsam.Rot2(bearing), distance, noise))
        if id not in placed:
            placed.add(id)
            values.insert(L(id), recordings.compose(guess, [dx, dy, 0])[:2])
    return graph, values


def planar(log):
    count, placed, online = len(log.sightings), set(), []
    graph, guesses, isam = gtsam.NonlinearFactorGraph(), gtsam.Values(), _isam2()
    with _Timer() as isam_timer:
        guess = np.zeros(3)
        for k in range(count):
            if k > 0:
                guess = recordings.compose(guess, log.steps[k - 1])
            factors, values = _planar_factors(log, k, guess, placed)
            isam.update(factors, values)
            pose = isam.calculateEstimatePose2(X(k))
            guess = np.array([pose.x(), pose.y(), pose.theta()])
            online.append(guess[:2])
            graph.push_back(factors)
            guesses.insert(values)
        last = isam.calculateEstimate()
    with _Timer() as timer:
        best = _batch(graph, guesses)
    found = {id: np.asarray(best.atPoint2(L(id))) for id in placed}
    result = {"isam2_s": isam_timer.seconds, "batch_s": timer.seconds, "landmarks": found,
              "isam2_map": _map_error({id: np.asarray(last.atPoint2(L(id))) for id in placed}, log.landmarks),
              "batch_map": _map_error(found, log.landmarks)}
    if log.truth is not None:
        result["isam2"] = recordings.rmse(online, log.truth[:, :2])
        result["batch"] = recordings.rmse([_xy(best.atPose2(X(k))) for k in range(count)], log.truth[:, :2])
    return result


# --- Stereo drives ---

class _Stereo:
    def __init__(self, drive):
        fu, fv, cu, cv, baseline = drive.camera
        self.drive, self.scale = drive, (fu, fv, cu, cv, baseline)
        self.camera = gtsam.Cal3_S2Stereo(fu, fv, 0, cu, cv, baseline)
        self.mount = gtsam.Pose3(gtsam.Rot3(drive.mount[0].T), drive.mount[1])
        self.noise = gtsam.noiseModel.Robust.Create(gtsam.noiseModel.mEstimator.Cauchy.Create(settings.CAUCHY),
                                                    gtsam.noiseModel.Diagonal.Sigmas(drive.pixel_sigmas))
        self.start = gtsam.Pose3(gtsam.Rot3.Expmap(drive.attitude[0]), drive.position[0])

    def step(self, k):
        dt = self.drive.time[k + 1] - self.drive.time[k]
        twist = np.concatenate([self.drive.rate[k], self.drive.velocity[k]])
        sigmas = np.concatenate([self.drive.rate_sigmas, self.drive.velocity_sigmas])
        return gtsam.Pose3.Expmap(twist * dt), gtsam.noiseModel.Diagonal.Sigmas(sigmas * dt)

    def point(self, k, j, pose):
        """The point in the world, or nothing where the disparity is below 3 pixels."""
        fu, fv, cu, cv, baseline = self.scale
        u, v, u_right, v_right = self.drive.pixels[k, j]
        if u - u_right < 3:
            return None
        depth = fu * baseline / (u - u_right)
        seen = np.array([(u - cu) * depth / fu, (0.5 * (v + v_right) - cv) * depth / fv, depth])
        return pose.compose(self.mount).transformFrom(seen)

    def sighting(self, k, j):
        u, v, u_right, v_right = self.drive.pixels[k, j]
        return gtsam.GenericStereoFactor3D(gtsam.StereoPoint2(u, u_right, 0.5 * (v + v_right)), self.noise, X(k), L(j),
                                           self.camera, False, False, self.mount)

    def frame(self, k, guess, placed):
        """The factors and first values that frame k brings. A point is placed by its first sighting that is near
        enough; a weak prior keeps points that are seen once determined."""
        graph, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
        values.insert(X(k), guess)
        if k == 0:
            graph.add(gtsam.PriorFactorPose3(X(0), self.start, gtsam.noiseModel.Isotropic.Sigma(6, KNOWN)))
        else:
            step, noise = self.step(k - 1)
            graph.add(gtsam.BetweenFactorPose3(X(k - 1), X(k), step, noise))
        for j in np.flatnonzero(self.drive.pixels[k, :, 0] >= 0):
            if j not in placed:
                point = self.point(k, j, guess)
                if point is None:
                    continue
                placed.add(j)
                values.insert(L(j), point)
                graph.add(gtsam.PriorFactorPoint3(L(j), point, gtsam.noiseModel.Isotropic.Sigma(3, 100.0)))
            graph.add(self.sighting(k, j))
        return graph, values


def stereo(drive):
    world, frames = _Stereo(drive), len(drive.time)
    result = {}
    with _Timer() as timer:  # the batch starts from odometry alone
        graph, guesses, placed, pose = gtsam.NonlinearFactorGraph(), gtsam.Values(), set(), world.start
        for k in range(frames):
            if k > 0:
                pose = pose.compose(world.step(k - 1)[0])
            factors, values = world.frame(k, pose, placed)
            graph.push_back(factors)
            guesses.insert(values)
        best = _batch(graph, guesses, 40)
    result["batch_s"] = timer.seconds
    result["batch"] = recordings.rmse([best.atPose3(X(k)).translation() for k in range(frames)], drive.position)
    result["batch_map"] = _map_error({j: best.atPoint3(L(j)) for j in placed}, drive.landmarks)
    with _Timer() as timer:
        isam, placed, pose, online = _isam2(), set(), world.start, []
        for k in range(frames):
            if k > 0:
                pose = pose.compose(world.step(k - 1)[0])
            try:
                isam.update(*world.frame(k, pose, placed))
            except RuntimeError as error:
                result["isam2_reason"] = f"failed at frame {k}: {str(error).strip().splitlines()[0]}"
                return result
            pose = isam.calculateEstimatePose3(X(k))
            online.append(pose.translation())
    result["isam2_s"] = timer.seconds
    result["isam2"] = recordings.rmse(online, drive.position)
    last = isam.calculateEstimate()
    result["isam2_map"] = _map_error({j: last.atPoint3(L(j)) for j in placed}, drive.landmarks)
    return result


# --- Robots ---

def robots(data, first):
    """One graph of all robots. A robot has a node wherever it saw something or was seen by another robot. `first`:
    times and poses of each robot from which the batch starts, by number."""
    numbers = {robot.number: k for k, robot in enumerate(data.robots)}
    limits = data.times[0], data.times[-1]
    nodes = [{robot.odometry[0, 0]} for robot in data.robots]
    sightings = []
    for k, robot in enumerate(data.robots):
        for when, subject, distance, bearing in robot.seen:
            if not max(limits[0], robot.odometry[0, 0]) <= when <= limits[1]:
                continue
            other = numbers.get(int(subject))
            if other == k or (other is not None and when < data.robots[other].odometry[0, 0]):
                continue
            sightings.append((k, when, int(subject), other, distance, bearing))
            nodes[k].add(when)
            if other is not None:
                nodes[other].add(when)
    keys, graph, values = [], gtsam.NonlinearFactorGraph(), gtsam.Values()
    with _Timer() as timer:
        for k, robot in enumerate(data.robots):
            keys.append({when: gtsam.symbol(chr(ord("a") + k), i) for i, when in enumerate(sorted(nodes[k]))})
            start = robot.true_pose(np.array([robot.odometry[0, 0]]))[0]
            ordered = sorted(nodes[k])
            guesses = _at(first[robot.number], ordered)
            for when, guess in zip(ordered, guesses):
                values.insert(keys[k][when], gtsam.Pose2(*guess))
            graph.add(gtsam.PriorFactorPose2(keys[k][ordered[0]], gtsam.Pose2(*start),
                                             gtsam.noiseModel.Isotropic.Sigma(3, KNOWN)))
            for before, after in zip(ordered, ordered[1:]):
                step, covariance = odometry.motion(robot, before, after)
                # GTSAM counts the error in the axes of the end.
                c, s = np.cos(step[2]), np.sin(step[2])
                turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
                covariance = turn @ covariance @ turn.T + 1e-10 * np.eye(3)
                graph.add(gtsam.BetweenFactorPose2(keys[k][before], keys[k][after], gtsam.Pose2(*step),
                                                   gtsam.noiseModel.Gaussian.Covariance(covariance)))
        loss = gtsam.noiseModel.mEstimator.Huber.Create(settings.HUBER)
        for k, when, subject, other, distance, bearing in sightings:
            sigmas = np.array([settings.BEARING, settings.RANGE * distance])
            noise = gtsam.noiseModel.Robust.Create(loss, gtsam.noiseModel.Diagonal.Sigmas(sigmas))
            key = keys[k][when]
            if other is not None:
                graph.add(gtsam.BearingRangeFactorPose2(key, keys[other][when], gtsam.Rot2(bearing), distance, noise))
                continue
            if not values.exists(L(subject)):
                seen = distance * np.array([np.cos(bearing), np.sin(bearing)])
                values.insert(L(subject), values.atPose2(key).transformFrom(seen))
            graph.add(gtsam.BearingRangeFactor2D(key, L(subject), gtsam.Rot2(bearing), distance, noise))
        best = _batch(graph, values)
    errors = []
    for k, robot in enumerate(data.robots):
        ordered = np.array(sorted(nodes[k]))
        poses = [best.atPose2(keys[k][when]) for when in ordered]
        times = data.times[data.times >= robot.odometry[0, 0]]
        all_poses = odometry.along(robot, times, (ordered, np.array([[p.x(), p.y(), p.theta()] for p in poses])))
        errors.append(recordings.rmse(all_poses[:, :2], robot.true_pose(times)[:, :2]))
    found = {id: np.asarray(best.atPoint2(L(id))) for id in data.landmarks if best.exists(L(id))}
    return {"batch": float(np.mean(errors)), "batch_s": timer.seconds, "landmarks": found,
            "batch_map": _map_error(found, data.landmarks), "isam2_reason": "not run on several robots"}


def _at(trajectory, times):
    """Poses at these times, from the nearest one before."""
    known, poses = trajectory
    return poses[np.clip(np.searchsorted(known, times, side="right") - 1, 0, len(known) - 1)]
