# SPDX-License-Identifier: BSD-3-Clause
"""Loads libcairn, and libcairn_sim when one of its functions is used.

Environment: CAIRN_LIBRARY is the path of libcairn.so or of its folder. Without it, the folder is used that pkg-config
named when this package was built; without that, the search path of the loader.
"""
import os

try:
    from ._abi import ffi, library_dir
except ImportError:  # run from the source tree
    from ._declarations import make_ffi
    ffi, library_dir = make_ffi(), None


_declared = ffi.dlopen(None)  # has the constants of the headers and the names of their functions

# cffi raises one of these for a missing symbol; the second one if the declarations were made at installation.
_MISSING = (AttributeError, getattr(ffi, "error", AttributeError))


def _has_v3():
    """Whether this processor supports x86-64-v3."""
    try:
        with open("/proc/cpuinfo") as file:
            flags = next((line for line in file if line.startswith("flags")), "").split()
    except OSError:
        return False
    return {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe", "xsave"} <= set(flags)


def _builds(folder, soname):
    """Paths of the builds in a folder, the best first. The loader chooses a build only if it is given no path."""
    best = os.path.join(folder, "glibc-hwcaps", "x86-64-v3", soname)
    return ([best] if os.path.isfile(best) and _has_v3() else []) + [os.path.join(folder, soname)]


def _soversion():
    """The number in the SONAME. Before 1.0 it has the minor version, which may break the interface."""
    major = str(_declared.CAIRN_VERSION_MAJOR)
    return f"{major}.{_declared.CAIRN_VERSION_MINOR}" if major == "0" else major


def _open(stem):
    """Opens lib`stem`.so in the named folder, or on the search path of the loader."""
    soname = f"lib{stem}.so.{_soversion()}"
    named = os.environ.get("CAIRN_LIBRARY")
    if named and os.path.isfile(named) and stem == "cairn":
        paths = [named]
    elif named:
        folder = named if os.path.isdir(named) else os.path.dirname(named)
        paths = _builds(folder, soname) + [os.path.join(folder, f"lib{stem}.so")]
    else:
        paths = _builds(library_dir, soname) if library_dir else []
        paths.append(soname)
    causes = []
    for path in paths:
        try:
            return ffi.dlopen(path)
        except OSError as error:
            causes.append(str(error).split(".  Additionally")[0])
    raise ImportError(f"{soname} can't be loaded ({'; '.join(causes)}): install the library, or set CAIRN_LIBRARY to "
                      "its path")


class Library:
    """Every function and constant of the C headers by its name: `lib.cairn_version()`, `lib.CAIRN_RESULT_NEW`."""

    def __init__(self):
        self._cairn = _open("cairn")
        built = [_declared.CAIRN_VERSION_MAJOR, _declared.CAIRN_VERSION_MINOR]
        loaded = ffi.string(self._cairn.cairn_version()).decode()
        if [int(part) for part in loaded.split(".")[:2]] != built:
            raise ImportError(f"this package was made from the headers of cairn {built[0]}.{built[1]}, but the loaded "
                              f"library is {loaded}: install the same version of both")

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        try:
            value = getattr(self._cairn, name)
        except _MISSING:
            if not name.startswith("cairn_"):
                raise AttributeError(f"cairn's C headers have no {name}") from None
            value = self._of_sim(name)
        setattr(self, name, value)
        return value

    def _of_sim(self, name):
        if name not in dir(_declared):
            raise AttributeError(f"cairn's C headers have no function {name}")
        try:
            if "_sim" not in self.__dict__:
                self._sim = _open("cairn_sim")
            return getattr(self._sim, name)
        except (ImportError, *_MISSING) as error:
            raise AttributeError(f"libcairn has no {name}, nor has libcairn_sim: {error}") from None

    def __dir__(self):
        return dir(_declared)


lib = Library()
