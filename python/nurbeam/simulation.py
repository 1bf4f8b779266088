"""A run that is taken step by step."""

from __future__ import annotations

import hashlib
import json
import math
import operator
import os
import tempfile
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import findings_of, tell
from .loads import Load
from .results import Results, RunError, Snapshot

if TYPE_CHECKING:
    from .signals import Signal
    from .system import System

__all__ = ["Simulation", "Checkpoint"]

Array = npt.NDArray[np.float64]
_MAGIC = b"nurbeam1"


class Checkpoint:
    """A moment that a motion can go on from: `model.simulate(..., start=checkpoint)`, in the same model with the same
    integrator, with the loads as `set_load` has left them. The step, the end and the output times may be others; where they
    are the same it goes on bit by bit as if it had not been interrupted. ValueError where
    the model is another."""

    def __init__(self, core: _core.Checkpoint, signals: Sequence[Any] = ()):
        self._core = core
        self._signals = list(signals)

    @property
    def time(self) -> float:
        """[s]"""
        return self._core.time

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes it to a file (netCDF). ValueError for one with signals, which such a file does not hold: use `to_bytes`."""
        if self._signals:
            raise ValueError("the checkpoint has signals, which its file does not hold; use to_bytes")
        self._core.save(os.fspath(file))

    def to_bytes(self) -> bytes:
        """The whole checkpoint with its signals, and a checksum (SHA-256) over all of it."""
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "checkpoint.nc")
            self._core.save(file)
            with open(file, "rb") as stream:
                state = stream.read()
        signals = [[np.asarray(part).tolist() for part in signal] for signal in self._signals]
        head = json.dumps({"signals": signals, "length": len(state)}).encode()
        body = len(head).to_bytes(8, "little") + head + state
        return _MAGIC + hashlib.sha256(body).digest() + body

    @staticmethod
    def from_bytes(data: bytes) -> Checkpoint:
        """Of what `to_bytes` has given. ValueError for anything else, and where a single bit of it has changed."""
        if data[: len(_MAGIC)] != _MAGIC:
            raise ValueError("these bytes are no checkpoint; expected those of Checkpoint.to_bytes")
        checksum, body = data[len(_MAGIC) :][:32], data[len(_MAGIC) + 32 :]
        if hashlib.sha256(body).digest() != checksum:
            raise ValueError("the checkpoint is damaged: it has not the checksum (SHA-256) that it was made with")
        start = 8 + int.from_bytes(body[:8], "little")
        signals = json.loads(body[8:start])["signals"]
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "checkpoint.nc")
            with open(file, "wb") as stream:
                stream.write(body[start:])
            return Checkpoint(Checkpoint.load(file)._core, [tuple(signal) for signal in signals])

    def __reduce__(self) -> Any:
        return Checkpoint.from_bytes, (self.to_bytes(),)

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

    def __init__(self, core: _core.LiveRun, case: _core.BuiltCase, signals: Sequence[Signal] = ()):
        self._core = core
        self._case = case
        self._signals = list(signals)

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
        return Results._of(self._core.recording, self.report, self._case.summary())

    @property
    def report(self) -> dict[str, Any]:
        """The state of the run: `status`, in words; `done`, False once it has failed or been interrupted; `time`, `steps`,
        `rejected_steps`, `newton_iterations`, `seconds`, `energy_drift` [J]. `events` are mesh adaptations and bodies at a
        beam's end, each with its `time` and `kind`. `warnings` have notes too, each with severity, position and
        message."""
        report = {**self._core.report(), "extremes": self._core.extremes()}
        collectors = json.loads(self._core.collectors())
        return {**report, "collectors": collectors} if collectors else report

    @property
    def checkpoint(self) -> Checkpoint:
        """The present moment of a motion that has begun; ValueError before its first step and in statics."""
        return Checkpoint(self._core.checkpoint(), [signal._core.state() for signal in self._signals])

    @property
    def system(self) -> System:
        """The equations of motion of the present mesh, at the present state."""
        from .system import System

        return System(_core.Equations.of(self._core))

    def set(self, signal: Signal, value: npt.ArrayLike, slope: npt.ArrayLike | None = None) -> None:
        """From now on a signal has this value, and changes by `slope` in a second, 0 when omitted. ValueError for one that
        is not of the model, and where the speed of a joint or a support would jump: see `ramp`."""
        self._set(signal, value, np.zeros(signal.size) if slope is None else slope, math.inf)

    def ramp(self, signal: Signal, value: npt.ArrayLike, by: float) -> None:
        """Takes a signal evenly from its present value to another one, where it is at the time `by` [s] and stays."""
        now = signal(self.time)
        if not by > self.time:
            raise ValueError(f"by is {by} s, but the run is at {self.time} s; give a later time")
        self._set(signal, now, (np.asarray(value, dtype=float) - now) / (by - self.time), by)

    def _set(self, signal: Signal, value: npt.ArrayLike, slope: npt.ArrayLike, until: float) -> None:
        if signal not in self._signals:
            raise ValueError(f"{signal!r} is not of this model; add it by add_force, as a motion or by set_wind first")
        self._core.set_signal(signal._core, signal._three(value), signal._three(slope), until)

    def values(self, *names: str) -> list[float]:
        """Histories at the present moment, by their names: `x, force = simulation.values("trolley.x", "upper.fz")`. Only
        what they need is computed, so that a few take less than a step. KeyError for a name that is unknown."""
        try:
            return self._core.values(list(names))
        except ValueError as problem:
            raise KeyError(str(problem)) from None

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
