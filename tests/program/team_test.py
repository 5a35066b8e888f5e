# SPDX-License-Identifier: BSD-3-Clause
"""Teams in the program: cairn simulate usv in its modes and compared, and cairn run of a MRCLAM folder."""
import json
import math
import os
import unittest

from support import ProgramTest, call

DATA = os.environ.get("CAIRN_DATA_DIR", "")
MODES = ("mono", "eo_diagonal", "eo_full", "joint", "submaps")


def means(figures, key):
    return [value for name, value in figures.items() if name.startswith("vehicle_") and name.endswith(key)]


class Usv(ProgramTest):
    def usv(self, *options):
        return self.figures("simulate", "usv", *options)

    def untimed(self, figures):
        return {key: value for key, value in figures.items() if "_ms" not in key and "seconds" not in key}

    def test_modes(self):
        alone = self.usv("--mode", "mono")
        self.assertEqual((alone["vehicles"], alone["steps"], alone["rejected"]), (2, 301, 0))
        self.assertEqual((alone["claimed_improvement"], alone["true_improvement"]), (0, 0))
        claimed = {}
        for mode in MODES[1:]:
            s = self.usv("--mode", mode, "--runs", "5")
            claimed[mode] = s["claimed_improvement"]
            self.assertTrue(0.3 < s["pose_anees_per_dof"] < 4, (mode, s))
        # Information: mono <= extended observations <= joint; the diagonal mode is overconfident.
        self.assertGreater(claimed["joint"], claimed["eo_full"] + 0.1)
        self.assertGreater(claimed["eo_diagonal"], claimed["eo_full"])
        self.assertGreater(claimed["eo_full"], 0)

    def test_same_seed_same_figures(self):
        one, again, other = (self.untimed(self.usv("--seed", seed)) for seed in ("7", "7", "8"))
        self.assertEqual(one, again)
        self.assertNotEqual(one["pose_rmse_m"], other["pose_rmse_m"])

    def test_every_option_matters(self):
        plain = self.usv()["vehicle_1_pose_rmse_m"]
        for options in (["--features=20"], ["--vehicles", "3"], ["--layout", "coast"], ["--separation=800"],
                        ["--duration=800"], ["--period=10"], ["--far-range=3000"], ["--range-noise=10"],
                        ["--bearing-noise=0.01"], ["--velocity-noise=0.1"], ["--rate-noise=0.003"], ["--mode=mono"],
                        ["--error=standard"], ["--gate=0.9"]):
            self.assertNotEqual(self.usv(*options)["vehicle_1_pose_rmse_m"], plain, options)

    def test_every_vehicle_ends_with_the_same_map(self):
        s = self.usv("--vehicles", "3", "--output", self.path("out"))
        maps = {}
        for row in self.read_csv(self.path("out"), "team_landmarks.csv"):
            maps.setdefault(row["vehicle"], {})[row["id"]] = (float(row["x"]), float(row["y"]))
        self.assertEqual(set(maps), {"1", "2", "3"})
        for other in ("2", "3"):
            self.assertEqual(set(maps[other]), set(maps["1"]))
            for name, (x, y) in maps["1"].items():
                self.assertLess(math.hypot(maps[other][name][0] - x, maps[other][name][1] - y), 1e-6)
        rows = self.read_csv(self.path("out"), "team_trajectories.csv")
        self.assertEqual(len(rows), 3 * s["steps"])
        late = [row for row in rows if row["vehicle"] == "2" and float(row["step"]) >= 0.1 * s["steps"]]
        square = [(float(r["x"]) - float(r["true_x"])) ** 2 + (float(r["y"]) - float(r["true_y"])) ** 2 for r in late]
        self.assertAlmostEqual(math.sqrt(sum(square) / len(square)), s["vehicle_2_pose_rmse_m"], places=5)
        with open(os.path.join(self.path("out"), "summary.json")) as file:
            self.assertEqual(self.untimed(json.load(file)), self.untimed(s))

    def steps(self, name="out"):
        """norm_m2 and recursion_ms of team_steps.csv by (features, mode, vehicle), as lists of floats over the steps."""
        found = {}
        for row in self.read_csv(self.path(name), "team_steps.csv"):
            norm, taken = found.setdefault((row["features"], row["mode"], row["vehicle"]), ([], []))
            self.assertEqual(len(norm), int(row["step"]))
            norm.append(float(row["norm_m2"]))
            taken.append(float(row["recursion_ms"]))
        return found

    def test_steps_of_the_team_and_of_each_boat_by_itself(self):
        s = self.usv("--mode", "eo_full", "--features", "6", "--output", self.path("out"))
        found = self.steps()
        self.assertEqual(set(found), {("6", mode, boat) for mode in ("eo_full", "mono") for boat in ("1", "2")})
        self.assertEqual({len(norm) for norm, _ in found.values()}, {s["steps"]})
        first = s["steps"] // 10 + 1  # from a tenth of the run on, as the program scores
        ratio = sum(found["6", "eo_full", "1"][0][first:]) / sum(found["6", "mono", "1"][0][first:])
        self.assertAlmostEqual(1 - ratio, s["claimed_improvement"], places=5)
        taken = found["6", "eo_full", "1"][1] + found["6", "eo_full", "2"][1]
        self.assertAlmostEqual(sum(taken) / len(taken), s["recursion_ms_mean"], delta=1e-4 * s["recursion_ms_mean"])
        correlated = 0
        for row in self.read_csv(self.path("out"), "team_trajectories.csv"):  # the norm is at least that of the variances
            norm = found["6", "eo_full", row["vehicle"]][0][int(row["step"])]
            variances = [(float(row[name]) / 3) ** 2 for name in ("sigma3_x", "sigma3_y")]
            self.assertGreaterEqual(norm * (1 + 1e-4), math.hypot(*variances))
            self.assertLessEqual(norm, sum(variances) * (1 + 1e-4))
            correlated += norm > 1.01 * math.hypot(*variances)
        self.assertGreater(correlated, 100)

    def test_steps_of_boats_by_themselves_are_written_once(self):
        self.usv("--mode", "mono", "--duration", "100", "--output", self.path("out"))
        rows = self.read_csv(self.path("out"), "team_steps.csv")
        self.assertEqual({(row["mode"], row["runs"]) for row in rows}, {("mono", "1")})
        self.assertEqual(len(rows), 2 * 21)

    def test_the_scene(self):
        self.usv("--vehicles", "3", "--features", "7", "--far-range", "4000", "--output", self.path("out"))
        rows = self.read_csv(self.path("out"), "team_scene.csv")
        kinds = {kind: [row for row in rows if row["kind"] == kind] for kind in ("coast", "feature", "course", "radar", "drive")}
        self.assertEqual({kind: len(of_it) for kind, of_it in kinds.items()},
                         {"coast": 201, "feature": 7, "course": 3, "radar": 3, "drive": 3 * 301})
        self.assertEqual({float(row["radius"]) for row in kinds["radar"]}, {4000})
        known = {row["id"]: row for row in self.read_csv(self.path("out"), "team_landmarks.csv")}
        for row in kinds["feature"]:
            if row["id"] in known:
                self.assertEqual((row["x"], row["y"]), (known[row["id"]]["true_x"], known[row["id"]]["true_y"]))
        truth = [row for row in self.read_csv(self.path("out"), "team_trajectories.csv")]
        self.assertEqual([(row["id"], row["x"], row["y"]) for row in kinds["drive"]],
                         [(row["vehicle"], row["true_x"], row["true_y"]) for row in truth])
        for course, radar, start in zip(kinds["course"], kinds["radar"], truth):
            self.assertEqual((radar["x"], radar["y"]), (start["true_x"], start["true_y"]))
            radius = float(course["radius"])
            self.assertAlmostEqual(radius, 1700 / (2 * math.pi), places=2)
            self.assertAlmostEqual(float(course["x"]), float(start["true_x"]), places=2)  # it starts in the south
            self.assertAlmostEqual(float(course["y"]) - radius, float(start["true_y"]), places=2)

    def test_withheld_ids(self):
        s = self.usv("--features", "6", "--association", "joint", "--range-noise", "3", "--bearing-noise", "0.001")
        self.assertGreater(s["paired"], 1000)
        self.assertLess(s["wrong_pairings"], 0.01 * s["paired"])

    def test_compare(self):
        done = call("simulate", "usv", "--compare", "--runs", "2", "--quiet", "--output", self.path("out"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = done.stdout.splitlines()
        self.assertEqual(len(lines), 1 + 3 * len(MODES))
        for features, paper in (("6", "50 %"), ("10", "40 %"), ("40", "30 %")):
            of_these = [line for line in lines if line.split()[0] == features]
            self.assertEqual(sorted(line.split()[1] for line in of_these), sorted(MODES))
            self.assertEqual(sum(paper in line[-8:] for line in of_these), 1)
        rows = self.read_csv(self.path("out"), "team_compare.csv")
        self.assertEqual(len(rows), 3 * len(MODES))
        with open(os.path.join(self.path("out"), "summary.json")) as file:
            summary = json.load(file)
        for row in rows:
            own = summary[f"{row['mode']}_{row['features']}"]
            self.assertAlmostEqual(100 * own["claimed_improvement"], float(row["claimed"]), places=3)
        found = self.steps()
        self.assertEqual(set(found), {(f, mode, boat) for f in ("6", "10", "40") for mode in MODES for boat in ("1", "2")})
        self.assertTrue(all(0 < value < 1e4 for _, taken in found.values() for value in taken))
        first = 301 // 10 + 1
        for row in rows:
            ratio = (sum(found[row["features"], row["mode"], "1"][0][first:])
                     / sum(found[row["features"], "mono", "1"][0][first:]))
            self.assertAlmostEqual(100 * (1 - ratio), float(row["claimed"]), places=3)
        self.assertEqual({row["runs"] for row in self.read_csv(self.path("out"), "team_steps.csv")}, {"2"})
        scene = self.read_csv(self.path("out"), "team_scene.csv")
        self.assertEqual(sum(row["kind"] == "feature" for row in scene), 40)

    def test_bad_usage(self):
        for arguments, word in ((["--mode", "friends"], "eo_full"), (["--vehicles", "0"], "1 to 64"),
                                (["--course", "laps"], "--course"), (["mars"], "second"),
                                (["--features", "0"], "1 to 1000")):
            self.assert_refused(call("simulate", "usv", *arguments), word)
        self.assert_refused(call("simulate", "usv", "--separation", "9000"), "separation", status=1)


def mrclam_folder(folder, robots=2, spoil=None):
    """Robots that drive circles and see four posts and each other, every second, without noise."""
    os.makedirs(folder)
    posts = {6: (3.0, 0.0), 7: (0.0, 3.0), 8: (-3.0, 1.0), 9: (1.0, -3.0)}
    files = {"Barcodes.dat": "# subject barcode\n" + "".join(f"{s} {10 + s}\n" for s in [*range(1, robots + 1), *posts]),
             "Landmark_Groundtruth.dat": "".join(f"{s} {x} {y} 0 0\n" for s, (x, y) in posts.items())}

    def pose(robot, t):
        heading = 0.2 * t
        return (robot - 1.5 + 0.5 * math.sin(heading), -0.5 * math.cos(heading), heading)
    for robot in range(1, robots + 1):
        odometry = "".join(f"{0.1 * k:.1f} 0.1 0.2\n" for k in range(600))
        truth, seen = "", ""
        for k in range(600):
            x, y, heading = pose(robot, 0.1 * k)
            truth += f"{0.1 * k:.1f} {x:.9f} {y:.9f} {heading:.9f}\n"
            if k % 10 != 5:
                continue
            targets = dict(posts)
            for other in range(1, robots + 1):
                if other != robot:
                    targets[other] = pose(other, 0.1 * k)[:2]
            for subject, (px, py) in targets.items():
                bearing = math.remainder(math.atan2(py - y, px - x) - heading, 2 * math.pi)
                seen += f"{0.1 * k:.1f} {10 + subject} {math.hypot(px - x, py - y):.9f} {bearing:.9f}\n"
        files[f"Robot{robot}_Odometry.dat"] = odometry
        files[f"Robot{robot}_Groundtruth.dat"] = truth
        files[f"Robot{robot}_Measurement.dat"] = seen
    if spoil:
        spoil(files)
    for name, content in files.items():
        with open(os.path.join(folder, name), "w") as file:
            file.write(content)
    return folder


class Mrclam(ProgramTest):
    def test_every_mode_follows_exact_measurements(self):
        folder = mrclam_folder(self.path("robots"))
        for mode in MODES:
            s = self.summary(folder, "--mode", mode)
            self.assertEqual((s["vehicles"], s["steps"], s["landmarks"]), (2, 60, 4))
            self.assertLess(s["pose_rmse_m"], 0.02, mode)
            self.assertLess(s["landmark_rmse_m"], 0.02, mode)

    def test_ids_withheld(self):
        folder = mrclam_folder(self.path("robots"))
        s = self.summary(folder, "--association", "joint")
        self.assertEqual((s["landmarks"], s["wrong_pairings"]), (4, 0))

    def test_time_of_the_run(self):
        s = self.summary(mrclam_folder(self.path("robots")))
        self.assertTrue(0 < s["filter_seconds"] < s["seconds"], s)

    def test_lines_out_of_time_order(self):
        plain = self.untimed(self.summary(mrclam_folder(self.path("a"))))

        def spoil(files):
            for name, lines in ((name, files[name].splitlines(True)) for name in list(files)):
                if name == "Robot1_Odometry.dat":
                    lines[3], lines[7], lines[9] = lines[9], lines[3], lines[7]
                elif name in ("Robot2_Measurement.dat", "Robot2_Groundtruth.dat"):
                    lines.insert(2, lines.pop())
                files[name] = "".join(lines)
        folder = mrclam_folder(self.path("b"), spoil=spoil)
        done = call("run", folder, "--summary", "json")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(self.untimed(json.loads(done.stdout)), plain)
        notes = sorted(line for line in done.stderr.splitlines() if "note: " in line)
        self.assertEqual(len(notes), 3, done.stderr)
        self.assertIn("Robot1_Odometry.dat: sorted by time, because of 3 lines", notes[0])
        self.assertIn("Robot2_Groundtruth.dat: sorted by time, because of 1 line earlier", notes[1])
        self.assertIn("Robot2_Measurement.dat: sorted by time", notes[2])

    def untimed(self, figures):
        return {key: value for key, value in super().untimed(figures).items() if "_ms" not in key}

    def test_as_text_comes(self):
        plain = self.untimed(self.summary(mrclam_folder(self.path("a"))))

        def spoil(files):
            for name, text in files.items():
                files[name] = "\ufeff" + text.replace("\n", "\r\n").replace(" ", "\t").rstrip("\r\n")
        self.assertEqual(self.untimed(self.summary(mrclam_folder(self.path("b"), spoil=spoil))), plain)

    def test_robots_without_truth(self):
        # They start where the posts that they see place them.
        def spoil(files):
            for robot in (1, 2):
                files.pop(f"Robot{robot}_Groundtruth.dat")
        folder = mrclam_folder(self.path("a"), spoil=spoil)
        for mode in MODES:
            s = self.summary(folder, "--mode", mode)
            self.assertEqual((s["vehicles"], s["steps"], s["landmarks"]), (2, 60, 4))
            self.assertFalse([key for key in s if "pose_" in key or "improvement" in key], s)
            self.assertLess(s["landmark_rmse_m"], 0.02, mode)
        done = call("run", folder)
        for robot in (1, 2):
            self.assertIn(f"note: robot {robot}: its first odometry has no true pose; it starts where", done.stderr)
        self.summary(folder, "--output", self.path("out"))
        first = self.read_csv(self.path("out"), "team_trajectories.csv")[0]
        self.assertEqual((first["true_x"], first["true_heading"]), ("", ""))
        self.assertGreater(float(first["sigma3_x"]), 0.01)  # the start is not known exactly
        self.assertLess(math.hypot(float(first["x"]) + 0.45, float(first["y"]) + 0.5), 0.01)

    def test_some_robots_without_truth(self):
        def spoil(files):
            files["Robot2_Groundtruth.dat"] = "# nothing\n"
        s = self.summary(mrclam_folder(self.path("a"), spoil=spoil))
        self.assertLess(s["pose_rmse_m"], 0.05)
        self.assertEqual(s["pose_rmse_m"], s["vehicle_1_pose_rmse_m"])
        self.assertNotIn("vehicle_2_pose_rmse_m", s)

    def test_a_start_that_nothing_tells(self):
        def blind(files):
            files.pop("Robot1_Groundtruth.dat")
            files["Robot1_Measurement.dat"] = ""
        self.assert_refused(call("run", mrclam_folder(self.path("a"), spoil=blind)),
                            "robot 1: its first odometry has no true pose", "too few posts")

        def one_post(files):
            files.pop("Robot1_Groundtruth.dat")
            files["Robot1_Measurement.dat"] = "".join(
                line for line in files["Robot1_Measurement.dat"].splitlines(True) if line.split()[1] == "16")
        # A single robot needs no frame that it shares. Its map has one of its own, which is not that of the true posts.
        s = self.summary(mrclam_folder(self.path("b"), robots=1, spoil=one_post))
        self.assertEqual(s["landmarks"], 1)
        self.assertNotIn("landmark_rmse_m", s)

    def test_steps_whose_covariance_is_nearly_singular(self):
        # After one motion from a known start, speed and rate have moved three numbers: the covariance has rank 2.
        def spoil(files):
            files["Robot2_Odometry.dat"] = "".join(f"{0.05 * k + 0.017:.3f} 0.067 0.0\n" for k in range(1200))
            files["Robot2_Groundtruth.dat"] = "".join(f"{0.1 * k:.1f} 0.0003 0.0002 2.4886\n" for k in range(600))
            files["Robot2_Measurement.dat"] = "".join(f"{0.25 * k + 0.04:.3f} 16 3.1 -2.1\n" for k in range(200))
        folder = mrclam_folder(self.path("a"), spoil=spoil)
        for mode in MODES:
            s = self.summary(folder, "--mode", mode)
            self.assertLess(s["vehicle_2_pose_anees_per_dof"], 1e4, mode)

    @unittest.skipUnless(DATA, "CAIRN_DATA_DIR is not set")
    def test_a_recording_with_a_nearly_singular_step(self):
        for mode in MODES:
            s = self.summary(os.path.join(DATA, "two_robots"), "--mode", mode)
            self.assertLess(s["pose_anees_per_dof"], 3, mode)

    @unittest.skipUnless(DATA, "CAIRN_DATA_DIR is not set")
    def test_real_lines_out_of_time_order(self):
        done = call("run", os.path.join(DATA, "mrclam9"), "--mode", "mono", "--summary", "json")
        self.assertEqual(done.returncode, 0)
        for robot in (1, 2, 3, 4):
            self.assertIn(f"note: Robot{robot}_Odometry.dat: sorted by time, because of 1 line earlier", done.stderr)

    def test_turns_slower_than_recorded(self):
        # The odometry says 0.4 rad/s, the robots turn 0.2: the posts tell.
        def spoil(files):
            for robot in (1, 2):
                name = f"Robot{robot}_Odometry.dat"
                files[name] = files[name].replace(" 0.2\n", " 0.4\n")
        done = call("run", mrclam_folder(self.path("a"), spoil=spoil), "--summary", "json")
        self.assertEqual(done.returncode, 0)
        self.assertIn("note: turns while driving: 0.50 of the odometry's rate", done.stderr)
        measured = json.loads(done.stdout)["pose_rmse_m"]
        self.assertLess(measured, 0.02)
        asis = call("run", self.path("a"), "--turns", "recorded", "--summary", "json")
        self.assertNotIn("turns while driving", asis.stderr)
        self.assertGreater(json.loads(asis.stdout)["pose_rmse_m"], 2 * measured)

    @unittest.skipUnless(DATA, "CAIRN_DATA_DIR is not set")
    def test_real_robots_that_turn_slower_than_recorded(self):
        s = self.summary(os.path.join(DATA, "mrclam9"))
        self.assertLess(s["pose_rmse_m"], 0.45)
        self.assertLess(s["landmark_rmse_m"], 0.06)

    def test_limits_of_submaps(self):
        folder = mrclam_folder(self.path("a"))
        submaps = lambda *options: self.untimed(self.summary(folder, "--mode", "submaps", *options))
        usual = submaps()
        self.assertEqual(submaps("--submap-landmarks=60", "--submap-distance=2"), usual)
        self.assertNotEqual(submaps("--submap-distance=0"), usual)  # no limit
        self.assertEqual(self.untimed(self.summary(folder, "--single-map")), self.untimed(self.summary(folder)))

    def test_bad_folders(self):
        self.assert_refused(call("run", mrclam_folder(self.path("a"), spoil=lambda f: f.pop("Robot2_Odometry.dat"))),
                            "Robot2_Odometry.dat")
        self.assert_refused(call("run", mrclam_folder(self.path("b"), spoil=lambda f: f.update(
            {"Robot1_Odometry.dat": "0 0.1\n"}))), "Robot1_Odometry.dat:1")
        folder = mrclam_folder(self.path("c"))
        self.assert_refused(call("run", folder, "--mode", "all"), "--mode")
        self.assert_refused(call("run", folder, folder), "second")

    @unittest.skipUnless(DATA, "CAIRN_DATA_DIR is not set")
    def test_five_real_robots(self):
        folder = os.path.join(DATA, "mrclam7")
        s = self.summary(folder)
        self.assertEqual((s["vehicles"], s["landmarks"]), (5, 15))
        self.assertLessEqual(s["pose_rmse_m"], 0.20)
        self.assertLessEqual(s["landmark_rmse_m"], 0.12)
        # the gate of a folder of robots, which another one of the command line replaces
        self.assertEqual(self.untimed(self.summary(folder, "--gate=0.99")), self.untimed(s))
        self.assertLess(self.summary(folder, "--gate=0.999")["rejected"], s["rejected"])
        self.assertLessEqual(s["pose_anees_per_dof"], 3)
        alone = self.summary(folder, "--mode", "mono")
        self.assertGreater(alone["pose_rmse_m"], 2 * s["pose_rmse_m"])

    @unittest.skipUnless(DATA, "CAIRN_DATA_DIR is not set")
    def test_five_real_robots_without_ids(self):
        folder = os.path.join(DATA, "mrclam7")
        noise = ("--range-noise", "0.044", "--bearing-noise", "0.016", "--error-persistence", "18")
        known = self.summary(folder, *noise)
        s = self.summary(folder, "--association", "joint")
        self.assertLessEqual(abs(s["landmarks"] - 15), 2)
        self.assertLessEqual(s["pose_rmse_m"], 1.25 * known["pose_rmse_m"])
        self.assertLessEqual(s["landmark_rmse_m"], 1.25 * known["landmark_rmse_m"])
        self.assertLessEqual(s["pose_anees_per_dof"], 1.5)


if __name__ == "__main__":
    unittest.main()
