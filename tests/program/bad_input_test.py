# SPDX-License-Identifier: BSD-3-Clause
"""Every bad file and every bad option: exit 2, and one line that tells where and why."""
import os
import re
import unittest

from support import ProgramTest, call

GOOD = ["T 0 0.0 1 2 3 0 0 0", "Z 0 7 5.0 0.1 0.2", "T 1 0.2 1.5 2 3 0 0 0", "O 1 0.5 0 0 0 0 0", "Z 1 7 4.5 0.1 0.2",
        "L 7 5 2 4"]


class BadTextLogs(ProgramTest):
    def check(self, lines, number, *words):
        path = self.write("bad.log", "".join(line + "\n" for line in lines))
        self.assert_refused(call("run", path, "--summary", "json"), "%s:%d: " % (path, number), *words)

    def replaced(self, number, line):
        return GOOD[:number - 1] + [line] + GOOD[number:]

    def test_the_good_one(self):
        path = self.write("good.log", "".join(line + "\n" for line in GOOD))
        self.assertEqual(call("run", path).returncode, 0)

    def test_unknown_record(self):
        self.check(self.replaced(5, "Q 1 2 3"), 5, "'Q'", "T, O, Z or L")
        self.check(self.replaced(2, "TT 0 7 5.0 0.1 0.2"), 2, "'TT'")

    def test_field_counts(self):
        self.check(self.replaced(3, "T 1 0.2 1.5 2 3 0 0"), 3, "record T has 8 fields, expected 9")
        self.check(self.replaced(4, "O 1 0.5 0 0 0 0 0 0"), 4, "record O has 9 fields, expected 8")
        self.check(self.replaced(5, "Z 1 7 4.5 0.1"), 5, "record Z has 5 fields, expected 6")
        self.check(self.replaced(6, "L 7 5 2"), 6, "record L has 4 fields, expected 5")
        self.check(self.replaced(1, "T"), 1, "record T has 1 fields")

    def test_numbers(self):
        self.check(self.replaced(3, "T 1 0.2 nan 2 3 0 0 0"), 3, "x 'nan' is not a finite number")
        self.check(self.replaced(3, "T 1 inf 1 2 3 0 0 0"), 3, "time 'inf'")
        self.check(self.replaced(4, "O 1 0.5 0 0 NaN 0 0"), 4, "droll 'NaN'")
        self.check(self.replaced(5, "Z 1 7 4.5x 0.1 0.2"), 5, "range '4.5x'")
        self.check(self.replaced(5, "Z 1 7 0 0.1 0.2"), 5, "range 0 is not positive")
        self.check(self.replaced(5, "Z 1 7 4.5 1e999 0.2"), 5, "azimuth '1e999'")
        self.check(self.replaced(6, "L 7 5 2 +-4"), 6, "z '+-4'")
        self.check(self.replaced(5, "Z 1 -7 4.5 0.1 0.2"), 5, "id '-7' is not a whole number")
        self.check(self.replaced(5, "Z 1 99999999999999999999 4.5 0.1 0.2"), 5, "id '99999999999999999999'")
        self.check(self.replaced(5, "Z 1 18446744073709551615 4.5 0.1 0.2"), 5, "reserved")
        self.check(self.replaced(5, "Z 1.0 7 4.5 0.1 0.2"), 5, "step '1.0'")

    def test_order(self):
        self.check(GOOD[1:], 2, "true pose of step 1, but step 0, the first one, has none")
        self.check(["Z 0 7 5 0 0", GOOD[3], GOOD[2]], 3, "true pose of step 1, but step 0")
        self.check(["O 0 0 0 0 0 0 0"], 1, "first step")
        self.check(self.replaced(3, "T 1 0.0 1.5 2 3 0 0 0"), 3, "time 0.0 does not increase")
        self.check(self.replaced(3, "T 1 -5 1.5 2 3 0 0 0"), 3, "does not increase")
        self.check(self.replaced(5, "Z 0 7 4.5 0.1 0.2"), 5, "step 0 comes after step 1")
        self.check(self.replaced(3, "T 2 0.2 1.5 2 3 0 0 0"), 3, "step 2 follows step 0")
        self.check(GOOD[:3] + GOOD[4:], 5, "step 1 ends here without an increment")
        self.check(["T 0 0 1 2 3 0 0 0", "O 0 0 0 0 0 0 0"], 2, "first step")

    def test_doubles(self):
        self.check(self.replaced(2, GOOD[0]), 2, "second true pose of step 0")
        self.check(GOOD + [GOOD[3]], 7, "second increment of step 1")
        self.check(GOOD + [GOOD[4]], 7, "landmark 7 twice in step 1")
        self.check(GOOD + [GOOD[5]], 7, "landmark 7 a second time")

    def test_truncated_anywhere(self):
        whole = "".join(line + "\n" for line in GOOD[:5])
        for size in range(1, len(whole) - 1):
            if whole[size - 1] == "\n" and not whole[:size].endswith(GOOD[2] + "\n"):
                continue  # whole records, whole steps: nothing tells that more should come
            path = self.write("bad.log", whole[:size])
            done = call("run", path)
            last, cut = whole[:size].splitlines()[-1], GOOD[whole[:size].count("\n")]
            if len(last.split()) < len(cut.split()) or last.startswith("T 1"):
                self.assert_refused(done, path + ":")
            else:  # a last line without an end is whole if it has all its fields, and the user is told
                self.assertEqual(done.returncode, 0, (last, done.stderr))
                self.assertIn("note: %s: the last line has no end" % path, done.stderr)

    def test_noise(self):
        self.check(self.replaced(2, "N 1 1 1 1 1 1 1 1"), 2, "record N has 9 fields, expected 10")
        self.check(self.replaced(2, "N 1 1 1 1 1 -1 1 1 1"), 2, "noise of an increment is negative")
        self.check(self.replaced(2, "N 1 1 1 1 1 1 1 1 0"), 2, "noise of an observation is not positive")
        self.check(self.replaced(2, "N 1 1 1 1 1 1 1 1 1e160"), 2, "too large")

    def test_numbers_too_small_for_a_double(self):
        self.check(self.replaced(5, "Z 1 7 1e-400 0.1 0.2"), 5, "range 1e-400 is not positive")
        self.check(self.replaced(5, "Z 1 7 4.5 1e-400x 0.2"), 5, "azimuth '1e-400x'")
        self.check(self.replaced(5, "Z 1 7 -1e400 0.1 0.2"), 5, "range '-1e400' is not a finite number")

    def test_text_of_two_bytes_a_letter(self):
        for encoding in ("utf-16", "utf-16-be", "utf-16-le"):
            mark = b"" if encoding == "utf-16" else b"\xfe\xff" if encoding == "utf-16-be" else b"\xff\xfe"
            path = self.write("bad.log", mark + "\n".join(GOOD).encode(encoding))
            self.assert_refused(call("run", path), path + ":1: ", "UTF-16", "UTF-8")

    def test_foreign_files(self):
        self.check(["# a comment alone"], 1, "no steps")
        self.check(["step,x,y", "1,2,3"], 1, "unknown record 'step,x,y'")
        for content in (b"\x7fELF\x02\x01\x01\x00\x00\xff\xfe\n\x00", b"\x00" * 4096, b"\n" * 10, b"PK\x03\x04zip"):
            path = self.write("bad.log", content)
            self.assert_refused(call("run", path), path + ":")
        self.assert_refused(call("run", self.write("empty", b"")), "empty:1: the file is empty")
        self.assert_refused(call("run", self.path("absent")), "absent: No such file or directory")
        self.assert_refused(call("run", self.folder), self.folder + ": a folder", "no Barcodes.dat")
        self.write("Barcodes.dat", b"1 5\n")
        self.assert_refused(call("run", self.folder), self.folder + ": no robot's files")


