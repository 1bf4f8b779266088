"""Curves, and the CAD files that they stand in."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import CadError, Finding, findings_of, tell, unknown

__all__ = ["Curve", "Curves", "ClosestPoint", "read", "write"]

Array = npt.NDArray[np.float64]


class ClosestPoint(NamedTuple):
    """The place of a curve that is nearest to a point."""

    parameter: float
    point: Array
    """(3,) [m]"""
    distance: float
    """[m]"""


def _points(values: npt.ArrayLike, name: str) -> Array:
    points = np.asarray(values, dtype=float)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"{name} have the shape {points.shape}; expected (n, 3): x, y and z of each, in metres")
    return np.ascontiguousarray(points)


def _point(values: npt.ArrayLike, name: str) -> Array:
    point = np.asarray(values, dtype=float)
    if point.shape != (3,):
        raise ValueError(f"{name} has the shape {point.shape}; expected (3,): x, y and z, in metres")
    return point


def _whole(value: Any, name: str) -> int:
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}; expected a whole number") from None


class Curve:
    """A NURBS curve in metres. It does not change: what changes a curve returns another one.

    Parameters
    ----------
    control_points
        (n, 3), in metres, not multiplied by the weights.
    knots
        All n + degree + 1 of them, not decreasing, both ends included. When omitted, those of a clamped curve with
        equal spans on [0, 1].
    degree
        3 unless said otherwise, or less where there are fewer points.
    weights
        (n,), positive; 1 when omitted.
    name
        Under which it is written into files.

    ValueError, with the value and the rule, for what is no curve.
    """

    def __init__(
        self,
        control_points: npt.ArrayLike,
        knots: npt.ArrayLike | None = None,
        degree: int | None = None,
        weights: npt.ArrayLike | None = None,
        name: str = "",
    ):
        points = _points(control_points, "control points")
        n = len(points)
        if n < 2:
            raise ValueError(f"{n} control point(s); a curve has at least 2")
        p = min(3, n - 1) if degree is None else _whole(degree, "degree")
        if knots is None:
            inner = np.linspace(0, 1, n - p + 1)[1:-1] if n > p else np.empty(0)
            knots = np.concatenate([np.zeros(p + 1), inner, np.ones(p + 1)])
        w = np.ones(n) if weights is None else np.asarray(weights, dtype=float)
        self._nurbs = _core.Nurbs(p, [float(k) for k in np.asarray(knots, dtype=float)], points, w)
        self.name = name
        self.facts: dict[str, Any] = {}

    @classmethod
    def _of(cls, nurbs: _core.Nurbs, name: str = "", facts: Mapping[str, Any] | None = None) -> Curve:
        curve = cls.__new__(cls)
        curve._nurbs = nurbs
        curve.name = name
        curve.facts = dict(facts or {})
        return curve

    @staticmethod
    def line(start: npt.ArrayLike, end: npt.ArrayLike, name: str = "") -> Curve:
        """The straight line between two points [m]."""
        return Curve._of(_core.line(_point(start, "start"), _point(end, "end")), name)

    @staticmethod
    def arc(
        center: npt.ArrayLike, start: npt.ArrayLike, end: npt.ArrayLike, normal: npt.ArrayLike, name: str = ""
    ) -> Curve:
        """The circular arc from `start` to `end` about `center` [m], by the right hand about `normal`; a whole circle
        where start and end are one. Exact: a rational curve."""
        parts = [_point(p, n) for p, n in ((center, "center"), (start, "start"), (end, "end"), (normal, "normal"))]
        return Curve._of(_core.arc(*parts), name)

    @property
    def degree(self) -> int:
        """Of its pieces between knots."""
        return self._nurbs.degree

    @property
    def knots(self) -> Array:
        """All knots, (n + degree + 1,)."""
        return self._nurbs.knots

    @property
    def control_points(self) -> Array:
        """(n, 3) [m], not multiplied by the weights."""
        return self._nurbs.control_points

    @property
    def weights(self) -> Array:
        """(n,)"""
        return self._nurbs.weights

    @property
    def is_rational(self) -> bool:
        """Whether the weights differ."""
        return self._nurbs.is_rational()

    @property
    def start(self) -> float:
        """The parameter that it starts at."""
        return self._nurbs.start

    @property
    def end(self) -> float:
        """The parameter that it ends at."""
        return self._nurbs.end

    @property
    def length(self) -> float:
        """[m], to a relative error of about 1e-13."""
        return self._nurbs.length()

    def __call__(self, parameter: npt.ArrayLike) -> Array:
        """Points at parameters between `start` and `end`: (3,) for one, (..., 3) for an array of them [m]."""
        u = np.asarray(parameter, dtype=float)
        return self._nurbs.points(u.ravel()).reshape(u.shape + (3,))

    def derivatives(self, parameter: npt.ArrayLike, n: int = 1) -> Array:
        """The point and its first n derivatives by the parameter: (n + 1, 3) for one, (..., n + 1, 3) for an array of them
        [m]."""
        u, n = np.asarray(parameter, dtype=float), _whole(n, "n")
        found = [self._nurbs.derivatives(float(each), n) for each in u.ravel()]
        return np.array(found).reshape(u.shape + (n + 1, 3))

    def sample(self, count: int = 200) -> Array:
        """Points at `count` equally spaced parameters, (count, 3) [m]."""
        return self(np.linspace(self.start, self.end, count))

    def closest_point(self, point: npt.ArrayLike) -> ClosestPoint:
        """The place nearest to a point [m]; of several equally near ones any."""
        return ClosestPoint(*self._nurbs.closest(_point(point, "point")))

    def insert_knot(self, parameter: float, times: int = 1) -> Curve:
        """The same curve with one more knot, or several."""
        return Curve._of(self._nurbs.insert_knot(float(parameter), _whole(times, "times")), self.name)

    def to_bezier(self) -> list[Curve]:
        """Its pieces between knots, each a curve on [0, 1] with degree + 1 control points."""
        return [Curve._of(piece, self.name) for piece in self._nurbs.bezier()]

    def to_cubic(self, tolerance: float = 1e-6) -> tuple[Curve, float]:
        """A cubic curve, as beams are made of, and a bound on how far points of the two at one parameter are apart [m]: 0
        up to degree 3, which is exact, else proven and at most the tolerance [m], greater than 0; one below 1e-14 of the
        size of the coordinates is taken as that."""
        if not tolerance > 0:
            raise ValueError(f"tolerance {tolerance} is not positive")
        nurbs, deviation = self._nurbs.cubics(tolerance)
        return Curve._of(nurbs, self.name), deviation

    def reversed(self) -> Curve:
        """The same curve run through backwards."""
        return Curve._of(self._nurbs.reversed(), self.name, self.facts)

    def __repr__(self) -> str:
        kind = "rational " if self.is_rational else ""
        name = f' "{self.name}"' if self.name else ""
        return (
            f"<{kind}Curve{name} of degree {self.degree}, {len(self.weights)} control points, length {self.length:.6g} m>"
        )

    def _repr_svg_(self) -> str:
        from .drawing import svg

        return svg([self.sample()])

    def _axis(self) -> dict[str, Any]:
        """As a case has it."""
        axis: dict[str, Any] = {
            "degree": self.degree,
            "knots": self.knots.tolist(),
            "control_points": self.control_points.tolist(),
        }
        if self.is_rational:
            axis["weights"] = self.weights.tolist()
        return {"nurbs": axis}


class Curves(Sequence[Curve]):
    """The curves of a CAD file, in its order; by number or by name. `unit` is the file's length unit (the curves are in
    metres), `findings` what is to be said of the file."""

    def __init__(self, curves: Iterable[Curve], unit: str, findings: Sequence[Finding]):
        self._curves = list(curves)
        self.unit = unit
        self.findings = list(findings)

    @property
    def names(self) -> list[str]:
        """Of the curves; "" for those without."""
        return [curve.name for curve in self._curves]

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            for curve in self._curves:
                if curve.name == key:
                    return curve
            raise KeyError(unknown("curve", key, {name for name in self.names if name}))
        return self._curves[key]

    def __len__(self) -> int:
        return len(self._curves)

    def __iter__(self) -> Iterator[Curve]:
        return iter(self._curves)

    def __repr__(self) -> str:
        return "[" + ",\n ".join(map(repr, self._curves)) + "]"

    def _repr_svg_(self) -> str:
        from .drawing import svg

        return svg([curve.sample() for curve in self._curves])


def read(file: str | os.PathLike[str]) -> Curves:
    """All curves of a STEP, IGES, DXF or BREP file. What each is in its file (layer, colour, part, radius of the pipe
    whose centre line it is, ...) stands in `curve.facts`.

    CadError where the file cannot be read; warnings of single curves become Python's."""
    curves, unit, plain = _core.read_curves(os.fspath(file))
    findings = findings_of(plain)
    if any(finding.severity == "error" for finding in findings):
        raise CadError(findings)
    tell(findings)
    return Curves((Curve._of(nurbs, facts["name"], facts) for nurbs, facts in curves), unit, findings)


def write(
    file: str | os.PathLike[str],
    curves: Curve | Iterable[Curve],
    unit: str = "mm",
    schema: str = "ap214",
) -> None:
    """Writes curves to a file whose extension says its format: .step, .iges, .dxf or .brep; each exactly, as one B-spline
    curve under its name, in the unit ("mm", "m" or "inch"). `schema` is that of STEP: "ap214" or "ap242".

    CadError where it cannot be written, ValueError for an unknown extension or unit."""
    if schema not in ("ap214", "ap242"):
        raise ValueError(unknown("schema", schema, ["ap214", "ap242"]))
    several = [curves] if isinstance(curves, Curve) else list(curves)
    for i, each in enumerate(several, 1):
        if not isinstance(each, Curve):
            raise TypeError(f"curve {i} is {each!r}; expected a Curve")
    named = [(curve.name or f"curve {i}", curve._nurbs) for i, curve in enumerate(several, 1)]
    findings = findings_of(_core.write_curves(os.fspath(file), named, unit, schema))
    if any(finding.severity == "error" for finding in findings):
        raise CadError(findings)
    tell(findings)
