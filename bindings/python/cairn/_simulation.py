# SPDX-License-Identifier: BSD-3-Clause
"""The base of simulated worlds and fleets: handles of libcairn_sim that hand out one step after another."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Generic, TypeVar

from . import _structs
from ._handle import Handle
from ._library import lib
from .constants import Status
from .error import CairnError

Step = TypeVar("Step")


class Simulation(Handle, Generic[Step]):
    """Iterates over the steps. WHAT names the functions: cairn_<WHAT>_next, _rewind, _steps and the struct _step."""

    def _function(self, verb: str) -> Any:
        return getattr(lib, f"cairn_{self.WHAT}_{verb}")

    def _step(self, fields: dict[str, Any]) -> Step:
        """The Python object for a step with these fields. The handle is locked."""
        raise NotImplementedError

    def __len__(self) -> int:
        """Number of steps, the start included."""
        return int(self._ask("size_t *", self._function("steps")))

    def __iter__(self) -> Iterator[Step]:
        self.rewind()
        for _ in range(len(self)):
            yield self.next()

    def next(self) -> Step:
        """The next step. Raises StopIteration after the last step."""
        struct = _structs.sized(f"cairn_{self.WHAT}_step")
        with self._guard.lock:
            try:
                self._call(self._function("next"), struct)
            except CairnError as error:
                if error.status == Status.ERROR_STATE and not self.closed:
                    raise StopIteration from error
                raise
            fields = _structs.as_dict(struct[0])
            return self._step({name: value for name, value in fields.items() if not name.endswith("_count")})

    def rewind(self) -> None:
        """Goes back to the first step. The same drive follows again, to the bit."""
        self._call(self._function("rewind"))
