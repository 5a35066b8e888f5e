# SPDX-License-Identifier: BSD-3-Clause
"""Errors of the library as exceptions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._library import ffi, lib
from .constants import Status

if TYPE_CHECKING:
    from .structs import MergeReport


class CairnError(Exception):
    """The library refused a call. The handle is as before.

    status: a member of cairn.Status. name: the name of its C constant. message: which argument or variable is wrong,
    why, and what to do. report: of a refused merge of maps, else None.
    """

    status: Status
    name: str
    message: str
    report: MergeReport | None = None

    def __init__(self, status: int, message: str) -> None:
        self.status = Status(status)
        self.name = status_name(status)
        self.message = message
        super().__init__(f"{self.name}: {message}")

    def __reduce__(self) -> tuple[type[CairnError], tuple[Status, str]]:
        return type(self), (self.status, self.message)


def status_name(status: int) -> str:
    """Name of a status in C, for example "CAIRN_ERROR_ARGUMENT"; "unknown status" for any other value."""
    name: str = ffi.string(lib.cairn_status_name(status)).decode()
    return name


def new_error() -> Any:
    """A cairn_error, which a call of the library fills in."""
    return ffi.new("cairn_error *", {"struct_size": ffi.sizeof("cairn_error")})


def failure(status: int, error: Any) -> CairnError:
    """The exception for a call that returned `status` and filled in `error`."""
    return CairnError(status, ffi.string(error.message).decode(errors="replace"))


def call(function: Any, *arguments: Any) -> None:
    """Calls a function of the library that belongs to no handle."""
    error = new_error()
    status = function(*arguments, error)
    if status:
        raise failure(status, error)
