# SPDX-License-Identifier: BSD-3-Clause
"""A log in which 30 % of the observations are gross errors, with the default options."""
import math
import random
import unittest

from support import ProgramTest

SHARE = 0.3
SEEDS = range(1, 9)


def spoil(log, seed):
    """Gross errors are uniform over what the sensor of make_log.py can see."""
    draw = random.Random(1000 + seed)
    lines = log.splitlines()
    for i, line in enumerate(lines):
        fields = line.split()
        if fields[0] == "Z" and draw.random() < SHARE:
            lines[i] = "Z %s %s %.9f %.9f %.9f" % (fields[1], fields[2], draw.uniform(1, 15),
                                                  draw.uniform(-math.pi, math.pi), draw.uniform(-0.5, 0.5))
    return "\n".join(lines) + "\n"


class OutlierTest(ProgramTest):
    def test_the_map_is_that_of_the_clean_log(self):
        for options in (["--single-map"], ["--submap-landmarks", "16", "--join", "dense"],
                        ["--submap-landmarks", "16", "--join", "sparse"]):
            with self.subTest(options=options):
                clean = spoiled = 0.0
                for seed in SEEDS:
                    log = self.neutral_log(landmarks=60, steps=200, seed=seed)
                    clean += self.summary(self.write("clean.log", log), *options)["landmark_rmse_m"] / len(SEEDS)
                    figures = self.summary(self.write("spoiled.log", spoil(log, seed)), *options)
                    spoiled += figures["landmark_rmse_m"] / len(SEEDS)
                    self.assertGreater(figures["refused_share"], 0.2)
                self.assertLess(spoiled, 1.15 * clean, (spoiled, clean))


if __name__ == "__main__":
    unittest.main()