class BadStarsLogs(ProgramTest):
    def check(self, spoils, *words):
        path = self.stars_log("bad.mat", *spoils)
        self.assert_refused(call("run", path, "--summary", "json", "--quiet"), path + ": ", *words)

    def test_missing_variables(self):
        for name in ("t", "y_k_j", "w_vk_vk_i", "v_vk_vk_i", "theta_vk_i", "r_i_vk_i", "fu", "fv", "cu", "cv", "b",
                     "C_c_v", "rho_v_c_v"):
            self.check(["--drop", name], "variable %s: missing" % name)

    def test_values(self):
        self.check(["--set", "t", "5", "nan"], "variable t: column 6: not finite")
        self.check(["--set", "t", "5", "100.1"], "variable t: column 6: time does not increase")
        self.check(["--set", "v_vk_vk_i", "9", "nan"], "variable v_vk_vk_i: column 4: not finite")
        self.check(["--set", "w_vk_vk_i", "0", "inf"], "variable w_vk_vk_i: column 1: not finite")
        self.check(["--set", "r_i_vk_i", "0", "nan"], "variable r_i_vk_i: column 1: the first true pose")
        self.check(["--set", "y_k_j", "0", "inf"], "variable y_k_j: column 1: not finite")
        self.check(["--set", "fu", "0", "0"], "variable fu: not positive")
        self.check(["--set", "cv", "0", "nan"], "variable cv: not finite")
        self.check(["--set", "C_c_v", "0", "1"], "variable C_c_v: not a rotation matrix")
        self.check(["--set", "y_var", "2", "0"], "variable y_var: not 4 positive variances")

    def test_sizes(self):
        self.check(["--cut", "theta_vk_i", "79"], "variable theta_vk_i: has 79 columns, expected 80")
        self.check(["--cut", "t", "79"], "variable y_k_j: is not 4 x 79 x M")
        self.check(["--cut", "rho_i_pj_i", "3"], "variable rho_i_pj_i: has 3 landmarks, y_k_j has 24")
        self.check(["--cut", "v_var", "0"], "variable v_var: not 3 positive variances")
        self.check(["--cut", "t", "0"], "variable t: empty")

    def test_truncated_anywhere(self):
        for spoils in ([], ["--compress"]):
            with open(self.stars_log("whole.mat", *spoils), "rb") as file:
                whole = file.read()
            sizes = list(range(8, 700, 37)) + list(range(700, len(whole), len(whole) // 40)) + [len(whole) - 1]
            for size in sizes:
                path = self.write("bad.mat", whole[:size])
                self.assert_refused(call("run", path), path + ": ")

    def test_garbled_anywhere(self):
        with open(self.stars_log("whole.mat", "--compress"), "rb") as file:
            whole = bytearray(file.read())
        for place in range(124, len(whole), len(whole) // 60):
            garbled = bytearray(whole)
            garbled[place] ^= 0x55
            done = call("run", self.write("bad.mat", bytes(garbled)), "--quiet")
            self.assertIn(done.returncode, (0, 1, 2), done.stderr)  # never a crash; noise may be a log, too
            self.assertEqual(done.stderr.count("\n"), 0 if done.returncode == 0 else 1, done.stderr)

    def test_other_matlab_files(self):
        header = b"MATLAB 7.3 MAT-file".ljust(116) + bytes(8) + b"\x00\x02IM"
        self.assert_refused(call("run", self.write("a.mat", header.ljust(512, b"\0"))), "a.mat: not MATLAB version 5")


class BadOptions(ProgramTest):
    def test_commands(self):
        self.assert_refused(call(), "no command")
        self.assert_refused(call("orbit", "mars"), "unknown command 'orbit'")
        self.assert_refused(call("--frobnicate"), "unknown option '--frobnicate'")

    def test_options(self):
        log = self.write("good.log", "".join(line + "\n" for line in GOOD))
        for arguments, word in [
                ([], "no log"), ([log, log], "second"), ([log, "--frobnicate"], "unknown option '--frobnicate'"),
                ([log, "--frobnicate=3"], "'--frobnicate'"), ([log, "--quiet=yes"], "takes no value"),
                ([log, "--output"], "needs a value"), ([log, "--output="], "--output"),
                ([log, "--summary", "xml"], "'xml' is not json"), ([log, "--error=left"], "invariant or standard"),
                ([log, "--seed", "-1"], "--seed"), ([log, "--forget-after", "2.5"], "--forget-after"),
                ([log, "--gate", "0"], "--gate"), ([log, "--gate", "1.5"], "probability"),
                ([log, "--batch-gate", "nan"], "--batch-gate"), ([log, "--iterations", "0"], "from 1 to 50"),
                ([log, "--iterations=51"], "from 1 to 50"), ([log, "--max-landmarks", "10000001"], "--max-landmarks"),
                ([log, "--submap-landmarks", "4097"], "from 0 to 4096"), ([log, "--submap-distance=-1"], "0 or more"),
                ([log, "--join", "loose"], "auto, dense or sparse"),
                ([log, "--association", "guess"], "known, nearest or joint"), ([log, "--compare"], "unknown option '--compare'"),
                ([log, "--error-persistence", "0.5"], "1 or more"), ([log, "--error-persistence", "x"], "--error-persistence"),
                ([log, "--min-disparity", "-3"], "above 0"), ([log, "--min-disparity-sigmas=-1"], "0 or more"), ([log, "--pixel-noise", "x"], "--pixel-noise"),
                ([log, "--velocity-noise="], "--velocity-noise"), ([log, "--rate-noise", "inf"], "--rate-noise")]:
            self.assert_refused(call("run", *arguments), word)

    def test_options_that_the_log_cannot_honour(self):
        log = self.write("good.log", "".join(line + "\n" for line in GOOD))
        isam = self.write("isam.txt", "LANDMARK 0 7 4 1 20 6 25\n")
        stars = self.stars_log("a.mat")
        for option in ("--pixel-noise", "--velocity-noise", "--rate-noise", "--min-disparity", "--min-disparity-sigmas"):
            for path in (log, isam):
                self.assert_refused(call("run", path, option, "1"), "option %s is for STARS files" % option, path,
                                    "text log", "leave the option out")
            self.summary(stars, option, "1")

    def test_options_that_contradict_each_other(self):
        log = self.write("good.log", "".join(line + "\n" for line in GOOD))
        for option in ("--submap-distance=5", "--submap-extent=5", "--submap-sigma=5", "--join=dense", "--join=sparse"):
            words = ("contradict", option.split("=")[0], "--single-map")
            self.assert_refused(call("run", log, "--single-map", option), *words)
            self.assert_refused(call("run", log, option, "--submap-landmarks=0"), *words)
            self.assert_refused(call("simulate", "mars", "--single-map", option), *words)
        self.summary(log, "--single-map", "--submap-distance=0", "--submap-extent=0", "--submap-sigma=0", "--join=auto")

    def test_places_that_cannot_be_written(self):
        log = self.write("good.log", "".join(line + "\n" for line in GOOD))
        self.assert_refused(call("run", log, "--output", log), log)
        self.assert_refused(call("run", log, "--output", self.path("absent/deep")), "absent/deep")

    def test_double_dash_ends_the_options(self):
        log = self.write("-odd", "".join(line + "\n" for line in GOOD))
        self.assertEqual(call("run", "--quiet", "--", log).returncode, 0)
        self.assert_refused(call("run", "--", "--quiet"), "--quiet: No such file")

    def test_help_version_and_manual_agree(self):
        version = call("--version")
        self.assertEqual(version.returncode, 0)
        self.assertRegex(version.stdout, r"^cairn \d+\.\d+\.\d+ \(.+\)\n$")
        texts = [call("--help"), call("run", "--help"), call("run", "-h"), call("simulate", "--help")]
        self.assertEqual({(t.returncode, t.stdout, t.stderr) for t in texts}, {(0, texts[0].stdout, "")})
        with open(os.path.join(os.path.dirname(__file__), "../../docs/cairn.1")) as file:
            manual = file.read().replace("\\-", "-")
        for word in re.findall(r"--[a-z-]+", texts[0].stdout):
            self.assertRegex(manual, word + r"\b")


if __name__ == "__main__":
    unittest.main()
