# SPDX-License-Identifier: BSD-3-Clause
"""Reports: what is read, thinned and drawn. browser_test.py tests the page in a browser."""
import contextlib
import io
import json
import os
import re
import shutil
import sys
import unittest
from unittest import mock

import support
import numpy as np
import reports
from reports import call, read_page
from cairn.report import __main__ as program
from cairn.report import curves, page, run, scene, shapes, thin


class PiecesTest(unittest.TestCase):
    def test_envelope_keeps_peaks(self):
        values = np.sin(np.arange(10000) / 300.0)
        values[4321], values[7000] = 9.0, -7.0
        kept = thin.envelope(values, 200)
        self.assertLess(len(kept), 210)
        self.assertTrue({0, 4321, 7000, 9999} <= set(kept.tolist()))
        self.assertEqual(sorted(set(kept.tolist())), kept.tolist())
        self.assertEqual(thin.envelope(values[:150], 200).tolist(), list(range(150)))
        holes = np.full(1000, np.nan)
        self.assertLessEqual(len(thin.envelope(holes, 100)), 102)

    def test_worst_and_evenly(self):
        badness = support.random(1).permutation(1000).astype(float)
        kept = thin.worst_and_evenly(badness, 100)
        self.assertEqual(len(kept), 100)
        self.assertTrue(set(np.argsort(-badness)[:25].tolist()) <= set(kept.tolist()))
        self.assertLess(np.diff(kept).max(), 40)

    def test_numbers_are_json(self):
        self.assertEqual(thin.numbers([1.23456, np.nan, np.inf], 2), [1.23, None, None])
        self.assertEqual(thin.significant([123456.0, 1.23456e-7, np.nan]), [123500.0, 1.235e-07, None])

    def test_ellipsoid(self):
        points, triangles = shapes.sphere()
        self.assertEqual((points.shape, triangles.shape), ((42, 3), (80, 3)))
        np.testing.assert_allclose(np.linalg.norm(points, axis=1), 1.0)
        draw = support.random(2).normal(size=(3, 3))
        covariance, centre = draw @ draw.T, np.array([1.0, 2, 3])
        off = shapes.ellipsoid(centre, covariance) - centre
        np.testing.assert_allclose(np.einsum("ij,ij->i", off @ np.linalg.inv(covariance), off), 9.0)
        edges = {frozenset(pair) for t in triangles.tolist() for pair in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0]))}
        self.assertEqual(len(points) - len(edges) + len(triangles), 2)  # Euler: a closed surface

    def test_outline(self):
        points = support.random(3).uniform(-1, 1, (200, 3))
        hull = shapes.outline(points)
        self.assertEqual(hull[0].tolist(), hull[-1].tolist())
        for a, b in zip(hull[:-1, :2], hull[1:, :2]):
            side = (b[0] - a[0]) * (points[:, 1] - a[1]) - (b[1] - a[1]) * (points[:, 0] - a[0])
            self.assertGreater(side.min(), -1e-12)
        for count in range(3):
            self.assertEqual(len(shapes.outline(points[:count])), count + 1 if count else 0)
        self.assertEqual(len(shapes.outline(np.column_stack([np.arange(5.0)] * 2 + [np.zeros(5)]))), 3)


