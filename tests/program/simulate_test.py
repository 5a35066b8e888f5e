# SPDX-License-Identifier: BSD-3-Clause
"""cairn simulate on small worlds: figures, files, comparison, and what is refused."""
import json
import math
import os
import unittest

from support import (ALWAYS, LEARNED, WITH_SUBMAPS, WITH_TRUE_END, WITH_TRUE_LANDMARKS, WITH_TRUE_POSES, ProgramTest, call)

ALL = ALWAYS | WITH_SUBMAPS | WITH_TRUE_POSES | WITH_TRUE_END | WITH_TRUE_LANDMARKS


class Simulate(ProgramTest):
    def mars(self, *options):
        return self.figures("simulate", "mars", *options)

    def test_the_papers_world(self):
        s = self.mars("--preset", "paper")
        self.assertEqual(set(s) - LEARNED, ALL)
        self.assertEqual((s["steps"], s["landmarks"], s["rejected"]), (201, 200, 0))
        self.assertGreater(s["submaps"], 4)
        self.assertLess(s["pose_axis_max_m"], 1)
        self.assertLess(s["attitude_axis_max_deg"], 0.5)
        self.assertLess(s["landmark_rmse_m"], 1.5)
        self.assertTrue(0.8 < s["nis_per_dof"] < 1.2, s)
        self.assertTrue(0.1 < s["pose_anees_per_dof"] < 3, s)
        self.assertLess(s["filter_seconds"], s["seconds"])

    def test_same_seed_same_figures(self):
        one, again, other = (self.untimed(self.mars("--seed", seed)) for seed in ("7", "7", "8"))
        self.assertEqual(one, again)
        self.assertNotEqual(one["pose_rmse_m"], other["pose_rmse_m"])

    def test_every_option_of_the_world_matters(self):
        plain = self.mars()
        for options in (["--laps", "2"], ["--radius=150"], ["--start-azimuth", "-1"], ["--landmarks=300"],
                        ["--speed=2"], ["--terrain", "waves"], ["--terrain=flat"], ["--max-slope=0.1"],
                        ["--contact", "point"],
                        ["--drive", "wheels-gyro"], ["--drive", "wheels"], ["--accelerometer", "acceleration"],
                        ["--stick", "per-frame"], ["--velocity-noise", "0.01"], ["--rate-noise=0.002"],
                        ["--drive=wheels-gyro", "--wheel-noise=0.1"], ["--drive=wheels-gyro", "--wheel-slip=0.1"],
                        ["--range-noise=2"], ["--azimuth-noise=0.02"], ["--stick-noise=0.02"], ["--near-range=10"],
                        ["--far-range=30"], ["--half-azimuth=0.8"], ["--pan-scan=0.7"], ["--stick-scan=0.1"],
                        ["--imu-period=0.1"], ["--motion-period=0.05"], ["--frame-period=1"], ["--course", "laps"],
                        ["--course=traverse"], ["--error=standard"], ["--iterations=1"], ["--gate=0.9"],
                        ["--submap-landmarks=30"], ["--single-map"], ["--preset=row1"], ["--seed=2"]):
            self.assertNotEqual(self.mars(*options)["pose_rmse_m"], plain["pose_rmse_m"], options)
        self.assertGreater(self.mars("--gate=0.9")["rejected"], 0)

    def test_courses_get_as_long_as_landmarks_ask(self):
        laps = self.mars("--course", "laps", "--landmarks", "400")
        self.assertEqual(laps["landmarks"], 400)
        self.assertAlmostEqual(laps["steps"], 2 * 400 * 160 / 50 / 1.6019 / 2, delta=2)
        traverse = self.mars("--course=traverse", "--landmarks=1500")
        self.assertGreater(traverse["landmarks"], 1490)
        # circles that touch share some of their ground, which makes them a little longer
        self.assertAlmostEqual(traverse["steps"], 1.25 * 1500 * 160 / 50 / 1.6019 / 2, delta=200)
        self.assertLess(traverse["filter_landmarks_max"], 70)
        home = self.mars("--course=traverse", "--landmarks=1800", "--closed", "--round-length=300")
        self.assertGreater(home["steps"], 1.25 * 1800 * 160 / 50 / 1.6019 / 2)

    def test_preset_counts_first(self):
        before = self.mars("--laps=1.5", "--submap-landmarks=30", "--preset=row2")
        after = self.mars("--preset=row2", "--laps=1.5", "--submap-landmarks=30")
        self.assertEqual(self.untimed(before), self.untimed(after))
        rows = [self.mars("--preset=row%d" % i) for i in (1, 2, 3, 4)]
        self.assertEqual([row["steps"] for row in rows], [201] * 4)
        self.assertLess(rows[0]["attitude_rmse_deg"], rows[3]["attitude_rmse_deg"])
        self.assertGreater(rows[2]["submaps"], rows[1]["submaps"])

    def test_runs_are_means(self):
        single = [self.mars("--seed", str(seed)) for seed in (4, 5, 6)]
        s = self.mars("--seed=4", "--runs", "3")
        means = ALL - {"verdict"}
        learned = LEARNED | {key + "_std" for key in LEARNED}
        self.assertEqual(set(s) - learned, means | {key + "_std" for key in means})
        for key in ("pose_rmse_m", "landmarks", "nis_per_dof", "submaps"):
            values = [one[key] for one in single]
            mean = sum(values) / 3
            self.assertAlmostEqual(s[key], mean, places=6)
            self.assertAlmostEqual(s[key + "_std"], math.sqrt(sum((v - mean) ** 2 for v in values) / 2), places=6)

    def test_consistency_over_seeds(self):
        s = self.mars("--preset=row3", "--runs=8")
        self.assertTrue(0.9 < s["nis_per_dof"] < 1.1, s)
        self.assertTrue(0.6 < s["pose_anees_per_dof"] < 1.6, s)
        self.assertLess(s["pose_end_m"], 1.2)

    def test_compare(self):
        out = self.path("out")
        done = call("simulate", "mars", "--compare", "--quiet", "--output", out, "--seed=3")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = {line[:42].strip(): line[42:].split() for line in done.stdout.splitlines()}
        with open(os.path.join(out, "summary.json")) as file:
            s = json.load(file)
        self.assertEqual(set(s), {"standard", "submaps"})
        self.assertEqual(set(s["submaps"]) - LEARNED, ALL)
        self.assertEqual(set(s["standard"]) - LEARNED, ALL - WITH_SUBMAPS)
        self.assertEqual(rows["features in the state variables"], ["700", "440"])
        self.assertEqual(rows["complexity, EKF-SLAM = 1"], ["1", "1", "0.248"])
        for name, key in (("largest error of position, an axis, m", "pose_axis_max_m"),
                          ("largest error of attitude, an axis, deg", "attitude_axis_max_deg")):
            cells = [cell for cell in rows[name] if cell != "<="]
            self.assertEqual(cells[0::2], ["1", "0.5"] if "position" in name else ["0.5", "0.5"])
            for cell, way in zip(cells[1::2], ("standard", "submaps")):
                self.assertAlmostEqual(float(cell), s[way][key], delta=1e-3 * s[way][key])
        work = (s["submaps"]["filter_landmarks_rms"] / s["standard"]["filter_landmarks_rms"]) ** 2
        self.assertAlmostEqual(float(rows["sum of squared landmarks in the filter"][1]), work, places=3)
        self.assertLess(work, 0.5)
        self.assertEqual(s["standard"]["submaps"], 0)
        self.assertEqual(s["standard"]["observations"], s["submaps"]["observations"])  # the same world
        for way in ("standard", "submaps"):
            with open(os.path.join(out, way, "summary.json")) as file:
                self.assertEqual(json.load(file), s[way])
            self.assertEqual(len(self.read_csv(os.path.join(out, way), "trajectory.csv")), 201)
        s = self.mars("--compare", "--runs=2")
        self.assertIn("pose_rmse_m_std", s["standard"])

    def test_files(self):
        out = self.path("out")
        s = self.mars("--course=laps", "--output", out)
        terrain = self.read_csv(out, "terrain.csv")
        columns = sum(row["y"] == terrain[0]["y"] for row in terrain)
        self.assertEqual(len(terrain) % columns, 0)
        xs = [float(row["x"]) for row in terrain]
        self.assertEqual(xs[:columns], xs[columns:2 * columns])
        self.assertEqual(xs[:columns], sorted(xs[:columns]))
        cell = xs[1] - xs[0]
        heights = {(round((float(r["x"]) - xs[0]) / cell), round((float(r["y"]) - float(terrain[0]["y"])) / cell)):
                   float(r["z"]) for r in terrain}
        trajectory = self.read_csv(out, "trajectory.csv")
        for row in trajectory[::10]:  # the rover drives on it
            x, y, z = (float(row["true_%s_m" % axis]) for axis in "xyz")
            corner = heights[math.floor((x - xs[0]) / cell), math.floor((y - float(terrain[0]["y"])) / cell)]
            self.assertLess(abs(z - corner), 1.5 * cell)
        landmarks = self.read_csv(out, "landmarks.csv")
        self.assertTrue(all(row["true_x_m"] for row in landmarks))
        self.assertEqual(len(self.read_csv(out, "submaps.csv")), s["submaps"])
        self.assertEqual(float(trajectory[-1]["t_s"]), 2 * (s["steps"] - 1))


