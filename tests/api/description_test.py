# SPDX-License-Identifier: BSD-3-Clause
"""api.json is what the headers say, on every machine; and what a header leaves out is an error with its place."""
import contextlib
import io
import json
import os
import re
import shutil
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SOURCE = os.path.join(ROOT, "src", "api")
sys.path.insert(0, SOURCE)
import describe  # noqa: E402

TARGETS = ("x86_64-linux-gnu", "aarch64-linux-gnu", "arm-linux-gnueabihf", "x86_64-w64-mingw32")


class DescriptionTest(unittest.TestCase):
    def test_the_description_is_what_the_headers_say(self):
        with contextlib.redirect_stderr(io.StringIO()) as errors:
            status = describe.main(["--check", os.path.join(SOURCE, "api.json")])
        self.assertEqual((status, errors.getvalue()), (0, ""))

    def test_an_outdated_description_is_found(self):
        with open(os.path.join(SOURCE, "api.json"), encoding="utf-8") as file:
            text = file.read()
        with tempfile.NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as file:
            file.write(text.replace('"name": "CAIRN_JOIN_DENSE", "value": 1', '"name": "CAIRN_JOIN_DENSE", "value": 3'))
            file.flush()
            with contextlib.redirect_stderr(io.StringIO()) as errors:
                self.assertEqual(describe.main(["--check", file.name]), 1)
        self.assertIn("CAIRN_JOIN_DENSE", errors.getvalue())

    def test_layouts_are_the_same_on_all_machines(self):
        here = list(describe.layout(describe.Api().out))
        self.assertGreater(len(here), 300)
        for target in TARGETS:
            with self.subTest(target):
                self.assertEqual(list(describe.layout(describe.Api([f"--target={target}"]).out)), here)

    def test_it_is_compact_json(self):
        value = describe.Api().out
        self.assertEqual(json.loads(describe.to_json(value)), value)


# What a header may leave out or say wrongly: (what it is, header, right, wrong, message).
CASES = (
    ("an output without direction", "filter.h", "CAIRN_OUT size_t *bytes", "size_t *bytes", "bytes needs CAIRN_IN"),
    ("an input without direction", "pose.h", "CAIRN_IN const cairn_pose *T_a_b", "const cairn_pose *T_a_b",
     "T_a_b needs CAIRN_IN"),
    ("an array without direction", "pose.h", "CAIRN_OUT CAIRN_UNIT(1) double quaternion[4]",
     "CAIRN_UNIT(1) double quaternion[4]", "quaternion needs CAIRN_OUT"),
    ("an output that is const", "pose.h", "CAIRN_IN const cairn_pose *truth", "CAIRN_OUT const cairn_pose *truth",
     "truth is const and out"),
    ("an input that is not const", "map.h", "CAIRN_IN_ARRAY(count) const uint64_t *ids",
     "CAIRN_IN_ARRAY(count) uint64_t *ids", "ids is an input that is not const"),
    ("a capacity of nothing", "map.h", "CAIRN_OUT_ARRAY(capacity) cairn_landmark *landmarks",
     "CAIRN_OUT cairn_landmark *landmarks", "`capacity` is the length of nothing"),
    ("a length that names no parameter", "filter.h", "CAIRN_IN_ARRAY(rows * rows)", "CAIRN_IN_ARRAY(lines * lines)",
     "the length of covariance names lines"),
    ("a length that names no field", "sensor.h", "CAIRN_OUT_ARRAY(6 * cairn_custom.rows)",
     "CAIRN_OUT_ARRAY(6 * cairn_custom.lines)", "the length of jacobian_pose names cairn_custom.lines"),
    ("a parameter without unit", "filter.h", "CAIRN_UNIT(rad) double pan", "double pan",
     "pan: a double needs one unit"),
    ("a field without unit", "motion.h", "B, distance between left and right wheels, m,",
     "B, distance between left and right wheels,", "cairn_wheels.track: a double needs one unit"),
    ("a unit that contradicts the comment", "motion.h", "  double rate_sigma;",
     "  CAIRN_UNIT(rad)\n  double rate_sigma;",
     "the mark says 'rad', the comment says ['rad/s']"),
    ("a unit that does not exist", "filter.h", "CAIRN_UNIT(rad) double stick", "CAIRN_UNIT(furlongs) double stick",
     "stick: the unit 'furlongs' is unknown"),
    ("a range that is not understood", "filter.h", "CAIRN_RANGE(> 0) double width", "CAIRN_RANGE(big) double width",
     "CAIRN_RANGE(big)"),
    ("an option without default", "motion.h", "; default 0.3", "", "cairn_wheels.radius is an option and does not say"),
    ("a parameter without meaning", "filter.h", "cairn_loss loss,", "int32_t loss,",
     "loss: an int32_t that is no enum"),
    ("a field without meaning", "map.h", "  cairn_bool has_transform;", "  int32_t has_transform;",
     "has_transform: an int32_t that is no enum"),
    ("padding at the end", "map.h",
     "  cairn_bool common; /**< 1: the map held this landmark before; 0: it was added */\n"
     "  uint32_t reserved; /**< 0 */\n", "  cairn_bool common; /**< 1: known */\n",
     "cairn_merged_id: 4 bytes of padding at its end"),
    ("padding inside", "motion.h", "  uint32_t reserved;        /**< 0 */\n", "",
     "cairn_twist_noise.velocity_sigma: 4 bytes of padding before it"),
    ("a pointer in a struct", "motion.h", "  double lateral_sigma;", "  double *lateral_sigma;",
     "cairn_wheels.lateral_sigma: a public struct holds no pointer"),
    ("a size_t in a struct", "map.h", "  uint64_t added;", "  size_t added;",
     "cairn_merge_report.added: a public struct holds no pointer and no size_t"),
    ("a struct that is neither versioned nor frozen", "map.h", "/** A landmark. Layout frozen. */",
     "/** A landmark. */", "cairn_landmark must either begin"),
    ("constants without type", "map.h", "enum CAIRN_VALUES(cairn_merge_by) {", "enum {", "an enum needs CAIRN_VALUES"),
    ("a result without owner", "status.h", "CAIRN_BORROWED(thread) const char", "const char",
     "cairn_last_message returns a pointer"),
    ("an owner that does not exist", "filter.h", "CAIRN_BORROWED(filter) const cairn_map *cairn_filter_map",
     "CAIRN_BORROWED(nobody) const cairn_map *cairn_filter_map", "its result belongs to nobody"),
    ("no thread rule", "pose.h", "Threads: any. Errors: CAIRN_ERROR_ARGUMENT (NULL). \\since",
     "Errors: CAIRN_ERROR_ARGUMENT (NULL). \\since", 'cairn_pose_identity does not say "Threads'),
    ("a thread rule in other words", "map.h", "Threads: as any const query of the handle. Errors: CAIRN_ERROR_ARGUMENT "
     "(NULL).", "Threads: as you like. Errors: CAIRN_ERROR_ARGUMENT (NULL).", "'as you like'"),
    ("a thread rule that the parameters contradict", "filter.h", "cairn_filter_pose_nees(const cairn_filter",
     "cairn_filter_pose_nees(cairn_filter", "ask for the thread rule 'one', not 'query'"),
    ("errors that are no statuses", "motion.h", "Errors: CAIRN_ERROR_ARGUMENT.", "Errors: some.",
     'cairn_wheels_init: "Errors: ..." must list'),
    ("a status that does not exist", "sensor.h", "Errors: CAIRN_ERROR_ARGUMENT.", "Errors: CAIRN_ERROR_WEATHER.",
     "there is no status CAIRN_ERROR_WEATHER"),
    ("no version", "health.h", "Complexity: O(1). \\since 0.2.0 */", "Complexity: O(1). */",
     'cairn_filter_health does not say "\\since"'),
    ("a call without error", "sensor.h", "cairn_cartesian *cartesian, size_t struct_size,\n"
     "                                            cairn_error *error", "cairn_cartesian *cartesian, size_t struct_size",
     "cairn_cartesian_init: its last parameter must be cairn_error"),
    ("a duration that does not say so", "filter.h", "/**< duration of the closing, s; it differs from run to run */",
     "/**< duration of the closing, s */", "cairn_closing_report.seconds: durations, and only they"),
    ("no comment", "map.h", "/** Landmarks in one frame", "/* Landmarks in one frame", "cairn_map has no comment"),
)


