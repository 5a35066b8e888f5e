# SPDX-License-Identifier: BSD-3-Clause
"""The program on recorded data, which the project does not carry: CAIRN_DATA_DIR names the folder."""
import os
import sys
import unittest

from support import SKIPPED, ProgramTest

DATA = os.environ.get("CAIRN_DATA_DIR", "")


class RecordedData(ProgramTest):
    def log(self, name):
        return os.path.join(DATA, name)

    def test_starry_night(self):
        s = self.summary(self.log("starry_night.mat"))
        self.assertEqual((s["steps"], s["landmarks"], s["observations"]), (1900, 20, 9410))
        self.assertLessEqual(s["pose_rmse_m"], 0.1)
        self.assertLessEqual(s["landmark_rmse_m"], 0.05)

    def test_drive_0001(self):
        s = self.summary(self.log("2011_09_26_drive_0001_sync_KLT.mat"))
        self.assertEqual((s["steps"], s["observations"]), (108, 10501))
        self.assertLessEqual(s["pose_final_m"], 1.0)
        self.assertNotIn("landmark_rmse_m", s)

    def test_drive_0036_with_forgetting(self):
        s = self.summary(self.log("2011_09_26_drive_0036_sync_KLT.mat"), "--forget-after", "1")
        self.assertEqual((s["steps"], s["observations"]), (250, 17519))
        self.assertLessEqual(s["pose_rmse_m"], 2.0)
        self.assertLessEqual(s["landmarks"], 119)


if __name__ == "__main__":
    if not DATA:
        print("skipped: CAIRN_DATA_DIR is not set")
        sys.exit(SKIPPED)
    unittest.main()
