# SPDX-License-Identifier: BSD-3-Clause
"""Error statuses of the C interface as exceptions."""
from ._library import ffi, lib


class CairnError(Exception):
    """The library refused a call. The handle is unchanged.

    status: one of the CAIRN_ERROR_ constants (a negative whole number). name: the name of that constant. message: which
    argument or variable is wrong, why, and what to do.
    """

    def __init__(self, status, message):
        self.status = int(status)
        self.name = ffi.string(lib.cairn_status_name(self.status)).decode()
        self.message = message
        super().__init__(f"{self.name}: {message}")

    def __reduce__(self):
        return type(self), (self.status, self.message)


def check(status, message="cairn_last_message"):
    """Raises a CairnError if `status` is an error. Must run in the thread of the failed call and right after it.
    `message` is the name of the function that returns the message."""
    if status != 0:
        raise CairnError(status, ffi.string(getattr(lib, message)()).decode(errors="replace"))


def closed(what):
    """The error of a call on a closed handle."""
    return CairnError(lib.CAIRN_ERROR_STATE, f"the {what} is closed: make a new one")
