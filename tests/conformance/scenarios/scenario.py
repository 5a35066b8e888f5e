# SPDX-License-Identifier: BSD-3-Clause
"""A scenario: a list of calls. README.md describes it."""


class Scenario:
    """Collects calls. Inputs are keyword arguments by the names of the C parameters."""

    def __init__(self, name, about):
        self.name = name
        self.about = about
        self.calls = []

    def call(self, function, gives=None, tolerance=None, **inputs):
        """A call that succeeds. `gives` names outputs; the others are recorded. Returns the first name."""
        entry = {"call": function}
        if inputs:
            entry["with"] = inputs
        if gives:
            entry["gives"] = dict(gives)
        if tolerance is not None:
            entry["tolerance"] = tolerance
        self.calls.append(entry)
        return next(iter(gives.values())) if gives else None

    def wrong(self, status, function, **inputs):
        """A call that fails with this status. Its message is recorded."""
        entry = {"call": function}
        if inputs:
            entry["with"] = inputs
        entry["status"] = "CAIRN_ERROR_" + status
        self.calls.append(entry)


def number(value):
    """A double: a number, or the name of one that JSON has not ("nan", "inf", "-inf")."""
    return value if isinstance(value, str) else float(value)


def pose(x=0.0, y=0.0, z=0.0, quaternion=(1.0, 0.0, 0.0, 0.0)):
    """A pose: position and quaternion w x y z."""
    return {"position": [number(x), number(y), number(z)], "quaternion": [number(value) for value in quaternion]}


def diagonal(*variances):
    """A covariance without correlations, row-major."""
    size = len(variances)
    return [number(variances[r]) if r == c else 0.0 for r in range(size) for c in range(size)]


def seen(landmark, *z):
    """An observation of a landmark."""
    return {"id": str(landmark), "z": [number(value) for value in (*z, 0.0, 0.0)[:3]]}
