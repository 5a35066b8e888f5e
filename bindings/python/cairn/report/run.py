# SPDX-License-Identifier: BSD-3-Clause
"""Reads the files that a run wrote into its folder."""
from __future__ import annotations

import csv
import json
import os
from typing import Any, cast

import io
import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

LARGE_TIME = 1e5            # s
WHOLE = {"id", "submap"}    # columns whose values a double may not hold exactly
WORDS = {"kind", "mode", "name", "reason", "reasons", "result", "verdict"}


class ReportError(Exception):
    """No report can be made of the folder. The message names the file and the cause."""


def _column(name: str, cells: list[Any]) -> Any:
    if name in WHOLE:
        return np.array([int(cell) for cell in cells], dtype=np.uint64)
    if name in WORDS:
        return np.array(cells, dtype=str)
    return np.array([float(cell) if cell else np.nan for cell in cells])


def _plain_table(header: list[str], body: str) -> Any:
    """Fast reader for long tables that hold only numbers."""
    body = body.replace("\r", "").replace(",,", ",nan,").replace(",,", ",nan,").replace(",\n", ",nan\n")
    if not body.strip():
        return {name: np.zeros(0) for name in header}
    values = np.loadtxt(io.StringIO(body), delimiter=",", ndmin=2)
    if values.shape[1] != len(header):
        raise ValueError(f"{values.shape[1]} fields under {len(header)} names")
    return dict(zip(header, values.T.copy()))


def read_columns(path: str, columns: list[str]) -> Any:
    """The same as read_table(). A table that lacks one of these columns is refused."""
    table = read_table(path)
    for column in columns:
        if table is not None and column not in table:
            raise ReportError(f"{path}: it has no column {column}")
    return table


def read_table(path: str) -> Any:
    """A CSV file as a dictionary of columns (NaN for an empty field), or None if there is no such file."""
    try:
        with open(path, newline="") as file:
            header = file.readline().strip().split(",")
            body = file.read()
    except FileNotFoundError:
        return None
    except (OSError, UnicodeDecodeError) as error:
        raise ReportError(f"{path}: it can't be read: {error}") from None
    try:
        if not (WHOLE | WORDS).intersection(header):
            return _plain_table(header, body)
        rows = [row for row in csv.reader(io.StringIO(body)) if row]
        for number, row in enumerate(rows):
            if len(row) != len(header):
                raise ValueError(f"line {number + 2} has {len(row)} fields under {len(header)} names")
        return {name: _column(name, [row[i] for row in rows]) for i, name in enumerate(header)}
    except ValueError as error:
        raise ReportError(f"{path}: it is not a table of numbers: {error}") from None


def read_figures(path: str) -> Any:
    """The figures of a summary.json by name. Empty if there is no such file."""
    try:
        with open(path) as file:
            found: Any = json.load(file)
    except FileNotFoundError:
        return {}
    except (OSError, ValueError) as error:
        raise ReportError(f"{path}: it can't be read: {error}") from None
    if not isinstance(found, dict):
        raise ReportError(f"{path}: it holds no figures")
    return {key: value for key, value in cast("dict[str, Any]", found).items() if isinstance(value, (int, float, str))}


class Observations:
    """The contents of innovations.csv: the first step of each landmark, the number of refused observations for each
    reason, and the number of landmarks in the filter at each step."""

    def __init__(self, path: str, closing_steps: list[Any]) -> None:
        self.first_step: dict[int, int] = {}  # by landmark id
        self.refused: dict[str, int] = {}  # number of refused observations by reason
        self.total = 0
        self.held_step: list[int] = []
        self.held: list[int] = []  # distinct landmarks observed since the last closing
        closings = sorted(closing_steps)
        held: set[str] = set()
        closed, step = 0, None
        try:
            with open(path) as file:
                columns = {name: i for i, name in enumerate(file.readline().strip().split(","))}
                if not {"step", "id", "result", "reason"} <= set(columns):
                    raise ReportError(f"{path}: it lacks one of the columns step, id, result, reason")
                at = [columns[name] for name in ("step", "id", "result", "reason")]
                for line in file:
                    fields = line.rstrip("\n").split(",")
                    number, name, result, reason = (fields[i] for i in at)
                    now = int(number)
                    if now != step:
                        if step is not None:
                            self.held_step.append(step)
                            self.held.append(len(held))
                        step = now
                        while closed < len(closings) and closings[closed] < now:
                            closed += 1
                            held = set()
                    self.total += 1
                    if result == "rejected":
                        self.refused[reason] = self.refused.get(reason, 0) + 1
                    elif name:
                        held.add(name)
                        self.first_step.setdefault(int(name), now)
                if step is not None:
                    self.held_step.append(step)
                    self.held.append(len(held))
        except FileNotFoundError:
            pass
        except (OSError, ValueError, IndexError) as error:
            raise ReportError(f"{path}: it is not a table of observations: {error}") from None


