# SPDX-License-Identifier: BSD-3-Clause
"""iSAM's text form: its figures, its covariances, records in any order, and bad records."""
import os
import random
import unittest

import planar_world
from support import (ALWAYS, WITH_SUBMAPS, WITH_TRUE_END, WITH_TRUE_LANDMARKS, WITH_TRUE_POSES, ProgramTest, call)

DATA = os.environ.get("CAIRN_DATA_DIR", "")
R3 = (50, 10, 5, 40, -8, 100)  # rows of an upper triangle
R2 = (20, 6, 25)
GOOD = ["EDGE2 0 1 1 0.5 0.3 50 10 5 40 -8 100", "LANDMARK 0 7 4 1 20 6 25", "LANDMARK 1 7 3 1 20 6 25"]


def product(A, B):
    return [[sum(a * b for a, b in zip(row, column)) for column in zip(*B)] for row in A]


def transposed(A):
    return [list(column) for column in zip(*A)]


def inverted(A):
    """Gauss-Jordan; enough for covariances."""
    n = len(A)
    rows = [[float(v) for v in row] + [float(i == k) for k in range(n)] for i, row in enumerate(A)]
    for i in range(n):
        rows[i] = [v / rows[i][i] for v in rows[i]]
        for k in range(n):
            if k != i:
                rows[k] = [a - rows[k][i] * b for a, b in zip(rows[k], rows[i])]
    return [row[n:] for row in rows]


def covariance(upper):
    n = 2 if len(upper) == 3 else 3
    R, values = [], iter(upper)
    for i in range(n):
        R.append([0.0] * i + [float(next(values)) for _ in range(n - i)])
    return inverted(product(transposed(R), R))


def root(information):
    """R of R^T R, as the rows of its upper triangle."""
    n = len(information)
    R = [[0.0] * n for _ in range(n)]
    for i in range(n):
        for j in range(i, n):
            rest = information[i][j] - sum(R[k][i] * R[k][j] for k in range(i))
            R[i][j] = rest ** 0.5 if i == j else rest / R[i][i]
    return [R[i][j] for i in range(n) for j in range(i, n)]


def reversed_edge(line):
    """The same measurement as an edge from the later pose to the earlier one."""
    fields = line.split()
    motion = [float(v) for v in fields[3:6]]
    back = planar_world.inverse(motion)
    J = []  # by numerical differences, column by column
    for k in range(3):
        step = 1e-6
        ends = [planar_world.inverse([v + sign * step * (i == k) for i, v in enumerate(motion)]) for sign in (1, -1)]
        J.append([(a - b) / (2 * step) for a, b in zip(*ends)])
    J = transposed(J)
    C = product(product(J, covariance([float(v) for v in fields[6:]])), transposed(J))
    values = [*back, *root(inverted(C))]
    return "EDGE2 %s %s " % (fields[2], fields[1]) + " ".join("%.12g" % v for v in values)


