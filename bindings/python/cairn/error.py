# SPDX-License-Identifier: BSD-3-Clause
"""Statuses of the C interface as exceptions."""
from ._library import ffi, lib


class CairnError(Exception):
    """A call that the library refused. It left its handle as it was.

    status: one of the CAIRN_ERROR_ constants (a negative whole number); name: that constant's name; message: which
    argument or variable, the cause, the remedy.
    """

    def __init__(self, status, message):
        self.status = int(status)
        self.name = ffi.string(lib.cairn_status_name(self.status)).decode()
        self.message = message
        super().__init__(f"{self.name}: {message}")

    def __reduce__(self):
        return type(self), (self.status, self.message)


def check(status, message="cairn_last_message"):
    """Raises the CairnError of a status that is an error. Called in the thread, and right after, the call failed;
    `message` is the function that tells of it."""
    if status != 0:
        raise CairnError(status, ffi.string(getattr(lib, message)()).decode(errors="replace"))


def closed(what):
    """The error of one who uses a handle after it was closed."""
    return CairnError(lib.CAIRN_ERROR_STATE, f"the {what} is closed: make a new one")
