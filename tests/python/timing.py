# SPDX-License-Identifier: BSD-3-Clause
"""What Python adds to an update: updates in C and in Python take turns on one filter, and their medians are compared.

timing.py LIBRARY [LANDMARKS] [FRAMES]: LIBRARY is update_timing.c as a shared library.
"""

import ctypes
import statistics
import sys
import time

import cairn
import numpy as np
from cairn import ffi, lib

BLOCK = 50


def frames(count):
    """A frame of `count` landmarks in the forms that Filter.update takes."""
    ids = np.arange(count)
    z = np.column_stack([3.0 + ids, 0.5 * ids - 2.0, 0.25 * (ids % 3)])
    return {"array of observations": (cairn.observations(ids, z),), "arrays of ids and z": (ids, z),
            "lists of ids and z": (ids.tolist(), z.tolist())}


def timed(compiled, arguments, frame, count):
    """Durations of `count` updates in C and in Python, ns. They take turns in blocks: each finds its caches warm, as in a
    program of its own."""
    clock, in_c, in_python = time.perf_counter_ns, [], []
    matches = np.zeros(len(frame), cairn.MATCH)
    with cairn.Filter(max_landmarks=len(frame)) as one:
        sensor = one.add_cartesian()
        update, handle = (int(ffi.cast("uintptr_t", pointer)) for pointer in (lib.cairn_filter_update, one._pointer))
        pointers = frame.ctypes.data, len(frame), matches.ctypes.data
        for _ in range(count // BLOCK):
            for _ in range(BLOCK):
                in_c.append(compiled.timed_update(update, handle, sensor, *pointers))
            for _ in range(BLOCK):
                start = clock()
                one.update(sensor, *arguments)
                in_python.append(clock() - start)
    if min(in_c) < 0:
        sys.exit("an update in C failed")
    return in_c, in_python


def main():
    library, landmarks, count = sys.argv[1], int((sys.argv[2:] or [8])[0]), int((sys.argv[3:] or [5000])[0])
    compiled = ctypes.CDLL(library)
    compiled.timed_update.restype = ctypes.c_double
    compiled.timed_update.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int32, ctypes.c_void_p, ctypes.c_size_t,
                                      ctypes.c_void_p]
    forms = frames(landmarks)
    frame = forms["array of observations"][0]
    for form, arguments in forms.items():
        in_c, in_python = timed(compiled, arguments, frame, count)
        c, python = (statistics.quantiles(times, n=10) for times in (in_c, in_python))
        print(f"{form}: {c[4] / 1e3:.2f} us in C, Python takes {(python[4] - c[4]) / 1e3:.2f} us more (medians; "
              f"the fastest tenths: {c[0] / 1e3:.2f} us, {(python[0] - c[0]) / 1e3:.2f} us more)")


if __name__ == "__main__":
    main()
