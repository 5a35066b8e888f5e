# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the program share: they get its path, and those of its helpers, by the environment."""
import csv
import io
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["CAIRN_PROGRAM"]
MAKE_STARS = os.environ["CAIRN_MAKE_STARS"]
HERE = os.path.dirname(os.path.abspath(__file__))
SKIPPED = 77  # ctest's SKIP_RETURN_CODE

ALWAYS = {"steps", "landmarks", "observations", "rejected", "submaps", "seconds", "filter_seconds", "step_ms_mean",
          "step_ms_second_half", "step_ms_p99", "step_ms_worst", "filter_landmarks_max", "filter_landmarks_mean",
          "filter_landmarks_rms", "peak_rss_mib", "nis_per_dof", "verdict", "verdict_good_share",
          "verdict_doubtful_share", "verdict_lost_share", "widenings"}
# Absent if the observations do not tell.
LEARNED = {"refused_share", "error_correlation", "sensor_noise_scale", "sensor_noise_scale_sigma", "motion_noise_scale",
           "motion_noise_scale_sigma"}
WITH_SUBMAPS = {"closing_ms_worst"}
WITH_TRUE_POSES = {"pose_rmse_m", "pose_rmse_corrected_m", "pose_final_m", "pose_max_m", "pose_axis_max_m",
                   "attitude_rmse_deg", "attitude_final_deg", "attitude_axis_max_deg", "pose_anees_per_dof"}
WITH_TRUE_END = {"pose_end_m", "attitude_end_deg"}  # the last step has a true pose
WITH_TRUE_LANDMARKS = {"landmark_rmse_m"}


def call(*arguments):
    return subprocess.run([PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          timeout=1200)


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return self.path(name)

    def neutral_log(self, landmarks=60, steps=150, seed=1):
        made = subprocess.run([sys.executable, os.path.join(HERE, "make_log.py"), str(landmarks), str(steps),
                               str(seed)], stdout=subprocess.PIPE, text=True, check=True)
        return made.stdout

    def stars_log(self, name, *spoils):
        subprocess.run([MAKE_STARS, self.path(name), *spoils], check=True)
        return self.path(name)

    def summary(self, log, *options):
        """The figures of a run that has to succeed."""
        return self.figures("run", log, *options)

    def figures(self, *arguments):
        done = call(*arguments, "--summary", "json", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.count("\n"), 1)
        return json.loads(done.stdout)

    def assert_no_truth(self, figures):
        """Without truth no figure is an error, not even one of 0."""
        self.assertLessEqual(ALWAYS, set(figures))
        self.assertEqual(set(figures) & (WITH_TRUE_POSES | WITH_TRUE_END | WITH_TRUE_LANDMARKS), set())

    def untimed(self, figures):
        """Without what the clock and the machine have a say in."""
        return {key: value for key, value in figures.items()
                if not key.startswith(("step_ms", "closing_ms", "seconds", "filter_seconds", "peak_rss"))}

    def assert_refused(self, done, *words, status=2):
        """One line on stderr that holds all the words, nothing on stdout."""
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("cairn: "), done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def read_csv(self, folder, name):
        with open(os.path.join(folder, name), newline="") as file:
            rows = list(csv.reader(io.StringIO(file.read())))
        for row in rows:
            self.assertEqual(len(row), len(rows[0]), name)
        return [dict(zip(rows[0], row)) for row in rows[1:]]