class Run:
    """The files of one run. A table without a file is None."""

    def __init__(self, folder: str, name: str | None = None) -> None:
        self.folder = folder
        self.name = name or os.path.basename(os.path.abspath(folder))
        self.trajectory = self._table("trajectory")
        if self.trajectory is None:
            raise ReportError(f"{folder}: there is no trajectory.csv: name the folder that 'cairn run --output' wrote")
        for column in ("step", "t_s", "x_m", "y_m", "z_m"):
            if column not in self.trajectory:
                raise ReportError(f"{os.path.join(folder, 'trajectory.csv')}: it has no column {column}")
        if len(self.trajectory["step"]) == 0:
            raise ReportError(f"{os.path.join(folder, 'trajectory.csv')}: it has no steps")
        self._set_clock()
        self.landmarks = self._table("landmarks")
        self.timing = self._table("timing")
        self.submaps = self._table("submaps")
        self.terrain = self._table("terrain")
        self.summary = self._json("summary")
        self.members = self._members()
        self.observations = Observations(self._path("innovations.csv"), self.closing_steps())

    def _set_clock(self) -> None:
        """Large times, for example seconds since 1970, count from the first step. A log may have no times: steps count."""
        self.timed = not np.isnan(self.trajectory["t_s"]).any()
        times = self.trajectory["t_s"] if self.timed else self.trajectory["step"]
        self.start = float(times[0]) if self.timed and abs(times[0]) > LARGE_TIME else 0.0
        self.trajectory["t_s"] = times - self.start

    def _path(self, file: str) -> str:
        return os.path.join(self.folder, file)

    def _table(self, name: str) -> Any:
        return read_table(self._path(name + ".csv"))

    def _json(self, name: str) -> Any:
        return read_figures(self._path(name + ".json"))

    def _members(self) -> dict[int, Any]:
        """Ids of the landmarks of each submap, by submap."""
        table = self._table("submap_landmarks")
        members: dict[int, Any] = {}
        if table is not None:
            for submap, landmark in zip(table["submap"].tolist(), table["id"].tolist()):
                members.setdefault(submap, []).append(landmark)
        return members

    def closing_steps(self) -> list[Any]:
        return [] if self.submaps is None else [int(step) for step in self.submaps["step"]]

    def positions(self, prefix: str = "") -> Any:
        """Positions (n x 3), m. With the prefix "true_" the true positions, or None if there is no truth."""
        columns = [self.trajectory.get(f"{prefix}{axis}_m") for axis in "xyz"]
        if any(column is None for column in columns):
            return None
        found = np.stack(columns, axis=1)
        return None if np.isnan(found).all() else found

    def times(self) -> Array:
        """Times of the steps: s since `start`. If `timed` is False they are numbers of steps."""
        times: Array = self.trajectory["t_s"]
        return times

    def time_of_steps(self, steps: Any) -> Any:
        return cast(Array, np.interp(steps, self.trajectory["step"], self.trajectory["t_s"]))

    def held_landmarks(self) -> Any:
        """Times, and the number of landmarks in the filter's state at each; None if no file has them."""
        table, seen = self.timing, self.observations
        if table is not None and "filter_landmarks" in table and len(table["step"]):
            return self.time_of_steps(table["step"]), table["filter_landmarks"]
        if seen.held:
            return self.time_of_steps(np.array(seen.held_step, float)), np.array(seen.held, float)
        return None

    def euler_error(self) -> Any:
        """True minus estimated roll, pitch and yaw (n x 3), rad, or None."""
        columns: list[Any] = []
        for angle in ("roll_rad", "pitch_rad", "yaw_rad"):
            true, estimate = self.trajectory.get("true_" + angle), self.trajectory.get(angle)
            if true is None or estimate is None or np.isnan(true).all():
                return None
            columns.append((true - estimate + np.pi) % (2 * np.pi) - np.pi)
        return np.stack(columns, axis=1)


def read_folder(folder: str) -> Any:
    """The runs of a folder: one, or `standard` and `submaps` of a comparison."""
    if not os.path.isdir(folder):
        raise ReportError(f"{folder}: there is no such folder")
    parts = [name for name in ("standard", "submaps") if os.path.isdir(os.path.join(folder, name))]
    if len(parts) == 2:
        return [Run(os.path.join(folder, name), name) for name in parts]
    return [Run(folder)]
