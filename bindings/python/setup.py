# SPDX-License-Identifier: BSD-3-Clause
"""Adds to the build what pyproject.toml can't say: the prepared declarations, and the library inside the package.

CAIRN_BUNDLE (environment) says where the library comes from:

| value | the package holds |
|---|---|
| a folder | the libraries of this folder: `lib` of a build tree, or of an installed library |
| none | no library: it uses the one that the system's loader finds, as Debian's package does |
| not set | the library, built from the source tree around this folder with CMake |

A build leaves nothing in the source tree.
"""
import atexit
import importlib
import os
import pathlib
import runpy
import shutil
import subprocess
import sys
import tempfile

from setuptools import Distribution, Extension, setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # setuptools before 70.1
    from wheel.bdist_wheel import bdist_wheel

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
DECLARED = runpy.run_path(str(HERE / "cairn" / "_declarations.py"))  # not the package, which needs numpy

BUNDLE = os.environ.get("CAIRN_BUNDLE", "")
SCRATCH = pathlib.Path(tempfile.mkdtemp(prefix="cairn-python-"))
atexit.register(shutil.rmtree, SCRATCH, ignore_errors=True)


def build_library():
    """Builds and installs the libraries in the scratch folder. Returns the folder that holds them."""
    if not (ROOT / "src" / "cairn" / "CMakeLists.txt").is_file():
        sys.exit("cairn: this folder has no sources of the library around it; set CAIRN_BUNDLE to the folder of an "
                 "installed library, or to 'none'")
    if shutil.which("cmake") is None:
        sys.exit("cairn: building the library needs cmake, a C++ compiler, Eigen and nanoflann (Debian: cmake g++ "
                 "libeigen3-dev libnanoflann-dev); or set CAIRN_BUNDLE to the folder of an installed library")
    tree, prefix = SCRATCH / "library", SCRATCH / "prefix"
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
    for command in (["-S", str(ROOT), "-B", str(tree), "-DCMAKE_BUILD_TYPE=Release", "-DCAIRN_BUILD_PROGRAM=OFF"],
                    ["--build", str(tree), "--parallel", jobs],
                    ["--install", str(tree), "--prefix", str(prefix), "--component", "runtime"]):
        subprocess.run(["cmake", *command], check=True)
    return next(prefix.glob("**/" + DECLARED["SONAMES"]["cairn"])).parent


def bundle(target):
    """Copies the libraries, all their builds, to a folder of the package."""
    source = pathlib.Path(BUNDLE) if BUNDLE else build_library()
    if source.parts[-2:-1] == ("glibc-hwcaps",):
        source = source.parents[1]
    for soname in DECLARED["SONAMES"].values():
        if not (source / soname).is_file():
            sys.exit(f"cairn: CAIRN_BUNDLE: {source} has no {soname}")
        for build in (pathlib.Path(), pathlib.Path("glibc-hwcaps", "x86-64-v3")):
            if (source / build / soname).is_file():
                (target / build).mkdir(parents=True, exist_ok=True)
                shutil.copyfile((source / build / soname).resolve(), target / build / soname)


class Build(build_py):
    """Adds what the source tree does not hold."""

    def run(self):
        super().run()
        if getattr(self, "editable_mode", False):
            return  # an editable install makes the declarations when it is loaded, and finds the library like a clone
        package = pathlib.Path(self.build_lib, "cairn")
        ffi = importlib.import_module("cffi").FFI()
        ffi.set_source("cairn._abi", None)
        ffi.cdef(DECLARED["CDEF"])
        ffi.emit_python_code(str(package / "_abi.py"))
        if BUNDLE != "none":
            bundle(package / "lib")


COMPILED = BUNDLE != "none" and sys.version_info >= (3, 11)  # the oldest Python whose limited interface has buffers


class Wheel(bdist_wheel):
    """A wheel with a library inside is for this kind of machine, and for each later version of Python."""

    def get_tag(self):
        return (*(("cp311", "abi3") if COMPILED else ("py3", "none")), super().get_tag()[2])


class Package(Distribution):
    def has_ext_modules(self):
        return BUNDLE != "none"


# Without Python's header files the package works all the same, only slower.
fast = Extension("cairn._fast", ["fast.c"], include_dirs=[str(ROOT / "include")], py_limited_api=True, optional=True)
setup(cmdclass={"build_py": Build, "bdist_wheel": Wheel}, distclass=Package, ext_modules=[fast] if COMPILED else [],
      options={"build": {"build_base": str(SCRATCH / "build")}, "egg_info": {"egg_base": str(SCRATCH)},
               "bdist_wheel": {"bdist_dir": str(SCRATCH / "wheel")}})
