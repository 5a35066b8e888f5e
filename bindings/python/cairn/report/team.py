# SPDX-License-Identifier: BSD-3-Clause
"""Reads the files that a team wrote into its folder: one run of all vehicles, or a comparison of the modes."""
from __future__ import annotations

import os
import types
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import run
from .run import ReportError

Array = NDArray[Any]

TRAJECTORY = ["step", "time", "vehicle", "x", "y", "heading", "sigma3_x", "sigma3_y", "sigma3_heading"]
LANDMARKS = ["vehicle", "id", "x", "y", "sigma3_x", "sigma3_y"]
COMPARISON = ["features", "mode", "claimed", "true", "anees", "band_low", "band_high", "rmse_m", "recursion_ms", "paper"]
STEPS = ["features", "mode", "runs", "step", "time", "vehicle", "norm_m2", "recursion_ms"]
SCENE = ["kind", "id", "x", "y", "radius"]


def _table(folder: str, name: str, columns: list[str]) -> Any:
    path = os.path.join(folder, name)
    table = run.read_columns(path, columns)
    if table is not None and len(table[columns[0]]) == 0 and columns is not LANDMARKS:
        raise ReportError(f"{path}: it has no lines")
    return table


class Vehicle:
    """The columns of one vehicle in a table, and its errors if there is truth."""

    def __init__(self, number: int, columns: dict[str, Array]) -> None:
        self.number = number
        self.columns = columns

    def __getitem__(self, name: str) -> Array:
        return self.columns[name]

    def error(self, name: str) -> Array:
        """Truth minus estimate of x, y or heading; NaN where there is no truth."""
        if f"true_{name}" not in self.columns:
            return np.full(len(self["time"]), np.nan)
        error = self[f"true_{name}"] - self[name]
        return (error + np.pi) % (2 * np.pi) - np.pi if name == "heading" else error


def _by_vehicle(table: dict[str, Array]) -> list[Vehicle]:
    return [Vehicle(int(number), {name: column[table["vehicle"] == number] for name, column in table.items()})
            for number in np.unique(table["vehicle"])]


class Scene:
    """The square that simulated boats drive in: team_scene.csv."""

    def __init__(self, table: dict[str, Array], path: str) -> None:
        self.table, self.path = table, path
        self.features = len(self._of("feature")["id"])
        self.boats = [int(number) for number in self._of("radar")["id"]]
        if len(self._of("coast")["id"]) == 0 or not self.boats:
            raise ReportError(f"{path}: it has no coast line or no radar")
        for kind in ("course", "radar"):
            for boat in self.boats:
                self.circle(kind, boat)

    def _of(self, kind: str) -> dict[str, Array]:
        chosen = self.table["kind"] == kind
        return {name: column[chosen] for name, column in self.table.items()}

    def points(self, kind: str, number: int | None = None) -> tuple[Array, Array]:
        """x and y of the coast, of the features or of the drive of boat `number`."""
        rows = self._of(kind)
        chosen = np.ones(len(rows["id"]), bool) if number is None else rows["id"] == number
        return rows["x"][chosen], rows["y"][chosen]

    def circle(self, kind: str, number: int) -> Any:
        """x, y and radius of the `course` of a boat, or of its `radar` at the start."""
        rows = self._of(kind)
        for i in np.flatnonzero(rows["id"] == number):
            return float(rows["x"][i]), float(rows["y"][i]), float(rows["radius"][i])
        raise ReportError(f"{self.path}: boat {number} has no {kind}")


