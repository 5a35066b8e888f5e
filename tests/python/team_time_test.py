# SPDX-License-Identifier: BSD-3-Clause
"""The world of boats and their curves over time on the page of a team, and the cooperative paper's figures as files. The
numbers are written by hand, so that each curve is known."""
import os
import tempfile
import unittest

import support  # noqa: F401
import numpy as np
from reports import call, read_page
from cairn.report import team, team_curves, team_time

MODES = {"mono": 4.0, "eo_full": 3.0, "submaps": 6.0, "joint": 2.0}  # norm of vehicle 1; that of vehicle 2 is twice as large
COUNTS = (6, 10, 40)


def norm_of(mode, features, vehicle, step):
    return 0.0 if step == 0 else MODES[mode] * vehicle * (1 + step / 10) * 6 / features


def time_of(mode, features, vehicle, step):
    """One step of the second vehicle takes a hundred times as long: the computer did something else."""
    return MODES[mode] * features * vehicle * (100 if (vehicle, step) == (2, 7) else 1)


def steps_csv(counts=COUNTS, modes=tuple(MODES), steps=30):
    rows = ["features,mode,runs,step,time,vehicle,norm_m2,recursion_ms"]
    rows += [f"{f},{mode},3,{k},{5 * k},{v},{norm_of(mode, f, v, k)},{time_of(mode, f, v, k)}"
             for f in counts for mode in modes for k in range(steps) for v in (1, 2)]
    return "\n".join(rows) + "\n"


def scene_csv(features=40):
    rows = ["kind,id,x,y,radius", "coast,1,-5000,3400,", "coast,2,0,3600,", "coast,3,5000,3500,"]
    rows += [f"feature,{i},{100 * i - 2000},{-50 * i}," for i in range(1, features + 1)]
    for boat, x in ((1, -750), (2, 750)):
        rows += [f"course,{boat},{x},0,270", f"radar,{boat},{x},-270,5000", f"drive,{boat},{x},-270,", f"drive,{boat},{x + 9},-268,"]
    return "\n".join(rows) + "\n"


COMPARISON = "features,mode,claimed,true,anees,band_low,band_high,rmse_m,recursion_ms,paper\n" + "".join(
    f"{f},{mode},1,1,1,0.9,1.1,3,0.1,50\n" for f in COUNTS for mode in MODES)
TRAJECTORY = ",".join(team.TRAJECTORY) + "\n" + "".join(f"{k},{5 * k},{v},{k},0,0,1,1,0.1\n" for k in range(3) for v in (1, 2))


class WrittenByHand(unittest.TestCase):
    def setUp(self):
        room = tempfile.TemporaryDirectory()
        self.addCleanup(room.cleanup)
        self.folder = room.name

    def make(self, **files):
        for name, text in files.items():
            with open(os.path.join(self.folder, name + ".csv"), "w") as file:
                file.write(text)
        return team.read_folder(self.folder)

    def comparison(self):
        return self.make(team_compare=COMPARISON, team_steps=steps_csv(), team_scene=scene_csv())


