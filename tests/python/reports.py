# SPDX-License-Identifier: BSD-3-Clause
"""Shared by the tests of reports: a call of the program, a test on a copy of a run's folder, and the data of a page."""
import contextlib
import io
import json
import os
import re
import shutil
import tempfile
import unittest
from unittest import mock

from cairn.report import __main__ as program
from cairn.report import page


def call(*arguments):
    """Status, output and error output of `python -m cairn.report`."""
    out, told = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(told), \
            mock.patch.object(page, "plotly_source", lambda: "/* plotly */"):
        return program.main(list(arguments)), out.getvalue(), told.getvalue()


def read_page(path):
    """Text of a page, and the data in it."""
    with open(path) as file:
        text = file.read()
    return text, json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S).group(1))


class FolderTest(unittest.TestCase):
    """Each test works on a fresh copy of the folder that make_run(folder) filled."""

    @classmethod
    def setUpClass(cls):
        cls.room = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.room.cleanup)
        cls.source = os.path.join(cls.room.name, "drive")
        cls.make_run(cls.source)

    def setUp(self):
        self.folder = os.path.join(self.room.name, "copy")
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(self.source, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
