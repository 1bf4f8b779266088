"""Inputs of a run that goes on."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from .checked import reduced

__all__ = ["Signal"]


class Signal:
    """A number, or a vector in world coordinates, that a run reads at its time, and that you set between its steps::

        pull = nb.Signal([0, 0, -50])
        model.add_force(pull, beam=cable, at={"fraction": 0.5})
        simulation = model.simulate(end_time=5, step="2 ms")
        while simulation.run_until(simulation.time + 0.01):
            simulation.set(pull, [0, 0, -50 - 10 * simulation.time], slope=[0, 0, -10])

    It is a force [N] in `model.add_force`, the speed of a joint or a support [m/s] as their `motion`, or the wind [m/s]
    in `model.set_wind`. Setting it is no change of the model: nothing is built anew and no integrator restarts. With
    its slope the motion is of the second order in the time between two settings, constant between them of the first. A signal
    belongs to one run at a time; a run begins with the value that it was made with.
    """

    def __init__(self, value: npt.ArrayLike = 0.0):
        numbers = np.atleast_1d(np.asarray(value, dtype=float))
        if numbers.shape not in ((1,), (3,)):
            raise ValueError(f"the value of a signal has the shape {np.shape(value)}; expected a number or (3,)")
        self.size: int = numbers.size
        """1 or 3 numbers."""
        self._first = numbers
        self._core = _core.Signal(self.size, self._three(numbers))

    def __call__(self, t: float) -> float | npt.NDArray[np.float64]:
        """Its value at a time [s]."""
        value = self._core(t)
        return float(value[0]) if self.size == 1 else value

    def _three(self, value: npt.ArrayLike) -> npt.NDArray[np.float64]:
        numbers = np.atleast_1d(np.asarray(value, dtype=float))
        if numbers.shape != (self.size,):
            raise ValueError(
                f"the value has the shape {np.shape(value)}; expected {'a number' if self.size == 1 else '(3,)'}"
            )
        return np.concatenate([numbers, np.zeros(3 - self.size)])

    def _begin(self, state: Any = None) -> None:
        """Of a run, which goes on with a state or begins with the first value."""
        none = np.zeros(3)
        self._core.restore(state or (self.size, self._three(self._first), none, none, 0.0, float("inf"), False))

    def __reduce__(self) -> Any:
        return reduced(Signal, float(self._first[0]) if self.size == 1 else self._first.tolist())

    def __repr__(self) -> str:
        return f"<Signal that begins with {self._first[0] if self.size == 1 else self._first.tolist()}>"
