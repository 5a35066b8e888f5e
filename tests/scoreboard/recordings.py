# SPDX-License-Identifier: BSD-3-Clause
"""What the smoothers and the odometry need of a recording, read without Cairn."""
import dataclasses
import glob
import hashlib
import os
import re

import numpy as np

import settings


def sha256(path):
    """Of a file; of a folder: of the names and hashes of its files, in the order of their names."""
    digest = hashlib.sha256()
    if os.path.isdir(path):
        for name in sorted(os.listdir(path)):
            digest.update(f"{name} {sha256(os.path.join(path, name))}\n".encode())
        return digest.hexdigest()
    with open(path, "rb") as file:
        for block in iter(lambda: file.read(1 << 20), b""):
            digest.update(block)
    return digest.hexdigest()


def wrap(angle):
    return (angle + np.pi) % (2 * np.pi) - np.pi


def compose(pose, step):
    """Of planar poses x, y, heading."""
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1], wrap(pose[2] + step[2])])


def chain(steps):
    poses = [np.zeros(3)]
    for step in steps:
        poses.append(compose(poses[-1], step))
    return np.array(poses)


def rmse(poses, truth):
    """Of positions, m. Rows without truth are left out."""
    poses, truth = np.asarray(poses), np.asarray(truth)
    known = ~np.isnan(truth[:, 0])
    return float(np.sqrt(np.mean(np.sum((poses[known] - truth[known]) ** 2, axis=1))))


@dataclasses.dataclass
class PlanarLog:
    """The text form of iSAM: EDGE2 i j dx dy dtheta, LANDMARK i l dx dy, each followed by the upper triangle of the
    square root of its information, row by row. The truth is a file of the same form without noise."""
    steps: np.ndarray       # n x 3: dx, dy, dtheta
    roots: list             # 3 x 3
    sightings: list         # for each pose: (landmark, dx, dy, 2 x 2 root)
    truth: np.ndarray       # (n + 1) x 3, or None
    landmarks: dict         # true positions


def _lines(path):
    with open(path) as file:
        return [line.split() for line in file if line.strip()]


def read_planar(path):
    steps, roots, sightings = [], [], {}
    for words in _lines(path):
        numbers = [float(word) for word in words[1:]]
        size = 3 if words[0] == "EDGE2" else 2
        root = np.zeros((size, size))
        root[np.triu_indices(size)] = numbers[2 + size:]
        if words[0] == "EDGE2":
            if (int(numbers[0]), int(numbers[1])) != (len(steps), len(steps) + 1):
                raise ValueError(f"{path}: the poses are not in their order")
            steps.append(numbers[2:5])
            roots.append(root)
        else:
            sightings.setdefault(int(numbers[0]), []).append((int(numbers[1]), numbers[2], numbers[3], root))
    truth, landmarks = None, {}
    true_path = path.removesuffix(".txt") + "_groundtruth.txt"
    if os.path.exists(true_path):
        words = _lines(true_path)
        truth = chain([[float(w) for w in line[3:6]] for line in words if line[0] == "EDGE2"])
        for line in words:
            if line[0] == "LANDMARK":
                pose = truth[int(line[1])]
                landmarks.setdefault(int(line[2]), compose(pose, [float(line[3]), float(line[4]), 0])[:2])
    return PlanarLog(np.array(steps), roots, [sightings.get(k, []) for k in range(len(steps) + 1)], truth, landmarks)


@dataclasses.dataclass
class Robot:
    number: int
    odometry: np.ndarray  # time, speed, rate
    seen: np.ndarray      # time, subject, range, bearing; of known subjects
    truth: np.ndarray     # time, x, y, heading

    def true_pose(self, times):
        poses = np.stack([np.interp(times, self.truth[:, 0], self.truth[:, i]) for i in (1, 2)]
                         + [wrap(np.interp(times, self.truth[:, 0], np.unwrap(self.truth[:, 3])))], axis=1)
        poses[(times < self.truth[0, 0]) | (times > self.truth[-1, 0])] = np.nan
        return poses


