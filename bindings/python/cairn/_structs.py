# SPDX-License-Identifier: BSD-3-Clause
"""Converts C structs and arrays to and from keyword arguments, dictionaries and numpy arrays. All names are the field
names of the headers, so that a new field in a header needs no change here."""

from __future__ import annotations

import enum
import math
import operator
from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import constants
from ._declarations import TYPED_FIELDS
from ._library import ffi, lib
from ._pose_type import Pose, PoseLike
from .error import call

BOOKKEEPING = ("struct_size", "reserved")  # fields that a Python caller neither sets nor sees
FLOAT64 = np.dtype(np.float64)
UINT64 = np.dtype(np.uint64)
INT64 = np.dtype(np.int64)
DOUBLES = ffi.typeof("double *")
Array = NDArray[np.float64]
Ids: TypeAlias = NDArray[Any] | Iterable[int]
"""Landmark ids: whole numbers from 0 to 2^64 - 1."""

_from_buffer = ffi.from_buffer


def name_of(kind: Any) -> str:
    """Name of a struct's type. cffi may put "struct" in front of it, depending on how the declarations were made."""
    name: str = kind.cname
    return name[7:] if name.startswith("struct ") else name


def shape_of_array(name: str, length: int) -> tuple[int, ...]:
    """Shape that a field of `length` values has in numpy: covariances are square, all other fields are flat."""
    side = math.isqrt(length)
    return (side, side) if "covariance" in name and side * side == length and side > 1 else (length,)


# Arrays.


def array(name: str, value: ArrayLike, shape: tuple[int | None, ...] | None = None) -> Array:
    """A C-contiguous array of doubles, whose buffer can be passed to C. None in `shape` means any length."""
    try:
        raw: NDArray[Any] = np.asarray(value)
        if raw.dtype.kind == "c":
            raise TypeError("they are complex, and must be real numbers")
        result: Array = raw if raw.dtype is FLOAT64 and raw.flags.c_contiguous else np.array(raw, FLOAT64, order="C")
    except (TypeError, ValueError) as error:
        raise TypeError(f"{name}: must be numbers: {error}") from None
    has = result.shape
    if shape is not None and has != shape:
        if len(has) != len(shape) or any(want not in (None, side) for want, side in zip(shape, has)):
            wanted = " x ".join("n" if want is None else str(want) for want in shape)
            raise ValueError(f"{name}: shape {wanted} is needed, and {has} was given")
    return result


def vector(name: str, value: ArrayLike, length: int) -> list[float]:
    """`length` numbers for a parameter `const double *`: cffi passes a short list faster than an array."""
    if type(value) is np.ndarray and value.dtype is FLOAT64 and value.shape == (length,):
        numbers: list[float] = value.tolist()
    else:
        numbers = array(name, value, (length,)).tolist()
    return numbers


def doubles(values: Array) -> Any:
    """Pointer to the values of an array of doubles. The array must live until the call returns."""
    return _from_buffer(DOUBLES, values)


def optional_doubles(name: str, value: ArrayLike | None, shape: tuple[int | None, ...]) -> Any:
    """Pointer to the values of an array, which the pointer keeps alive; NULL for None."""
    return ffi.NULL if value is None else doubles(array(name, value, shape))


def pointer(kind: str, values: NDArray[Any]) -> Any:
    """Pointer to an array of structs or whole numbers. The array must live until the call returns."""
    return _from_buffer(kind, values)


def identifier(name: str, value: int) -> int:
    """A landmark id or the number of a vehicle: a whole number from 0 to 2^64 - 1."""
    try:
        number = operator.index(value)
    except TypeError as error:
        raise TypeError(f"{name}: must be a whole number: {error}") from None
    if not 0 <= number < 1 << 64:
        raise ValueError(f"{name}: is not in 0 to 2^64 - 1: {number}")
    return number


def identifiers(name: str, values: Ids) -> NDArray[np.uint64]:
    """Landmark ids as an array of uint64: whole numbers from 0 to 2^64 - 1, one dimension."""
    if type(values) is np.ndarray:
        if values.ndim != 1:
            raise ValueError(f"{name}: must have one dimension, and has {values.ndim}")
        if values.size == 0:
            return np.zeros(0, UINT64)
        if values.dtype.kind not in "iu":
            raise TypeError(f"{name}: must be whole numbers, and is an array of {values.dtype}")
        if values.dtype.kind == "i" and values.min() < 0:
            raise ValueError(f"{name}: an id is negative: {values.min()}")
        return np.ascontiguousarray(values, dtype=UINT64)
    try:
        numbers = list(values)
        if set(map(type, numbers)) != {int}:
            numbers = [operator.index(value) for value in numbers]
    except TypeError as error:
        raise TypeError(f"{name}: must be whole numbers: {error}") from None
    if numbers and not 0 <= min(numbers) <= max(numbers) < 1 << 64:
        raise ValueError(f"{name}: an id is not in 0 to 2^64 - 1")
    return np.array(numbers, UINT64)


