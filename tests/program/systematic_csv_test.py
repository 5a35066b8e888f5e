# SPDX-License-Identifier: BSD-3-Clause
"""systematic.csv: the systematic errors that the filter estimates, step by step."""
import os
import unittest

from support import ProgramTest

TRUE_BIAS = (0.10, -0.05)  # left and up, m/s


class SystematicCsv(ProgramTest):
    def drive(self, *options):
        return self.figures("simulate", "mars", "--preset", "row2", "--seed", "3", "--output", self.path("out"),
                            f"--true-velocity-bias=0,{TRUE_BIAS[0]},{TRUE_BIAS[1]}", *options)

    def states(self):
        """(value, sigma) at each step by the name of the state."""
        found = {}
        for row in self.read_csv(self.path("out"), "systematic.csv"):
            found.setdefault(row["name"], []).append((float(row["value"]), float(row["sigma"])))
        return found

    def test_the_states_of_a_run(self):
        s = self.drive("--velocity-bias=0,0.2,0.2", "--mount-turn=0,0,0.02")
        found = self.states()
        self.assertEqual(list(found), ["velocity bias y [m/s]", "velocity bias z [m/s]", "turn z of sensor 0 [rad]"])
        for steps in found.values():
            self.assertEqual(len(steps), s["steps"])
        for name, true in zip(found, TRUE_BIAS):
            value, sigma = found[name][-1]
            self.assertLess(abs(value - true), 4 * sigma)
            self.assertLess(sigma, 0.5 * found[name][0][1])

    def test_no_states_no_file(self):
        self.drive("--velocity-bias=0,0.2,0.2")
        self.assertTrue(os.path.exists(os.path.join(self.path("out"), "systematic.csv")))
        self.drive()
        self.assertFalse(os.path.exists(os.path.join(self.path("out"), "systematic.csv")))


if __name__ == "__main__":
    unittest.main()
