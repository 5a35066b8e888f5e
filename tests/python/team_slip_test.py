# SPDX-License-Identifier: BSD-3-Clause
"""A member of a team slips: it finds back, and its teammates do not follow it."""
import unittest

import support
import cairn
import numpy as np


class Pair:
    """Two vehicles that are told that they stand still among landmarks; each sees the landmarks and the other vehicle."""

    RADAR = {"range_sigma": 0.05, "bearing_sigma": 0.01}

    def __init__(self, mode, seed=1):
        self.random = support.random(seed)
        self.landmarks = support.random(3).uniform(-9, 9, (14, 2))
        self.places = [np.array([0.0, 0.0]), np.array([3.0, 1.0])]
        self.time, self.refused = 0.0, [[], []]
        starts = [((*place, 0.0), (1.0, 0, 0, 0)) for place in self.places]
        options = {"submap_landmarks": 14} if mode == "submaps" else {}
        self.teams = [cairn.Team(vehicle=own + 1, mode=mode, radar=self.RADAR,
                                 filter={"initial_pose": starts[own], "max_landmarks": 40, "max_observations": 32, **options})
                      for own in range(2)]
        for own, team in enumerate(self.teams):
            team.add(2 - own, starts[1 - own])

    def sight(self, own, points):
        offset = points - self.places[own]
        polar = np.column_stack([np.hypot(*offset.T), np.arctan2(offset[:, 1], offset[:, 0])])
        return polar + self.random.normal(0, 1, polar.shape) * [0.05, 0.01]

    def step(self, slip=0.0):
        """One step; the first vehicle slips along x, of which its odometry knows nothing."""
        for own, team in enumerate(self.teams):
            self.places[own] = self.places[own] + self.random.normal(0, 0.01, 2) + ([slip, 0] if own == 0 else [0, 0])
            if self.time > 0:
                team.predict_twist(1.0, (0, 0, 0), (0, 0, 0), velocity_sigma=[0.01] * 3, rate_sigma=[0, 0, 0.001])
        for own, team in enumerate(self.teams):
            team.observe(self.time, (np.arange(len(self.landmarks)), self.sight(own, self.landmarks)),
                         ([2 - own], self.sight(own, self.places[1 - own][None])))
        self.time += 1.0
        for sender, team in enumerate(self.teams):
            for packet in team.packets():
                self.teams[1 - sender].receive(packet)
        for own, team in enumerate(self.teams):
            self.refused[own].append(int((team.decisions()["result"] == cairn.Result.REJECTED).sum()))

    def error(self, team, vehicle):
        return np.linalg.norm(self.teams[team].pose(vehicle + 1)[0][:2] - self.places[vehicle])


class TeamSlipTest(unittest.TestCase):
    def test_a_member_that_slips_finds_back(self):
        for mode in ("mono", "submaps", "eo_full", "joint"):
            with self.subTest(mode=mode):
                pair = Pair(mode)
                for _ in range(60):
                    pair.step()
                before = [pair.error(0, 0), pair.error(1, 1)]
                self.assertLess(max(before), 0.15)
                pair.step(slip=1.0)
                for _ in range(40):
                    pair.step()
                refused = np.array(pair.refused[0][60:])
                if mode != "submaps":  # there a submap of 14 landmarks closes in each frame, and the closing finds back
                    self.assertGreater(refused[0], 5)
                self.assertLess(refused[10:].mean(), 1.0)
                self.assertLess(pair.error(0, 0), 0.2)
                self.assertLess(pair.error(1, 1), 0.2)
                if mode == "joint":
                    self.assertLess(pair.error(1, 0), 0.2)


if __name__ == "__main__":
    unittest.main()