@dataclasses.dataclass
class Robots:
    """A MRCLAM folder. All robots make a step whenever one of them saw something (docs/mrclam.md)."""
    robots: list
    landmarks: dict      # true positions
    times: np.ndarray


def _table(path, columns):
    return np.loadtxt(path, ndmin=2).reshape(-1, columns) if os.path.getsize(path) else np.zeros((0, columns))


def _in_order(rows):
    return rows[np.argsort(rows[:, 0], kind="stable")]


def read_robots(folder):
    subjects = {int(code): int(subject) for subject, code in _table(os.path.join(folder, "Barcodes.dat"), 2)}
    landmarks = {int(row[0]): row[1:3] for row in _table(os.path.join(folder, "Landmark_Groundtruth.dat"), 5)}
    robots = []
    for path in glob.glob(os.path.join(folder, "Robot*_Odometry.dat")):
        number = int(re.search(r"Robot(\d+)_", path)[1])
        name = os.path.join(folder, f"Robot{number}_")
        seen = _in_order(_table(name + "Measurement.dat", 4))
        known = [code in subjects for code in seen[:, 1].astype(int)]
        seen = seen[known]
        seen[:, 1] = [subjects[code] for code in seen[:, 1].astype(int)]
        robots.append(Robot(number, _in_order(_table(path, 3)), seen, _in_order(_table(name + "Groundtruth.dat", 4))))
    robots.sort(key=lambda robot: robot.number)
    end = min(min(robot.odometry[-1, 0], robot.truth[-1, 0]) for robot in robots)
    times = np.concatenate([robot.seen[robot.seen[:, 0] >= robot.odometry[0, 0], 0] for robot in robots])
    return Robots(robots, landmarks, np.unique(times[times <= end]))


@dataclasses.dataclass
class StereoDrive:
    """A STARS file: measured body velocities and rates, and tracks of points in a rectified stereo camera."""
    time: np.ndarray      # s
    velocity: np.ndarray  # n x 3, body frame
    rate: np.ndarray      # n x 3
    pixels: np.ndarray    # n x points x 4: u and v left, u and v right; -1: not seen
    camera: tuple         # fu, fv, cu, cv, baseline
    mount: tuple          # rotation body to camera, position of the camera in the body
    position: np.ndarray  # true, n x 3
    attitude: np.ndarray  # rotation vectors body to world, n x 3
    pixel_sigmas: np.ndarray     # of u left, u right and the mean of both v
    velocity_sigmas: np.ndarray  # m/s
    rate_sigmas: np.ndarray      # rad/s
    landmarks: dict              # true positions by column of the tracks


def read_stereo(path):
    """The noise is that of the file, or that of the settings if the file has none."""
    import scipy.io
    m = scipy.io.loadmat(path, squeeze_me=True)
    pixels = m.get("y_var", np.array([1, 2, 1, 2]) * settings.PIXELS ** 2)
    true_points = m.get("rho_i_pj_i", np.zeros((3, 0)))
    frames = min(len(m["t"]), m["y_k_j"].shape[1], m["r_i_vk_i"].shape[1])
    camera = tuple(float(m[name]) for name in ("fu", "fv", "cu", "cv", "b"))
    return StereoDrive(m["t"][:frames], m["v_vk_vk_i"].T[:frames], m["w_vk_vk_i"].T[:frames],
                       np.moveaxis(m["y_k_j"], 0, 2)[:frames], camera,
                       (m["C_c_v"], m["rho_v_c_v"]), m["r_i_vk_i"].T[:frames], m["theta_vk_i"].T[:frames],
                       np.sqrt([pixels[0], pixels[2], (pixels[1] + pixels[3]) / 4]),
                       np.sqrt(m.get("v_var", np.full(3, settings.VELOCITY ** 2))),
                       np.sqrt(m.get("w_var", np.full(3, settings.RATE ** 2))),
                       {j: true_points[:, j] for j in range(true_points.shape[1])})
