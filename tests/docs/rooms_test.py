# SPDX-License-Identifier: BSD-3-Clause
"""A room of the library includes only rooms below it (docs/architecture.md), and the program only the C headers."""
import glob
import os
import re
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# From the top. The rooms of one floor may include each other only where the map's folders do.
FLOORS = [{"capi"}, {"team"}, {"slam"}, {"map", "map/join/dense", "map/join/sparse", "map/merge"},
          {"association", "ekf", "health"}, {"motion", "sensor"}, {"linear"}, {"geometry"}, {"core"}]
OPEN_FLOOR = FLOORS[3]
FLOOR = {room: number for number, floor in enumerate(FLOORS) for room in floor}


def includes(text):
    return re.findall(r'^#include "([^"]+)"', text, re.MULTILINE)


def wrong_includes(room, text):
    for path in includes(text):
        other = os.path.dirname(path)
        if other == room or other not in FLOOR:
            continue
        if FLOOR[other] < FLOOR[room] or FLOOR[other] == FLOOR[room] and room not in OPEN_FLOOR:
            yield path


def sources(folder):
    for path in sorted(glob.glob(os.path.join(ROOT, folder, "**", "*.[ch]pp"), recursive=True)):
        with open(path, encoding="utf-8") as file:
            yield os.path.relpath(path, os.path.join(ROOT, folder)), file.read()


class RoomsTest(unittest.TestCase):
    def test_every_room_has_a_floor(self):
        rooms = {os.path.dirname(path) for path, _ in sources("src/cairn")} - {""}
        self.assertEqual(rooms, set(FLOOR))

    def test_includes_point_down(self):
        found = [(path, other) for path, text in sources("src/cairn")
                 for other in wrong_includes(os.path.dirname(path), text)]
        self.assertEqual(found, [])

    def test_the_program_includes_only_c_headers(self):
        found = [(path, other) for path, text in sources("src/program") for other in includes(text)
                 if not other.startswith(("program/", "options/"))]
        self.assertEqual(found, [])

    def test_wrong_includes_are_found(self):
        self.assertEqual(list(wrong_includes("ekf", '#include "slam/filter.hpp"\n#include "core/error.hpp"\n')),
                         ["slam/filter.hpp"])
        self.assertEqual(list(wrong_includes("ekf", '#include "association/doubt.hpp"\n#include "ekf/batch.hpp"\n')),
                         ["association/doubt.hpp"])


if __name__ == "__main__":
    unittest.main()
