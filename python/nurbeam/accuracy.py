"""The errors of mesh and step that a run has estimated."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .errors import unknown

__all__ = ["Accuracy", "NumberWithError"]

Array = npt.NDArray[np.float64]


class NumberWithError(NamedTuple):
    """A number of a run with its error of mesh and step: of the finest run where the case was refined."""

    quantity: str
    value: float
    error: float
    """NaN where there is none"""
    unit: str
    relative: float
    """The error, in parts of the scale of the quantity; NaN where there is none"""
    s: float
    """Reference arc length of an extreme along a beam [m]; NaN of others"""
    time: float
    """[s]; of a static analysis the load factor; NaN of modes"""
    not_converged: str
    """Why the error is no bound; empty where it is one"""


def _number(value: Any) -> float:
    return float("nan") if value is None else float(value)


class Accuracy(Mapping[str, Array]):
    """The errors of the histories over their times, by the names of their columns: `results.accuracy["tip.y"]` belongs to
    `results["tip.y"]`. They never fall in time."""

    def __init__(self, facts: Mapping[str, Any], columns: Mapping[str, Array]):
        self._facts = dict(facts)
        self._columns = dict(columns)

    @classmethod
    def _of_directory(cls, facts: Mapping[str, Any], directory: Path) -> Accuracy:
        file = directory / "errors.csv"
        if not file.exists():
            return cls(facts, {})
        with open(file, newline="", encoding="utf-8") as stream:
            head, *rows = list(csv.reader(stream))
        values = np.array([[float(cell or "nan") for cell in row] for row in rows]).reshape(len(rows), len(head))
        names = [name.rpartition(" [")[0] for name in head]
        return cls(facts, {name: values[:, i] for i, name in enumerate(names) if name != "time"})

    def __getitem__(self, name: str) -> Array:
        if name not in self._columns:
            raise KeyError(unknown("history", name, self._columns))
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def reached(self) -> bool:
        """Whether all that was asked for is right to the target; True without a target."""
        return self._facts.get("reached") is not False

    @property
    def parted(self) -> float | None:
        """From when on the runs part, so that positions are unknown [s]; None where they do not."""
        parted = self._facts.get("parted [s]")
        return None if parted is None else float(parted)

    @property
    def runs(self) -> Sequence[Mapping[str, Any]]:
        """The runs that the errors come from, the finest first: `level`, `elements`, `step [s]`, `steps`."""
        return list(self._facts.get("runs", []))

    def table(self) -> list[NumberWithError]:
        """All numbers: histories at the end, extremes, events, modes."""
        return [
            NumberWithError(
                of["quantity"], _number(of["value"]), _number(of["error"]), of["unit"], _number(of["relative"]),
                _number(of["place"]), _number(of["time"]), of["not_converged"] or "",
            )
            for of in self._facts.get("quantities", [])
        ]  # fmt: skip

    def converged(self, name: str) -> bool:
        """Whether the errors of all numbers of that name are bounds."""
        found = [number for number in self.table() if number.quantity == name]
        if not found:
            raise KeyError(unknown("number", name, [number.quantity for number in self.table()]))
        return not any(number.not_converged for number in found)

    def __repr__(self) -> str:
        good = sum(not number.not_converged for number in self.table())
        return f"<Accuracy: {good} of {len(self.table())} numbers have a bound>"