class TeamTimeTest(WrittenByHand):
    def test_norm_and_improvement_on_the_page(self):
        self.comparison()
        status, _, told = call(self.folder)
        self.assertEqual((status, told), (0, ""))
        text, found = read_page(os.path.join(self.folder, "report.html"))
        figures = found["curves"][len(COUNTS) + 3 + 2:]  # after bars, consistency and worlds
        self.assertEqual(len(figures), len(COUNTS) * (2 + 2 + 2))
        for at, features in enumerate(COUNTS):
            of_it = figures[4 * at: 4 * at + 4]
            for vehicle, (norm, ratio) in enumerate(zip(of_it[:2], of_it[2:]), 1):
                self.assertEqual([trace["name"] for trace in norm["data"]], ["mono", "eo_full", "submaps", "joint"])
                self.assertEqual([trace["name"] for trace in ratio["data"]], ["eo_full", "submaps", "joint"])
                for trace in norm["data"]:
                    self.assertEqual(trace["x"], [5.0 * k for k in range(30)])
                    np.testing.assert_allclose(trace["y"], [norm_of(trace["name"], features, vehicle, k) for k in range(30)],
                                               rtol=1e-4)
                for trace, gain in zip(ratio["data"], (25.0, -50.0, 50.0)):
                    self.assertEqual(trace["y"], [None] + [gain] * 29)  # at the start both know all
                self.assertEqual([trace.get("visible", True) for trace in norm["data"]], [True, True, "legendonly", True])
                self.assertEqual(ratio["layout"]["shapes"][0]["y0"], {6: 50, 10: 40, 40: 30}[features])
                self.assertEqual((norm["alone"], ratio["alone"]), (False, False))
        for number, features in ((3, 6), (5, 10), (6, 40)):
            self.assertIn(f"<h2>Uncertainty with {features} features (Figure {number} of the cooperative paper)</h2>", text)
        self.assertIn("Means of 3 worlds.", text)
        self.assertIn("Medians of 3 worlds.", text)
        self.assertEqual(text.count("Figure 7 of the cooperative paper"), 1)

    def test_the_time_of_a_recursion(self):
        one = self.comparison()
        first, second = team_time.recursions(one.steps, 10, one.steps.vehicles)
        self.assertIn("vehicle 2, 10 features (Figure 7", second["title"])
        self.assertNotIn("Figure", first["title"])
        for figure, vehicle in ((first, 1), (second, 2)):
            strong = {trace["name"]: trace for trace in figure["data"] if trace.get("showlegend", True)}
            self.assertEqual({name: set(trace["y"]) for name, trace in strong.items()},
                             {mode: {10 * vehicle * size} for mode, size in MODES.items()})
        self.assertNotIn("beyond", first["note"])
        self.assertIn("4 steps are beyond the axis", second["note"])
        pale = [trace for trace in second["data"] if not trace.get("showlegend", True)]
        self.assertEqual([[k for k, value in enumerate(trace["y"]) if value is None] for trace in pale], [[7]] * 4)
        self.assertEqual(second["layout"]["yaxis"]["range"], [0, team_time.BESIDE * 10 * 2 * 6.0])

    def test_the_world(self):
        scene = self.comparison().scene
        figure = team_time.world(scene, 10)
        traces = {trace["name"]: trace for trace in figure["data"]}
        self.assertEqual((traces["features"]["x"], traces["features"]["y"]),
                         ([100 * i - 2000 for i in range(1, 11)], [-50 * i for i in range(1, 11)]))
        self.assertEqual((traces["coast line"]["x"], traces["coast line"]["y"]), ([-5000, 0, 5000], [3400, 3600, 3500]))
        self.assertEqual((max(traces["land"]["y"]), min(traces["land"]["y"])), (5000, 3400))
        for kind, radius, y in (("radar", 5000, -270), ("course", 270, 0)):
            for boat, x in ((1, -750), (2, 750)):
                circle = traces[f"{kind} {boat}"]
                np.testing.assert_allclose(np.hypot(np.array(circle["x"]) - x, np.array(circle["y"]) - y), radius, rtol=1e-3)
        for axis in ("xaxis", "yaxis"):  # the circles are whole
            self.assertGreater(figure["layout"][axis]["range"][1], 5750)
        self.assertIn("Figure 2", figure["title"])
        self.assertIn("Figure 4", team_time.world(scene, 40)["title"])
        self.assertNotIn("Figure", team_time.world(scene, 12)["title"])

    def test_one_run_without_its_twin(self):
        one = self.make(team_trajectories=TRAJECTORY, team_steps=steps_csv((15,), ("joint",)))
        self.assertEqual(team_time.improvements(one.steps, 15), [])
        self.assertEqual(call(self.folder)[0], 0)
        text, found = read_page(os.path.join(self.folder, "report.html"))
        self.assertEqual(len(found["curves"]), 1 + 2)
        norm, taken = (figure["data"] for figure in found["curves"][1:])
        for at, vehicle in enumerate((1, 2)):
            self.assertEqual((norm[at]["name"], taken[at]["name"]), (f"vehicle {vehicle}",) * 2)
            np.testing.assert_allclose(norm[at]["y"], [norm_of("joint", 15, vehicle, k) for k in range(30)], rtol=1e-4)
            self.assertEqual(set(taken[at]["y"]), {30.0 * vehicle})
        self.assertNotIn("cooperative paper", text)

    def test_a_bar_that_would_squeeze_the_others_is_cut(self):
        one = self.make(team_compare=COMPARISON.replace("40,joint,1,1,", "40,joint,20,-1141,"))
        figure = team_curves.improvement(one)[-1]
        self.assertEqual([trace["y"][-1] for trace in figure["data"]], [20, team_curves.LEAST_BAR])
        self.assertEqual(figure["data"][1]["text"][-1], "-1141")
        self.assertIn("cut at -150 %", figure["note"])
        self.assertGreater(figure["layout"]["yaxis"]["range"][0], -200)


