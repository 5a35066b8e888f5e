# SPDX-License-Identifier: BSD-3-Clause
"""The base of simulated worlds and fleets: handles of libcairn_sim that hand out one step after another."""
from . import _structs
from ._handle import Handle
from ._library import ffi, lib
from .error import CairnError, check


def check_sim(status):
    """Raises a CairnError with the message of libcairn_sim if `status` is an error."""
    check(status, "cairn_sim_last_message")


class Simulation(Handle):
    """Iterates over the steps. WHAT names the functions: cairn_<WHAT>_next, _rewind, _steps and the struct _step."""

    def _function(self, verb):
        return getattr(lib, f"cairn_{self.WHAT}_{verb}")

    def _step(self, struct):
        """The Python object for a filled struct. It must copy all arrays, which the next step overwrites."""
        raise NotImplementedError

    def __len__(self):
        """Number of steps, the start included."""
        steps = ffi.new("size_t *")
        with self._use() as handle:
            check_sim(self._function("steps")(handle, steps))
        return steps[0]

    def __iter__(self):
        self.rewind()
        for _ in range(len(self)):
            yield self.next()

    def next(self):
        """The next step. Raises StopIteration after the last step."""
        struct = _structs.sized(f"cairn_{self.WHAT}_step")
        with self._use() as handle:
            try:
                check_sim(self._function("next")(handle, struct))
            except CairnError as error:
                if error.status == lib.CAIRN_ERROR_STATE:
                    raise StopIteration from None
                raise
            return self._step(struct)

    def rewind(self):
        """Goes back to the first step. The same drive follows again, to the bit."""
        with self._use() as handle:
            check_sim(self._function("rewind")(handle))