# Structs.


def constant(where: str, kind: str, value: Any) -> int:
    """The value of a constant of the type `kind` (a class of cairn.constants) that is given as a member, a number, or a
    word."""
    members: type[enum.IntEnum] = getattr(constants, kind)
    if isinstance(value, str):
        try:
            return members[value.upper()]
        except KeyError:
            words = ", ".join(repr(member.name.lower()) for member in members)
            raise ValueError(f"{where}: must be one of {words}, and is {value!r}") from None
    try:
        return operator.index(value)
    except TypeError as error:
        raise TypeError(f"{where}: {error}") from None


def set_field(struct: Any, name: str, kind: Any, value: Any, where: str, typed: str | None) -> None:
    """Sets one field of a struct to a Python value. `typed` is the type of constants that the field holds, or None."""
    where = f"{where}{name}"
    if kind.kind == "array":
        shape = shape_of_array(name, kind.length)
        values = np.asarray(value)
        if values.shape != (kind.length,):  # a flat array is always accepted
            values = array(where, value, shape)
        setattr(struct, name, array(where, values).ravel().tolist())
    elif kind.kind == "struct":
        if name_of(kind) == "cairn_pose":
            value = pose_fields(where, value)
        set_fields(getattr(struct, name), kind, value, where + ".")
    else:
        if typed is not None and typed != "bool":
            value = constant(where, typed, value)
        try:
            setattr(struct, name, value if kind.cname == "double" else operator.index(value))
        except (TypeError, OverflowError) as error:
            raise type(error)(f"{where}: {error}") from None


def set_fields(struct: Any, kind: Any, values: Mapping[str, Any], where: str = "") -> None:
    fields = {name: field.type for name, field in kind.fields if not name.startswith(BOOKKEEPING)}
    typed = TYPED_FIELDS.get(name_of(kind), {})
    for name, value in values.items():
        if name not in fields:
            raise TypeError(f"there is no option '{where}{name}': {name_of(kind)} has {', '.join(fields)}")
        set_field(struct, name, fields[name], value, where, typed.get(name))


def pose_fields(name: str, value: Any) -> dict[str, Any]:
    """The fields of a pose that is given as (position, quaternion), as a cairn.Pose, or as a dictionary."""
    if isinstance(value, dict):
        return value  # pyright: ignore[reportUnknownVariableType]
    try:
        position, quaternion = value
    except (TypeError, ValueError):
        raise ValueError(f"{name}: must be a pose: (position, quaternion w x y z)") from None
    return {"position": position, "quaternion": quaternion}


def new(struct_name: str, values: Mapping[str, Any]) -> Any:
    """A struct with the library's defaults (from its _init function) and with the given fields set."""
    struct = ffi.new(f"{struct_name} *")
    call(getattr(lib, f"{struct_name}_init"), struct, ffi.sizeof(struct_name))
    set_fields(struct, ffi.typeof(struct_name), values)
    return struct


def new_pose(name: str, value: PoseLike) -> Any:
    """A cairn_pose from (position, quaternion)."""
    position, quaternion = pose_fields(name, value).values()
    return ffi.new("cairn_pose *", (vector(f"{name}.position", position, 3),
                                    vector(f"{name}.quaternion", quaternion, 4)))


def sized(struct_name: str) -> Any:
    """An empty struct with its struct_size set, for a function that fills it."""
    return ffi.new(f"{struct_name} *", {"struct_size": ffi.sizeof(struct_name)})


def as_dict(struct: Any) -> dict[str, Any]:
    """The fields of a struct: numbers, constants, arrays, and poses as cairn.Pose."""
    result: dict[str, Any] = {}
    kind = ffi.typeof(struct)
    typed = TYPED_FIELDS.get(name_of(kind), {})
    for name, field in kind.fields:
        if name.startswith(BOOKKEEPING):
            continue
        value = getattr(struct, name)
        if field.type.kind == "array":
            value = np.array(list(value)).reshape(shape_of_array(name, field.type.length))
        elif field.type.kind == "struct":
            value = Pose.of(value)
        elif name in typed:
            value = bool(value) if typed[name] == "bool" else getattr(constants, typed[name])(value)
        result[name] = value
    return result
