# SPDX-License-Identifier: BSD-3-Clause
"""Adds to the build what pyproject.toml can't say: the declarations, made from the C headers."""
import os
import sys

from setuptools import setup
from setuptools.command.build_py import build_py

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from cairn import _declarations  # noqa: E402


class BuildWithDeclarations(build_py):
    def run(self):
        super().run()
        if getattr(self, "editable_mode", False):
            return  # an editable install reads the headers whenever it is loaded
        _declarations.write_module(os.path.join(self.build_lib, "cairn", "_abi.py"))


setup(cmdclass={"build_py": BuildWithDeclarations})
