# SPDX-License-Identifier: BSD-3-Clause
"""10,000 handles are made and freed, and the process does not grow."""
import gc
import os
import unittest

import support
import cairn
import numpy as np

WARM_UP, COUNT = 500, 10000
ROOM = 1 << 20  # allocators keep a little


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def used_filter():
    """A filter with a custom sensor, a log, maps and an error."""
    one = cairn.Filter(max_landmarks=4, max_observations=4)
    sensor = one.add_cartesian()
    one.add_custom(lambda pose, landmark: None, rows=1)
    one.set_log(lambda line: None)
    one.update(sensor, [1, 2], [[1, 2, 3], [4, 5, 6]])
    one.map.copy()
    try:
        one.map.landmark(9)
    except cairn.CairnError:
        pass
    return one


class LeakTest(unittest.TestCase):
    def constant(self, make, count=COUNT):
        for _ in range(WARM_UP):
            make()
        gc.collect()
        before = resident()
        for _ in range(count):
            make()
        gc.collect()
        self.assertLess(resident() - before, ROOM)

    def test_filters(self):
        self.constant(lambda: cairn.Filter(max_landmarks=4, max_observations=4))

    def test_filters_that_are_forgotten(self):
        self.constant(used_filter, 3000)

    def test_filters_that_are_closed(self):
        self.constant(lambda: used_filter().close(), 1000)

    def test_teams(self):
        self.constant(lambda: cairn.Team(vehicle=1, filter={"max_landmarks": 4}), 1000)

    def test_simulations(self):
        self.constant(lambda: (cairn.World(landmarks=20).next(), cairn.Fleet(features=4).next()), 300)

    def test_results(self):
        one = used_filter()
        frame = cairn.observations([1, 2], np.array([[1.0, 2, 3], [4, 5, 6]]))
        self.constant(lambda: (one.update(0, frame), one.update(0, [1], [[1, 2, 3]]), one.pose(), one.health(),
                               one.last_update()), 2000)


if __name__ == "__main__":
    support.need("numpy", "cffi")
    unittest.main()
