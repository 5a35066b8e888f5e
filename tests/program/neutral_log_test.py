# SPDX-License-Identifier: BSD-3-Clause
"""The program on small neutral logs: figures, files and options."""
import json
import math
import os
import unittest

import make_log
from support import (ALWAYS, LEARNED, WITH_SUBMAPS, WITH_TRUE_END, WITH_TRUE_LANDMARKS, WITH_TRUE_POSES, ProgramTest, call)


def records(text, letter):
    return [[float(field) for field in line.split()[1:]] for line in text.splitlines() if line.startswith(letter + " ")]


def dead_reckoning_rmse(text):
    """Position error where the increments alone are added up."""
    truths = {int(r[0]): r[2:] for r in records(text, "T")}
    position, attitude = truths[0][:3], make_log.Rotation.from_euler(*truths[0][3:])
    square = 0.0
    for r in records(text, "O"):
        moved = attitude.turn(r[1:4])
        position = [a + b for a, b in zip(position, moved)]
        attitude = attitude * make_log.Rotation.from_euler(*r[4:7])
        square += sum((a - b) ** 2 for a, b in zip(position, truths[int(r[0])]))
    return math.sqrt(square / len(truths))


class NeutralLog(ProgramTest):
    def test_figures(self):
        text = self.neutral_log(steps=400)
        s = self.summary(self.write("a.log", text))
        self.assertEqual(set(s) - LEARNED, ALWAYS | WITH_SUBMAPS | WITH_TRUE_POSES | WITH_TRUE_END | WITH_TRUE_LANDMARKS)
        self.assertEqual(s["steps"], 401)
        self.assertEqual(s["observations"], len(records(text, "Z")))
        self.assertEqual(s["landmarks"], len({r[1] for r in records(text, "Z")}))
        self.assertLess(s["rejected"], 0.05 * s["observations"])
        self.assertLess(s["pose_rmse_m"], 0.3 * dead_reckoning_rmse(text))
        self.assertLess(s["landmark_rmse_m"], 0.25)
        self.assertLess(s["attitude_rmse_deg"], 1.0)
        self.assertLessEqual(s["pose_rmse_m"], s["pose_max_m"])
        self.assertLessEqual(s["pose_final_m"], s["pose_max_m"])
        self.assertTrue(0.1 < s["pose_anees_per_dof"] < 2, s)
        self.assertTrue(0.8 < s["nis_per_dof"] < 1.2, s)
        self.assertTrue(0 < s["step_ms_mean"] <= s["step_ms_worst"], s)
        self.assertLessEqual(s["step_ms_p99"], s["step_ms_worst"])

    def test_same_log_same_figures(self):
        log = self.write("a.log", self.neutral_log())
        self.assertEqual(*(self.untimed(self.summary(log)) for _ in range(2)))

    def test_without_truth(self):
        text = self.neutral_log()
        kept = [line for line in text.splitlines(True) if line[0] in "OZ" or line.startswith("T 0 ")]
        s = self.summary(self.write("a.log", "".join(kept)))
        # Only the start is known, and the filter was given it: no error is 0 for that reason.
        self.assert_no_truth(s)
        self.assertEqual(s["steps"], 151)

    def test_without_any_true_pose(self):
        # The start is the origin. The first motion or the first observations begin the log.
        text = self.neutral_log()
        plain = [line for line in text.splitlines(True) if line[0] in "OZ" or line.startswith("T 0 ")]
        at_origin = ["T 0 0 0 0 0 0 0 0\n"] + plain[1:]
        out, same = self.path("out"), self.path("same")
        s = self.summary(self.write("a.log", "".join(plain[1:])), "--output", out)
        self.assert_no_truth(s)
        self.assertEqual(self.untimed(self.summary(self.write("b.log", "".join(at_origin)), "--output", same)),
                         self.untimed(s))
        maps = [[(row["id"], row["x_m"], row["cov_zz_m2"]) for row in self.read_csv(folder, "landmarks.csv")]
                for folder in (out, same)]
        self.assertEqual(*maps)
        later = [line for line in plain[1:] if not line.startswith("Z 0 ")]
        self.assertEqual(self.summary(self.write("c.log", "".join(later)))["steps"], 151)

    def test_one_step(self):
        s = self.summary(self.write("a.log", "T 0 0 1 2 3 0 0 0\nZ 0 7 5 0 0\n"))
        self.assertEqual((s["steps"], s["landmarks"]), (1, 1))
        self.assertNotIn("pose_rmse_m", s)

    def test_noise_in_the_file(self):
        text = self.neutral_log()
        degree = math.pi / 180
        usual = [0.02] * 3 + [0.1 * degree] * 3 + [0.1, 0.5 * degree, 0.5 * degree]
        plain = self.summary(self.write("a.log", text))
        told = self.summary(self.write("b.log", "N " + " ".join(map(repr, usual)) + "\n" + text))
        self.assertAlmostEqual(told["pose_rmse_m"], plain["pose_rmse_m"], places=9)
        for k in range(9):  # each value counts
            other = usual[:k] + [3 * usual[k]] + usual[k + 1:]
            s = self.summary(self.write("c.log", "N " + " ".join(map(repr, other)) + "\n" + text))
            self.assertLess(s["nis_per_dof"], told["nis_per_dof"] - 1e-4, k)

    def test_gate_1_accepts_all(self):
        # One observation is far out: its frame fails the gate of the batch, too.
        lines = self.neutral_log().splitlines(True)
        last = max(i for i, line in enumerate(lines) if line.startswith("Z 150 "))
        fields = lines[last].split()
        lines[last] = " ".join(fields[:3] + [str(float(fields[3]) + 5)] + fields[4:]) + "\n"
        log = self.write("a.log", "".join(lines))
        self.assertEqual(self.summary(log, "--gate", "1")["rejected"], 0)
        self.assertGreater(self.summary(log, "--gate", "1", "--batch-gate", "0.9999")["rejected"], 0)
        self.assertGreater(self.summary(log, "--gate", "0.9999")["rejected"], 0)

    def test_comments_blanks_and_line_ends(self):
        text = self.neutral_log(steps=20)
        plain = self.summary(self.write("a.log", text))
        varied = "# a comment\n\n" + text.replace("\n", "\r\n").replace(" ", "\t ")
        self.assertEqual(self.summary(self.write("b.log", varied))["pose_rmse_m"], plain["pose_rmse_m"])
        commented = "".join(line + " # seen\n" if line[0] == "Z" else line + "\n" for line in text.splitlines())
        marked = "\ufeff# begins with a byte order mark\n" + commented
        self.assertEqual(self.summary(self.write("c.log", marked))["pose_rmse_m"], plain["pose_rmse_m"])
        self.assertEqual(self.summary(self.write("d.log", "\ufeff" + text))["pose_rmse_m"], plain["pose_rmse_m"])

    def test_last_line_without_an_end(self):
        text = self.neutral_log(steps=20)
        plain = self.summary(self.write("a.log", text))
        for name, ending in (("b.log", ""), ("c.log", " "), ("d.log", "\r"), ("e.log", "\n# end"), ("f.log", "\n\n \t")):
            log = self.write(name, text.rstrip("\n") + ending)
            self.assertEqual(self.summary(log)["landmark_rmse_m"], plain["landmark_rmse_m"])
            done = call("run", log)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (0, 1))
            self.assertIn("note: %s: the last line has no end" % log, done.stderr)

    def test_numbers_that_are_nearly_0(self):
        text = self.neutral_log(steps=20)
        lines = [" ".join(line.split()[:4] + ["0", "0"]) if line[0] == "Z" else line for line in text.splitlines()]
        plain = self.summary(self.write("a.log", "\n".join(lines) + "\n"), "--gate=1")
        tiny = [" ".join(line.split()[:4] + ["1e-400", "-1e-999"]) if line[0] == "Z" else line for line in lines]
        same = self.summary(self.write("b.log", "\n".join(tiny) + "\n"), "--gate=1")
        self.assertEqual(self.untimed(same), self.untimed(plain))

    def test_options_matter(self):
        log = self.write("a.log", self.neutral_log())
        plain = self.summary(log)
        same = self.summary(log, "--submap-landmarks=60", "--seed=5", "--error=invariant", "--submap-distance=0")
        self.assertEqual(self.untimed(same), self.untimed(plain))
        for options in (["--error", "standard"], ["--iterations=1"], ["--gate=0.5", "--batch-gate", "1"]):
            other = self.summary(log, *options)
            self.assertNotEqual(other["pose_rmse_m"], plain["pose_rmse_m"], options)
        self.assertGreater(self.summary(log, "--gate=0.5", "--batch-gate=1")["rejected"], plain["rejected"])
        self.assertEqual(self.summary(log, "--gate=1", "--batch-gate=1")["rejected"], 0)

    def test_single_map(self):
        log = self.write("a.log", self.neutral_log())
        single = self.summary(log, "--single-map")
        self.assertEqual(self.untimed(self.summary(log, "--submap-landmarks", "0")), self.untimed(single))
        self.assertEqual(single["submaps"], 0)
        self.assertNotIn("closing_ms_worst", single)
        self.assertEqual(single["filter_landmarks_max"], single["landmarks"])
        self.assertEqual((single["pose_end_m"], single["attitude_end_deg"]),
                         (single["pose_final_m"], single["attitude_final_deg"]))

    def test_ids_withheld(self):
        log, out = self.write("a.log", self.neutral_log(landmarks=60, steps=300)), self.path("out")
        known = self.summary(log, "--single-map")
        self.assertNotIn("paired", known)
        for how in ("nearest", "joint"):
            s = self.summary(log, "--single-map", "--association", how, "--output", out)
            self.assertEqual((s["observations"], s["submaps"]), (known["observations"], 0))
            self.assertEqual(s["paired"] + s["rejected"] + s["landmarks"], s["observations"])
            self.assertLessEqual(s["paired_wrongly"], 0.003 * s["paired"])
            self.assertEqual(s["landmarks"] - s["landmarks_twice"], known["landmarks"])
            self.assertLess(s["landmark_rmse_m"], 1.1 * known["landmark_rmse_m"] + 0.02)
            # Numbered as they come, and scored by the log's ids.
            rows = self.read_csv(out, "landmarks.csv")
            self.assertEqual([int(row["id"]) for row in rows], list(range(int(s["landmarks"]))))
            self.assertTrue(all(row["error_x_m"] for row in rows))
        for join in ("dense", "sparse"):
            s = self.summary(log, "--association", "joint", "--submap-landmarks", "15", "--join", join, "--output", out)
            self.assertGreater(s["submaps"], 3)
            self.assertLessEqual(s["paired_wrongly"], 0.003 * s["paired"])
            self.assertLessEqual(abs(s["landmarks"] - s["landmarks_twice"] - known["landmarks"]), 1)
            self.assertLessEqual(s["landmarks_twice"], 1)
            self.assertLess(s["landmark_rmse_m"], 1.5 * known["landmark_rmse_m"] + 0.05)

    def test_submaps(self):
        text = self.neutral_log(landmarks=120, steps=500)
        log, out = self.write("a.log", text), self.path("out")
        single = self.summary(log, "--single-map")
        s = self.summary(log, "--submap-landmarks", "15", "--join", "dense", "--output", out)
        self.assertEqual((s["landmarks"], s["observations"]), (single["landmarks"], single["observations"]))
        self.assertGreater(s["submaps"], 7)
        self.assertLess(s["filter_landmarks_max"], 15 + 16)  # a frame may add more than one
        self.assertLess(s["landmark_rmse_m"], 2 * single["landmark_rmse_m"] + 0.05)
        self.assertTrue(0 < s["closing_ms_worst"])
        self.assertLessEqual(s["step_ms_worst"] * 1.0001, 1e3 * s["filter_seconds"])

        submaps = self.read_csv(out, "submaps.csv")
        self.assertEqual([int(row["submap"]) for row in submaps], list(range(int(s["submaps"]))))
        self.assertEqual({row["reason"] for row in submaps[:-1]}, {"landmarks"})
        self.assertEqual(submaps[-1]["reason"], "caller")  # the one that was open at the end
        steps = [int(row["step"]) for row in submaps]
        self.assertEqual(steps, sorted(steps))
        self.assertEqual(steps[-1], 500)
        for row in submaps:
            self.assertEqual(sum(int(row[name]) for name in ("new", "fused", "refused")), int(row["landmarks"]))
            self.assertAlmostEqual(sum(float(row["q" + name]) ** 2 for name in "wxyz"), 1, places=9)
        self.assertEqual(sum(int(row["new"]) for row in submaps), s["landmarks"])
        members = self.read_csv(out, "submap_landmarks.csv")
        counts = [sum(int(row["submap"]) == i for row in members) for i in range(len(submaps))]
        self.assertEqual(counts, [int(row["landmarks"]) for row in submaps])
        self.assertEqual({row["id"] for row in members}, {row["id"] for row in self.read_csv(out, "landmarks.csv")})
        truth = {int(r[0]): r[2:5] for r in records(text, "T")}
        for before, row in zip(submaps, submaps[1:]):  # a submap starts where the one before was closed
            base = [float(row[name]) for name in "xyz"]
            self.assertLess(math.dist(base, truth[int(before["step"])]), 1.5)

        timing = self.read_csv(out, "timing.csv")
        self.assertEqual(max(int(row["filter_landmarks"]) for row in timing), s["filter_landmarks_max"])
        closings = [int(row["step"]) for row in timing if row["closing_ms"]]
        self.assertEqual(closings, steps[:-1])
        trajectory = self.read_csv(out, "trajectory.csv")
        after = trajectory[closings[0]]  # the new submap starts with a known pose
        self.assertEqual(float(after["local_sigma_x_m"]), 0)
        self.assertGreater(float(after["sigma3_x_m"]), 0)

    def test_other_limits_of_submaps(self):
        log = self.write("a.log", self.neutral_log(steps=400))
        for limit, reason in (("--submap-distance=20", "distance"), ("--submap-extent=15", "extent"),
                              ("--submap-sigma=0.03", "sigma")):
            out = self.path(reason)
            s = self.summary(log, "--submap-landmarks", "1000", limit, "--output", out)
            self.assertGreater(s["submaps"], 2, limit)
            self.assertIn(reason, {row["reason"] for row in self.read_csv(out, "submaps.csv")})

    def test_forgetting_with_submaps(self):
        log = self.write("a.log", self.neutral_log())
        forgetful = self.summary(log, "--forget-after", "3", "--submap-landmarks", "10")
        self.assertLess(forgetful["landmarks"], 30)
        self.assertGreater(forgetful["submaps"], 3)

    def test_forgetting_bounds_the_map(self):
        log = self.write("a.log", self.neutral_log())
        plain = self.summary(log)
        forgetful = self.summary(log, "--forget-after", "1")
        self.assertLessEqual(forgetful["landmarks"], 8)  # those of the last frame
        self.assertGreater(forgetful["pose_rmse_m"], plain["pose_rmse_m"])
        self.assertEqual(self.summary(log, "--forget-after=1000")["pose_rmse_m"], plain["pose_rmse_m"])
        for frames in (2, 7, 30):
            self.summary(log, "--forget-after", str(frames))  # the capacity that it works out suffices

    def test_too_small_a_map_refuses_what_does_not_fit(self):
        log = self.write("a.log", self.neutral_log())
        small = self.summary(log, "--single-map", "--max-landmarks", "10")
        self.assertEqual(small["landmarks"], 10)
        self.assertGreater(small["rejected"], self.summary(log, "--single-map")["rejected"])

    def test_text_summary(self):
        log = self.write("a.log", self.neutral_log(steps=20))
        done = call("run", log)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for key in ALWAYS | WITH_TRUE_POSES | WITH_TRUE_LANDMARKS:
            self.assertIn(key, done.stdout)

    def test_output_files(self):
        text = self.neutral_log()
        log, out = self.write("a.log", text), self.path("out")
        done = call("run", log, "--summary", "json", "--output", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        s = json.loads(done.stdout)
        with open(os.path.join(out, "summary.json")) as file:
            self.assertEqual(json.load(file), s)

        trajectory = self.read_csv(out, "trajectory.csv")
        self.assertEqual([int(row["step"]) for row in trajectory], list(range(151)))
        squares = [sum(float(row["error_%s_m" % axis]) ** 2 for axis in "xyz") for row in trajectory]
        self.assertAlmostEqual(math.sqrt(sum(squares) / 151), s["pose_rmse_m"], places=6)
        nees = [float(row["nees"]) for row in trajectory if row["nees"]]
        self.assertAlmostEqual(sum(nees) / len(nees) / 6, s["pose_anees_per_dof"], places=5)
        for row in trajectory:
            for name in ("x_m", "y_m", "z_m"):
                self.assertAlmostEqual(float(row["true_" + name]) - float(row[name]), float(row["error_" + name]))
            attitude = make_log.Rotation.from_euler(*(float(row[n]) for n in ("roll_rad", "pitch_rad", "yaw_rad")))
            sign = math.copysign(1, attitude.w * float(row["qw"]))
            for name in ("w", "x", "y", "z"):
                self.assertAlmostEqual(sign * getattr(attitude, name), float(row["q" + name]), places=6)
        first, last = trajectory[0], trajectory[-1]
        self.assertEqual(float(first["error_x_m"]), 0)
        self.assertGreater(float(last["sigma3_x_m"]), 0)
        inside = sum(abs(float(r["error_x_m"])) <= float(r["sigma3_x_m"]) for r in trajectory)
        self.assertGreater(inside, 0.9 * len(trajectory))

        landmarks = self.read_csv(out, "landmarks.csv")
        self.assertEqual(len(landmarks), s["landmarks"])
        squares = [sum(float(row["error_%s_m" % axis]) ** 2 for axis in "xyz") for row in landmarks]
        self.assertAlmostEqual(math.sqrt(sum(squares) / len(squares)), s["landmark_rmse_m"], places=6)

        innovations = self.read_csv(out, "innovations.csv")
        self.assertEqual(len(innovations), s["observations"])
        results = [row["result"] for row in innovations]
        self.assertEqual(results.count("rejected"), s["rejected"])
        self.assertEqual(set(results) - {"matched", "new", "rejected"}, set())
        seen = [(int(r[0]), int(r[1])) for r in records(text, "Z")]
        self.assertEqual([(int(row["step"]), int(row["id"])) for row in innovations], seen)
        self.assertEqual(sum(int(row["observations"]) for row in landmarks), len(seen) - s["rejected"])

        health = self.read_csv(out, "health.csv")
        self.assertEqual([int(row["step"]) for row in health], [int(row["step"]) for row in trajectory])
        verdicts = [row["verdict"] for row in health]
        self.assertEqual(verdicts[-1], s["verdict"])
        self.assertEqual(set(verdicts) - {"good", "doubtful", "lost"}, set())
        self.assertTrue(all((row["verdict"] == "good") == (row["reasons"] == "") for row in health))
        self.assertGreater(float(health[-1]["nis_upper"]), 1)
        self.assertAlmostEqual(float(health[-1]["sensor_scale"]), s["sensor_noise_scale"], places=6)

        timing = self.read_csv(out, "timing.csv")
        self.assertEqual(len(timing), 151)
        rows = sum(int(row["nis_rows"]) for row in timing)
        self.assertAlmostEqual(sum(float(row["nis"]) for row in timing) / rows, s["nis_per_dof"], places=6)
        self.assertAlmostEqual(sum(float(row["step_ms"]) for row in timing) / 151, s["step_ms_mean"], places=5)

    def test_large_ids(self):
        text = self.neutral_log(steps=20)
        big = 2 ** 64 - 1000
        lines = []
        for line in text.splitlines():
            fields = line.split()
            place = {"Z": 2, "L": 1}.get(fields[0])
            if place:
                fields[place] = str(big + int(fields[place]))
            lines.append(" ".join(fields))
        out = self.path("out")
        s = self.summary(self.write("a.log", "\n".join(lines) + "\n"), "--output", out)
        self.assertEqual(s["landmark_rmse_m"], self.summary(self.write("b.log", text))["landmark_rmse_m"])
        self.assertTrue(all(int(row["id"]) > big for row in self.read_csv(out, "landmarks.csv")))


if __name__ == "__main__":
    unittest.main()