class ReportTest(reports.FolderTest):
    @classmethod
    def make_run(cls, folder):
        support.run_program(folder, options=["--single-map"])
        for name in ("health.csv", "systematic.csv", "trajectory_online.tum", "trajectory_corrected.tum"):  # see trust_test.py
            with contextlib.suppress(FileNotFoundError):
                os.remove(os.path.join(folder, name))

    def test_what_is_read(self):
        (one,) = run.read_folder(self.folder)
        self.assertEqual(len(one.times()), one.summary["steps"])
        self.assertEqual(one.observations.total, one.summary["observations"])
        self.assertEqual(sum(one.observations.refused.values()), one.summary["rejected"])
        off = one.positions("true_") - one.positions()
        self.assertAlmostEqual(np.sqrt((off**2).sum(axis=1).mean()), one.summary["pose_rmse_m"], places=6)
        self.assertLess(np.abs(one.euler_error()).max(), 0.2)
        seen = scene.Landmarks(one)
        self.assertEqual(seen.count, one.summary["landmarks"])
        self.assertTrue((np.diff(seen.first) >= 0).all())
        self.assertTrue(np.allclose(seen.covariances, seen.covariances.transpose(0, 2, 1)))

    def test_held_landmarks_start_anew_at_closings(self):
        self.write("innovations.csv", "step,id,result,reason,distance,threshold\n0,1,new,none,0,0\n0,2,new,none,0,0\n"
                   "1,2,matched,none,1,9\n1,3,rejected,gate,99,9\n2,18446744073709551614,new,none,0,0\n3,1,matched,none,0,0\n")
        seen = run.Observations(self.path("innovations.csv"), [1])
        self.assertEqual((seen.held_step, seen.held), ([0, 1, 2, 3], [2, 2, 1, 2]))
        self.assertEqual(seen.first_step, {1: 0, 2: 0, 18446744073709551614: 2})
        self.assertEqual((seen.refused, seen.total), ({"gate": 1}, 6))

    def test_a_page(self):
        status, out, told = call(self.folder)
        self.assertEqual((status, told), (0, ""))
        self.assertIn("report.html", out)
        text, data = read_page(self.path("report.html"))
        self.assertEqual(len(data["curves"]), 9)
        self.assertEqual(re.findall(r"@[A-Z]+@", text), [])
        self.assertFalse(re.search(r"""(src|href)=["']?(https?:)?//""", text))
        for key in ("pose_rmse_m", "step_ms_worst", "landmarks"):
            self.assertTrue(f"<code>{key}</code>" in text, key)
        shown = data["scene"]["runs"][0]
        self.assertEqual(shown["counts"]["landmarks"], len(shown["landmarks"]["x"]))
        self.assertGreater(len(data["scene"]["stops"]), 50)
        self.assertEqual(data["scene"]["stops"][-1]["landmarks"], shown["counts"]["landmarks"])

    def test_submaps_and_terrain(self):
        (one,) = run.read_folder(self.folder)
        ids = one.landmarks["id"].tolist()
        self.write("submaps.csv", "submap,step,reason,landmarks,new,fused,refused,seconds,moved_max_m,x,y,z,qw,qx,qy,qz\n"
                   f"0,40,landmarks,{len(ids) // 2},1,0,0,0.1,0,0,0,0,1,0,0,0\n1,120,caller,2,2,0,0,0.1,0,0,0,0,1,0,0,0\n")
        self.write("submap_landmarks.csv", "submap,id\n" + "".join(f"0,{i}\n" for i in ids[: len(ids) // 2])
                   + "".join(f"1,{i}\n" for i in ids[-2:]))
        self.write("terrain.csv", "x,y,z\n" + "".join(f"{x},{y},{x + 10 * y}\n" for y in (0, 1, 2) for x in (5, 6)))
        (one,) = run.read_folder(self.folder)
        built = scene.build([one])
        self.assertEqual([stop["step"] for stop in built["stops"]], [40, 120])
        self.assertEqual([stop["submaps"] for stop in built["stops"]], [1, 2])
        self.assertEqual(built["terrain"], {"x": [5, 6], "y": [0, 1, 2], "z": [[5, 6], [15, 16], [25, 26]]})
        drawn = built["runs"][0]["outlines"]
        self.assertEqual([len(outline["landmarks"]) for outline in drawn], [len(ids) // 2, 2])
        self.assertGreater(len(drawn[1]["x"]), 3)  # two landmarks have no outline: the trajectory is added
        marked = [trace for trace in curves.step_time([one])["data"] if "marker" in trace]
        self.assertEqual(len(marked[0]["x"]), 2)

    def test_big_maps_are_thinned_and_it_is_said(self):
        lines = [f"{i},{i % 300},{i // 300},0,0.01,0,0,0.02,0,0.03,5,,,,,,,0.3,0.4,0.5" for i in range(30000)]
        with open(self.path("landmarks.csv")) as file:
            header = file.readline()
        self.write("landmarks.csv", header + "\n".join(lines) + "\n")
        (one,) = run.read_folder(self.folder)
        counts = scene.run_scene(one)["counts"]
        self.assertEqual(counts, {"landmarks": 30000, "landmarksDrawn": scene.MOST_LANDMARKS,
                                  "ellipsoids": scene.MOST_ELLIPSOIDS, "submaps": 0})
        self.assertIn("landmarks are drawn, evenly chosen", page.asset("scene.js"))

    def test_only_the_trajectory_must_be_there(self):
        for name in os.listdir(self.folder):
            if name != "trajectory.csv":
                os.remove(self.path(name))
        status, _, told = call(self.folder, "-o", self.path("small.html"))
        self.assertEqual((status, told), (0, ""))
        self.assertEqual(len(read_page(self.path("small.html"))[1]["curves"]), 6)

    def test_a_run_without_truth(self):
        with open(self.path("trajectory.csv")) as file:
            rows = [line.rstrip("\n").split(",") for line in file]
        for row in rows[1:]:
            row[12:28], row[34] = [""] * 16, ""
        self.write("trajectory.csv", "\n".join(map(",".join, rows)) + "\n")
        (one,) = run.read_folder(self.folder)
        self.assertIsNone(one.positions("true_"))
        self.assertIsNone(one.euler_error())
        self.assertEqual(curves.errors([one]), [])
        self.assertEqual(call(self.folder)[0], 0)

    def test_a_planar_vehicle_has_three_errors(self):
        with open(self.path("trajectory.csv")) as file:
            header, *rows = [line.rstrip("\n").split(",") for line in file]
        for row in rows:
            for name in ("z_m", "dtheta_x_rad", "dtheta_y_rad"):
                for kind in ("error", "sigma3"):
                    row[header.index(f"{kind}_{name}")] = "0"
        self.write("trajectory.csv", "\n".join(map(",".join, [header, *rows])) + "\n")
        (one,) = run.read_folder(self.folder)
        self.assertEqual([figure["title"] for figure in curves.errors([one])], ["x", "y", "yaw: about the map's z"])

    def test_names_are_no_markup(self):
        folder = os.path.join(self.room.name, "<b>bold & 'more'")
        shutil.copytree(self.folder, folder)
        with open(os.path.join(folder, "summary.json"), "w") as file:
            json.dump({"<i>": "</script><b>", "steps": 3}, file)
        self.assertEqual(call(folder)[0], 0)
        text, _ = read_page(os.path.join(folder, "report.html"))
        self.assertEqual([tag for tag in ("<b>", "<i>") if tag in text], [])

    def refused(self, *words):
        status, out, told = call(self.folder)
        self.assertEqual((status, out), (2, ""))
        self.assertEqual(told.count("\n"), 1, told)
        for word in words:
            self.assertIn(word, told)

    def test_what_is_broken_is_told(self):
        self.write("timing.csv", "step,step_ms\n0,1\n1,fast\n")
        self.refused("timing.csv", "fast")
        self.write("timing.csv", "step,step_ms\n0,1\n1\n")
        self.refused("timing.csv")
        os.remove(self.path("timing.csv"))
        self.write("submaps.csv", "submap,step,reason\n0,40\n")
        self.refused("submaps.csv", "line 2", "2 fields")
        os.remove(self.path("submaps.csv"))
        self.write("summary.json", "{")
        self.refused("summary.json")
        os.remove(self.path("summary.json"))
        self.write("innovations.csv", "step,id\n0,1\n")
        self.refused("innovations.csv", "lacks")
        self.write("trajectory.csv", "step,t_s\n0,1\n")
        self.refused("trajectory.csv", "x_m")
        self.write("trajectory.csv", "step,t_s,x_m,y_m,z_m\n")
        self.refused("no steps")
        os.remove(self.path("trajectory.csv"))
        self.refused("no trajectory.csv")
        status, _, told = call(self.path("nowhere"))
        self.assertEqual(status, 2)
        self.assertIn("no such folder", told)

    def test_a_comparison(self):
        both = os.path.join(self.room.name, "both")
        for name in ("standard", "submaps"):
            shutil.copytree(self.folder, os.path.join(both, name), dirs_exist_ok=True)
        runs = run.read_folder(both)
        self.assertEqual([one.name for one in runs], ["standard", "submaps"])
        with mock.patch.object(program, "pictures_of", lambda runs: [("Figure 5: ground", "image/png", b"abc")]):
            self.assertEqual(call(both)[0], 0)
        text, data = read_page(os.path.join(both, "report.html"))
        self.assertEqual(len(data["scene"]["runs"]), 2)
        self.assertTrue("data:image/png;base64,YWJj" in text)
        self.assertTrue("<th>standard</th><th>submaps</th>" in text)

    def test_no_plotly_no_matplotlib(self):
        with mock.patch.dict(sys.modules, {"plotly": None, "plotly.offline": None}), \
                contextlib.redirect_stderr(io.StringIO()) as told:
            self.assertEqual(program.main([self.folder]), 2)
        self.assertIn("pip install 'cairn[report]'", told.getvalue())


if __name__ == "__main__":
    unittest.main()
