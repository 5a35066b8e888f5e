# SPDX-License-Identifier: BSD-3-Clause
"""What the page of a run shows of its trustworthiness. The files are written by hand, so that each curve is known."""
import os
import tempfile
import unittest
from unittest import mock

import support  # noqa: F401
import numpy as np
import trust_data
from reports import call, read_page
from cairn.report import __main__ as program
from cairn.report import path_curves, run, trust, trust_curves


class TrustTest(unittest.TestCase):
    def setUp(self):
        room = tempfile.TemporaryDirectory()
        self.addCleanup(room.cleanup)
        self.folder = room.name
        trust_data.write(self.folder, trajectory=trust_data.trajectory_csv())

    def health(self, text=None):
        trust_data.write(self.folder, health=text or trust_data.health_csv())
        return trust.health_of(self.folder)

    def page(self):
        status, _, told = call(self.folder)
        self.assertEqual((status, told), (0, ""))
        text, found = read_page(os.path.join(self.folder, "report.html"))
        return text, found["curves"]

    def test_each_part_appears_with_its_file(self):
        self.assertEqual(len(self.page()[1]), 0)
        for title, count, file in (("<h2>Trust</h2>", 6, dict(health=trust_data.health_csv())),
                                   ("<h2>Systematic errors", 2, dict(systematic=trust_data.systematic_csv())),
                                   ("<h2>Corrected and online", 2, dict(trajectory_corrected_tum=trust_data.tum(0.01)))):
            before, curves = self.page()
            self.assertNotIn(title, before)
            trust_data.write(self.folder, **file)
            text, more = self.page()
            self.assertIn(title, text)
            self.assertEqual(len(more) - len(curves), count)

    def test_a_file_without_lines_shows_nothing(self):
        trust_data.write(self.folder, health=trust_data.HEALTH, systematic="step,time,name,value,sigma\n",
                         trajectory_online_tum="", trajectory_corrected_tum="# no poses\n")
        self.assertEqual(len(self.page()[1]), 0)

    def test_verdict_and_reasons(self):
        figure = trust_curves.verdict(self.health())
        spans = {trace["name"]: (trace["x"][0::3], trace["x"][1::3]) for trace in figure["data"]}
        self.assertEqual(spans, {"good": ([0, 110], [80, 200]), "doubtful": ([100], [110]), "lost": ([80], [100]),
                                 "jump": ([80], [100]), "refusals": ([80], [110])})
        axis = figure["layout"]["yaxis"]
        heights = {trace["name"]: trace["y"][0] for trace in figure["data"]}
        self.assertEqual({name: axis["ticktext"][axis["tickvals"].index(at)] for name, at in heights.items()},
                         {name: name for name in heights})
        self.assertIn("good 85.0 %, doubtful 5.0 %, lost 10.0 %", figure["note"])
        self.assertIn("at the end good", figure["note"])

    def test_every_reason_has_a_name(self):
        words = "nis|refusals|widened|sensor_noise|motion_noise|bias|jump|landmarks|closing|blind|definite".split("|")
        health = self.health(trust_data.health_csv().replace("refusals|jump", "|".join(words)))
        self.assertEqual(set(health.reasons), set(words))
        shown = trust_curves.verdict(health)["layout"]["yaxis"]["ticktext"][3:]
        self.assertEqual(len(set(shown)), len(words))
        self.assertFalse([name for name in shown if "_" in name])

    def test_short_spans_can_be_seen_and_many_stay_few(self):
        times, held = np.arange(100000.0), np.zeros(100000, bool)
        held[50000] = True
        begins, ends = trust_curves.spans(times, held)
        self.assertEqual(begins.tolist(), [50000])
        self.assertGreaterEqual(ends[0] - begins[0], 100)
        held[:20000:2] = True
        begins, ends = trust_curves.spans(times, held)
        self.assertLess(len(begins), 900)
        self.assertEqual((begins[0], begins[-1]), (0, 50000))
        self.assertTrue((begins[1:] > ends[:-1]).all())

    def test_numbers_of_the_health(self):
        health = self.health()
        refused = trust_curves.refusals(health)
        self.assertEqual({value for value in refused["data"][0]["y"]}, {1.0, 40.0})
        self.assertEqual((refused["data"][1]["x"], refused["data"][1]["text"]), ([99], ["by 2.5"]))
        noise = {trace["name"]: trace for trace in trust_curves.learned_noise(health)["data"]}
        self.assertEqual((noise["motion"]["x"][0], noise["motion"]["y"][0]), (0, None))  # unknown at first
        self.assertEqual(noise["motion"]["y"][-1], round(1 + 199 / 400, 3))
        self.assertEqual(set(noise["sensors"]["y"]), {None, 0.9})
        high, low = noise["motion: 2 σ"]["y"][179], noise["motion: 2 σ"]["y"][180]  # the upper side, then the lower one
        self.assertAlmostEqual(high - low, 4 * round(20 / 199, 3), places=2)
        self.assertIn("motion at the end 1.5 ± 0.1", trust_curves.learned_noise(health)["note"])
        recent = trust_curves.recent_innovations(health)
        self.assertIn(f"{100 * 179 / 199:.1f} %", recent["note"])  # the first step has no NIS
        self.assertEqual(set(recent["data"][1]["y"]), {None, 1.0, 5.0})
        both = trust_curves.contradictions(health)["data"]
        self.assertEqual([set(trace["y"]) for trace in both], [{1.0}, {0.5, 6.0}])
        self.assertEqual(set(trust_curves.persistence(health)["data"][0]["y"]), {0.1})

    def test_columns_that_say_nothing_have_no_panel(self):
        lines = trust_data.health_csv().splitlines()
        rows = [",".join(line.split(",")[:4] + [""] * 15) for line in lines[1:]]
        self.assertEqual(trust_curves.of_health(self.health("\n".join([lines[0], *rows]) + "\n")), [])
        short = "step,t_s,verdict,reasons\n0,0,good,\n"
        self.assertEqual(trust_curves.of_health(self.health(short)), [])
        self.assertEqual(len(self.page()[1]), 1)

    def test_large_times_count_from_the_first_step(self):
        start = 1317042272.25
        trust_data.write(self.folder, trajectory=trust_data.trajectory_csv(start=start), health=trust_data.health_csv(start),
                         systematic=trust_data.systematic_csv(start), trajectory_online_tum=trust_data.tum(0.03, jitter=start),
                         trajectory_corrected_tum=trust_data.tum(0.01, jitter=start))
        text, curves = self.page()
        self.assertIn("200 steps, 199.0 s; times count from 1317042272.250 s", text)
        ends = [max(x for trace in curve["data"] for x in trace["x"] if x is not None) for curve in curves]
        self.assertEqual(ends, [200] + [199] * 7 + [50] + [199])  # the one before the last is from above
        self.assertEqual(len(curves[-1]["data"]), 2)  # both trajectories still find the truth

    def test_a_run_without_times(self):
        def timeless(text, column):
            lines = [line.split(",") for line in text.splitlines()]
            return "\n".join(",".join(line[:column] + [""] + line[column + 1:] if at else line)
                             for at, line in enumerate(lines)) + "\n"
        trust_data.write(self.folder, trajectory=timeless(trust_data.trajectory_csv(), 1),
                         health=timeless(trust_data.health_csv(), 1), systematic=timeless(trust_data.systematic_csv(), 1))
        text, curves = self.page()
        self.assertIn('<p class="lead">200 steps</p>', text)
        self.assertEqual({curve["layout"]["xaxis"]["title"]["text"] for curve in curves}, {"step"})
        self.assertEqual(curves[0]["data"][0]["x"][:2], [80, 100])

    def test_systematic_errors(self):
        trust_data.write(self.folder, systematic=trust_data.systematic_csv())
        states = trust.systematic_of(self.folder)
        self.assertEqual([state[:2] for state in states], [("wheel scale left", ""), ("gyro bias z", "rad/s")])
        scale, gyro = trust_curves.systematic(states)
        band, curve = gyro["data"]
        self.assertEqual(gyro["layout"]["yaxis"]["title"]["text"], "rad/s")
        self.assertAlmostEqual(band["y"][0], 3 * 0.002, places=9)
        self.assertAlmostEqual(band["y"][-1], -3 * 0.002, places=9)
        self.assertAlmostEqual(curve["y"][-1], -0.002 * (1 - 0.98 ** 199), places=6)
        self.assertIn("at the end -0.00196 ± 0.00081 rad/s", gyro["note"])
        rows = "".join(f"0,0,state {i} [m/s],1,1\n" for i in range(15))
        trust_data.write(self.folder, systematic="step,time,name,value,sigma\n" + rows)
        text, curves = self.page()
        self.assertEqual(len(curves), 12)
        self.assertIn("Not drawn: state 12, state 13, state 14.", text)

    def test_trajectories(self):
        trust_data.write_all(self.folder)
        (one,) = run.read_folder(self.folder)
        above, errors = path_curves.of_run(one, trust.Trust(self.folder))
        self.assertEqual([trace["name"] for trace in above["data"]], ["true", "online", "corrected"])
        self.assertEqual([len(trace["x"]) for trace in above["data"]], [200, 200, 150])
        self.assertEqual({trace["name"]: (trace["x"][0], set(trace["y"])) for trace in errors["data"]},
                         {"online": (0, {0.03}), "corrected": (50, {0.01})})
        self.assertEqual(errors["note"], "root mean square: online 0.03 m, corrected 0.01 m")
        trust_data.write(self.folder, trajectory_corrected_tum=trust_data.tum(0.01, jitter=0.3))  # times that have no truth
        errors = path_curves.of_run(one, trust.Trust(self.folder))[1]
        self.assertEqual([trace["name"] for trace in errors["data"]], ["online"])

    def test_trajectories_without_truth(self):
        trust_data.write_all(self.folder)
        trust_data.write(self.folder, trajectory=trust_data.trajectory_csv(with_truth=False))
        (one,) = run.read_folder(self.folder)
        (above,) = path_curves.of_run(one, trust.Trust(self.folder))
        self.assertEqual([trace["name"] for trace in above["data"]], ["online", "corrected"])

    def refused(self, *words, **files):
        trust_data.write_all(self.folder)
        trust_data.write(self.folder, **files)
        status, out, told = call(self.folder)
        self.assertEqual((status, out, told.count("\n")), (2, "", 1), told)
        for word in words:
            self.assertIn(word, told)

    def test_what_is_broken_is_told(self):
        self.refused("health.csv", "column verdict", health="step,t_s,reasons\n0,0,\n")
        self.refused("health.csv", "'fine'", health=trust_data.health_csv().replace(",lost,", ",fine,"))
        self.refused("health.csv", "half", health=trust_data.health_csv().replace("0.01,", "half,"))
        self.refused("systematic.csv", "column sigma", systematic="step,time,name,value\n0,0,a,1\n")
        self.refused("trajectory_online.tum", "eight", trajectory_online_tum="0 1 2 3\n")
        self.refused("trajectory_corrected.tum", "one", trajectory_corrected_tum="one 1 2 3 0 0 0 1\n")

    def test_two_runs_each_say_what_they_think(self):
        both = os.path.join(self.folder, "both")
        for name in ("standard", "submaps"):
            os.makedirs(os.path.join(both, name))
            trust_data.write_all(os.path.join(both, name))
        with mock.patch.object(program, "pictures_of", lambda runs: ()):
            self.assertEqual(call(both)[0], 0)
        text, _ = read_page(os.path.join(both, "report.html"))
        for name in ("standard", "submaps"):
            self.assertIn(f"<h2>Trust: {name}</h2>", text)


if __name__ == "__main__":
    unittest.main()
