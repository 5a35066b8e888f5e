# SPDX-License-Identifier: BSD-3-Clause
"""Files of --output for other tools: map as PLY, map and trajectories as GeoJSON, and those of each vehicle of a team."""
import json
import math
import os
import unittest

from support import ProgramTest, call

NUMBERS = {"double": float, "uint": int}


def read_ply(path):
    """A reader of the ascii form of PLY with one element: its rows as dictionaries."""
    with open(path) as file:
        lines = file.read().splitlines()
    end = lines.index("end_header")
    header = [line.split() for line in lines[:end] if not line.startswith("comment ")]
    assert header[:2] == [["ply"], ["format", "ascii", "1.0"]], header
    (element, name, count), properties = header[2], header[3:]
    assert (element, name) == ("element", "vertex") and all(word[0] == "property" for word in properties), header
    rows = [line.split(" ") for line in lines[end + 1:]]
    assert len(rows) == int(count) and all(len(row) == len(properties) for row in rows)
    return [{name: NUMBERS[kind](word) for (_, kind, name), word in zip(properties, row)} for row in rows]


class Earth:
    """The opposite direction of the program's: latitude, longitude and height to east, north, up, in closed form."""

    def __init__(self, latitude, longitude, height=0.0):
        self.origin = self.geocentric(longitude, latitude, height)
        self.latitude, self.longitude = math.radians(latitude), math.radians(longitude)

    def geocentric(self, longitude, latitude, height=0.0):
        a, f = 6378137.0, 1 / 298.257223563
        lat, lon = math.radians(latitude), math.radians(longitude)
        n = a / math.sqrt(1 - f * (2 - f) * math.sin(lat) ** 2)
        return ((n + height) * math.cos(lat) * math.cos(lon), (n + height) * math.cos(lat) * math.sin(lon),
                ((1 - f) ** 2 * n + height) * math.sin(lat))

    def local(self, longitude, latitude, height=0.0):
        x, y, z = (a - b for a, b in zip(self.geocentric(longitude, latitude, height), self.origin))
        out = math.cos(self.longitude) * x + math.sin(self.longitude) * y
        return (math.cos(self.longitude) * y - math.sin(self.longitude) * x,
                math.cos(self.latitude) * z - math.sin(self.latitude) * out,
                math.cos(self.latitude) * out + math.sin(self.latitude) * z)


