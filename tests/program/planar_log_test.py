# SPDX-License-Identifier: BSD-3-Clause
"""The planar form of the neutral log: its figures, its noise, and bad records."""
import math
import unittest

import planar_world
from support import (ALWAYS, WITH_SUBMAPS, WITH_TRUE_END, WITH_TRUE_LANDMARKS, WITH_TRUE_POSES, ProgramTest, call)

GOOD = ["N 0.1 0.2 0.05 0.3 0.02", "T 0 0 1 2 0.5", "Z 0 7 4 0", "T 1 1 2 2 0.5", "O 1 1 0 0", "L 7 5 2"]


class PlanarLog(ProgramTest):
    def test_figures(self):
        sums = dict.fromkeys(("pose_anees_per_dof", "nis_per_dof"), 0.0)
        for seed in range(1, 9):
            s = self.summary(self.write("a.log", planar_world.World(seed).neutral()))
            self.assertLessEqual(ALWAYS | WITH_SUBMAPS | WITH_TRUE_POSES | WITH_TRUE_END | WITH_TRUE_LANDMARKS, set(s))
            self.assertEqual((s["steps"], s["landmarks"]), (137, 12))
            self.assertLess(s["pose_rmse_m"], 0.15)
            self.assertLess(s["landmark_rmse_m"], 0.15)
            for key in sums:
                sums[key] += s[key] / 8
        # Over 3 degrees of freedom, with the noise of the file; a factor of 2 would show.
        self.assertTrue(0.6 < sums["pose_anees_per_dof"] < 1.5, sums)
        self.assertTrue(0.9 < sums["nis_per_dof"] < 1.1, sums)

    def test_noise_of_the_file(self):
        out = self.path("out")
        self.summary(self.write("a.log", "\n".join(GOOD) + "\n"), "--output", out)
        row = self.read_csv(out, "trajectory.csv")[1]
        c, s = math.cos(0.5), math.sin(0.5)
        self.assertAlmostEqual(float(row["sigma3_x_m"]), 3 * math.hypot(0.1 * c, 0.2 * s))
        self.assertAlmostEqual(float(row["sigma3_y_m"]), 3 * math.hypot(0.1 * s, 0.2 * c))
        self.assertAlmostEqual(float(row["sigma3_dtheta_z_rad"]), 0.15)
        post = self.read_csv(out, "landmarks.csv")[0]
        self.assertAlmostEqual(float(post["x_m"]), 1 + 4 * c)
        self.assertAlmostEqual(float(post["cov_xx_m2"]), (0.3 * c) ** 2 + (4 * 0.02 * s) ** 2)
        self.assertAlmostEqual(float(post["cov_xy_m2"]), (0.3 ** 2 - (4 * 0.02) ** 2) * s * c)

    def test_noise_may_change(self):
        out = self.path("out")
        self.summary(self.write("a.log", "\n".join([*GOOD[:4], "N 0.4 0.4 0.01 1 1", *GOOD[4:]]) + "\n"), "--output", out)
        self.assertAlmostEqual(float(self.read_csv(out, "trajectory.csv")[1]["sigma3_x_m"]), 1.2)
        self.assertAlmostEqual(float(self.read_csv(out, "trajectory.csv")[1]["sigma3_dtheta_z_rad"]), 0.03)

    def test_without_truth(self):
        s = self.summary(self.write("a.log", planar_world.World().neutral(truth=False)))
        self.assert_no_truth(s)
        self.assertEqual((s["steps"], s["landmarks"]), (137, 12))

    def test_exact_motion(self):
        # A motion may be known exactly, an observation may not.
        text = planar_world.World().neutral().replace("N 0.02 0.02 0.005", "N 0 0 0")
        self.assertGreater(self.summary(self.write("a.log", text), "--gate", "1")["pose_rmse_m"], 0.15)

    def test_ids_withheld(self):
        s = self.summary(self.write("a.log", planar_world.World().neutral()), "--association", "joint")
        self.assertEqual((s["landmarks"], s["paired_wrongly"]), (12, 0))


class BadPlanarLogs(ProgramTest):
    def check(self, number, line, *words):
        lines = GOOD[:number - 1] + [line] + GOOD[number:]
        path = self.write("bad.log", "".join(line + "\n" for line in lines))
        self.assert_refused(call("run", path), "%s:%d: " % (path, number), *words)

    def test_the_good_one(self):
        self.summary(self.write("good.log", "\n".join(GOOD) + "\n"))

    def test_noise(self):
        path = self.write("bad.log", "".join(line + "\n" for line in GOOD[1:]))
        self.assert_refused(call("run", path), path + ":1: ", "begins with its noise (N)")
        self.check(1, "N 0.1 0.2 -0.05 0.3 0.02", "noise of an increment is negative")
        self.check(1, "N 0.1 0.2 1e200 0.3 0.02", "noise of an increment is negative or too large")
        self.check(1, "N 0.1 0.2 0.05 0 0.02", "noise of an observation is not positive")
        self.check(1, "N 0.1 0.2 0.05 0.3 1e-200", "too small")
        self.check(1, "N 0.1 0.2 0.05 0.3 1e200", "too large")
        self.check(1, "N 0.1 0.2 nan 0.3 0.02", "dheading 'nan'")

    def test_records_of_the_other_form(self):
        self.check(2, "T 0 0 1 2 0 0 0 0.5", "record T has 9 fields, expected 6")
        self.check(3, "Z 0 7 4 0 0", "record Z has 6 fields, expected 5")
        self.check(5, "O 1 1 0 0 0 0 0", "record O has 8 fields, expected 5")
        self.check(6, "L 7 5 2 0", "record L has 5 fields, expected 4")
        self.check(4, "N 1 1 1 1 1 1 1 1 1", "record N has 10 fields, expected 6")

    def test_values(self):
        self.check(3, "Z 0 7 0 0", "range 0 is not positive")
        self.check(3, "Z 0 7 4 west", "bearing 'west'")
        self.check(2, "T 0 0 1 inf 0.5", "y 'inf'")


if __name__ == "__main__":
    unittest.main()
