# SPDX-License-Identifier: BSD-3-Clause
"""Reports of teams: what is read and drawn. browser_test.py tests the page in a browser."""
import os
import re
import subprocess
import unittest

import support
import numpy as np
import reports
from reports import call, read_page
from cairn.report import team, team_curves

COMPARISON = """features,mode,claimed,true,anees,in_band,band_low,band_high,rmse_m,landmark_rmse_m,recursion_ms,paper
6,mono,0,0,1.07,0.93,0.85,1.17,5.4,10.1,0.008,50
6,eo_diagonal,22,17,1.23,0.21,0.85,1.17,4.9,10.8,0.016,50
6,joint,45,49,1.03,0.96,0.85,1.17,3.8,3.5,0.022,50
40,mono,0,0,0.99,0.99,0.85,1.17,2.3,4.2,0.29,30
40,eo_diagonal,12,-86,2.37,0,0.85,1.17,3.1,6.6,0.74,30
"""


class TeamReportTest(reports.FolderTest):
    @classmethod
    def make_run(cls, folder):
        subprocess.run([os.environ["CAIRN_PROGRAM"], "simulate", "usv", "--vehicles", "3", "--duration", "400", "--output",
                        folder, "--quiet"], check=True, stdout=subprocess.DEVNULL)

    def test_what_is_read(self):
        one = team.read_folder(self.folder)
        self.assertEqual([vehicle.number for vehicle in one.vehicles], [1, 2, 3])
        self.assertEqual([len(vehicle["time"]) for vehicle in one.vehicles], [81] * 3)
        first = one.vehicles[0]
        scored = first["step"] >= 0.1 * 81  # the figure of the program
        square = first.error("x")[scored] ** 2 + first.error("y")[scored] ** 2
        self.assertAlmostEqual(np.sqrt(square.mean()), one.summary["vehicle_1_pose_rmse_m"], places=6)
        self.assertLess(np.abs(first.error("heading")).max(), 0.1)
        self.assertTrue(one.one_map())
        self.assertEqual(len(one.maps[0]["id"]), one.summary["landmarks"])

    def test_a_page(self):
        status, out, told = call(self.folder)
        self.assertEqual((status, told), (0, ""))
        text, found = read_page(self.path("report.html"))
        self.assertEqual(len(found["curves"]), 2 + 3 * 6)  # world and map; 3 errors, norm, improvement, time of each boat
        self.assertEqual([curve["alone"] for curve in found["curves"]], [True] * 2 + [False] * 18)
        self.assertIsNone(found["scene"])
        self.assertEqual(re.findall(r"@[A-Z]+@", text), [])
        names = [trace["name"] for trace in found["curves"][1]["data"]]
        for name in ("vehicle 1", "vehicle 2", "vehicle 3", "true trajectories", "landmarks", "true landmarks", "3 σ"):
            self.assertIn(name, names)
        self.assertEqual(names.count("landmarks"), 1)
        self.assertIn("<code>vehicle_3_pose_rmse_m</code>", text)
        self.assertIn("3 vehicles, 81 steps, 400.0 s", text)
        self.assertNotIn('id="slider"', text)

    def test_maps_that_differ_are_drawn_each(self):
        with open(self.path("team_landmarks.csv")) as file:
            lines = file.read().splitlines()
        cells = lines[1].split(",")
        cells[2] = str(float(cells[2]) + 1.0)
        self.write("team_landmarks.csv", "\n".join([lines[0], ",".join(cells), *lines[2:]]) + "\n")
        names = [trace["name"] for trace in team_curves.the_map(team.read_folder(self.folder))["data"]]
        self.assertEqual([f"landmarks of vehicle {v}" in names for v in (1, 2, 3)], [True] * 3)

    def test_ellipses(self):
        covariance = np.array([[4.0, 1.5], [1.5, 1.0]])
        columns = {"x": np.array([5.0]), "y": np.array([-2.0]), "sigma3_x": np.array([6.0]), "sigma3_y": np.array([3.0])}
        for more, matrix in (({"cov_xy": np.array([1.5])}, covariance), ({}, np.diag([4.0, 1.0]))):
            x, y = team_curves.ellipses(team.Vehicle(1, {**columns, **more}))
            off = np.stack([x[:-1] - 5.0, y[:-1] + 2.0])
            np.testing.assert_allclose(np.einsum("ik,ij,jk->k", off, np.linalg.inv(matrix), off), 9.0)
            self.assertTrue(np.isnan(x[-1]))

    def test_without_truth_and_landmarks(self):
        with open(self.path("team_trajectories.csv")) as file:
            rows = [line.rstrip("\n").split(",") for line in file]
        for row in rows[1:]:
            row[9:12] = [""] * 3
        self.write("team_trajectories.csv", "\n".join(map(",".join, rows)) + "\n")
        for name in ("team_landmarks.csv", "team_steps.csv", "team_scene.csv", "summary.json"):
            os.remove(self.path(name))
        status, _, told = call(self.folder)
        self.assertEqual((status, told), (0, ""))
        self.assertEqual(len(read_page(self.path("report.html"))[1]["curves"]), 1)

    def test_a_comparison(self):
        folder = os.path.join(self.room.name, "<compared>")
        os.makedirs(folder, exist_ok=True)
        with open(os.path.join(folder, "team_compare.csv"), "w") as file:
            file.write(COMPARISON)
        with open(os.path.join(folder, "summary.json"), "w") as file:
            file.write('{"mono_6": {"claimed_improvement": 0}}')
        status, _, told = call(folder)
        self.assertEqual((status, told), (0, ""))
        text, found = read_page(os.path.join(folder, "report.html"))
        self.assertEqual(len(found["curves"]), 2 + 3)
        few, many = found["curves"][:2]
        self.assertEqual(few["data"][0]["x"], ["eo_diagonal", "joint"])
        self.assertEqual([trace["y"] for trace in few["data"]], [[22, 45], [17, 49]])
        self.assertEqual([trace["y"] for trace in many["data"]], [[12, None], [-86, None]])
        self.assertEqual([curve["layout"]["shapes"][0]["y0"] for curve in (few, many)], [50, 30])
        self.assertEqual(few["layout"]["yaxis"]["range"], many["layout"]["yaxis"]["range"])
        self.assertLess(many["layout"]["yaxis"]["range"][0], -86)
        band = found["curves"][2]["layout"]["shapes"][0]
        self.assertEqual((band["y0"], band["y1"]), (0.85, 1.17))
        self.assertIn("the cooperative paper claims 50 %", text)
        self.assertNotIn("<compared>", text)
        self.assertIn("<td>-86.0</td>", text)

    def test_a_folder_of_both_goes_by_its_summary(self):
        self.write("team_compare.csv", COMPARISON)
        self.assertIsInstance(team.read_folder(self.folder), team.TeamRun)
        self.write("summary.json", "{}")
        self.assertIsInstance(team.read_folder(self.folder), team.TeamComparison)

    def refused(self, *words):
        status, out, told = call(self.folder)
        self.assertEqual((status, out, told.count("\n")), (2, "", 1), told)
        for word in words:
            self.assertIn(word, told)

    def test_what_is_broken_is_told(self):
        self.write("summary.json", "[1]")
        self.refused("summary.json")
        self.write("summary.json", "{}")
        self.write("team_steps.csv", "features,mode,runs,step,time,vehicle,norm_m2\n6,mono,1,0,0,1,0\n")
        self.refused("team_steps.csv", "recursion_ms")
        os.remove(self.path("team_steps.csv"))
        self.write("team_scene.csv", "kind,id,x,y\n")
        self.refused("team_scene.csv", "radius")
        self.write("team_scene.csv", "kind,id,x,y,radius\ncoast,1,-5,3,\ncoast,2,5,3,\nfeature,1,0,1,\nradar,1,0,0,4\n")
        self.refused("team_scene.csv", "boat 1 has no course")
        self.write("team_scene.csv", "kind,id,x,y,radius\nfeature,1,0,1,\n")
        self.refused("team_scene.csv", "coast")
        os.remove(self.path("team_scene.csv"))
        self.write("team_landmarks.csv", "vehicle,id,x\n1,2,3\n")
        self.refused("team_landmarks.csv", "column y")
        self.write("team_trajectories.csv", "step,time\n0,1\n")
        self.refused("team_trajectories.csv", "column vehicle")
        self.write("team_trajectories.csv", ",".join(team.TRAJECTORY) + "\n")
        self.refused("no lines")
        self.write("team_trajectories.csv", ",".join(team.TRAJECTORY) + "\n0,0,one,0,0,0,0,0,0\n")
        self.refused("team_trajectories.csv", "one")
        os.remove(self.path("team_trajectories.csv"))
        self.write("team_compare.csv", COMPARISON.replace("paper", "article"))
        self.refused("team_compare.csv", "paper")


if __name__ == "__main__":
    unittest.main()