class FiguresTest(WrittenByHand):
    """The figures as files. Skipped without matplotlib."""

    def setUp(self):
        super().setUp()
        try:
            from cairn.report import team_figures
        except ImportError as error:
            self.skipTest(str(error))
        self.figures = team_figures

    def written(self, kind="png"):
        folder = os.path.join(self.folder, "figures")
        status, out, told = call(self.folder, "--figures", folder, "--format", kind)
        return status, sorted(os.listdir(folder)) if os.path.isdir(folder) else [], told

    def test_files_of_a_comparison(self):
        self.comparison()
        self.assertEqual(self.written(), (0, [f"usv_figure_0{number}.png" for number in range(2, 8)], ""))

    def test_files_of_one_run(self):
        self.make(team_trajectories=TRAJECTORY, team_steps=steps_csv((10,), ("mono", "joint")), team_scene=scene_csv(10))
        self.assertEqual(self.written("svg"), (0, [f"usv_figure_0{number}.svg" for number in (2, 5, 7)], ""))

    def test_nothing_to_draw(self):
        for counts, modes in (((12,), ("mono", "joint")), ((6,), ("joint",)), ((10,), ("mono",))):
            self.make(team_trajectories=TRAJECTORY, team_steps=steps_csv(counts, modes))
            status, files, told = self.written()
            self.assertEqual((status, files, told.count("\n")), (2, [], 1))
            self.assertIn("nothing to draw", told)

    def test_curves_of_a_figure(self):
        one = self.comparison()
        figure = self.figures.norms(one.steps, 6)
        self.addCleanup(self.figures.pyplot.close, "all")
        for at, (axes, ratio) in enumerate(zip(figure.axes[:2], figure.axes[2:4])):
            drawn = {curve.get_label(): curve.get_ydata() for curve in axes.lines}
            self.assertEqual(set(drawn), {self.figures.LABELS[mode] for mode in ("mono", "eo_full", "joint")})
            np.testing.assert_allclose(drawn[self.figures.LABELS["joint"]],
                                       [norm_of("joint", 6, at + 1, k) for k in range(30)])
            self.assertEqual([set(curve.get_ydata()[1:].round(9)) for curve in ratio.lines[:2]], [{25.0}, {50.0}])
            self.assertEqual(set(ratio.lines[2].get_ydata()), {50})  # the paper's
        times = self.figures.recursion(one.steps, 10).axes[0]
        self.assertEqual(times.get_ylim()[0], 0)
        self.assertEqual([set(curve.get_ydata()) for curve in times.lines[1::2]], [{80.0}, {60.0}, {40.0}])  # of boat 2
        world = self.figures.world(one.scene, 10).axes[0]
        stars = [curve for curve in world.lines if curve.get_marker() == "*"]
        self.assertEqual([len(curve.get_xdata()) for curve in stars], [10])
        self.assertGreater(world.get_xlim()[1], 5.75)

    def test_a_boat_points_along_its_course(self):
        scene = self.comparison().scene
        figure = self.figures.world(scene, 10)
        self.addCleanup(self.figures.pyplot.close, figure)
        (boat,) = [curve for curve in figure.axes[1].lines if isinstance(curve.get_marker(), tuple)]
        self.assertEqual((boat.get_xdata()[0], boat.get_ydata()[0]), (750, -270))
        self.assertAlmostEqual((boat.get_marker()[2] + 90) % 360, 0)  # east; a triangle without turn points north


if __name__ == "__main__":
    unittest.main()