class Refusals(ProgramTest):
    def test_bad_usage(self):
        for arguments, word in [
                ([], "no scenario"), (["venus"], "unknown scenario 'venus'"), (["mars", "mars"], "second"),
                (["mars", "--frobnicate"], "cairn simulate --help"),
                (["mars", "--course", "square"], "circle, laps or traverse"),
                (["mars", "--landmarks", "0"], "from 1 to 10000000"), (["mars", "--landmarks=1e3"], "--landmarks"),
                (["mars", "--preset", "row5"], "paper, row1, row2, row3 or row4"), (["mars", "--runs=0"], "--runs"),
                (["mars", "--compare=yes"], "takes no value"),
                (["mars", "--compare", "--single-map"], "--single-map"),
                (["mars", "--compare", "--submap-landmarks=0"], "--single-map"), (["mars", "--terrain=sea"], "rolling"),
                (["mars", "--contact=none"], "wheels or point"), (["mars", "--drive=legs"], "wheels-gyro"),
                (["mars", "--stick=joy"], "per-frame"), (["mars", "--accelerometer=none"], "acceleration"),
                (["mars", "--speed", "-1"], "--speed"), (["mars", "--rate-noise", "nan"], "--rate-noise"),
                (["mars", "--pixel-noise", "1"], "unknown option '--pixel-noise'"), (["mars", "--seed=x"], "--seed"),
                (["mars", "--radius=20"], "radius"), (["mars", "--motion-period=0.13"], "motion_period"),
                (["mars", "--far-range=1"], "far_range"), (["mars", "--half-azimuth=4"], "half_azimuth"),
                (["mars", "--max-slope=1"], "max_slope"),
                (["mars", "--course=traverse", "--closed"], "traverse_closed")]:
            self.assert_refused(call("simulate", *arguments), word)

    def test_places_that_cannot_be_written(self):
        file = self.write("file", "")
        self.assert_refused(call("simulate", "mars", "--output", file), file)
        self.assert_refused(call("simulate", "mars", "--compare", "--output", self.path("no/where")), "no/where")

    def test_too_small_a_map_refuses_what_does_not_fit(self):
        small = self.figures("simulate", "mars", "--single-map", "--max-landmarks=50")
        self.assertEqual(small["landmarks"], 50)
        self.assertGreater(small["rejected"], 0)


if __name__ == "__main__":
    unittest.main()