class Steps:
    """Claimed uncertainty and time of each vehicle at each step: team_steps.csv."""

    def __init__(self, table: dict[str, Array], _: str) -> None:
        self.table = table
        self.features = sorted({int(number) for number in table["features"]})
        self.modes = list(dict.fromkeys(table["mode"].tolist()))
        self.vehicles = sorted({int(number) for number in table["vehicle"]})
        self.runs = int(table["runs"].max())

    def compares(self) -> bool:
        """Whether there are steps with a team and steps without."""
        return "mono" in self.modes and len(self.modes) > 1

    def curve(self, column: str, features: int, mode: str, vehicle: int) -> tuple[Array, Array]:
        """Times and values of a column. Empty if the mode was not run with this number of features."""
        chosen = ((self.table["features"] == features) & (self.table["mode"] == mode)
                  & (self.table["vehicle"] == vehicle))
        return self.table["time"][chosen], self.table[column][chosen]

    def improvement(self, features: int, mode: str, vehicle: int) -> tuple[Array, Array]:
        """Times, and by how much the norm is smaller than in the mode mono, in %; NaN where the norm of mono is 0."""
        times, norm = self.curve("norm_m2", features, mode, vehicle)
        alone_times, alone = self.curve("norm_m2", features, "mono", vehicle)
        if len(times) == 0 or not np.array_equal(times, alone_times):
            return np.zeros(0), np.zeros(0)
        with np.errstate(divide="ignore", invalid="ignore"):
            return times, np.where(alone > 0, 100 * (alone - norm) / alone, np.nan)


def _read(folder: str, name: str, columns: list[str], kind: Any) -> Any:
    table = _table(folder, name, columns)
    return None if table is None else kind(table, os.path.join(folder, name))


class TeamRun:
    """The files of 'cairn simulate usv --output' or of 'cairn run' on an MRCLAM folder."""

    def __init__(self, folder: str) -> None:
        self.folder = folder
        self.name = os.path.basename(os.path.abspath(folder))
        self.vehicles = _by_vehicle(_table(folder, "team_trajectories.csv", TRAJECTORY))
        landmarks = _table(folder, "team_landmarks.csv", LANDMARKS)
        self.maps = _by_vehicle(landmarks) if landmarks is not None else []
        self.summary = run.read_figures(os.path.join(folder, "summary.json"))
        self.scene = _read(folder, "team_scene.csv", SCENE, Scene)
        self.steps = _read(folder, "team_steps.csv", STEPS, Steps)
        self.observations = types.SimpleNamespace(refused={})  # no file holds them

    def drawn_features(self) -> list[int]:
        """The numbers of features with which the scene can be drawn."""
        return [] if self.scene is None else [self.scene.features]

    def one_map(self) -> bool:
        """Whether all vehicles hold the same map. They do if all run the same filter."""
        if not self.maps:
            return True
        first = self.maps[0]
        return all(np.array_equal(one["id"], first["id"]) and np.allclose(one["x"], first["x"], rtol=0, atol=1e-6)
                   and np.allclose(one["y"], first["y"], rtol=0, atol=1e-6) for one in self.maps)


class TeamComparison:
    """The files of 'cairn simulate usv --compare --output': rows by number of features and mode."""

    def __init__(self, folder: str) -> None:
        self.folder = folder
        self.name = os.path.basename(os.path.abspath(folder))
        self.table = _table(folder, "team_compare.csv", COMPARISON)
        self.features = sorted({int(number) for number in self.table["features"]})
        self.modes = list(dict.fromkeys(self.table["mode"].tolist()))
        self.scene = _read(folder, "team_scene.csv", SCENE, Scene)
        self.steps = _read(folder, "team_steps.csv", STEPS, Steps)

    def drawn_features(self) -> list[Any]:
        """The numbers of features with which the scene can be drawn: the first features are those of the smaller worlds."""
        return [] if self.scene is None else self.features

    def value(self, column: str, features: int, mode: str) -> float:
        """One figure; NaN if the mode was not run with this number of features."""
        found = (self.table["features"] == features) & (self.table["mode"] == mode)
        return float(self.table[column][found][0]) if found.any() else float("nan")


def read_folder(folder: str) -> Any:
    """A TeamRun or a TeamComparison, or None if the folder holds neither. If the folder was used for both, its
    summary.json decides."""
    has_run, has_comparison = (os.path.isfile(os.path.join(folder, name))
                               for name in ("team_trajectories.csv", "team_compare.csv"))
    if has_run and has_comparison:
        has_comparison = "vehicles" not in run.read_figures(os.path.join(folder, "summary.json"))
    if has_comparison:
        return TeamComparison(folder)
    return TeamRun(folder) if has_run else None
