"""A run that is taken step by step."""

from __future__ import annotations

import math
import operator
import os
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import findings_of, tell
from .loads import Load
from .results import Results, RunError, Snapshot

if TYPE_CHECKING:
    from .system import System

__all__ = ["Simulation", "Checkpoint"]

Array = npt.NDArray[np.float64]


class Checkpoint:
    """A moment that a motion can go on from: `model.simulate(..., start=checkpoint)`, in the same model with the same
    integrator, with the loads as `set_load` has left them. The step, the end and the output times may be others; where they
    are the same it goes on bit by bit as if it had not been interrupted (with `ida` within its tolerance). ValueError where
    the model is another."""

    def __init__(self, core: _core.Checkpoint):
        self._core = core

    @property
    def time(self) -> float:
        """[s]"""
        return self._core.time

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes it to a file (netCDF)."""
        self._core.save(os.fspath(file))

    @staticmethod
    def load(file: str | os.PathLike[str]) -> Checkpoint:
        """Reads one that `save`, or a run into a directory (`restart.nc`), has written. OSError where there is no such
        file, ValueError where it is another."""
        os.stat(file)
        try:
            return Checkpoint(_core.Checkpoint.load(os.fspath(file)))
        except RuntimeError as problem:
            raise ValueError(f"{os.fspath(file)!r} is no checkpoint that can be read: {problem}") from None


class Simulation:
    """A run of a model that is taken step by step, as `model.simulate(...)` returns it.

    Iterating goes from output time to output time and gives the snapshots; `step` takes single steps. Both may be mixed,
    and loads changed in between. It belongs to one thread at a time; Python goes on in others while it computes.
    """

    def __init__(self, core: _core.LiveRun, case: _core.BuiltCase):
        self._core = core
        self._case = case

    def __iter__(self) -> Iterator[Snapshot]:
        """Snapshots at the output times, from the present one to the end of the run. RunError where it ends before."""
        while (frame := self._core.next()) is not None:
            yield Snapshot(frame)
        self._check()

    def step(self) -> bool:
        """Takes the next step: first what leads to the state at time 0, then steps of the integrator, each with the
        events that follow from it (in statics: the next load factor). Returns whether more are to come; RunError where
        the run has failed."""
        more = self._core.step()
        if not more:
            self._check()
        return more

    def run_until(self, time: float) -> bool:
        """Takes steps until the time [s] is reached. Returns whether more are to come. ValueError for no number."""
        if math.isnan(time):
            raise ValueError("time is not a number")
        more = not self.ended
        while more and (self.time < time or not self._core.begun):
            more = self.step()
        return more

    def run(self, told: Callable[[float], None] | None = None) -> Results:
        """Runs to the end; `told` is called with each output time."""
        while (frame := self._core.next()) is not None:
            if told:
                told(frame.time)
        self._check()
        return self.results

    @property
    def time(self) -> float:
        """Simulated until now [s]."""
        return self._core.time

    @property
    def ended(self) -> bool:
        """Whether there is nothing more to come."""
        return self._core.ended

    @property
    def snapshot(self) -> Snapshot:
        """The present state, at an output time or not."""
        return Snapshot(self._core.now())

    @property
    def results(self) -> Results:
        """The snapshots until now."""
        return Results._of(self._core.recording, self.report)

    @property
    def report(self) -> dict[str, Any]:
        """What the run has come to: `status`, in words; `done`, False once it has failed or been interrupted; `time`,
        `steps`, `rejected_steps`, `newton_iterations`, `seconds`, `energy_drift` [J], `events` (changes of the mesh, bodies
        at a beam's end, each with its `time` and `kind`), `warnings` (notes too, each its severity, its place and its
        message)."""
        return self._core.report()

    @property
    def checkpoint(self) -> Checkpoint:
        """The present moment of a motion that has begun; ValueError before its first step and in statics."""
        return Checkpoint(self._core.checkpoint())

    @property
    def system(self) -> System:
        """The equations of motion of the present mesh, at the present state."""
        from .system import System

        return System(_core.Equations.of(self._core))

    def set_load(self, load: Load | int, value: npt.ArrayLike) -> None:
        """Gives a load another value from now on, a vector in world coordinates: three numbers, in N for a force, N m for
        a moment, N/m for a force per length; texts with units are for models alone. `load` is what `model.add_load` has
        returned, or its number among the loads of the case; where it is on a beam of several chains it changes on each."""
        number: Any = getattr(load, "number", load)
        try:
            number = operator.index(number)
        except TypeError:
            raise ValueError(f"the load is {load!r}; expected what add_load has returned, or a number") from None
        if number < 0:
            raise ValueError(f"the load is {number}; they are counted from 0")
        try:
            vector = np.asarray(value, dtype=float)
        except (TypeError, ValueError):
            raise ValueError(f"the value of a load is {value!r}; expected three numbers, in N, N m or N/m") from None
        if vector.shape != (3,):
            raise ValueError(f"the value of a load has the shape {vector.shape}; expected (3,)")
        self._core.change_load(number, vector)

    def _check(self) -> None:
        report = self.report
        if not report["done"]:
            raise RunError(report["status"], self.results)
        tell(findings_of(report["warnings"]))

    def __repr__(self) -> str:
        return f'<Simulation of "{self._case.name}" at {self.time:.6g} of {self._case.end_time:.6g} s>'
