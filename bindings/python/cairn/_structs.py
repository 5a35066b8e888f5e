# SPDX-License-Identifier: BSD-3-Clause
"""Converts C structs and arrays to and from keyword arguments, dictionaries and numpy arrays. All names are the field
names of the headers, so that a new field in a header needs no change here."""
import math
import operator

import numpy as np

from ._library import ffi, lib
from ._pose_type import Pose
from .error import check

BOOKKEEPING = ("struct_size", "reserved")  # fields that a Python caller neither sets nor sees
_NUMPY_OF = {"double": "f8", "float": "f4", "int32_t": "i4", "uint32_t": "u4", "int64_t": "i8", "uint64_t": "u8",
             "size_t": "u8", "uint8_t": "u1", "int8_t": "i1"}


def name_of(kind):
    """Name of a struct's type. cffi may put "struct" in front of it, depending on how the declarations were made."""
    return kind.cname[7:] if kind.cname.startswith("struct ") else kind.cname


def shape_of_array(name, length):
    """Shape that a field of `length` values has in numpy: covariances are square, all other fields are flat."""
    side = math.isqrt(length)
    return (side, side) if "covariance" in name and side * side == length and side > 1 else (length,)


def array(name, value, shape=None):
    """A C-contiguous array of doubles, whose buffer can be passed to C. None in `shape` means any length."""
    if np.iscomplexobj(value):
        raise TypeError(f"{name}: must be real numbers, and is complex")
    try:
        result = np.ascontiguousarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{name}: must be numbers: {error}") from None
    if shape is not None:
        fits = result.ndim == len(shape) and all(want in (None, has) for want, has in zip(shape, result.shape))
        if not fits:
            wanted = " x ".join("n" if want is None else str(want) for want in shape)
            raise ValueError(f"{name}: shape {wanted} is needed, and {result.shape} was given")
    return result


def doubles(values):
    """Pointer to the values of an array of doubles. The array must live until the call returns."""
    return ffi.from_buffer("double *", values)


def identifiers(name, values):
    """Landmark ids as an array of uint64: whole numbers from 0 to 2^64 - 1, one dimension."""
    if isinstance(values, np.ndarray):
        if values.ndim != 1:
            raise ValueError(f"{name}: must have one dimension, and has {values.ndim}")
        if values.size == 0:
            return np.zeros(0, np.uint64)
        if values.dtype.kind not in "iu":
            raise TypeError(f"{name}: must be whole numbers, and is an array of {values.dtype}")
        if values.dtype.kind == "i" and values.min() < 0:
            raise ValueError(f"{name}: an id is negative: {values.min()}")
        return np.ascontiguousarray(values, dtype=np.uint64)
    try:
        numbers = [operator.index(value) for value in values]
    except TypeError as error:
        raise TypeError(f"{name}: must be whole numbers: {error}") from None
    if any(number < 0 or number >= 1 << 64 for number in numbers):
        raise ValueError(f"{name}: an id is not in 0 to 2^64 - 1")
    return np.fromiter(numbers, dtype=np.uint64, count=len(numbers))


def dtype(type_name):
    """The numpy type with the memory layout of the C struct. Covariances are square."""
    names, formats, offsets = [], [], []
    for name, field in ffi.typeof(type_name).fields:
        kind, shape = field.type, ()
        if kind.kind == "array":
            kind, shape = kind.item, shape_of_array(name, kind.length)
        base = dtype(kind.cname) if kind.kind == "struct" else np.dtype(_NUMPY_OF[kind.cname])
        names.append(name)
        formats.append((base, shape) if shape else base)
        offsets.append(field.offset)
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": ffi.sizeof(type_name)})


def constant(field, word, struct=""):
    """The value of a constant that is given by a word: error="standard" is CAIRN_STATE_ERROR_STANDARD, join_loss="huber" is
    CAIRN_LOSS_HUBER, and mode="joint" in an options struct of a team is CAIRN_TEAM_JOINT."""
    for prefix in (field, field.split("_")[0], field.split("_")[-1], *struct.split("_")[1:2]):
        value = getattr(lib, f"CAIRN_{prefix}_{word}".upper(), None)
        if value is not None:
            return value
    raise ValueError(f"{field}: there is no constant CAIRN_{field.split('_')[0].upper()}_{word.upper()}")


