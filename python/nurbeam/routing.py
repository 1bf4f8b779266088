"""Cables of a given length between two clamps."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from .curves import Curve
from .errors import CaseError, Finding, MissingCase, findings_of, tell
from .model import Quantity, _json

__all__ = ["route", "routes", "Route"]

Array = npt.NDArray[np.float64]
End = Union[Sequence[Any], Mapping[str, Any]]


class Route(NamedTuple):
    """A cable in equilibrium under its weight, clamped at both ends, straight where it is free."""

    name: str
    """Of the cable."""
    curve: Curve
    """The deformed axis, exactly as the elements have it [m]."""
    length: float
    """Unstressed [m]."""
    drawn_length: float
    """Of the curve [m]: the unstressed length with the stretch of the axial force."""
    distance: float
    """Of the ends [m]."""
    least_radius: float
    """Of bending [m]: EI over the largest bending moment; infinite where nothing bends it."""
    least_radius_s: float
    """Its position: unstressed length from the start [m]."""
    largest_tension: float
    """Of the axial force along the cable [N]; 0 where there is thrust alone."""
    largest_thrust: float
    """Of the axial force along the cable [N]; 0 where there is tension alone."""
    sag: float
    """Below the line between the ends [m]; NaN where there is none."""
    from_force: Array
    """(3,) [N], of the first clamp on the cable."""
    to_force: Array
    """(3,) [N], of the second one."""
    elements: int
    """How many the tolerance asked for."""


def _end(end: End) -> Any:
    """As the file of cables has it."""
    if isinstance(end, Mapping):
        return _json(end)
    point, direction = end
    return {"point": _json(point), "direction": _json(direction)}


def cable_numbers(mass_per_length: float, bending_stiffness: float, axial_stiffness: float) -> tuple[Any, Any]:
    """The section and the material of a cable of which mass per length [kg/m], EI [N m^2] and EA [N] are known: an area of
    1000 kg/m^3, and Young's modulus by EA and that."""
    for name, value in {"mass_per_length": mass_per_length, "bending_stiffness": bending_stiffness, "axial_stiffness": axial_stiffness}.items():
        if not value > 0:
            raise ValueError(f"{name} is {value}; must be greater than 0")
    density = 1000.0
    area = mass_per_length / density
    modulus = axial_stiffness / area
    return {"area": area, "second_moment": bending_stiffness / modulus}, {"density": density, "youngs_modulus": modulus}


def _found(text: str, file: str, time_limit: float, tolerance: float) -> list[Route]:
    if not time_limit > 0:
        raise ValueError(f"time_limit is {time_limit} s; must be greater than 0")
    results, plain = _core.routes(text, file, time_limit, tolerance)
    findings = findings_of(plain)
    if any(finding.severity == "error" for finding in findings):
        raise CaseError(findings)
    tell(findings)
    return [Route(curve=Curve._of(nurbs, facts["name"]), **facts) for nurbs, facts in filter(None, results)]


def route(
    start: End,
    end: End,
    *,
    length: Quantity | None = None,
    slack: float | None = None,
    least_bend_radius: Quantity | None = None,
    section: Mapping[str, Any] | None = None,
    material: Mapping[str, Any] | str | None = None,
    mass_per_length: float | None = None,
    bending_stiffness: float | None = None,
    axial_stiffness: float | None = None,
    gravity: npt.ArrayLike = (0, 0, -9.81),
    name: str = "cable",
    time_limit: float = 3,
    tolerance: float = 1e-6,
) -> Route:
    """The equilibrium of a cable between two clamps, as an exact curve.

    Parameters
    ----------
    start, end
        A pair of a point (3,) [m] and the direction (3,) in which the cable leaves it; or a position on a CAD curve
        by the keys of the file of cables: `{"file": "plug.step", "curve": "rim", "at": "centre", "flip": True}`.
    length, slack, least_bend_radius
        One of them: the unstressed length [m]; its excess over the distance of the ends, as a part of that distance; or the
        minimum bend radius [m], for which the shortest length is found.
    section, material
        By the keys of the case file; or instead all three of `mass_per_length` [kg/m], `bending_stiffness` EI
        [N m^2] and `axial_stiffness` EA [N].
    gravity
        (3,) [m/s^2]
    time_limit
        Of the search for one equilibrium [s]; a bend radius takes up to ten times that.
    tolerance
        Error of positions, over the length of the cable.

    CaseError, with the values and what would be possible, where the cable is too short, no length respects the radius, or no
    equilibrium is found within the time.
    """
    numbers = (mass_per_length, bending_stiffness, axial_stiffness)
    given = [each for each in numbers if each is not None]
    if given and (len(given) < 3 or section is not None or material is not None):
        raise TypeError("give either section and material, or all of mass_per_length, bending_stiffness and axial_stiffness")
    if len(given) == 3:
        section, material = cable_numbers(*given)
    if section is None or material is None:
        raise TypeError("section or material is missing; give both, or mass_per_length, bending_stiffness and axial_stiffness")
    cable = {
        "name": name, "from": _end(start), "to": _end(end), "length": length, "slack": slack,
        "least_bend_radius": least_bend_radius, "section": section, "material": material,
    }  # fmt: skip
    case = {"nurbeam_route": 1, "gravity": _json(np.asarray(gravity, dtype=float)), "cables": [_json(cable)]}
    return _found(json.dumps(case), name, time_limit, tolerance)[0]


def routes(cables: str | os.PathLike[str] | Mapping[str, Any], time_limit: float = 3, tolerance: float = 1e-6) -> list[Route]:
    """The equilibria of all cables of a file, or of its contents: what `nurbeam route` finds. CaseError as `route`, also
    where there is no such file (MissingCase, a FileNotFoundError)."""
    if isinstance(cables, Mapping):
        return _found(json.dumps(_json(cables)), "cables", time_limit, tolerance)
    file = Path(cables)
    if not file.is_file():
        raise MissingCase([Finding("error", str(file), "does not exist")])
    return _found(file.read_text(encoding="utf-8"), os.fspath(file), time_limit, tolerance)
