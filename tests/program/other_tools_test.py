# SPDX-License-Identifier: BSD-3-Clause
"""Other tools read what the program and an example write: evo, plyfile, pyproj and rerun, all from the Python package
index. check_other_tools.sh runs it."""
import json
import math
import os
import subprocess
import sys
import unittest

import numpy as np
import plyfile
import pyproj
import rerun.chunk
from support import HERE, ProgramTest

MISSION = os.path.join(HERE, "../../bindings/python/examples/rerun_mission.py")


class OtherTools(ProgramTest):
    def evo(self, folder, truth, estimate):
        """The root mean square of the position error that evo_ape prints, m. Nothing is aligned, which is its default."""
        done = subprocess.run(["evo_ape", "tum", os.path.join(folder, truth), os.path.join(folder, estimate)],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        (line,) = [line for line in done.stdout.splitlines() if line.split()[:1] == ["rmse"]]
        return float(line.split()[1])

    def check_evo(self, folder, figures):
        for kind, key in (("online", "pose_rmse_m"), ("corrected", "pose_rmse_corrected_m")):
            rmse = self.evo(folder, "trajectory_truth.tum", f"trajectory_{kind}.tum")
            self.assertAlmostEqual(rmse, figures[key], delta=1e-6 + 1e-6 * figures[key])

    def test_evo_of_a_world(self):
        self.check_evo(self.path("out"), self.figures("simulate", "mars", "--course=laps", "--output", self.path("out")))

    def test_evo_of_logs(self):
        log = self.write("a.log", self.neutral_log())
        self.check_evo(self.path("out"), self.figures("run", log, "--submap-landmarks=15", "--output", self.path("out")))
        edges = "".join(f"EDGE2 {k} {k + 1} 1 0 0 50 0 0 50 0 100\n" for k in range(4))  # a log without times
        self.write("line_groundtruth.txt", edges.replace("1 0 0 50", "1.125 0 0 50"))
        figures = self.figures("run", self.write("line.txt", edges), "--output", self.path("line"))
        self.assertGreater(figures["pose_rmse_m"], 0.1)
        self.check_evo(self.path("line"), figures)

    def test_evo_of_a_team(self):
        folder = self.path("out")
        self.figures("simulate", "usv", "--vehicles=2", "--duration=60", "--output", folder)
        table = self.read_csv(folder, "team_trajectories.csv")
        for vehicle in "12":
            rows = [row for row in table if row["vehicle"] == vehicle]
            square = sum((float(row["x"]) - float(row["true_x"])) ** 2 + (float(row["y"]) - float(row["true_y"])) ** 2
                         for row in rows)
            rmse = self.evo(folder, *(f"vehicle_{vehicle}_trajectory_{kind}.tum" for kind in ("truth", "online")))
            self.assertAlmostEqual(rmse, math.sqrt(square / len(rows)), delta=1e-6)

    def test_plyfile_and_pyproj(self):
        folder, origin = self.path("out"), (46.0207, 7.7491, 1608)
        self.figures("simulate", "mars", "--output", folder, "--origin", ",".join(map(str, origin)))
        table = self.read_csv(folder, "landmarks.csv")
        points = plyfile.PlyData.read(os.path.join(folder, "map.ply"))["vertex"]
        for name, column in (("x", "x_m"), ("y", "y_m"), ("z", "z_m"), ("id", "id"), ("observations", "observations")):
            self.assertEqual(list(points[name]), [float(row[column]) for row in table])
        for axis in "xyz":
            np.testing.assert_allclose(3 * points[f"sigma_{axis}"], [float(row[f"sigma3_{axis}_m"]) for row in table])
        with open(os.path.join(folder, "map.geojson")) as file:
            features = json.load(file)["features"]
        places = np.array([f["geometry"]["coordinates"] for f in features if f["properties"]["kind"] == "landmark"])
        earth = pyproj.Transformer.from_pipeline(
            "+proj=pipeline +step +inv +proj=topocentric +ellps=WGS84 +lat_0={} +lon_0={} +h_0={} "
            "+step +inv +proj=cart +ellps=WGS84 +step +proj=unitconvert +xy_in=rad +xy_out=deg".format(*origin))
        wanted = np.stack(earth.transform(points["x"], points["y"], points["z"]), axis=1)
        rounding = (5e-10, 5e-10, 5e-5)
        for worst, limit in zip(np.abs(places - wanted).max(axis=0), rounding):
            self.assertLess(worst, 1.1 * limit)

    def mission(self, *options):
        """The number of rows of each entity of the mission that the example saves, and what it printed."""
        saved = self.path("mission.rrd")
        done = subprocess.run([sys.executable, MISSION, "--save", saved, *options], stdout=subprocess.PIPE, text=True,
                              check=True)
        rows = {}
        for chunk in rerun.chunk.RrdReader(saved).stream():
            rows[chunk.entity_path] = rows.get(chunk.entity_path, 0) + chunk.num_rows
        return rows, done.stdout

    def test_a_mission_in_rerun(self):
        rows, said = self.mission("--course=circle")
        steps, submaps = (int(said.split(word)[0].split()[-1]) for word in (" steps", " submaps"))
        self.assertGreater(submaps, 2)
        for name in ("world/rover", "world/position", "world/drive/online", "world/drive/truth", "world/submap"):
            self.assertEqual(rows[f"/{name}"], steps, name)
        for name in ("world/submap/landmarks", "trust/nis", "error/x", "error/y", "error/z"):
            self.assertEqual(rows[f"/{name}"], steps + 1, name)  # one more: the map at the end, or how a line looks
        for name in ("world/map/landmarks", "world/drive/corrected"):
            self.assertEqual(rows[f"/{name}"], submaps, name)
        self.assertEqual((rows["/world/ground"], rows["/world/rover/body"], rows["/trust/verdict"]), (1, 1, 1))
        self.assertIn("the verdict is good", said)

    def test_the_verdict_of_a_biased_mission(self):
        rows, said = self.mission("--course=circle", "--velocity-bias=0.3")
        self.assertGreater(rows["/trust/verdict"], 1)
        self.assertNotIn("the verdict is good", said)


if __name__ == "__main__":
    unittest.main()
