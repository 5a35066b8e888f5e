# SPDX-License-Identifier: BSD-3-Clause
"""Shared by the tests of the Python package. Exits with 77, which ctest reports as skipped, if the interpreter lacks a
module that the package needs."""
import importlib
import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
SKIPPED = 77


def need(*modules):
    for name in modules:
        try:
            importlib.import_module(name)
        except ImportError as error:
            print(f"skipped: {sys.executable} has no {name} ({error})")
            sys.exit(SKIPPED)


def need_program(name, path):
    if not path:
        print(f"skipped: there is no {name}")
        sys.exit(SKIPPED)
    return path


need("numpy", "cffi")

import numpy as np  # noqa: E402

LANDMARKS = {7: (6.0, 2.0, 0.5), 8: (9.0, -3.0, 1.0), 9: (4.0, 5.0, -0.5), 12: (11.0, 1.0, 2.0)}
MAKE_LOG = os.path.join(ROOT, "tests", "bench", "make_log.py")


def seen(ids=LANDMARKS, noise=None):
    """Observations of these landmarks by a sensor at the origin of the map."""
    points = np.array([LANDMARKS[i] for i in ids])
    return points if noise is None else points + noise


def random(seed):
    return np.random.RandomState(seed)  # its numbers are the same in every version of numpy


def run_program(folder, landmarks=120, steps=120, seed=1, options=()):
    """Runs `cairn run` on a generated log. The results are in `folder`."""
    program = os.environ["CAIRN_PROGRAM"]
    made = subprocess.run([sys.executable, MAKE_LOG, str(landmarks), str(steps), str(seed)], stdout=subprocess.PIPE,
                          check=True)
    log = folder + ".log"
    with open(log, "wb") as file:
        file.write(made.stdout)
    subprocess.run([program, "run", log, "--output", folder, "--quiet", *options], stdout=subprocess.DEVNULL, check=True)
    return folder


def compiler():
    return shutil.which((os.environ.get("CC") or "cc").split()[0])
