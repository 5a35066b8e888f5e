# SPDX-License-Identifier: BSD-3-Clause
"""What the loaded library says about itself, and the words of its constants."""

from __future__ import annotations

from typing import Any, TypeVar

from . import _structs
from ._declarations import OPTIONS
from ._library import ffi, lib
from .constants import Doubts

Options = TypeVar("Options")


def _text(characters: Any) -> str:
    text: str = ffi.string(characters).decode()
    return text


def version() -> str:
    """Version of the loaded library, for example "0.2.0"."""
    return _text(lib.cairn_version())


def version_number() -> int:
    """Version of the loaded library as a number: 10000 major + 100 minor + patch."""
    return int(lib.cairn_version_number())


def build() -> str:
    """Instruction set that the loaded library was compiled for: "x86-64", "x86-64-v3" or "generic"."""
    return _text(lib.cairn_build())


def has(feature: str) -> bool:
    """Whether the loaded library has a feature: "sparse", "teams", "trajectory", "systematic", "robust", "health"."""
    return bool(lib.cairn_has(feature.encode()))


def id_none() -> int:
    """The id that no landmark has: ID_NONE."""
    return int(lib.cairn_id_none())


def verdict_text(verdict: int) -> str:
    """A verdict in one word: "good", "doubtful" or "lost"; "unknown" for any other value."""
    return _text(lib.cairn_verdict_text(verdict))


def doubt_text(reason: int) -> str:
    """A reason of a verdict in words. `reason` is one bit of cairn.Doubts; anything else gives "unknown"."""
    return _text(lib.cairn_doubt_text(reason))


def doubt_texts(reasons: int) -> list[str]:
    """The reasons of a verdict in words, one text for each bit."""
    return [doubt_text(reason) for reason in Doubts if reasons & reason]


def defaults(options: type[Options]) -> Options:
    """The defaults of the library for a class of options: defaults(cairn.FilterOptions)["max_landmarks"]."""
    if options.__name__ not in OPTIONS:
        raise TypeError(f"options: must be one of {', '.join(OPTIONS)}, and is {options.__name__}")
    filled: Any = _structs.as_dict(_structs.new(OPTIONS[options.__name__], {})[0])
    return filled  # type: ignore[no-any-return]
