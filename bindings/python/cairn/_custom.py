# SPDX-License-Identifier: BSD-3-Clause
"""The caller's functions that the library calls: custom sensors and the log."""
import numpy as np

from . import _structs
from ._library import ffi
from .pose import Pose


def _values(pointer, count):
    return np.frombuffer(ffi.buffer(pointer, 8 * count), np.float64)


class Callbacks:
    """Keeps the callbacks of one filter alive. Keeps an exception of a callback until the C call is over, because an
    exception must not pass through C."""

    def __init__(self):
        self._kept = []
        self._log = ffi.NULL
        self._pending = None

    def raise_pending(self):
        error, self._pending = self._pending, None
        if error is not None:
            raise error

    def _guarded(self, answer):
        """Returns 0 if `answer` wrote its outputs, 1 if it had none, -1 if it raised an exception: that aborts the C
        call, and the filter stays as before."""
        if self._pending is not None:
            return -1
        try:
            return 0 if answer() else 1
        except BaseException as error:  # KeyboardInterrupt too
            self._pending = error
            return -1

    @staticmethod
    def _write(result, outputs):
        """Copies (value, array, ...) to the C arrays [(name, pointer, shape), ...]. Returns False if the result is
        None."""
        if result is None:
            return False
        if len(result) != len(outputs):
            raise ValueError(f"a callback must return {len(outputs)} values, and returned {len(result)}")
        for value, (name, pointer, shape) in zip(result, outputs):
            _values(pointer, int(np.prod(shape)))[:] = _structs.array(name, value, shape).ravel()
        return True

    def custom(self, struct, predict, place):
        """Sets the callbacks of a cairn_custom."""
        rows = int(struct.rows)

        def predicted(_, pose, landmark, z, jacobian_pose, jacobian_landmark):
            return self._guarded(lambda: self._write(predict(Pose.of(pose), _values(landmark, 3).copy()), [
                ("z", z, (rows,)), ("jacobian_pose", jacobian_pose, (rows, 6)),
                ("jacobian_landmark", jacobian_landmark, (rows, 3))]))

        def placed(_, pose, z, landmark, jacobian_pose, jacobian_z):
            return self._guarded(lambda: self._write(place(Pose.of(pose), _values(z, rows).copy()), [
                ("landmark", landmark, (3,)), ("jacobian_pose", jacobian_pose, (3, 6)),
                ("jacobian_z", jacobian_z, (3, rows))]))

        self._keep(struct, "predict", predicted)
        if place is not None:
            self._keep(struct, "place", placed)

    def _keep(self, struct, name, function):
        callback = ffi.callback(f"cairn_custom_{name}", function, error=-1)
        setattr(struct, name, callback)
        self._kept.append(callback)  # a field of a C struct does not keep it alive

    def log(self, function):
        """The C callback of a log function. Earlier callbacks are kept, because they may be in use."""
        if function is None:
            return ffi.NULL

        def logged(_, line):
            text = ffi.string(line).decode(errors="replace")
            self._guarded(lambda: function(text) or True)

        callback = ffi.callback("cairn_log", logged)
        self._kept.append(callback)
        return callback
