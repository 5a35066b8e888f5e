# SPDX-License-Identifier: BSD-3-Clause
"""The base of all handles of the library: used by one thread at a time, closed once, and never used after that."""

from __future__ import annotations

import threading
import weakref
from typing import Any, NoReturn, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _structs
from ._library import ffi
from .constants import Status
from .error import CairnError, failure, new_error
from .layouts import OF_STRUCT

Self = TypeVar("Self", bound="Handle")

SIZE = ffi.typeof("size_t *")
UINT64 = ffi.typeof("uint64_t *")


class Guard:
    """What a handle shares with the handles that it lends: its lock, the memory of its errors, and the exception that a
    callback raised during a call."""

    __slots__ = ("blocked", "error", "lock", "raised")

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.blocked = False  # in a call, or closed
        self.error = new_error()
        self.raised: BaseException | None = None


class Handle:
    """Owns a C handle, or borrows one from another Handle and keeps that one alive."""

    WHAT = "handle"

    def __init__(self, pointer: Any, destroy: Any, owner: Handle | None = None) -> None:
        self._pointer = pointer
        self._owner = owner
        self._guard: Guard = Guard() if owner is None else owner._guard
        self._finalizer = None if destroy is None else weakref.finalize(self, destroy, pointer)

    def _call(self, function: Any, *arguments: Any) -> None:
        """Calls function(handle, *arguments, error). Threads wait for each other. A callback must not call its own
        filter."""
        guard = self._guard
        with guard.lock:
            pointer = self._pointer
            if guard.blocked or pointer is None:
                self._refuse()
            guard.blocked = True
            try:
                status = function(pointer, *arguments, guard.error)
            finally:
                guard.blocked = False
            if status:
                self._fail(status)

    def _fail(self, status: int) -> NoReturn:
        """Raises the error of a call that returned `status`: that of the library, or what a callback raised."""
        raised, self._guard.raised = self._guard.raised, None
        if raised is not None and status == Status.ERROR_CALLBACK:
            raise raised
        raise failure(status, self._guard.error)

    def _refuse(self) -> NoReturn:
        """Raises the error of a call on a handle that is closed or in a call."""
        closed = self._owner if self._owner is not None and self._owner.closed else self if self.closed else None
        if closed is not None:
            raise CairnError(Status.ERROR_STATE, f"the {closed.WHAT} is closed: make a new one")
        raise CairnError(Status.ERROR_STATE, f"this {self.WHAT} is in a call already: a callback must not call the filter "
                                             "that called the callback")

    def _lend(self, function: Any) -> Any:
        """The handle that function(handle) returns. It belongs to this handle."""
        with self._guard.lock:
            if self._guard.blocked or self._pointer is None:
                self._refuse()
            return function(self._pointer)

    def _ask(self, kind: str, function: Any, *arguments: Any) -> Any:
        """The value that function(handle, *arguments, value, error) writes."""
        value = ffi.new(kind)
        self._call(function, *arguments, value)
        return value[0]

    def _report(self, struct_name: str, function: Any, *arguments: Any) -> Any:
        """The struct that function(handle, *arguments, struct, error) fills, as a dictionary."""
        report = _structs.sized(struct_name)
        self._call(function, *arguments, report)
        return _structs.as_dict(report[0])

    def _filled(self, kind: str, function: Any, *arguments: Any) -> NDArray[Any]:
        """The array of structs or ids that function(handle, *arguments, buffer, capacity, needed, error) fills."""
        needed = ffi.new(SIZE)
        with self._guard.lock:
            self._call(function, *arguments, ffi.NULL, 0, needed)
            result = np.zeros(needed[0], OF_STRUCT.get(kind, np.uint64))
            if needed[0]:
                self._call(function, *arguments, _structs.pointer(f"{kind} *", result), needed[0], needed)
        return result

    def _points(self, columns: int, function: Any, *arguments: Any) -> NDArray[np.float64]:
        """The points, `columns` coordinates each, that function(handle, *arguments, buffer, capacity, needed, error)
        fills."""
        needed = ffi.new(SIZE)
        with self._guard.lock:
            self._call(function, *arguments, ffi.NULL, 0, needed)
            result = np.zeros((needed[0], columns))
            if needed[0]:
                self._call(function, *arguments, _structs.doubles(result), needed[0], needed)
        return result

    @property
    def closed(self) -> bool:
        """Whether the handle can't be used any more."""
        return self._pointer is None or (self._owner is not None and self._owner.closed)

    def close(self) -> None:
        """Frees the memory of the handle. Later calls raise CairnError; closing twice is not an error."""
        with self._guard.lock:
            if self._pointer is None:
                return
            if self._finalizer is not None:
                if self._guard.blocked:
                    raise CairnError(Status.ERROR_STATE, f"this {self.WHAT} is in a call and can't be closed now: close "
                                                         "it after the call")
                self._guard.blocked = True
                self._pointer = None
                self._finalizer()
            self._pointer = None

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __copy__(self) -> NoReturn:
        raise TypeError(f"a {type(self).__name__} can't be copied by the copy module: it owns a handle of the library")

    def __deepcopy__(self, _: object) -> NoReturn:
        self.__copy__()

    def __reduce__(self) -> NoReturn:
        raise TypeError(f"a {type(self).__name__} can't be pickled")
