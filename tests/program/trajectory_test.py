# SPDX-License-Identifier: BSD-3-Clause
"""The trajectories that a run writes: their form, and the error of the corrected one."""
import math
import os
import unittest

from support import ProgramTest


class Trajectories(ProgramTest):
    def tum(self, folder, name):
        with open(os.path.join(folder, name)) as file:
            rows = [[float(word) for word in line.split(" ")] for line in file]
        for row in rows:
            self.assertEqual(len(row), 8)
            self.assertAlmostEqual(math.hypot(*row[4:]), 1, places=12)
        return rows

    def rmse(self, one, other):
        return math.sqrt(sum(math.dist(a[1:4], b[1:4]) ** 2 for a, b in zip(one, other)) / len(one))

    def check_files(self, *command):
        folder = self.path("out")
        s = self.figures(*command, "--output", folder)
        online, corrected, truth = (self.tum(folder, f"trajectory_{name}.tum")
                                    for name in ("online", "corrected", "truth"))
        table = self.read_csv(folder, "trajectory.csv")
        self.assertEqual({len(online), len(corrected), len(truth), len(table)}, {s["steps"]})
        for row, wanted in zip(online, table):
            time = wanted["t_s"] or wanted["step"]
            names = ("x_m", "y_m", "z_m", "qx", "qy", "qz", "qw")
            self.assertEqual(row, [float(time)] + [float(wanted[name]) for name in names])
        self.assertEqual([row[0] for row in corrected], [row[0] for row in online])
        self.assertAlmostEqual(self.rmse(online, truth), s["pose_rmse_m"], places=6)
        self.assertAlmostEqual(self.rmse(corrected, truth), s["pose_rmse_corrected_m"], places=6)
        return s, corrected, online

    def test_a_recorded_log(self):
        s, _, online = self.check_files("run", self.write("a.log", self.neutral_log()), "--submap-landmarks=15")
        self.assertEqual([row[0] for row in online[:3]], [0, 0.25, 0.5])
        self.assertLess(s["pose_rmse_corrected_m"], s["pose_rmse_m"])

    def test_a_log_without_times(self):
        """iSAM's form has none: the times are the numbers of the steps."""
        edges = "".join(f"EDGE2 {k} {k + 1} 1 0 0 50 0 0 50 0 100\n" for k in range(4))
        self.write("line_groundtruth.txt", edges)
        _, _, online = self.check_files("run", self.write("line.txt", edges + "LANDMARK 1 7 2 0.5 10 0 10\n"))
        self.assertEqual([row[0] for row in online], [0, 1, 2, 3, 4])

    def test_a_simulated_world(self):
        s, _, online = self.check_files("simulate", "mars", "--course=laps")
        self.assertLess(s["pose_rmse_corrected_m"], 0.9 * s["pose_rmse_m"])
        self.assertGreater(online[1][0], 0)

    def test_a_single_map_corrects_nothing(self):
        s, corrected, online = self.check_files("simulate", "mars", "--single-map")
        self.assertEqual(corrected, online)
        self.assertEqual(s["pose_rmse_corrected_m"], s["pose_rmse_m"])

    def test_steps_without_observations(self):
        """Every third step of the log loses its observations. Its pose is kept all the same."""
        lines = [line for line in self.neutral_log().splitlines(keepends=True)
                 if not (line.startswith("Z") and int(line.split()[1]) % 3 == 1)]
        self.check_files("run", self.write("b.log", "".join(lines)), "--submap-landmarks=15")


if __name__ == "__main__":
    unittest.main()
