# SPDX-License-Identifier: BSD-3-Clause
"""The page in a browser, loaded from the disk and without network. If CAIRN_SHOTS is set, it names the folder for the
screenshots."""
import os
import subprocess
import sys
import tempfile
import time
import unittest

import support

support.need("plotly", "matplotlib")

import chromium  # noqa: E402
import numpy as np  # noqa: E402
import trust_data  # noqa: E402

support.need_program("chromium", chromium.PROGRAM)
KEPT = os.environ.get("CAIRN_SHOTS")
EMPTY = "[...document.querySelectorAll('.plot:not(.scene)')].filter(p => !p.querySelector('.trace, .point')).map(p => p.id)"
SHOWN = "({n: document.getElementById('scene').data.find(t => t.name.startsWith('%s')).x.length}).n"


def report(folder, *options):
    return subprocess.run([sys.executable, "-B", "-m", "cairn.report", folder, *options], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)


class BrowserTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.room = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.room.cleanup)
        cls.compared = os.path.join(cls.room.name, "a comparison")
        subprocess.run([os.environ["CAIRN_PROGRAM"], "simulate", "mars", "--compare", "--submap-landmarks", "40", "--output",
                        cls.compared, "--quiet"], check=True, stdout=subprocess.DEVNULL)
        cls.single = support.run_program(os.path.join(cls.room.name, "drive"), options=["--single-map"])
        cls.browser = chromium.Browser(1000, 760)
        cls.addClassCleanup(cls.browser.__exit__)

    def open(self, folder, *options):
        done = report(folder, *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        path = os.path.join(folder, "report.html")
        self.assertLess(os.path.getsize(path), 12e6)
        self.browser.complaints.clear()
        self.browser.requests.clear()
        self.browser.open(path)
        return path

    def tearDown(self):
        self.assertEqual(self.browser.complaints, [])
        asked = [url for url in self.browser.requests if not url.startswith(("file:///", "data:", "blob:"))]
        self.assertEqual(asked, [])

    def picture(self, name):
        """The part of the window with the scene. The test checks that the scene is not empty."""
        image = self.browser.screenshot(os.path.join(KEPT, name + ".png") if KEPT else None)
        box = self.browser.evaluate("(r => [r.left, r.top, r.right, r.bottom].map(Math.round))"
                                    "(document.getElementById('scene').getBoundingClientRect())")
        scene = image[max(box[1], 0): box[3], max(box[0], 0): box[2]]
        self.assertGreater(scene.size, 60000)
        colours = np.unique(scene.reshape(-1, 3), axis=0)
        self.assertGreater(len(colours), 500, "the scene is blank")
        self.assertGreater(np.mean((scene < 235).any(axis=2)), 0.02, "the scene is all but blank")
        return scene

    def stop_at(self, share):
        number = self.browser.evaluate(
            "(s => { s.value = Math.round(s.max * %g); s.dispatchEvent(new Event('input')); return +s.value; })"
            "(document.getElementById('slider'))" % share)
        self.browser.wait(f"document.body.dataset.stop === '{number}'")
        return number, self.browser.evaluate("document.getElementById('stop').textContent")

    def test_a_comparison(self):
        self.open(self.compared)
        stops = int(self.browser.evaluate("document.getElementById('slider').max")) + 1
        self.assertGreaterEqual(stops, 4)
        at_end = self.picture("comparison")
        paths = self.browser.evaluate(SHOWN % "estimated trajectory (submaps)")
        outlines = self.browser.evaluate(SHOWN % "submaps")
        number, label = self.stop_at(0.0)
        self.assertEqual(number, 0)
        self.assertIn(" 1 submap ", label)
        self.assertLess(self.browser.evaluate(SHOWN % "estimated trajectory (submaps)"), paths / 2)
        early = self.browser.evaluate(SHOWN % "submaps")
        self.assertTrue(0 < early < outlines, (early, outlines))
        at_start = self.picture("comparison_start")
        self.assertGreater(np.mean((at_start != at_end).any(axis=2)), 0.005)
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('figure img').length"), 9)
        self.assertTrue(self.browser.evaluate("[...document.querySelectorAll('figure img')].every(i => i.naturalWidth > 300)"))
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('.plot:not(.scene) .xtick').length > 20"), True)

    def test_one_map_step_by_step_and_narrow(self):
        self.open(self.single)
        self.picture("single")
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('section:not(.trust) .plot:not(.scene)').length"), 9)
        self.assertEqual(self.browser.evaluate(EMPTY), [])
        self.stop_at(0.15)
        early = self.browser.evaluate(SHOWN % "landmarks")
        self.stop_at(1.0)
        self.assertLess(early, self.browser.evaluate(SHOWN % "landmarks"))

        self.browser.evaluate("document.getElementById('play').click()")  # at the end, play begins at the start again
        self.browser.wait("+document.getElementById('slider').value >= 2")
        self.browser.evaluate("document.getElementById('play').click()")
        time.sleep(0.3)
        paused = self.browser.evaluate("document.getElementById('slider').value")
        time.sleep(0.5)
        self.assertEqual(self.browser.evaluate("document.getElementById('slider').value"), paused)

        metrics = dict(height=760, deviceScaleFactor=1, mobile=False)  # a telephone
        self.browser.call("Emulation.setDeviceMetricsOverride", width=400, **metrics)
        try:
            self.browser.evaluate("new Promise(done => setTimeout(done, 500))")
            self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), 400)
        finally:
            self.browser.call("Emulation.setDeviceMetricsOverride", width=1000, **metrics)

    def test_teams(self):
        for name, options, curves, mark in (("boats", [], 14, "radar 2"), ("modes", ["--compare", "--runs", "2"], 26, "true")):
            folder = os.path.join(self.room.name, name)
            subprocess.run([os.environ["CAIRN_PROGRAM"], "simulate", "usv", "--duration", "200", "--output", folder, "--quiet",
                            *options], check=True, stdout=subprocess.DEVNULL)
            self.open(folder)
            image = self.browser.screenshot(os.path.join(KEPT, name + ".png") if KEPT else None)
            self.assertGreater(len(np.unique(image.reshape(-1, 3), axis=0)), 100)
            self.assertEqual(self.browser.evaluate("document.querySelectorAll('.plot').length"), curves)
            self.assertEqual(self.browser.evaluate("document.querySelectorAll('.plot .main-svg').length > 0"), True)
            self.assertIn(mark, self.browser.evaluate("document.getElementById('curve0').data.map(t => t.name)"))
            drawn = self.browser.evaluate("document.querySelectorAll('#curve0 .trace, #curve0 .bars .point').length")
            self.assertGreater(drawn, 3)
            self.assertEqual(self.browser.evaluate(EMPTY), [])

    def test_what_a_run_says_of_itself(self):
        folder = os.path.join(self.room.name, "trust")
        os.mkdir(folder)
        trust_data.write_all(folder)
        self.open(folder)
        self.browser.screenshot(os.path.join(KEPT, "trust.png") if KEPT else None, whole_page=True)
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('section.trust .plot').length"), 10)
        self.assertEqual(self.browser.evaluate(EMPTY), [])
        # 20 s were lost, the first 80 s good, and the row of the lost ones is the upper one.
        bar = "document.querySelectorAll('#curve0 .scatterlayer .trace')[%d].querySelector('path.js-line').getBBox()"
        widths = [self.browser.evaluate((bar + ".width") % at) for at in range(3)]
        self.assertAlmostEqual(widths[0] / widths[2], 20 / 80, delta=0.01)
        heights = [self.browser.evaluate((bar + ".y") % at) for at in range(3)]
        self.assertEqual(heights, sorted(heights))

    def test_the_papers_figures(self):
        for kind, begin in (("png", b"\x89PNG\r\n"), ("svg", b"<?xml")):
            folder = os.path.join(self.room.name, kind)
            done = report(self.compared, "--figures", folder, "--format", kind)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            names = [f"figure_{number:02d}.{kind}" for number in range(5, 14)]
            self.assertEqual(sorted(os.listdir(folder)), names)
            self.assertEqual(done.stdout.split("\n")[:-1], [os.path.join(folder, name) for name in names])
            for name in names:
                with open(os.path.join(folder, name), "rb") as file:
                    content = file.read()
                self.assertTrue(content.startswith(begin), name)
                if kind == "png":
                    image = chromium.pixels(content)
                    inked = np.mean((image < 200).any(axis=2))
                    self.assertTrue(0.005 < inked < 0.7, (name, inked))


if __name__ == "__main__":
    unittest.main()