class IncompleteTest(unittest.TestCase):
    """The tool says what a copy of the headers lacks, and where."""

    def setUp(self):
        self.root = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.root)
        for library in describe.LIBRARIES:
            os.makedirs(os.path.join(self.root, os.path.dirname(library["symbols"])), exist_ok=True)
            shutil.copy(os.path.join(ROOT, library["symbols"]), os.path.join(self.root, library["symbols"]))
        shutil.copytree(os.path.join(ROOT, "include"), os.path.join(self.root, "include"))

    def problems(self):
        return describe.Api(root=self.root).problems.lines

    def change(self, path, old, new):
        path = os.path.join(self.root, path)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        self.assertTrue(old in text, f"{path} does not contain {old!r} any more")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace(old, new, 1))

    def test_each_case_is_found(self):
        self.assertEqual(self.problems(), [])
        for _, header, right, wrong, _ in CASES:
            self.change(f"include/cairn/{header}", right, wrong)
        found = self.problems()
        for what, header, _, _, message in CASES:
            with self.subTest(what):
                self.assertTrue(any(re.match(rf"include/cairn/{header}:\d+: .*{re.escape(message)}", line)
                                    for line in found), "\n".join(found))

    def test_a_function_that_is_not_exported(self):
        self.change("src/cairn/capi/symbols.txt", "cairn_map_size@@", "cairn_map_sizes@@")
        found = self.problems()
        self.assertEqual(len(found), 2, found)
        self.assertRegex(found[0], r"^include/cairn/map\.h:\d+: cairn_map_size is not in")
        self.assertIn("no header declares cairn_map_sizes", found[1])

    def test_a_header_of_no_library(self):
        with open(os.path.join(self.root, "include/cairn/stray.h"), "w", encoding="utf-8"):
            pass
        self.assertEqual(self.problems(), ["api: include/cairn/stray.h belongs to no library"])

    def test_a_header_that_does_not_compile(self):
        self.change("include/cairn/map.h", "uint64_t id;", "uint64 id;")
        with self.assertRaisesRegex(describe.DescriptionError, "map.h"):
            self.problems()


if __name__ == "__main__":
    unittest.main()
