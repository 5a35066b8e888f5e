# SPDX-License-Identifier: BSD-3-Clause
"""The base of all handles of the library: used by one thread at a time, closed once, and never used after that."""
import contextlib
import threading

from ._library import ffi, lib
from .error import CairnError, closed


class Handle:
    """Owns a C handle, or borrows one from another Handle and keeps that one alive."""

    WHAT = "handle"

    def __init__(self, pointer, destroy, owner=None):
        self._pointer = pointer
        self._destroy = destroy
        self._owner = owner
        self._lock = owner._lock if owner is not None else threading.RLock()
        self._busy = owner._busy if owner is not None else [False]

    @contextlib.contextmanager
    def _use(self):
        """The C handle, for one call. Threads wait for each other. A callback must not call its own filter."""
        with self._lock:
            if self._owner is not None and self._owner.closed:
                raise closed(self._owner.WHAT)
            if self._pointer is None:
                raise closed(self.WHAT)
            if self._busy[0]:
                raise CairnError(lib.CAIRN_ERROR_STATE, f"this {self.WHAT} is in a call already: a callback must not "
                                                        "call the filter that called the callback")
            self._busy[0] = True
            try:
                yield self._pointer
            finally:
                self._busy[0] = False

    @property
    def closed(self):
        return self._pointer is None or (self._owner is not None and self._owner.closed)

    def close(self):
        """Frees the memory of the handle. Later calls raise CairnError; closing twice is not an error."""
        with self._lock:
            if self._pointer is None:
                return
            if self._busy[0] and self._destroy is not None:
                raise CairnError(lib.CAIRN_ERROR_STATE, f"this {self.WHAT} is in a call and can't be closed now: close it "
                                                        "after the call")
            pointer, self._pointer = self._pointer, None
            if self._destroy is not None:
                self._destroy(pointer)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __del__(self):
        if getattr(self, "_pointer", None) is not None and self._destroy is not None and ffi is not None:
            self._destroy(self._pointer)
            self._pointer = None

    def __copy__(self):
        raise TypeError(f"a {type(self).__name__} can't be copied by the copy module: it owns a handle of the library")

    def __deepcopy__(self, _):
        return self.__copy__()

    def __reduce__(self):
        raise TypeError(f"a {type(self).__name__} can't be pickled")
