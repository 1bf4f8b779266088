"""Curves, and the CAD files that they stand in."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from .checked import reduced
from .errors import CadError, Finding, MissingCadFile, findings_of, tell, unknown

__all__ = ["Curve", "Curves", "ClosestPoint", "read", "write"]

Array = npt.NDArray[np.float64]


class ClosestPoint(NamedTuple):
    """The point of a curve that is nearest to a point."""

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

    def __reduce__(self) -> Any:
        """Pickled to the last bit."""
        return reduced(Curve._of, self._nurbs, self.name, self.facts)

    @staticmethod
    def circle(center: npt.ArrayLike, radius: float, normal: npt.ArrayLike = (0, 0, 1), name: str = "") -> Curve:
        """The whole circle about `center` [m], by the right hand about `normal`. Exact: a rational curve. It starts along
        x from the centre, or along y where the normal is x."""
        if not radius > 0:
            raise ValueError(f"the radius of a circle is {radius} m; must be positive")
        middle, axis = _point(center, "center"), _point(normal, "normal")
        if not np.linalg.norm(axis) > 0:
            raise ValueError("the normal of a circle must have a direction")
        axis = axis / np.linalg.norm(axis)
        across = np.eye(3)[0] if abs(axis[0]) < 1 - 1e-9 else np.eye(3)[1]
        across = across - across.dot(axis) * axis
        start = middle + radius * across / np.linalg.norm(across)
        return Curve.arc(middle, start, start, axis, name)

    @staticmethod
    def through(
        points: npt.ArrayLike,
        degree: int | None = None,
        tangents: npt.ArrayLike | None = None,
        closed: bool = False,
        name: str = "",
    ) -> Curve:
        """The smooth curve through points, (n, 3) in metres and in their order, exact at each; `Curve(points)` takes control
        points, which lie beside the curve. Its parameter is the length of the chords between them. `degree` is 3 unless said
        otherwise, or less where there are fewer points. `tangents` are directions: (2, 3) at both ends, or (n, 3) at every
        point. A `closed` curve is smooth where its end meets its start; the first point need not be repeated."""
        given = _points(points, "points")
        directions = None if tangents is None else _points(tangents, "tangents")
        usual = 3 if closed or tangents is not None else max(1, min(3, len(given) - 1))
        p = usual if degree is None else _whole(degree, "degree")
        return Curve._of(_core.through(given, p, directions, bool(closed)), name)

    @staticmethod
    def from_dict(values: Mapping[str, Any]) -> Curve:
        """The curve of a `to_dict`, or of the "axis" of a case that is an inline NURBS curve."""
        inner = values.get("nurbs", values)
        known = {"degree", "knots", "control_points", "weights", "name"}
        for key in inner:
            if key not in known:
                raise KeyError(unknown("key", key, known))
        for key in ("degree", "knots", "control_points"):
            if key not in inner:
                raise KeyError(f'"{key}" is missing; a curve has "degree", "knots" and "control_points"')
        weights, name = inner.get("weights"), inner.get("name", "")
        return Curve(inner["control_points"], inner["knots"], inner["degree"], weights, name)

    def to_dict(self) -> dict[str, Any]:
        """Lists of numbers for JSON, under the keys of an inline NURBS curve of a case: "degree", "knots",
        "control_points", and "weights" and "name" where there are."""
        values: dict[str, Any] = dict(self._axis()["nurbs"])
        return {**values, "name": self.name} if self.name else values

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
        """The point nearest to a point [m]; of several equally near ones any."""
        return ClosestPoint(*self._nurbs.closest(_point(point, "point")))

    def insert_knot(self, parameter: float, times: int = 1) -> Curve:
        """The same curve with one more knot, or several."""
        return Curve._of(self._nurbs.insert_knot(float(parameter), _whole(times, "times")), self.name)

    def to_bezier(self) -> list[Curve]:
        """Its pieces between knots, each a curve on [0, 1] with degree + 1 control points."""
        return [Curve._of(piece, self.name) for piece in self._nurbs.bezier()]

    def to_cubic(self, tolerance: float = 1e-6) -> tuple[Curve, float]:
        """The cubic curve of a beam, and a bound on the distance of both curves at one parameter [m]. The bound is 0 up
        to degree 3, which is exact; otherwise it is proven and at most the tolerance [m], greater than 0. A tolerance
        below 1e-14 of the size of the coordinates is taken as that."""
        if not tolerance > 0:
            raise ValueError(f"tolerance {tolerance} is not positive")
        nurbs, deviation = self._nurbs.cubics(tolerance)
        return Curve._of(nurbs, self.name), deviation

    def join(self, *others: Curve) -> Curve:
        """This curve and others behind it as one. ValueError where an end is not the next start, to a millionth of the
        length."""
        return Curve._of(_core.joined([self._nurbs, *(other._nurbs for other in others)]), self.name)

    def split_at(self, parameter: float | Sequence[float]) -> list[Curve]:
        """Its pieces between these parameters; each keeps the parameters of the curve. ValueError for one that is not
        between the first and the last of the curve."""
        at = [float(each) for each in np.atleast_1d(np.asarray(parameter, dtype=float))]
        first, last = float(self.knots[0]), float(self.knots[-1])
        for each in at:
            if not first < each < last:
                raise ValueError(f"cannot be split at {each:.6g}; the parameters of the curve lie between {first:.6g} and {last:.6g}")
        return [Curve._of(piece, self.name) for piece in self._nurbs.split_at(at)]

    def transformed(self, matrix: npt.ArrayLike) -> Curve:
        """The curve moved by an affine map, (3, 3), (3, 4) or (4, 4): turned by its first three columns, then shifted by
        the fourth [m]."""
        given = np.asarray(matrix, dtype=float)
        if given.shape == (4, 4) and not np.array_equal(given[3], [0, 0, 0, 1]):
            raise ValueError(f"the last row of the matrix is {given[3]}; must be [0, 0, 0, 1]")
        if given.shape not in ((3, 3), (3, 4), (4, 4)):
            raise ValueError(f"the matrix has the shape {given.shape}; expected (3, 3), (3, 4) or (4, 4)")
        moved = np.zeros((3, 4))
        moved[:, : given.shape[1]] = given[:3]
        return Curve._of(self._nurbs.moved(moved), self.name)

    def curvature(self, parameter: npt.ArrayLike) -> Array:
        """At parameters, one number or an array of them [1/m]."""
        d = self.derivatives(parameter, 2)
        first, second = d[..., 1, :], d[..., 2, :]
        return np.asarray(np.linalg.norm(np.cross(first, second), axis=-1) / np.linalg.norm(first, axis=-1) ** 3)

    def parameter_at(self, length: npt.ArrayLike) -> Array:
        """The parameters where the curve is so long from its start on [m]; one number, a text with a unit ("10 m") or an
        array of numbers."""
        s = np.asarray(_core.length_of(length) if isinstance(length, str) else length, dtype=float)
        return np.array([self._nurbs.parameter_at(float(each)) for each in s.ravel()]).reshape(s.shape)[()]

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

    CadError where the file cannot be read, also a FileNotFoundError where it is not there; warnings of single curves become Python's."""
    curves, unit, plain = _core.read_curves(os.fspath(file))
    findings = findings_of(plain)
    if any(finding.severity == "error" for finding in findings):
        raise (CadError if os.path.exists(file) else MissingCadFile)(findings)
    tell(findings)
    return Curves((Curve._of(nurbs, facts["name"], facts) for nurbs, facts in curves), unit, findings)


