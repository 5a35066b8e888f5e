# SPDX-License-Identifier: BSD-3-Clause
"""A simulated rover maps its surroundings, and the viewer rerun shows it while it drives.

    pip install rerun-sdk
    python3 rerun_mission.py                        opens the viewer
    python3 rerun_mission.py --save mission.rrd     writes a file instead, for `rerun mission.rrd` on another machine

The scene has the ground, the rover with the ellipsoid of its position, the true drive, the drive as it was known
online and as it is known after each closing of a submap, and every landmark with its ellipsoid: those of the map and
those of the open submap. All ellipsoids contain 95 %. Beside it are the verdict in words, the error of the position in
its band of three standard deviations, and the normalised innovations in theirs."""
import argparse
import time

import cairn
import numpy as np
import rerun as rr
import rerun.blueprint as rrb

SCALE_95 = np.sqrt(7.8147)  # chi-square with three degrees of freedom
TRUTH, ONLINE, CORRECTED, SUBMAP, BAND = (120, 200, 120), (240, 160, 60), (90, 160, 250), (250, 220, 90), (150, 150, 150)
AXES = {"x": (230, 80, 80), "y": (80, 170, 80), "z": (80, 120, 230)}
HALF_BODY = (0.8, 0.5, 0.3)  # m


def quaternions(R):
    """Rotation matrices (n x 3 x 3) as quaternions x y z w: the largest eigenvectors of Bar-Itzhack's matrices."""
    K = np.empty((len(R), 4, 4))
    K[:, :3, :3] = R + R.transpose(0, 2, 1)
    K[:, 3, 3] = np.trace(R, axis1=1, axis2=2)
    K[:, range(3), range(3)] -= K[:, 3, 3, None]
    K[:, :3, 3] = K[:, 3, :3] = np.stack([R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], axis=1)
    return np.linalg.eigh(K)[1][:, :, -1]


def ellipsoids(centers, covariances, color, labels=None):
    """Ellipsoids of positions (n x 3) by their covariances (n x 3 x 3)."""
    variances, axes = np.linalg.eigh(np.asarray(covariances).reshape(-1, 3, 3))
    axes[np.linalg.det(axes) < 0] *= -1  # a rotation, no mirror
    return rr.Ellipsoids3D(centers=centers, half_sizes=SCALE_95 * np.sqrt(np.maximum(variances, 1e-12)),
                           quaternions=quaternions(axes), colors=color, labels=labels, show_labels=False)


def log_pose(path, position, quaternion):
    rr.log(path, rr.Transform3D(translation=position, quaternion=quaternion[[1, 2, 3, 0]]))


def log_landmarks(path, landmarks, color):
    """Each shows its id if it is selected."""
    rr.log(path, ellipsoids(landmarks["position"], landmarks["covariance"], color, [str(id) for id in landmarks["id"]]))


def log_ground(world, cells=60):
    lower, upper = world.extent()
    x, y = (np.linspace(a - 10, b + 10, cells) for a, b in zip(lower, upper))
    x, y = np.meshgrid(x, y)
    corner = (np.arange(cells - 1)[:, None] * cells + np.arange(cells - 1)).ravel()
    triangles = np.concatenate([np.stack([corner, corner + 1, corner + cells], axis=1),
                                np.stack([corner + 1, corner + cells + 1, corner + cells], axis=1)])
    vertices = np.stack([x, y, world.height(x, y)], axis=2).reshape(-1, 3)
    height = vertices[:, 2]
    shade = 60 + 80 * (height - height.min()) / max(np.ptp(height), 1e-9)
    rr.log("world/ground", rr.Mesh3D(vertex_positions=vertices, triangle_indices=triangles,
                                     vertex_colors=np.repeat(shade[:, None], 3, axis=1).astype(np.uint8)), static=True)


def log_scene(world):
    rr.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    log_ground(world)
    rr.log("world/rover/body", rr.Boxes3D(half_sizes=[HALF_BODY], colors=ONLINE), static=True)
    for axis, color in AXES.items():
        names = [f"{axis}, -3 sigma", f"{axis}, +3 sigma", f"{axis}, m"]
        rr.log(f"error/{axis}", rr.SeriesLines(colors=[color, color, color], widths=[0.5, 0.5, 2], names=names), static=True)
    rr.log("trust/nis", rr.SeriesLines(colors=[BAND, BAND, ONLINE], names=["lower bound", "upper bound", "NIS of a row"]),
           static=True)


def blueprint():
    return rrb.Blueprint(rrb.Horizontal(
        rrb.Spatial3DView(origin="world", name="Mission"),
        rrb.Vertical(rrb.TextDocumentView(origin="trust/verdict", name="Verdict"),
                     rrb.TimeSeriesView(origin="trust/nis", name="Normalised innovation squared"),
                     rrb.TimeSeriesView(origin="error", name="Position: truth minus estimate"),
                     row_shares=[1, 2, 2]),
        column_shares=[2, 1]), collapse_panels=True)


