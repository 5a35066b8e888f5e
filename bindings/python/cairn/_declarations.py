# SPDX-License-Identifier: BSD-3-Clause
"""Makes cffi's declarations from the C headers with the C preprocessor, so that no declaration is written twice.

Every header of include/cairn is run through `cc -E`. A few lines replace the standard headers, because cffi knows their
types. There are no predefined macros, so CAIRN_API expands to nothing. The result is plain C declarations. Macros that
expand to a whole number become constants.

Environment: CAIRN_INCLUDE_DIR is the folder that holds cairn/cairn.h. Without it, the folder of the source tree around
this file is used; without that, the folder that pkg-config names. CC is the compiler; the default is cc.
"""
import glob
import os
import re
import shlex
import subprocess
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
STAND_INS = {"stddef.h": "", "stdint.h": "#define UINT64_MAX 18446744073709551615\n#define UINT32_MAX 4294967295\n"}
MARK = "cairn_macro"


def _is_include_dir(folder):
    return os.path.isfile(os.path.join(folder, "cairn", "cairn.h"))


def find_include_dir():
    """The folder that holds cairn/cairn.h."""
    named = os.environ.get("CAIRN_INCLUDE_DIR")
    if named:
        if not _is_include_dir(named):
            raise RuntimeError(f"CAIRN_INCLUDE_DIR: there is no cairn/cairn.h in {named}")
        return named
    of_source_tree = os.path.normpath(os.path.join(HERE, "..", "..", "..", "include"))
    if _is_include_dir(of_source_tree):
        return of_source_tree
    installed = pkg_config("includedir")
    if installed and _is_include_dir(installed):
        return installed
    raise RuntimeError("cairn's C headers were not found: install the library with its headers so that "
                       "'pkg-config cairn' finds it, or set CAIRN_INCLUDE_DIR to the folder that holds cairn/cairn.h")


def pkg_config(variable):
    """A variable of cairn.pc that names a folder, or None where there is none."""
    try:
        done = subprocess.run(["pkg-config", f"--variable={variable}", "cairn"], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    told = done.stdout.strip()
    if not os.path.isdir(told):
        told = " ".join(shlex.split(told))  # pkgconf escapes a space for the shell, other implementations do not
    return told or None


def _preprocess(source, *options):
    command = shlex.split(os.environ.get("CC") or "cc") + ["-E", "-undef", "-nostdinc", *options, "-x", "c", "-"]
    try:
        done = subprocess.run(command, input=source, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    except OSError as error:
        raise RuntimeError(f"the C preprocessor can't be run ({command[0]}: {error.strerror}): install a C compiler, "
                           "or set CC to one") from error
    if done.returncode != 0:
        raise RuntimeError(f"the C preprocessor failed: {' '.join(command)}\n{done.stderr}")
    return done.stdout


def declarations(include_dir):
    """The C declarations of all headers under `include_dir`/cairn, in the form that cffi's cdef takes."""
    names = sorted(os.path.basename(path) for path in glob.glob(os.path.join(include_dir, "cairn", "*.h")))
    includes = "".join(f"#include <cairn/{name}>\n" for name in names)
    with tempfile.TemporaryDirectory() as stand_ins:
        for name, text in STAND_INS.items():
            with open(os.path.join(stand_ins, name), "w") as file:
                file.write(text)
        folders = ["-I", stand_ins, "-I", include_dir]
        macros = re.findall(r"^#define (CAIRN_\w+) ", _preprocess(includes, "-dM", *folders), re.MULTILINE)
        probes = "".join(f'{MARK} "{macro}" {macro}\n' for macro in sorted(macros))
        lines = _preprocess(includes + probes, "-P", *folders).splitlines()
    constants = []
    for line in (line for line in lines if line.startswith(MARK)):
        whole_number = re.fullmatch(MARK + r' "(\w+)" \(?(-?(?:0[xX][0-9a-fA-F]+|\d+))[uUlL]*\)?', line.strip())
        if whole_number:
            constants.append("#define {} {}".format(*whole_number.groups()))
    plain = [line for line in lines if line.strip() and not line.startswith(MARK)]
    return "\n".join(plain + constants) + "\n"


def make_ffi(include_dir=None):
    """cffi's declarations, made from the headers now."""
    import cffi
    ffi = cffi.FFI()
    ffi.cdef(declarations(include_dir or find_include_dir()))
    return ffi


def write_module(path):
    """Writes the module `_abi` that an installed package loads instead of reading the headers again."""
    import cffi
    ffi = cffi.FFI()
    ffi.set_source("cairn._abi", None)
    ffi.cdef(declarations(find_include_dir()))
    ffi.emit_python_code(path)
    folder = pkg_config("libdir")
    with open(path, "a") as file:
        file.write(f"\nlibrary_dir = {folder and os.path.realpath(folder)!r}\n")
