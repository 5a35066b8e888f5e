# SPDX-License-Identifier: BSD-3-Clause
"""The program on small STARS logs that the helper writes."""
import unittest

from support import (ALWAYS, LEARNED, WITH_SUBMAPS, WITH_TRUE_END, WITH_TRUE_LANDMARKS, WITH_TRUE_POSES, ProgramTest,
                     call)


class StarsLog(ProgramTest):
    def test_figures(self):
        s = self.summary(self.stars_log("a.mat"))
        self.assertEqual(set(s), ALWAYS | LEARNED | WITH_SUBMAPS | WITH_TRUE_POSES | WITH_TRUE_END |
                         WITH_TRUE_LANDMARKS)
        self.assertEqual(s["steps"], 80)
        self.assertLess(s["pose_rmse_m"], 0.05)
        self.assertLess(s["attitude_rmse_deg"], 0.5)
        self.assertLess(s["landmark_rmse_m"], 0.3)
        self.assertTrue(0.1 < s["pose_anees_per_dof"] < 2, s)
        self.assertTrue(0.8 < s["nis_per_dof"] < 1.2, s)
        self.assertLess(s["rejected"], 0.05 * s["observations"])

    def test_kinds_of_storage(self):
        plain = self.summary(self.stars_log("a.mat"))
        packed = self.summary(self.stars_log("b.mat", "--compress"))
        self.assertEqual(packed["pose_rmse_m"], plain["pose_rmse_m"])
        single = self.summary(self.stars_log("c.mat", "--single"))
        self.assertAlmostEqual(single["pose_rmse_m"], plain["pose_rmse_m"], places=3)

    def test_the_name_tells_nothing(self):
        s = self.summary(self.stars_log("a.txt"))
        self.assertEqual(s["steps"], 80)

    def test_noise(self):
        with_variances = self.stars_log("a.mat")
        without = self.stars_log("b.mat", "--drop", "y_var", "--drop", "v_var", "--drop", "w_var")
        wanted = ["--pixel-noise", "1", "--velocity-noise=0.05", "--rate-noise=0.01"]
        plain = self.summary(with_variances)
        self.assertEqual(self.summary(without, *wanted)["pose_rmse_m"], plain["pose_rmse_m"])
        self.assertEqual(self.summary(with_variances, *wanted)["pose_rmse_m"], plain["pose_rmse_m"])
        defaults = self.summary(without)
        named = self.summary(without, "--pixel-noise=2", "--velocity-noise=0.1", "--rate-noise=0.01")
        self.assertEqual(defaults["pose_rmse_m"], named["pose_rmse_m"])
        self.assertLess(defaults["nis_per_dof"], 0.5)  # it takes the pixels for twice as noisy as they are

    def test_what_is_not_seen(self):
        plain = self.summary(self.stars_log("a.mat"))
        some = self.summary(self.stars_log("b.mat", "--set", "y_k_j", "1", "nan"))
        self.assertEqual(some["observations"], plain["observations"] - 1)
        unseen = self.summary(self.stars_log("c.mat", "--set", "y_k_j", "1", "-1"))
        self.assertEqual(unseen["observations"], plain["observations"] - 1)

    def test_without_true_landmarks(self):
        s = self.summary(self.stars_log("a.mat", "--drop", "rho_i_pj_i"))
        self.assertEqual(set(s), ALWAYS | LEARNED | WITH_SUBMAPS | WITH_TRUE_POSES | WITH_TRUE_END)

    def test_without_some_true_poses(self):
        s = self.summary(self.stars_log("a.mat", "--set", "r_i_vk_i", "30", "nan"))
        self.assertEqual(s["steps"], 80)
        self.assertLess(s["pose_rmse_m"], 0.05)

    def test_frames_without_a_time_are_left_out(self):
        log = self.stars_log("a.mat", "--cut", "t", "60", "--cut", "y_k_j", "60", "--drop", "rho_i_pj_i")
        done = call("run", log)
        self.assertEqual(done.returncode, 0)
        self.assertIn("note: ", done.stderr)
        self.assertIn("frame 60", done.stderr)
        self.assertEqual(self.summary(log)["steps"], 60)

    def test_one_landmark(self):
        # An array of 4 x K x 1 has two dimensions in the file.
        s = self.summary(self.stars_log("a.mat", "--cut", "y_k_j", "80", "--cut", "rho_i_pj_i", "1"))
        self.assertEqual(s["landmarks"], 1)

    def test_disparity_bounds_placing(self):
        log = self.stars_log("a.mat")
        near = self.summary(log, "--min-disparity", "20")
        self.assertLess(near["landmarks"], self.summary(log)["landmarks"])
        self.assertGreater(near["rejected"], 0)
        sure = self.summary(log, "--min-disparity-sigmas", "15")
        anyhow = self.summary(log, "--min-disparity-sigmas=0", "--min-disparity=0.1")
        self.assertLess(sure["landmarks"], anyhow["landmarks"])


if __name__ == "__main__":
    unittest.main()