def _check_name(name: str, number: int) -> None:
    if len(name) > 250:
        raise ValueError(f"the name of curve {number} has {len(name)} characters: {name[:40]!r}...; at most 250")
    if barred := [c for c in name if ord(c) < 32 or ord(c) == 127]:
        raise ValueError(f"the name of curve {number} is {name!r}; it must not hold {barred[0]!r}, a control character")


def write(
    file: str | os.PathLike[str],
    curves: Curve | Iterable[Curve],
    unit: str = "mm",
    schema: str = "ap214",
) -> None:
    """Writes curves to a file whose extension says its format: .step, .iges, .dxf or .brep; each exactly, as one B-spline
    curve under its name, in the unit ("mm", "m" or "inch"). `schema` is that of STEP: "ap214" or "ap242".

    CadError where it cannot be written, ValueError for an unknown extension or unit, and for a name that no file holds:
    of more than 250 characters, or with a line break or another control character."""
    if schema not in ("ap214", "ap242"):
        raise ValueError(unknown("schema", schema, ["ap214", "ap242"]))
    several = [curves] if isinstance(curves, Curve) else list(curves)
    for i, each in enumerate(several, 1):
        if not isinstance(each, Curve):
            raise TypeError(f"curve {i} is {each!r}; expected a Curve")
        _check_name(each.name, i)
    named = [(curve.name or f"curve {i}", curve._nurbs) for i, curve in enumerate(several, 1)]
    findings = findings_of(_core.write_curves(os.fspath(file), named, unit, schema))
    if any(finding.severity == "error" for finding in findings):
        raise CadError(findings)
    tell(findings)