class IsamLog(ProgramTest):
    def world(self, name, seed=1):
        world = planar_world.World(seed)
        self.write(name + "_groundtruth.txt", world.isam(noise=False))
        return self.write(name + ".txt", world.isam())

    def test_figures(self):
        sums = dict.fromkeys(("pose_anees_per_dof", "nis_per_dof"), 0.0)
        for seed in range(1, 9):
            s = self.summary(self.world("a", seed))
            self.assertLessEqual(ALWAYS | WITH_SUBMAPS | WITH_TRUE_POSES | WITH_TRUE_END | WITH_TRUE_LANDMARKS, set(s))
            self.assertEqual((s["steps"], s["landmarks"]), (137, 12))
            self.assertLess(s["pose_rmse_m"], 0.15)
            self.assertLess(s["landmark_rmse_m"], 0.15)
            for key in sums:
                sums[key] += s[key] / 8
        self.assertTrue(0.6 < sums["pose_anees_per_dof"] < 1.5, sums)
        self.assertTrue(0.9 < sums["nis_per_dof"] < 1.1, sums)

    def test_without_truth(self):
        s = self.summary(self.write("a.txt", planar_world.World().isam()))
        self.assert_no_truth(s)

    def test_the_name_tells_nothing(self):
        world = planar_world.World()
        self.write("a_groundtruth", world.isam(noise=False))
        self.assertIn("pose_rmse_m", self.summary(self.write("a", world.isam())))

    def test_covariances(self):
        out = self.path("out")
        self.summary(self.write("a.txt", "\n".join(GOOD[:2]) + "\n"), "--output", out)
        C = covariance(R3)
        row = self.read_csv(out, "trajectory.csv")[1]
        self.assertAlmostEqual(float(row["x_m"]), 1)
        for name, variance in (("x_m", C[0][0]), ("y_m", C[1][1]), ("dtheta_z_rad", C[2][2])):
            self.assertAlmostEqual(float(row["sigma3_" + name]), 3 * variance ** 0.5, places=9)
        C = covariance(R2)
        post = self.read_csv(out, "landmarks.csv")[0]
        self.assertEqual((float(post["x_m"]), float(post["y_m"]), float(post["z_m"])), (4, 1, 0))
        for name, variance in (("xx", C[0][0]), ("xy", C[0][1]), ("yy", C[1][1])):
            self.assertAlmostEqual(float(post["cov_%s_m2" % name]), variance, places=9)

    def test_any_order(self):
        plain = self.summary(self.world("a"))
        lines = planar_world.World().isam().splitlines()
        edges = [line for line in lines if line.startswith("EDGE2")]
        sightings = [line for line in lines if line.startswith("LANDMARK")]
        random.Random(3).shuffle(edges)
        self.write("b_groundtruth.txt", planar_world.World().isam(noise=False))
        s = self.summary(self.write("b.txt", "\n".join(sightings + edges) + "\n"))
        self.assertEqual(self.untimed(s), self.untimed(plain))

    def test_edges_from_the_later_pose(self):
        text = planar_world.World().isam().replace("50 0 0 50 0 200", "50 10 5 40 -8 100")
        plain = self.summary(self.write("a.txt", text), "--output", self.path("a"))
        back = "\n".join(reversed_edge(line) if line.startswith("EDGE2") else line for line in text.splitlines())
        self.assertEqual(self.summary(self.write("b.txt", back + "\n"), "--output", self.path("b"))["steps"], plain["steps"])
        for one, two in zip(self.read_csv(self.path("a"), "trajectory.csv"), self.read_csv(self.path("b"), "trajectory.csv")):
            for key in ("x_m", "y_m", "qz", "sigma3_x_m", "sigma3_y_m", "sigma3_dtheta_z_rad"):
                self.assertAlmostEqual(float(one[key]), float(two[key]), places=5)

    def test_what_is_left_out_is_told(self):
        text = planar_world.World().isam()
        plain = self.summary(self.write("a.txt", text))
        first = text.splitlines()[0]
        self.assertTrue(first.startswith("LANDMARK"))
        more = ["EDGE2 0 40 1 1 1 50 0 0 50 0 200", "EDGE2 90 3 1 1 1 50 0 0 50 0 200", "EDGE2 0 1 9 9 9 1 0 0 1 0 1", first]
        done = call("run", self.write("b.txt", text + "\n".join(more) + "\n"), "--summary", "json")
        self.assertEqual(done.returncode, 0)
        self.assertIn("left out 2 EDGE2 between poses that do not follow each other", done.stderr)
        self.assertIn("left out 1 EDGE2 between two poses that already have one", done.stderr)
        self.assertIn("left out 1 LANDMARK of a landmark that the pose already has", done.stderr)
        self.assertEqual(self.untimed(self.summary(self.path("b.txt"))), self.untimed(plain))

    @unittest.skipUnless(DATA, "CAIRN_DATA_DIR is not set")
    def test_city_trees(self):
        log = os.path.join(DATA, "cityTrees10000.txt")
        s = self.summary(log, "--single-map")
        self.assertEqual((s["steps"], s["landmarks"], s["observations"]), (10000, 100, 4443))
        self.assertLessEqual(s["pose_rmse_m"], 1.9)
        self.assertTrue(0.9 < s["pose_anees_per_dof"] < 1.1, s)
        self.assertLessEqual(self.summary(log, "--single-map", "--gate", "1")["pose_rmse_m"], 1.5)


class BadIsamLogs(ProgramTest):
    def check(self, number, line, *words):
        lines = GOOD[:number - 1] + [line] + GOOD[number:]
        path = self.write("bad.txt", "".join(line + "\n" for line in lines))
        self.assert_refused(call("run", path), "%s:%d: " % (path, number), *words)

    def test_the_good_one(self):
        self.summary(self.write("good.txt", "\n".join(GOOD) + "\n"))

    def test_records(self):
        self.check(2, "VERTEX2 0 0 0 0", "TORO")
        self.check(1, "VERTEX2 0 0 0 0", "TORO")
        self.check(2, "POINT2 1 2 3", "unknown record 'POINT2', expected EDGE2 or LANDMARK")
        self.check(1, "EDGE2 0 1 1 0.5 0.3", "record EDGE2 has 6 fields, expected 12")
        self.check(3, "LANDMARK 1 7 3 1 20 6 25 1", "record LANDMARK has 9 fields, expected 8")

    def test_values(self):
        self.check(1, "EDGE2 0 1 1 nan 0.3 50 10 5 40 -8 100", "dy 'nan'")
        self.check(1, "EDGE2 0 -1 1 0 0.3 50 10 5 40 -8 100", "pose '-1'")
        self.check(1, "EDGE2 1 1 1 0 0.3 50 10 5 40 -8 100", "from pose 1 to itself")
        self.check(3, "LANDMARK 1 18446744073709551615 3 1 20 6 25", "reserved")

    def test_matrices_without_a_covariance(self):
        for zero in ("0 10 5 40 -8 100", "50 10 5 0 -8 100", "50 10 5 40 -8 0", "50 10 5 40 -8 1e-200", "1e200 0 0 40 0 100"):
            self.check(1, "EDGE2 0 1 1 0.5 0.3 " + zero, "gives no finite, positive covariance")
        for zero in ("0 6 25", "20 6 0", "1e-170 0 1", "1e200 0 1e200"):
            self.check(2, "LANDMARK 0 7 4 1 " + zero, "gives no finite, positive covariance")

    def test_a_pose_that_no_edge_reaches(self):
        path = self.write("bad.txt", "\n".join(GOOD + ["LANDMARK 5 7 3 1 20 6 25"]) + "\n")
        self.assert_refused(call("run", path), path, "no record EDGE2 leads from pose 1 to pose 5")

    def test_bad_truth(self):
        log = self.write("a.txt", "\n".join(GOOD) + "\n")
        beside = self.write("a_groundtruth.txt", "EDGE2 0 1 1 0 0 1 0 0 1 0\n")
        self.assert_refused(call("run", log), beside + ":1: ", "record EDGE2 has 11 fields")


if __name__ == "__main__":
    unittest.main()