def set_field(struct, name, kind, value, where, owner=""):
    """Sets one field of a struct of type `owner` to a Python value."""
    where = f"{where}{name}"
    if kind.kind == "array":
        shape = shape_of_array(name, kind.length)
        values = np.asarray(value)
        if values.shape != (kind.length,):  # a flat array is always accepted
            values = array(where, value, shape)
        setattr(struct, name, [float(number) for number in values.ravel()])
    elif kind.kind == "struct":
        set_fields(getattr(struct, name), kind, pose_fields(where, value) if name_of(kind) == "cairn_pose" else value,
                   where + ".")
    elif kind.kind == "primitive":
        if isinstance(value, str):
            value = constant(name, value, owner)
        try:
            setattr(struct, name, value if kind.cname == "double" else operator.index(value))
        except (TypeError, OverflowError) as error:
            raise type(error)(f"{where}: {error}") from None
    else:
        setattr(struct, name, value)


def set_fields(struct, kind, values, where=""):
    fields = {name: field.type for name, field in kind.fields if not name.startswith(BOOKKEEPING)}
    for name, value in values.items():
        if name not in fields:
            raise TypeError(f"there is no option '{where}{name}': {name_of(kind)} has {', '.join(fields)}")
        set_field(struct, name, fields[name], value, where, name_of(kind))


def pose_fields(name, value):
    """The fields of a pose that is given as (position, quaternion), as a cairn.Pose, or as a dictionary."""
    if isinstance(value, dict):
        return value
    try:
        position, quaternion = value
    except (TypeError, ValueError):
        raise ValueError(f"{name}: must be a pose: (position, quaternion w x y z)") from None
    return {"position": position, "quaternion": quaternion}


def new(type_name, values):
    """A struct with the library's defaults (from its _init function) and with the given fields set."""
    struct = ffi.new(f"{type_name} *")
    check(getattr(lib, f"{type_name}_init")(struct, ffi.sizeof(type_name)))
    set_fields(struct, ffi.typeof(type_name), values)
    return struct


def new_pose(name, value):
    """A cairn_pose from (position, quaternion)."""
    struct = ffi.new("cairn_pose *")
    set_fields(struct, ffi.typeof("cairn_pose"), pose_fields(name, value), f"{name}.")
    return struct


def sized(type_name):
    """An empty struct with its struct_size set, for a function that fills it."""
    struct = ffi.new(f"{type_name} *")
    struct.struct_size = ffi.sizeof(type_name)
    return struct


def report(type_name, ask):
    """Calls a function that fills a struct with a struct_size; returns the struct as a dictionary."""
    struct = sized(type_name)
    check(ask(struct))
    return as_dict(struct[0])


def observations(ids, z, covariance=None):
    """An array of cairn_observation from n ids, n x rows values and their noise (n x rows x rows, or None). `ids` may
    also be a complete array of observations; then z and covariance must be None."""
    layout = dtype("cairn_observation")
    if z is None:
        frame = np.asarray(ids)
        if frame.dtype != layout or frame.ndim != 1 or covariance is not None:
            raise TypeError("z is missing: only an array of observations can be given without z")
        return np.ascontiguousarray(frame)
    ids = identifiers("ids", ids)
    z = array("z", np.zeros((0, 3)) if len(ids) == 0 and np.size(z) == 0 else z, (len(ids), None))
    rows = z.shape[1]
    if not 1 <= rows <= 3:
        raise ValueError(f"z: must have 1 to 3 values per observation, and has {rows}")
    frame = np.zeros(len(ids), layout)
    frame["id"] = ids
    frame["z"][:, :rows] = z
    if covariance is not None:
        packed = array("covariance", covariance, (len(ids), rows, rows)).reshape(len(ids), rows * rows)
        frame["covariance"].reshape(len(ids), 9)[:, : rows * rows] = packed
    return frame


def as_dict(struct):
    """The fields of a struct: numbers, arrays, and poses as cairn.Pose. Pointers are left out."""
    result = {}
    for name, field in ffi.typeof(struct).fields:
        if name.startswith(BOOKKEEPING) or field.type.kind == "pointer":
            continue
        value = getattr(struct, name)
        if field.type.kind == "array":
            value = np.array(list(value)).reshape(shape_of_array(name, field.type.length))
        elif field.type.kind == "struct":
            value = Pose.of(value) if name_of(field.type) == "cairn_pose" else as_dict(value)
        result[name] = value
    return result


def filled(type_name, ask):
    """The array of structs that ask(buffer, capacity, needed) fills. The first call asks for the number of structs."""
    needed = ffi.new("size_t *")
    check(ask(ffi.NULL, 0, needed))
    result = np.zeros(needed[0], dtype(type_name) if type_name in STRUCTS else _NUMPY_OF[type_name])
    if len(result):
        check(ask(ffi.from_buffer(f"{type_name} *", result, require_writable=True), len(result), needed))
    return result[: needed[0]]


STRUCTS = frozenset(ffi.list_types()[0])
