# SPDX-License-Identifier: BSD-3-Clause
"""Reads what a run says about its own trustworthiness: health.csv, systematic.csv and the two trajectories."""
from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import run as run_files
from .run import ReportError

Array = NDArray[Any]

HEALTH = ["step", "t_s", "verdict", "reasons"]
SYSTEMATIC = ["step", "time", "name", "value", "sigma"]
VERDICTS = ["good", "doubtful", "lost"]


def _table(folder: str, name: str, columns: list[str]) -> Any:
    table = run_files.read_columns(os.path.join(folder, name), columns)
    return table if table is not None and len(table[columns[0]]) else None


def _clock(table: dict[str, Array], column: str, start: float) -> Array:
    """Times since `start`, or the numbers of the steps: a log may have no times."""
    return table["step"] if np.isnan(table[column]).any() else table[column] - start


class Health:
    """The verdict of each step with its reasons, and the columns of numbers."""

    def __init__(self, table: dict[str, Array], path: str, start: float) -> None:
        self.times = _clock(table, "t_s", start)
        self.numbers = {name: column for name, column in table.items() if column.dtype.kind == "f"}
        unknown = sorted(set(table["verdict"].tolist()) - set(VERDICTS))
        if unknown:
            raise ReportError(f"{path}: unknown verdict '{unknown[0]}'")
        self.level = np.array([VERDICTS.index(word) for word in table["verdict"].tolist()])
        named: list[set[str]] = [set(words.split("|")) - {""} for words in table["reasons"].tolist()]
        words_of = sorted({word for words in named for word in words})
        self.reasons = {word: np.array([word in words for words in named]) for word in words_of}

    def column(self, name: str) -> Any:
        """A column of numbers, or None if the file has no such column or only empty fields."""
        found = self.numbers.get(name)
        return None if found is None or np.isnan(found).all() else found


def health_of(folder: str, start: float = 0.0) -> Any:
    """The Health of a run, or None if it has no health.csv with steps."""
    table = _table(folder, "health.csv", HEALTH)
    return None if table is None else Health(table, os.path.join(folder, "health.csv"), start)


def systematic_of(folder: str, start: float = 0.0) -> Any:
    """(name, unit, times, values, sigmas) of each estimated systematic error."""
    table = _table(folder, "systematic.csv", SYSTEMATIC)
    if table is None:
        return []
    found: list[Any] = []
    times = _clock(table, "time", start)
    for name in dict.fromkeys(table["name"].tolist()):
        chosen = table["name"] == name
        title, _, unit = name.partition("[")
        found.append((title.strip(), unit.rstrip("] "), times[chosen],
                      *(table[column][chosen] for column in ("value", "sigma"))))
    return found


def tum_of(folder: str, name: str, start: float = 0.0) -> Any:
    """Times since `start` (n) and positions (n x 3) of a trajectory in TUM form, or None if there is no such file with poses."""
    path = os.path.join(folder, name)
    try:
        with open(path) as file:
            rows = [line.split() for line in file if line.strip() and not line.startswith("#")]
    except FileNotFoundError:
        return None
    except (OSError, UnicodeDecodeError) as error:
        raise ReportError(f"{path}: it can't be read: {error}") from None
    if not rows:
        return None
    if any(len(row) != 8 for row in rows):
        raise ReportError(f"{path}: a line has not the eight numbers time x y z qx qy qz qw")
    try:
        values = np.array(rows, dtype=float)
    except ValueError as error:
        raise ReportError(f"{path}: it is not a table of numbers: {error}") from None
    return values[:, 0] - start, values[:, 1:4]


class Trust:
    """All of it for one run, with times that count from `start`. Each part may be missing."""

    def __init__(self, folder: str, start: float = 0.0) -> None:
        self.health = health_of(folder, start)
        self.systematic = systematic_of(folder, start)
        self.online, self.corrected = (tum_of(folder, f"trajectory_{name}.tum", start) for name in ("online", "corrected"))
