# SPDX-License-Identifier: BSD-3-Clause
"""The scoreboard on made-up recordings: its table, what it skips, and odometry alone against formulas."""
import hashlib
import math
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import odometry  # noqa: E402
import recordings  # noqa: E402

PROGRAM, MAKE_STARS = os.environ["CAIRN_PROGRAM"], os.environ["CAIRN_MAKE_STARS"]

# A square of four edges of 1 m, and one tree. The logged edges are 10 % too long.
TRUE_SQUARE = "".join(f"EDGE2 {k} {k + 1} 1 0 {math.pi / 2} 50 0 0 50 0 100\n" for k in range(4))
TREE = "LANDMARK 0 7 2 0.5 10 0 10\nLANDMARK 4 7 2 0.5 10 0 10\n"


class ScoreboardTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w") as file:
            file.write(text)
        return path

    def planar_log(self):
        self.write("cityTrees10000_groundtruth.txt", TRUE_SQUARE + TREE)
        return self.write("cityTrees10000.txt", TRUE_SQUARE.replace(" 1 0 1.5", " 1.1 0 1.5") + TREE)

    def robots(self, name, rate=0.0):
        """Two robots, 0.5 m/s for 4 s. Robot 1 sees robot 2, which sees a post."""
        self.write(f"{name}/Barcodes.dat", "1 11\n2 12\n6 16\n")
        self.write(f"{name}/Landmark_Groundtruth.dat", "6 5 1 0 0\n")
        for robot in (1, 2):
            rows = [k / 10 for k in range(41)]
            self.write(f"{name}/Robot{robot}_Odometry.dat", "".join(f"{t} 0.5 {rate}\n" for t in rows))
            self.write(f"{name}/Robot{robot}_Groundtruth.dat", "".join(f"{t} {0.5 * t} {robot} 0\n" for t in rows))
            seen = [(t, 12 if robot == 1 else 16, robot) for t in (1, 2, 3)]
            text = "".join(f"{t} {code} {1 if robot == 1 else math.hypot(5 - 0.5 * t, 1)} "
                           f"{math.pi / 2 if robot == 1 else math.atan2(-1, 5 - 0.5 * t)}\n" for t, code, _ in seen)
            self.write(f"{name}/Robot{robot}_Measurement.dat", text)
        return os.path.join(self.folder, name)

    def board(self, *options):
        done = subprocess.run([sys.executable, "-B", os.path.join(HERE, "scoreboard.py"), "--program", PROGRAM,
                               "--data", self.folder, *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, timeout=600, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def table(self, page):
        lines = [[cell.strip() for cell in line[1:-1].split("|")] for line in page.splitlines()
                 if line.startswith("| ")]
        return {line[0]: dict(zip(lines[0], line)) for line in lines[2:]}

    def test_one_line_a_recording(self):
        subprocess.run([MAKE_STARS, os.path.join(self.folder, "starry_night.mat")], check=True)
        log = self.planar_log()
        self.robots("two_robots")
        page = self.board()
        table = self.table(page)
        self.assertEqual(set(table), {"starry_night.mat", "cityTrees10000.txt", "two_robots"})
        self.assertLess(float(table["starry_night.mat"]["online"]), float(table["starry_night.mat"]["odometry"]))
        self.assertGreater(float(table["starry_night.mat"]["corrected"]), 0)
        # The corners are 0.1 m off along one axis and then along both, and the last one is where the first one is.
        self.assertAlmostEqual(float(table["cityTrees10000.txt"]["odometry"]),
                               math.sqrt((0.01 + 0.02 + 0.01) / 5), places=3)
        self.assertLess(float(table["two_robots"]["odometry"]), 1e-6)
        self.assertTrue(table["two_robots"]["time"].endswith(" s"))
        with open(log, "rb") as file:
            self.assertIn(hashlib.sha256(file.read()).hexdigest() + "  cityTrees10000.txt", page)
        self.assertIn(recordings.sha256(os.path.join(self.folder, "two_robots")) + "  two_robots", page)

    def test_what_is_missing_is_told(self):
        self.write("starry_night.mat", "no log\n")
        os.remove(os.path.join(self.robots("two_robots"), "Robot1_Groundtruth.dat"))
        page = self.board()
        self.assertRegex(page, r"- starry_night\.mat: cairn: .*starry_night\.mat")
        self.assertRegex(page, r"- two_robots: odometry alone: .*Robot1_Groundtruth\.dat")
        self.assertIn("- mrclam7: skipped, it is not in the folder", page)
        self.assertIn("--with-gtsam was not given", page)
        self.assertEqual(self.table(page)["starry_night.mat"]["online"], "")

    def test_recordings_can_be_chosen(self):
        self.planar_log()
        self.robots("two_robots")
        self.assertEqual(set(self.table(self.board("two_robots"))), {"two_robots"})
        done = subprocess.run([sys.executable, "-B", os.path.join(HERE, "scoreboard.py"), "--program", PROGRAM,
                               "--data", self.folder, "no_such"], stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual((done.returncode, "there is no recording 'no_such'" in done.stderr), (1, True))

    def test_the_hash_of_a_folder_depends_on_names_and_contents(self):
        folder = self.robots("two_robots")
        one = recordings.sha256(folder)
        self.write("two_robots/Barcodes.dat", "1 11\n2 12\n6 17\n")
        other = recordings.sha256(folder)
        os.rename(os.path.join(folder, "Barcodes.dat"), os.path.join(folder, "Barcode.dat"))
        self.assertEqual(len({one, other, recordings.sha256(folder)}), 3)

    def test_odometry_of_a_robot(self):
        data = recordings.read_robots(self.robots("two_robots", rate=0.2))
        poses = odometry.along(data.robots[0], np.array([1.05, 2.0]))
        for pose, time in zip(poses, (1.05, 2.0)):  # a circle of 2.5 m
            np.testing.assert_allclose(pose, [2.5 * math.sin(0.2 * time), 1 + 2.5 * (1 - math.cos(0.2 * time)),
                                              0.2 * time], atol=1e-9)

    def test_covariance_of_a_motion(self):
        """Against random motions: path and turn of each record have white noise."""
        import settings
        data = recordings.read_robots(self.robots("two_robots", rate=0.2))
        robot, random = data.robots[0], np.random.default_rng(1)
        step, covariance = odometry.motion(robot, 0.0, 3.0)
        exact, ends = robot.odometry.copy(), []
        for _ in range(800):
            robot.odometry = exact.copy()
            robot.odometry[:, 1] += random.normal(0, settings.SPEED / math.sqrt(0.1), len(exact))
            robot.odometry[:, 2] += random.normal(0, settings.TURN / math.sqrt(0.1), len(exact))
            ends.append(odometry.motion(robot, 0.0, 3.0)[0] - step)
        drawn = np.cov(np.array(ends).T)
        scale = np.sqrt(np.outer(np.diag(covariance), np.diag(covariance)))
        self.assertLess(np.max(np.abs(drawn - covariance) / scale), 0.12)


if __name__ == "__main__":
    unittest.main()
