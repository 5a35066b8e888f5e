# SPDX-License-Identifier: BSD-3-Clause
"""The caller's functions that the library calls: custom sensors and the log.

The library gets three C functions, which are the same for all filters, and a pointer to the Python object that they
serve. The object lives until the library releases this pointer.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _structs
from ._handle import Guard
from ._library import ffi
from .pose import Pose

Array = NDArray[np.float64]
Predict = Callable[[Pose, Array], "Sequence[ArrayLike] | None"]
Place = Predict

ANSWER, NONE, ABORT = 1, 0, -1

_served: dict[Any, Any] = {}  # objects that the library holds a pointer to, by this pointer


def _serve(served: Any) -> Any:
    """The pointer to an object, which lives until it is released."""
    pointer = ffi.new_handle(served)
    _served[pointer] = served
    return pointer


@ffi.callback("cairn_release_fn")  # type: ignore[untyped-decorator]
def release(pointer: Any) -> None:
    """The library does not use the pointer any more."""
    _served.pop(pointer, None)


def _values(pointer: Any, count: int) -> Array:
    return np.frombuffer(ffi.buffer(pointer, 8 * count), np.float64)


class Sensor:
    """The model of a custom sensor: two functions, and what they raised."""

    def __init__(self, rows: int, predict: Predict, place: Place | None, guard: Guard) -> None:
        self.rows, self.predict, self.place, self.guard = rows, predict, place, guard

    def answer(self, function: Predict | None, pose: Any, values: Any, count: int,
               outputs: list[tuple[str, Any, tuple[int, ...]]]) -> int:
        """Calls a function and copies its result to the C arrays [(name, pointer, shape), ...]. An exception must not
        pass through C: it aborts the C call, which leaves the filter as before, and is raised after the call."""
        try:
            if function is None:
                return NONE
            result = function(Pose.of(pose), _values(values, count).copy())
            if result is None:
                return NONE
            if len(result) != len(outputs):
                raise ValueError(f"a callback must return {len(outputs)} values, and returned {len(result)}")
            for value, (name, pointer, shape) in zip(result, outputs):
                _values(pointer, int(np.prod(shape)))[:] = _structs.array(name, value, shape).ravel()
            return ANSWER
        except BaseException as error:  # KeyboardInterrupt too
            self.guard.raised = error
            return ABORT

    def served(self) -> Any:
        """The pointer that the library passes to PREDICT and PLACE; `release` frees it."""
        return _serve(self)


@ffi.callback("cairn_custom_predict_fn", error=ABORT)  # type: ignore[untyped-decorator]
def PREDICT(user: Any, pose: Any, landmark: Any, z: Any, jacobian_pose: Any, jacobian_landmark: Any) -> int:
    sensor: Sensor = ffi.from_handle(user)
    return sensor.answer(sensor.predict, pose, landmark, 3, [
        ("z", z, (sensor.rows,)), ("jacobian_pose", jacobian_pose, (sensor.rows, 6)),
        ("jacobian_landmark", jacobian_landmark, (sensor.rows, 3))])


@ffi.callback("cairn_custom_place_fn", error=ABORT)  # type: ignore[untyped-decorator]
def PLACE(user: Any, pose: Any, z: Any, landmark: Any, jacobian_pose: Any, jacobian_z: Any) -> int:
    sensor: Sensor = ffi.from_handle(user)
    return sensor.answer(sensor.place, pose, z, sensor.rows, [
        ("landmark", landmark, (3,)), ("jacobian_pose", jacobian_pose, (3, 6)),
        ("jacobian_z", jacobian_z, (3, sensor.rows))])


class Log:
    """The receiver of a filter's log lines. The library does not ask it for an answer, so an exception can't abort the
    call: it goes to sys.unraisablehook, which prints it."""

    def __init__(self, function: Callable[[str], object]) -> None:
        self.function = function

    def receive(self, line: str) -> None:
        try:
            self.function(line)
        except BaseException as error:
            sys.unraisablehook(_Unraisable(error, self.function))

    def served(self) -> Any:
        """The pointer that the library passes to LOG; `release` frees it."""
        return _serve(self)


class _Unraisable:
    """What sys.unraisablehook reads."""

    def __init__(self, error: BaseException, where: object) -> None:
        self.exc_type: type[BaseException] = type(error)
        self.exc_value: BaseException | None = error
        self.exc_traceback: TracebackType | None = error.__traceback__
        self.err_msg: str | None = "Exception ignored in the log of a cairn.Filter"
        self.object = where


@ffi.callback("cairn_log_fn")  # type: ignore[untyped-decorator]
def LOG(payload: Any, line: Any) -> None:
    log: Log = ffi.from_handle(payload)
    log.receive(ffi.string(line).decode(errors="replace"))