class ToolFiles(ProgramTest):
    def features(self, folder, name, kind):
        with open(os.path.join(folder, name)) as file:
            collection = json.load(file, parse_constant=self.fail)  # NaN is no JSON
        self.assertEqual(collection["type"], "FeatureCollection")
        for feature in collection["features"]:
            self.assertEqual(set(feature), {"type", "properties", "geometry"})
            self.assertEqual(feature["type"], "Feature")
        return [f for f in collection["features"] if f["properties"]["kind"] == kind]

    def check_ply(self, folder):
        points, table = read_ply(os.path.join(folder, "map.ply")), self.read_csv(folder, "landmarks.csv")
        self.assertGreater(len(points), 10)
        self.assertEqual(len(points), len(table))
        for point, row in zip(points, table):
            self.assertEqual((int(point["id"]), point["observations"]), (int(row["id"]), int(row["observations"])))
            for axis in "xyz":
                self.assertEqual(point[axis], float(row[f"{axis}_m"]))
                self.assertAlmostEqual(3 * point[f"sigma_{axis}"], float(row[f"sigma3_{axis}_m"]), places=12)
        return table

    def check_landmarks(self, folder, earth, heights):
        table = self.check_ply(folder)
        points = self.features(folder, "map.geojson", "landmark")
        rings = {f["properties"]["landmark_id"]: f for f in self.features(folder, "map.geojson", "ellipse_95")}
        self.assertEqual(len(points), len(table))
        self.assertEqual(len(rings), len(table))
        for point, row in zip(points, table):
            self.assertEqual(point["geometry"]["type"], "Point")
            properties, place = point["properties"], point["geometry"]["coordinates"]
            self.assertEqual(len(place), 3 if heights else 2)
            self.assertEqual((properties["landmark_id"], properties["observations"]),
                             (int(row["id"]), int(row["observations"])))
            wanted = [float(row[f"{axis}_m"]) for axis in "xyz"]
            for axis, (has, want) in enumerate(zip(earth.local(*place), wanted)):
                if axis < 2 or heights:
                    self.assertAlmostEqual(has, want, delta=2e-4)  # nine decimals of a degree, four of a metre
            c = properties["covariance_m2"]
            upper = [float(row[f"cov_{pair}_m2"]) for pair in ("xx", "xy", "xz", "yy", "yz", "zz")]
            for has, want in zip(c[:3] + c[4:6] + c[8:], upper):
                self.assertAlmostEqual(has, want, delta=1e-8 * (1e-3 + abs(want)))
            for axis, at in (("east", 0), ("north", 4), ("up", 8)):
                self.assertAlmostEqual(properties[f"sigma_{axis}_m"] ** 2, c[at], delta=1e-7 * c[at])
            self.check_ring(rings[properties["landmark_id"]], earth, wanted, c)

    def check_ring(self, feature, earth, centre, c):
        """Each corner lies where the horizontal covariance puts 95 %: at a squared distance of -2 ln 0.05."""
        self.assertEqual(feature["geometry"]["type"], "Polygon")
        (ring,) = feature["geometry"]["coordinates"]
        self.assertEqual(ring[0], ring[-1])
        self.assertGreaterEqual(len(ring), 4)
        corners = [[a - b for a, b in zip(earth.local(*corner)[:2], centre)] for corner in ring]
        area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(corners, corners[1:])) / 2
        self.assertGreater(area, 0)  # counterclockwise
        determinant = c[0] * c[4] - c[1] * c[1]
        for x, y in corners:
            distance = (c[4] * x * x - 2 * c[1] * x * y + c[0] * y * y) / determinant
            # The rounding of a corner against the shorter axis, which is at least sqrt(determinant / trace).
            tolerance = 4 * 2e-4 * 2.45 / math.sqrt(determinant / (c[0] + c[4])) + 1e-6
            self.assertAlmostEqual(distance, -2 * math.log(0.05), delta=tolerance)

    def check_line(self, file, kind, poses, earth):
        """`poses`: the file of the same trajectory in TUM's form."""
        folder, name = os.path.split(file)
        (line,) = self.features(folder, name, kind)
        self.assertEqual(line["geometry"]["type"], "LineString")
        with open(os.path.join(folder, poses)) as tum:
            wanted = [[float(word) for word in row.split()][1:4] for row in tum]
        self.assertEqual(len(line["geometry"]["coordinates"]), len(wanted))
        for place, position in zip(line["geometry"]["coordinates"], wanted):
            for has, want in zip(earth.local(*place)[:2], position):
                self.assertAlmostEqual(has, want, delta=2e-4)

    def test_a_world(self):
        folder = self.path("out")
        self.figures("simulate", "mars", "--output", folder, "--origin=-33.8568,151.2153,20")
        earth = Earth(-33.8568, 151.2153, 20)
        self.check_landmarks(folder, earth, heights=True)
        for kind in ("trajectory_online", "trajectory_corrected", "trajectory_truth"):
            self.check_line(os.path.join(folder, "map.geojson"), kind, f"{kind}.tum", earth)

    def test_a_log_without_truth_and_an_origin_without_height(self):
        log = "".join(line for line in self.neutral_log().splitlines(keepends=True) if line.split()[0] not in ("T", "L"))
        folder = self.path("out")
        figures = self.figures("run", self.write("a.log", log), "--output", folder, "--origin", "78.22,15.65")
        self.assert_no_truth(figures)
        self.check_landmarks(folder, Earth(78.22, 15.65), heights=False)
        self.assertEqual(self.features(folder, "map.geojson", "trajectory_truth"), [])
        self.assertEqual(len(self.features(folder, "map.geojson", "trajectory_corrected")), 1)
        self.assertNotIn("trajectory_truth.tum", os.listdir(folder))

    def test_the_180th_meridian(self):
        """A line that crosses it has no jump: its longitudes go beyond 180 degrees."""
        folder = self.path("out")
        self.figures("simulate", "mars", "--output", folder, "--origin", "0,180")
        (line,) = self.features(folder, "map.geojson", "trajectory_online")
        longitudes = [place[0] for place in line["geometry"]["coordinates"]]
        self.assertLess(max(longitudes) - min(longitudes), 0.01)
        self.assertGreater(max(longitudes), 180)
        self.assertLess(min(longitudes), 180)

    def test_one_pose_is_no_line(self):
        lines = self.neutral_log().splitlines(keepends=True)
        folder = self.path("out")
        log = "".join(line for line in lines if line.split()[0] not in "TZO" or int(line.split()[1]) == 0)
        self.figures("run", self.write("a.log", log), "--output", folder, "--origin", "1,2")
        self.assertEqual(self.features(folder, "map.geojson", "trajectory_online"), [])

    def test_no_place_no_geojson(self):
        folder = self.path("out")
        self.figures("simulate", "mars", "--output", folder)
        self.check_ply(folder)
        self.assertEqual([name for name in os.listdir(folder) if name.endswith(".geojson")], [])

    def test_two_filters(self):
        folder = self.path("out")
        call("simulate", "mars", "--compare", "--quiet", "--output", folder, "--origin", "1,2")
        for way in ("standard", "submaps"):
            self.check_landmarks(os.path.join(folder, way), Earth(1, 2), heights=False)

    def test_a_team(self):
        folder = self.path("out")
        self.figures("simulate", "usv", "--vehicles=3", "--duration=60", "--output", folder, "--origin", "44,8.9,0")
        table, landmarks = self.read_csv(folder, "team_trajectories.csv"), self.read_csv(folder, "team_landmarks.csv")
        earth = Earth(44, 8.9)
        self.assertEqual({row["vehicle"] for row in table}, set("123"))
        for vehicle in "123":
            own = [row for row in table if row["vehicle"] == vehicle]
            for kind, columns in (("online", ("x", "y", "heading")), ("truth", ("true_x", "true_y", "true_heading"))):
                name = f"vehicle_{vehicle}_trajectory_{kind}.tum"
                with open(os.path.join(folder, name)) as file:
                    poses = [[float(word) for word in line.split()] for line in file]
                self.assertEqual(len(poses), len(own))
                for (time, x, y, z, qx, qy, qz, qw), row in zip(poses, own):
                    self.assertEqual([time, x, y, z, qx, qy], [float(row[c]) for c in ("time", *columns[:2])] + [0, 0, 0])
                    self.assertAlmostEqual(math.remainder(2 * math.atan2(qz, qw) - float(row[columns[2]]), math.tau), 0)
                self.check_line(os.path.join(folder, f"vehicle_{vehicle}_map.geojson"), f"trajectory_{kind}", name, earth)
            points = read_ply(os.path.join(folder, f"vehicle_{vehicle}_map.ply"))
            self.assertEqual([(point["id"], point["x"], point["y"]) for point in points],
                             [(int(row["id"]), float(row["x"]), float(row["y"])) for row in landmarks
                              if row["vehicle"] == vehicle])
            places = self.features(folder, f"vehicle_{vehicle}_map.geojson", "landmark")
            self.assertEqual([place["properties"]["landmark_id"] for place in places], [point["id"] for point in points])

    def test_what_is_refused(self):
        for value, *words in (("91,0", "'91'", "latitude", "-90", "90"), ("0,-180.1", "'-180.1'", "longitude", "180"),
                              ("1", "LAT,LON,HEIGHT"), ("1,2,3,4", "LAT,LON,HEIGHT"), ("", "LAT,LON,HEIGHT"),
                              ("1,2,", "''"), ("1,x", "'x'"), ("nan,0", "'nan'"), ("1,2,inf", "'inf'")):
            done = call("simulate", "mars", "--output", self.path("out"), "--origin", value)
            self.assert_refused(done, "--origin", *words)
        self.assertEqual(os.listdir(self.folder), [])
        self.assert_refused(call("simulate", "mars", "--origin", "1,2"), "--origin", "--output")
        self.assert_refused(call("simulate", "usv", "--origin", "1,2"), "--origin", "--output")
        self.assert_refused(call("run", self.write("a.log", self.neutral_log()), "--origin", "1,2"), "--output")
        self.assert_refused(call("simulate", "usv", "--compare", "--origin", "1,2", "--output", self.path("out")),
                            "--origin", "--compare")


if __name__ == "__main__":
    unittest.main()