class Mission:
    """The rover's filter, and what the viewer has seen of it."""

    def __init__(self, world, rover):
        self.world, self.rover = world, rover
        self.camera = rover.add_stereo_head(**world.head())
        self.online, self.truth = [], []
        self.closed, self.words = 0, None

    def step(self, step):
        self.rover.set_twist_noise(velocity_sigma=step.velocity_sigma, rate_sigma=step.rate_sigma)
        self.rover.point_head(self.camera, step.pan, step.stick)
        for motion in step.motions:
            self.rover.predict_twist(motion["dt"], motion["velocity"], motion["rate"])
        self.rover.update(self.camera, step.observations)

    def show(self, step):
        rr.set_time("mission", duration=step.time)
        position, quaternion, covariance = self.rover.pose()
        self.online.append(position)
        self.truth.append(step.truth.position)
        log_pose("world/rover", position, quaternion)
        rr.log("world/position", ellipsoids([position], covariance[:3, :3], ONLINE))
        rr.log("world/drive/online", rr.LineStrips3D([self.online], colors=ONLINE))
        rr.log("world/drive/truth", rr.LineStrips3D([self.truth], colors=TRUTH))
        base, turn, _ = self.rover.base_pose()
        log_pose("world/submap", base, turn)  # its landmarks are in its own frame
        log_landmarks("world/submap/landmarks", self.rover.local_map.landmarks(), SUBMAP)
        self.show_map()
        self.show_trust(step.truth.position - position, 3 * np.sqrt(np.diag(covariance)[:3]))

    def show_map(self):
        """The map changes only when a submap is closed. The poses driven so far are then known better, too."""
        if self.rover.submap_count == self.closed:
            return
        self.closed = self.rover.submap_count
        log_landmarks("world/map/landmarks", self.rover.map.landmarks(), CORRECTED)
        rr.log("world/drive/corrected", rr.LineStrips3D([self.rover.trajectory()["position"]], colors=CORRECTED))

    def show_trust(self, error, bound):
        for axis, value, limit in zip(AXES, error, bound):
            rr.log(f"error/{axis}", rr.Scalars([-limit, limit, value]))
        health = self.rover.health()
        rr.log("trust/nis", rr.Scalars([health["nis_lower"], health["nis_upper"], health["nis_per_row"]]))
        if health["words"] != self.words:
            self.words = health["words"]
            text = f"# {self.words[0]}\n" + "".join(f"- {reason}\n" for reason in self.words[1:])
            rr.log("trust/verdict", rr.TextDocument(text, media_type=rr.MediaType.MARKDOWN))

    def finish(self):
        self.rover.close_submap()
        log_landmarks("world/submap/landmarks", self.rover.local_map.landmarks(), SUBMAP)
        self.show_map()


def main():
    parser = argparse.ArgumentParser(description="A simulated rover maps its surroundings, shown by rerun.")
    parser.add_argument("--seed", type=int, default=1, help="seed of the world (default: 1)")
    parser.add_argument("--course", choices=("circle", "laps", "traverse"), default="laps", help="default: laps")
    parser.add_argument("--landmarks", type=int, default=200, help="default: 200")
    parser.add_argument("--submap-landmarks", type=int, default=60, help="close a submap that holds so many (default: 60)")
    parser.add_argument("--velocity-bias", type=float, default=0.0, metavar="M_S",
                        help="error of the measured forward velocity that the filter is not told of: see the verdict")
    parser.add_argument("--pause", type=float, metavar="S", help="wait between steps (default: 0.05 s; with --save: 0)")
    rr.script_add_args(parser)
    arguments = parser.parse_args()
    pause = arguments.pause if arguments.pause is not None else 0 if arguments.save else 0.05
    rr.script_setup(arguments, "cairn_mission", default_blueprint=blueprint())
    with cairn.World(seed=arguments.seed, course=arguments.course, landmarks=arguments.landmarks,
                     velocity_bias=(arguments.velocity_bias, 0, 0)) as world, \
            cairn.Filter(max_landmarks=arguments.landmarks, max_observations=world.most_observations,
                         submap_landmarks=arguments.submap_landmarks, trajectory_poses=len(world),
                         initial_pose=world.pose(0.0)) as rover:
        log_scene(world)
        mission = Mission(world, rover)
        for step in world:
            mission.step(step)
            mission.show(step)
            time.sleep(pause)
        mission.finish()
        print(f"{len(world)} steps, {len(rover.map)} landmarks, {rover.submap_count} submaps;"
              f" the verdict is {rover.health()['words'][0]}")
    rr.script_teardown(arguments)


if __name__ == "__main__":
    main()
