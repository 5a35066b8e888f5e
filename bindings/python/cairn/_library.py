# SPDX-License-Identifier: BSD-3-Clause
"""Loads libcairn, and libcairn_sim when one of its functions is used.

CAIRN_LIBRARY (environment) is the path of libcairn.so or of its folder. Without it, the libraries inside the package
are used; a package without them uses the search path of the loader.
"""

from __future__ import annotations

import importlib
import os
from typing import Any

from ._declarations import CDEF, FUNCTIONS, SONAMES, VERSION

HERE = os.path.dirname(os.path.abspath(__file__))
INSIDE = os.path.join(HERE, "lib")  # the libraries of a wheel


def _make_ffi() -> Any:
    """cffi's object with all C declarations. An installed package has them prepared."""
    try:
        return importlib.import_module("cairn._abi").ffi
    except ImportError:  # run from the source tree
        made = importlib.import_module("cffi").FFI()
        made.cdef(CDEF)
        return made


ffi: Any = _make_ffi()
"""cffi's object: types, memory and casts."""

# cffi raises one of these for a missing symbol; the second one if the declarations were made at installation.
_MISSING: tuple[type[Exception], ...] = (ImportError, AttributeError, getattr(ffi, "error", AttributeError))


def _has_v3() -> bool:
    """Whether this processor supports x86-64-v3."""
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as file:
            flags = next((line for line in file if line.startswith("flags")), "").split()
    except OSError:
        return False
    return {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe", "xsave"} <= set(flags)


def _builds(folder: str, soname: str) -> list[str]:
    """Paths of the builds in a folder, the best first. The loader chooses a build only if it is given no path."""
    best = os.path.join(folder, "glibc-hwcaps", "x86-64-v3", soname)
    return ([best] if os.path.isfile(best) and _has_v3() else []) + [os.path.join(folder, soname)]


def _paths(library: str, soname: str) -> list[str]:
    """Where a library may be, the best place first."""
    named = os.environ.get("CAIRN_LIBRARY")
    if not named:
        return _builds(INSIDE, soname) if os.path.isdir(INSIDE) else [soname]
    if os.path.isfile(named):
        if library == "cairn":
            return [named]
        named = os.path.dirname(named)
    return [*_builds(named, soname), os.path.join(named, f"lib{library}.so")]


def _open(library: str) -> Any:
    soname = SONAMES[library]
    causes: list[str] = []
    for path in _paths(library, soname):
        try:
            return ffi.dlopen(path)
        except OSError as error:
            causes.append(str(error).split(".  Additionally")[0])
    raise ImportError(f"this package is cairn {VERSION} and needs {soname}, which can't be loaded "
                      f"({'; '.join(causes)}): install that version of the library, or set CAIRN_LIBRARY to its path")


def _numbers(version: str) -> list[int]:
    return [int(part) for part in version.split(".")]


def _check_version(library: Any) -> None:
    """Refuses a library that may lack a function of this package, or may have changed one."""
    wanted, loaded = VERSION, ffi.string(library.cairn_version()).decode()
    if _numbers(loaded)[:2] != _numbers(wanted)[:2] or _numbers(loaded) < _numbers(wanted):
        raise ImportError(f"this package is cairn {wanted}, but the loaded library is cairn {loaded}: install the same "
                          "version of both")


class Library:
    """Every function of the C interface by its name: `lib.cairn_version()`."""

    def __init__(self) -> None:
        self._libraries = {"cairn": _open("cairn")}
        _check_version(self._libraries["cairn"])

    def __getattr__(self, name: str) -> Any:
        for library, functions in FUNCTIONS.items():
            if name in functions:
                break
        else:
            raise AttributeError(f"the C interface has no function {name}")
        try:
            if library not in self._libraries:
                self._libraries[library] = _open(library)
            function = getattr(self._libraries[library], name)
        except _MISSING as error:
            raise AttributeError(f"lib{library} has no {name}: {error}") from None
        setattr(self, name, function)
        return function

    def __dir__(self) -> list[str]:
        return sorted(name for functions in FUNCTIONS.values() for name in functions)


lib: Any = Library()
"""Every function of the C interface by its name, for what the classes of this package do not do."""
