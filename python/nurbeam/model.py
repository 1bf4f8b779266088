"""Models: the words of the case file, in memory."""

from __future__ import annotations

import copy
import functools
import json
import math
import os
import re
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np
import numpy.typing as npt

from . import _core
from .checked import reduced
from .curves import Curve
from .errors import CaseError, Error, Finding, MissingCase, findings_of, tell, unknown
from .loads import Load
from .progress import progress_bar
from .results import Results, RunError
from .signals import Signal
from .simulation import Checkpoint, Simulation

if TYPE_CHECKING:
    from .system import System

__all__ = ["Model", "load", "Circle", "Pipe", "Rectangle", "IBeam", "Rope", "Section", "Material", "Beam", "Body", "schema"]

Quantity = Union[float, str]
"""A number in SI units, or a text with a unit: "5 mm"."""
Place = Union[float, str, Mapping[str, Any], npt.ArrayLike]
"""A position on a beam: "start", "end", a reference arc length from the start ([m] or a text with a unit), a point nearby
(three numbers [m]), or as in the case file {"length": ...}, {"fraction": ...}, {"near": [...], "within": ...}."""
Force = Callable[[float, npt.NDArray[np.float64], npt.NDArray[np.float64]], Any]
MotionLaw = Callable[[float], Any]


def _complain(place: str, value: Any) -> None:
    """CaseError where a part of a case has what cannot be, whatever may still be added to it; `place`: "beams.section"."""
    plain = _json(value)
    wrong = [Finding(f.severity, f"{place}: {f.where}", f.message) for f in _not_finite(plain)]
    found = findings_of(_core.check_part(place, json.dumps(_finite(plain))))
    wrong += [finding for finding in found if finding.severity == "error"]
    if wrong:
        raise CaseError(wrong)


class Section(dict[str, Any]):
    """A cross-section by the keys of the case file: `Section(area="2 cm^2", second_moment=3e-9)`. A wrong key or value is
    a CaseError."""

    def __init__(self, **keys: Any):
        _complain("beams.section", keys)
        super().__init__(**keys)


class Circle(Section):
    """A round solid section: `Circle(radius="6 mm")`."""

    def __init__(self, radius: Quantity, **keys: Any):
        _check_size("radius", radius)
        super().__init__(radius=radius, **keys)


def _check_size(key: str, value: Any, least: float = 0, including: bool = False) -> None:
    """Numbers are checked where they are written; texts with a unit by the case."""
    if isinstance(value, bool) or not isinstance(value, (int, float, np.number, str)):
        raise TypeError(f"{key} is {value!r}; expected a number in metres or a text with a unit (\"5 mm\")")
    if not isinstance(value, str) and not (value >= least if including else value > least):
        raise ValueError(f"{key} is {value} m; must be greater than {least}{' or equal' if including else ''}")


class Pipe(Section):
    """A pipe: `Pipe(radius="24.15 mm", wall="3.2 mm")`, of its outer radius and its wall, or of `bore`, the inner radius.
    `bends="flexible"`: bends are softer, as the section becomes oval there."""

    def __init__(self, radius: Quantity, wall: Quantity | None = None, bore: Quantity | None = None, **keys: Any):
        _check_size("radius", radius)
        if (wall is None) == (bore is None):
            raise TypeError("give either wall or bore, the inner radius")
        if wall is not None:
            _check_size("wall", wall)
            bore = _difference(radius, wall)
        assert bore is not None
        _check_size("bore", bore, including=True)
        if not _metres(bore) < _metres(radius):
            raise ValueError(f"bore is {bore!r} and radius {radius!r}; the bore, an inner radius, must be less than the radius")
        super().__init__(radius=radius, bore=bore, **keys)


def _metres(size: Quantity) -> float:
    return _core.length_of(size) if isinstance(size, str) else float(size)


def _difference(a: Quantity, b: Quantity) -> Quantity:
    """In the unit of both, else in metres."""
    difference = _metres(a) - _metres(b)
    if isinstance(a, str) and isinstance(b, str):
        unit, other = (text.lstrip(" +-.0123456789eE") for text in (a, b))
        if unit == other:
            return f"{difference / _core.length_of(f'1 {unit}'):.15g} {unit}"
    return difference


class Rectangle(Section):
    """A rectangle: `Rectangle(width=0.1, height="0.2 m")`; the height lies in the plane of a planar model, and along the
    section's y axis."""

    def __init__(self, width: Quantity, height: Quantity, **keys: Any):
        _check_size("width", width)
        _check_size("height", height)
        super().__init__(rectangle=[width, height], **keys)


class IBeam(Section):
    """An I, upright along the section's y axis: `IBeam(height="200 mm", width="100 mm", flange="8.5 mm", web="5.6 mm")`."""

    def __init__(self, height: Quantity, width: Quantity, flange: Quantity, web: Quantity, **keys: Any):
        sizes = {"height": height, "width": width, "flange": flange, "web": web}
        for key, value in sizes.items():
            _check_size(key, value)
        super().__init__(i_section=sizes, **keys)


class Rope(Section):
    """A wire rope: `Rope(diameter="16 mm", metallic_area="110 mm^2")`; `wires`, of which each bends by itself."""

    def __init__(self, diameter: Quantity, metallic_area: Quantity, wires: int | None = None, **keys: Any):
        _check_size("diameter", diameter)
        rope = {"diameter": diameter, "metallic_area": metallic_area, "wires": wires}
        super().__init__(rope={key: value for key, value in rope.items() if value is not None}, **keys)


class Material(dict[str, Any]):
    """A material by the keys of the case file: `Material(density=7850, youngs_modulus="210 GPa")`; `damping` [s],
    `thermal_expansion` [1/K], `shear_modulus` [Pa], `poissons_ratio`, `law` ("green", "hooke" or rows)."""

    def __init__(self, density: Quantity, youngs_modulus: Quantity, **keys: Any):
        _complain("beams.material", {"density": density, "youngs_modulus": youngs_modulus, **keys})
        super().__init__(density=density, youngs_modulus=youngs_modulus, **keys)


class _Named:
    def __init__(self, name: str):
        self.name = name

    def __repr__(self) -> str:
        return f'<{type(self).__name__} "{self.name}">'


class Beam(_Named):
    """A beam of a model, as `model.add_beam` returns it; wherever a beam is asked for its name does too."""


class Body(_Named):
    """A body of a model, as `model.add_body` returns it; wherever a body is asked for its name does too."""

    def at(self, place: str | npt.ArrayLike) -> dict[str, Any]:
        """A point of a rigid body, for joints, supports, connectors and loads: the name of one of its `points`, or its
        reference position (3,) [m]."""
        return {"body": self.name, "at": place}


def _json(value: Any) -> Any:
    """As JSON can hold it."""
    if isinstance(value, _Named):
        return value.name
    if isinstance(value, Mapping):
        return {str(key): _json(item) for key, item in value.items() if item is not None}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Iterable) and not isinstance(value, str):
        return [_json(item) for item in value]
    if value is None or isinstance(value, (str, int, float)):
        return value
    raise TypeError(f"{value!r} is nothing that a case or a study can hold; expected a number, a text, a list or a mapping, "
                    "or for a beam or a body its name or what add_beam and add_body have returned")


def _rename_files(value: Any, renamed: Callable[[str], str]) -> None:
    """Gives the files that a case or a study names other names, in place."""
    for item in value.values() if isinstance(value, dict) else value if isinstance(value, list) else []:
        _rename_files(item, renamed)
    if isinstance(value, dict) and isinstance(value.get("file"), str):
        value["file"] = renamed(value["file"])


def _not_finite(value: Any, path: str = "") -> list[Finding]:
    """The numbers of a case or a study that are none."""
    if isinstance(value, dict):
        return [f for key, item in value.items() for f in _not_finite(item, f"{path}.{key}" if path else key)]
    if isinstance(value, list):
        return [f for i, item in enumerate(value) for f in _not_finite(item, f"{path}[{i}]")]
    if isinstance(value, float) and not math.isfinite(value):
        return [Finding("error", path, f"is {value}; expected a finite number")]
    return []


def _place(at: Any) -> Any:
    """As the case file has it."""
    if at is None or isinstance(at, Mapping):
        return at
    if isinstance(at, str):
        return {"length": at} if re.match(r"\s*[-+.\d]", at) else at
    return {"length": at} if np.ndim(at) == 0 else {"near": at}


def _grip(end: Any) -> Any:
    """The end of a connector as the case file has it."""
    if isinstance(end, Body):
        return {"body": end.name}
    if isinstance(end, Mapping):
        of_beam = "body" not in end  # of a body it is the name of a point, or a point
        return {key: _place(value) if key == "at" and of_beam else value for key, value in end.items()}
    if isinstance(end, str):
        return {"body": end}
    return {"point": end}


def _axis(axis: Any) -> Any:
    if isinstance(axis, Curve):
        return axis._axis()
    if isinstance(axis, Mapping):
        return axis
    if isinstance(axis, (str, os.PathLike)):
        return {"file": os.fspath(axis)}
    return {"polyline": axis}


class Model:
    """A model: beams, bodies, supports, loads, and an analysis.

    It is a case, built part by part. The methods take the keys of the case file by their names (docs/case-reference.md).
    Quantities are numbers in SI units or texts with a unit ("5 mm"). A wrong key or value is a CaseError where it is
    written. Parts that do not fit together are found when the model is checked or run; CaseError lists all of them with
    their positions.

    Parameters
    ----------
    gravity
        (3,) [m/s^2]; [0, 0, -9.81] when omitted.
    name
        Title; heads messages and pictures.
    """

    def __init__(self, gravity: npt.ArrayLike | None = None, name: str = "model", **keys: Any):
        self.case: dict[str, Any] = {"nurbeam": 1, "name": name, "beams": [], "analysis": {}}
        """The case as JSON has it, to read and to change."""
        known = _case_keys()
        for key in keys:
            if key not in known:
                raise TypeError(unknown("key of a model", key, known))
        if gravity is not None:
            self.case["gravity"] = _json(np.asarray(gravity, dtype=float) if not _has_text(gravity) else gravity)
        self.case.update(_json(keys))
        self._file = name
        self._folder: str | None = None  # of the file that it was loaded from; None: the working directory
        self._laws: list[tuple[dict[str, Any], Force | Signal]] = []
        self._motions: list[MotionLaw | Signal] = []
        self._wind: Signal | None = None

    @property
    def name(self) -> str:
        """Its title."""
        return str(self.case.get("name", self._file))

    # --- Parts

    def add(self, kind: str, **keys: Any) -> dict[str, Any]:
        """Adds an item to a list of the case: `model.add("loads", beam="cable", at="end", force=[0, 0, -100])`. All other
        `add_...` do this. CaseError for a wrong key or value. Returns the item, which may be changed."""
        if kind not in _case_lists():
            raise TypeError(unknown("list of a case", kind, _case_lists()))
        of_body = keys.get("beam") is None and keys.get("body") is not None  # whose place is a name or a point
        item: dict[str, Any] = _json({k: _place(v) if k == "at" and not of_body else v for k, v in keys.items()})
        _complain(kind, item)
        self.case.setdefault(kind, []).append(item)
        return item

    def _next_name(self, kind: str, name: str | None, otherwise: str) -> str:
        return name if name is not None else f"{otherwise} {len(self.case.get(kind, [])) + 1}"

    def add_beam(
        self,
        axis: Curve | npt.ArrayLike | Mapping[str, Any] | str | os.PathLike[str],
        section: Mapping[str, Any],
        material: Mapping[str, Any],
        elements: int | Mapping[str, Any] | None = None,
        name: str | None = None,
        **keys: Any,
    ) -> Beam:
        """A beam along a curve, through points (n, 3) [m], or along what an `axis` of the case file says (a text is a CAD
        file). `elements`: their number, or {"max_length": ...}, {"per_segment": ...}, {"tolerance": ...}. Other keys as
        in the case file: `torsion`, `stress_free`, `temperature`, `initial`, `corners`, ..."""
        if name is None and isinstance(axis, Curve) and axis.name:
            name = axis.name
        named = self._next_name("beams", name, "beam")
        count = {"count": elements} if isinstance(elements, (int, np.integer)) else elements
        self.add("beams", name=named, axis=_axis(axis), section=section, material=material, elements=count, **keys)
        return Beam(named)

    def add_body(self, name: str, mass: Quantity, roll_inertia: Quantity | None = None, **keys: Any) -> Body:
        """A point mass on a sliding joint or a connector. With `inertia` = [Ixx, Iyy, Izz] [kg m^2] about its centre of
        mass it is a rigid body, with the reference `position` of that centre, named `points` = {"rim": (3,) [m], ...} and
        `axes` of its own. It starts with `velocity` [m/s] and `angular_velocity` [rad/s], and `turned` from the reference
        configuration."""
        self.add("bodies", name=name, mass=mass, roll_inertia=roll_inertia, **keys)
        return Body(name)

    def add_support(
        self,
        beam: Beam | Body | Mapping[str, Any] | str,
        at: Place | None = None,
        type: str = "pinned",
        name: str | None = None,
        motion: Any = None,
        axis: npt.ArrayLike | None = None,
        rotation: Mapping[str, Any] | None = None,
        **keys: Any,
    ) -> None:
        """Supports a position of a beam: "pinned", "guided" (free along `direction`), "clamped" or "fork", which with a
        `direction` slide along it; or a body or its `body.at("rim")`, where "pinned" is a ball, and a pin with `axis`.
        `rotation` turns what it holds: {"axis": ..., "table": rows [time, degrees]} or {"axis": ...,
        "speed": rad/s, "ramp": s}, about a point `about` where that is given. `motion` moves it from
        its reference position: rows [time, dx, dy, dz], or a smooth function motion(t) that returns the displacement (3,) [m], or
        this with its first two derivatives; else these are taken by differences over 0.1 ms, also just before time 0.
        A `Signal` of three numbers is its velocity [m/s]."""
        by = self._by_function(motion)
        by["rotation"] = rotation
        if isinstance(beam, (Body, Mapping)):
            self.add("supports", **_grip(beam), type=type, name=name, axis=axis, **by, **keys)
        else:
            self.add("supports", beam=beam, at=at, type=type, name=name, axis=axis, **by, **keys)

    def add_sliding_joint(
        self,
        body: Body | str,
        beam: Beam | str,
        at: Place,
        speed: Quantity | None = None,
        motion: Mapping[str, Any] | MotionLaw | Signal | None = None,
        slope: str | None = None,
        at_beam_end: str | None = None,
        **keys: Any,
    ) -> None:
        """Puts a body on a beam, to slide along it. `motion` prescribes how: {"speed": ...}, {"table": rows [time, s]}, or a
        smooth function motion(t) that returns the reference arc length from the beam's start [m], or this with its first
        two derivatives; else these are taken by differences over 0.1 ms, also just before time 0. A `Signal` is its speed
        [m/s]. `slope`: "automatic", "continuous" or "discontinuous"; `at_beam_end`: "leave" or "stop"."""
        self.add(
            "sliding_joints",
            body=body, beam=beam, at=at, speed=speed, slope=slope, at_beam_end=at_beam_end,
            **self._by_function(motion), **keys,
        )  # fmt: skip

    def add_eyelet(
        self,
        name: str,
        beam: Beam | str,
        at: Place,
        position: npt.ArrayLike | None = None,
        equilibrium: str | None = None,
        **keys: Any,
    ) -> None:
        """Runs a beam through a ring without mass: at `position` [m], or on the reference curve. `equilibrium`: `"held"`
        locks the position `at` in it until the motion starts, "free" finds its equilibrium. `keys`: `on` (a body that carries it),
        `path`, `inertia`, `motion`, `force`, `friction` and the others of the case file."""
        self.add("eyelets", name=name, beam=beam, at=at, position=position, equilibrium=equilibrium, **keys)

    def add_reel(
        self,
        name: str,
        beam: Beam | str,
        end: str,
        stored: Quantity,
        **keys: Any,
    ) -> None:
        """Puts the "start" or the "end" of a beam on a reel, with a length stored on it [m] in addition to the
        reference curve. `keys`: `motion`, `force`, `inertia`, `friction`, `feed`, `on`, `at_empty` and the others of the case
        file."""
        self.add("reels", name=name, beam=beam, end=end, stored=stored, **keys)

    def add_collector(
        self,
        name: str,
        beam: Beam | str,
        at: Place,
        travel: npt.ArrayLike,
        masses: Sequence[Quantity],
        stiffness: Sequence[Quantity],
        force: Any,
        motion: Mapping[str, Any],
        **keys: Any,
    ) -> None:
        """Presses sprung masses, from the base up, on a wire from one side, and moves them along `travel`: a pantograph.
        `force` lifts one of them: a number [N], rows [time, N], or {"per_speed_squared": ..., "offset": ...}; `motion` is
        {"speed": ...} or {"table": rows [time, way]}. `keys`: `up`, `damping`, `force_on`, `contact`, `evaluate`, `filter`,
        `bands`, `uplift` as in the case file. Statistics are in the report of a run into a directory, under
        "collectors"; histories then have a row at every step."""
        self.add(
            "collectors",
            name=name, beam=beam, at=at, travel=travel, masses=list(masses), stiffness=list(stiffness), force=force,
            motion=motion, **keys,
        )  # fmt: skip

    def add_connector(
        self,
        name: str,
        type: str,
        start: Mapping[str, Any] | Body | npt.ArrayLike,
        end: Mapping[str, Any] | Body | npt.ArrayLike,
        **keys: Any,
    ) -> None:
        """Connects two bodies, positions on beams or points: a "spring", "rod", "tension-only", "rotational" (about an
        `axis`) or what else the case file has. An end is a body, {"beam": ..., "at": ...}, or a point in space (3,) [m]. Keys as in the case file:
        `stiffness`, `damping`, `length`, ..."""
        self.add("connectors", name=name, type=type, **{"from": _grip(start), "to": _grip(end)}, **keys)

    def add_rod(
        self,
        name: str,
        start: Mapping[str, Any] | Body | npt.ArrayLike,
        end: Mapping[str, Any] | Body | npt.ArrayLike,
        length: Quantity | None = None,
        **keys: Any,
    ) -> None:
        """A constant distance between two ends: `length` [m], or that of the reference configuration. It is
        `add_connector` of the type "rod"."""
        self.add_connector(name, "rod", start, end, length=length, **keys)

    def add_joint(
        self,
        beams: Sequence[Beam | Body | Mapping[str, Any] | str | npt.ArrayLike],
        type: str,
        at: npt.ArrayLike | Mapping[str, Any] | None = None,
        name: str | None = None,
        axis: npt.ArrayLike | None = None,
        **keys: Any,
    ) -> None:
        """Joins beams where an end of one meets the other, or near a point [m]: "hinged" or "rigid". With a rigid body
        among them, it joins two of bodies, `body.at("rim")`, {"beam": ..., "at": ...} and points in space: also
        "universal" with `axes`, "cylinder" and "slide" along `axis`. `drive` turns the first body about the axis of a
        "hinged" joint: {"motion": {"speed": rad/s}}, {"motion": {"table": rows [time, degrees]}} or {"moment": N m}."""
        if any(isinstance(each, (Body, Mapping)) for each in beams):
            self.add("joints", between=[_grip(each) for each in beams], type=type, name=name, axis=axis, **keys)
        else:
            self.add("joints", beams=beams, type=type, at=at, name=name, axis=axis, **keys)

    def add_load(
        self,
        beam: Beam | Body | Mapping[str, Any] | str,
        at: Place | None = None,
        force: Any = None,
        moment: Any = None,
        force_per_length: Any = None,
        force_per_projected_length: Any = None,
        torque_per_length: Quantity | None = None,
        follower: bool | None = None,
        time: Any = None,
        **keys: Any,
    ) -> Load:
        """A force [N] or moment [N m] at a position, or on a body or its `body.at("rim")`; or a force [N/m] or torque
        [N m/m] per length, or a force per length as
        seen along it (`force_per_projected_length`: snow, ice). `time`: rows
        [time, factor]; `follower`: it turns with the section; `moves`: {"speed": ...}; `offset`: [x, y] from the axis."""
        on = _grip(beam) if isinstance(beam, (Body, Mapping)) else {"beam": beam, "at": at}
        self.add(
            "loads",
            **on, force=force, moment=moment, force_per_length=force_per_length,
            force_per_projected_length=force_per_projected_length,
            torque_per_length=torque_per_length, follower=follower, time=time, **keys,
        )  # fmt: skip
        return Load(len(self.case["loads"]) - 1)

    def add_probe(
        self, name: str, beam: Beam | Body | Mapping[str, Any] | str, at: Place | None = None, **keys: Any
    ) -> None:
        """A point of a beam whose motion and section forces are recorded under the name, or a point of a rigid body,
        `body.at("rim")`, with its acceleration and load factors."""
        on = _grip(beam) if isinstance(beam, (Body, Mapping)) else {"beam": beam, "at": _place(at)}
        probe = _json({"name": name, **on, **keys})
        _complain("output.probes", probe)
        output = self.case.setdefault("output", {})
        output.setdefault("probes", []).append(probe)

    def add_force(
        self,
        law: Force | Signal,
        body: Body | str | None = None,
        beam: Beam | str | None = None,
        at: Place | None = None,
        points: Sequence[Mapping[str, Any]] | None = None,
        spatial: bool | None = None,
    ) -> None:
        """A force by a function of yours, on a body, on a position of a beam, or on several `points`. Each point is
        {"body": ...} or {"beam": ..., "at": ...}.

        law(t, position, velocity) takes the time [s] and the point's position [m] and velocity [m/s] in world
        coordinates, (3,) arrays, of several points (points, 3). It returns the force [N] in the same shape. It may
        return (force, by_position, by_velocity): derivatives of all components by all others, (3 points, 3 points).
        Without them, or where they are None, differences call the law 6 times for each point. It must have no memory:
        a step may be tried several times. An exception ends the run and comes out unchanged. A `Signal` of three
        numbers instead of the function is the force [N] itself. `spatial`: it may act out of the plane of a planar
        model, which is then spatial. Buckling does not multiply it. Modes about the reference configuration leave it
        out, as they do loads."""
        if not callable(law):
            raise TypeError(f"a law is a function law(t, position, velocity), not {law!r}")
        if points is None:
            points = [{"body": body, "beam": beam, "at": at}]
        elif body is not None or beam is not None or at is not None:
            raise TypeError("give either points, or body or beam and at")
        places = [{k: _place(v) if k == "at" else v for k, v in point.items()} for point in points]
        self._laws.append((_json({"points": places, "spatial": spatial}), law))

    def set_wind(self, wind: Signal | None) -> None:
        """Bodies with a drag area feel a wind [m/s] that a signal of three numbers says, instead of that of the case; its
        `air` must have a density. None: that of the case. The energies book its work as that of a force."""
        if wind is not None and not isinstance(wind, Signal):
            raise TypeError(f"the wind is {wind!r}; expected a Signal of three numbers, or None")
        self._wind = wind

    def set(self, path: str, value: Any) -> None:
        """Sets one value of the case by its path, as `--set` does: `model.set("beams[0].section.radius", "7 mm")`, also
        by name, `"beams.cable.elements.count"`; None removes the key or the item, `"loads[+]"` appends one. KeyError for a path that leads nowhere,
        CaseError for a value that cannot stand there; the case is then as it was."""
        asked = _json(value)
        case, json_value = (json.dumps(_finite(each)) for each in (_json(self.case), asked))
        text, place, problem, found = _core.with_value(case, path, json_value)
        if problem:
            raise KeyError(problem)
        wrong = _not_finite(asked, place) + findings_of(found)
        if wrong:
            raise CaseError(wrong)
        _put(self.case, json.loads(text), [int(p) if p.isdigit() else p for p in re.findall(r"[^.\[\]]+", place)], asked)

    def __reduce__(self) -> Any:
        """Pickled as it is, its functions by their names."""
        return reduced(_with, type(self), self.__dict__)

    def copy(self) -> Model:
        """Another model like this, which may be changed by itself."""
        other = Model.__new__(Model)
        other.case = copy.deepcopy(self.case)
        other._file = self._file
        other._folder = self._folder
        other._laws = list(self._laws)
        other._motions = list(self._motions)
        other._wind = self._wind
        return other

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the case to a file, for the command line; files that it names are then relative to the new one. Error where
        it has forces or motions by functions, which no file holds."""
        if self._laws or self._motions or self._wind:
            raise Error("the model has forces or motions by functions or signals, which a case file cannot hold")
        self._require_finite(self.case)
        folder, target = self._folder or os.getcwd(), os.path.dirname(os.path.abspath(file))
        case = copy.deepcopy(self.case)
        if folder != target:
            _rename_files(case, lambda name: name if os.path.isabs(name)
                          else os.path.relpath(os.path.join(folder, name), target))
        with open(file, "w", encoding="utf-8") as stream:
            json.dump(case, stream, indent=2)
            stream.write("\n")

    # --- Asking

    def _text(self, analysis: Mapping[str, Any], every: Quantity | None) -> str:
        case = dict(self.case)
        own, asked = case.get("analysis", {}), _json(analysis)
        if isinstance(own, dict):  # else it is said what is wrong with it
            kind = own.get("type", "dynamic")
            if (other := asked.get("type", kind)) != kind:
                own = {key: own[key] for key in ("length_control",) if key in own}
                if other != "dynamic" and isinstance(output := case.get("output"), dict):
                    case["output"] = {key: value for key, value in output.items() if key != "every"}
            case["analysis"] = {**own, **asked}
        if every is not None:
            case["output"] = {**case.get("output", {}), "every": _json(every)}
        if self._laws:
            case["laws"] = [law for law, _ in self._laws]
        self._require_finite(case)
        return json.dumps(case)

    def _path(self) -> str:
        """Of its file, beside which others are looked for, also from another working directory than it was loaded from."""
        if self._folder is None or os.path.dirname(os.path.abspath(self._file)) == self._folder:
            return self._file
        return os.path.join(self._folder, os.path.basename(self._file))

    def _require_finite(self, case: dict[str, Any]) -> None:
        if wrong := _not_finite(case):
            raise CaseError([Finding(f.severity, f"{self._file}: {f.where}", f.message) for f in wrong])

    def _built(self, analysis: Mapping[str, Any], every: Quantity | None = None) -> tuple[_core.BuiltCase, list[Finding]]:
        built, plain = _core.build(self._text(analysis, every), self._path())
        findings = findings_of(plain)
        if built is None:
            raise CaseError(findings)
        return built, findings

    def _or_static(self, analysis: Mapping[str, Any]) -> Mapping[str, Any]:
        """What needs a model alone takes the analysis that asks for least where there is none."""
        return analysis or ({} if self.case.get("analysis") else {"type": "static"})

    def _functions(self) -> tuple[list[Any], list[Any], list[Any]]:
        def core(function: Any) -> Any:
            return function._core if isinstance(function, Signal) else function

        laws, wind = [core(function) for _, function in self._laws], [self._wind._core] if self._wind else []
        return laws, [core(motion) for motion in self._motions], wind

    def _signals(self) -> list[Signal]:
        """Each once, in the order of forces, motions and the wind."""
        used = [*(law for _, law in self._laws), *self._motions, self._wind]
        return list(dict.fromkeys(each for each in used if isinstance(each, Signal)))

    def _by_function(self, motion: Any) -> dict[str, Any]:
        """The keys of a motion, which may be a function."""
        if not callable(motion):
            return {"motion": motion}
        self._motions.append(motion)
        return {"motion_law": len(self._motions) - 1}

    def check(self, **analysis: Any) -> list[Finding]:
        """What is to be said of the model, warnings and notes; CaseError where it cannot be one. The keywords are those
        of `run`."""
        return self._built(analysis, analysis.pop("every", None))[1]

    def summary(self, **analysis: Any) -> dict[str, Any]:
        """The model as it is understood: dimension, beams with their lengths and stiffnesses, bodies, supports, loads. The
        keywords are those of `run`; a model without an analysis is looked at as for a static one."""
        every = analysis.pop("every", None)
        summary: dict[str, Any] = json.loads(self._built(self._or_static(analysis), every)[0].summary())
        return summary

    def run(
        self,
        end_time: Quantity | None = None,
        step: Quantity | None = None,
        *,
        every: Quantity | None = None,
        out: str | os.PathLike[str] | None = None,
        resume: bool = False,
        progress: bool | None = None,
        **analysis: Any,
    ) -> Results:
        """Runs the model to its end.

        Keywords are the keys of `analysis` in the case file (`type`, `end_time`, `step`, `tolerance`, `initial`,
        `load_steps`, `integrator`, ...). They replace those of the case, which do not count for another `type`. `every`
        is the time between snapshots. With `out` the run writes a results directory, as the command line does; `resume`
        continues from the checkpoint there. Otherwise the results are in memory only. `progress` shows a bar, by tqdm;
        when omitted on a terminal.

        `accuracy=True` estimates the errors of mesh and step, `accuracy="1 %"` refines both until they are below it:
        `results.accuracy`. A target that is not reached is a warning.

        CaseError for a model that cannot be one, RunError (with the `results` until then) where the run ends before its
        end; Ctrl-C ends it with KeyboardInterrupt. Other threads go on meanwhile."""
        keys: dict[str, Any] = {"end_time": end_time, "step": step, **analysis}
        if isinstance(analysis.get("accuracy"), (str, float)):
            keys["accuracy"] = {"target": analysis["accuracy"]}
        built, findings = self._built(keys, every)
        findings += findings_of(built.divide_for_motion(bool(self._laws or self._motions)))
        tell(findings)
        if out is not None:
            return self._run_into(built, out, resume, progress)
        if resume:
            raise ValueError('resume goes on from the restart point of a results directory; name it with "out"')
        accuracy = self._accuracy_in_memory(built, keys, progress)
        if built.analysis in ("modes", "buckling"):
            recording, report = _core.modes(built, self._functions())
            results = Results._of(recording, report)
            if not report["done"]:
                raise RunError(report["status"], results)
            tell(findings_of(report["warnings"]))
            results._accuracy = accuracy._accuracy if accuracy else None
            return results
        if accuracy:
            return accuracy
        with progress_bar(built, progress) as told:
            return self._begin(built, None).run(told)

    def _accuracy_in_memory(
        self, built: _core.BuiltCase, keys: Mapping[str, Any], progress: bool | None
    ) -> Results | None:
        """The results of a run that is asked for its errors, by way of a directory that is gone then; None of one that is
        not asked."""
        asked = keys.get("accuracy")
        if asked is None:
            asked = self.case.get("analysis", {}).get("accuracy", False)
        if asked is False:
            return None
        with tempfile.TemporaryDirectory() as folder:
            results = self._run_into(built, folder, False, progress)
            results.directory = None
            results._summary = built.summary()
        return results

    def _run_into(
        self, built: _core.BuiltCase, out: str | os.PathLike[str], resume: bool, progress: bool | None
    ) -> Results:
        if resume and (self._laws or self._motions):
            tell([Finding("warning", "resume", "the functions of the model cannot be compared with those of the run that is "
                          "there: the results are right where they are the same; else run without resume")])
        with progress_bar(built, progress) as told:
            code, messages = _core.run_into(built, self._functions(), os.fspath(out), resume, told)
        lines = [line.split("error: ", 1)[-1] for line in messages.splitlines() if "error: " in line]
        if code in (2, 4):
            raise Error("\n".join(lines) or messages)
        results = Results(out)
        if code == 3 and results._accuracy is not None and not results._accuracy.reached:
            tell([Finding("warning", "accuracy", "\n".join(lines))])
        elif code != 0:
            raise RunError("\n".join(lines) or messages, results)
        said = [line.removeprefix("warning: ") for line in messages.splitlines() if line.startswith("warning: ")]
        tell(Finding("warning", *line.split(": ", 1)) for line in said)
        return results

    def modes(self, count: int = 10, **modes: Any) -> Results:
        """The lowest natural frequencies and their shapes, about the equilibrium unless `about="drawn"`: `results.modes`."""
        return self.run(type="modes", modes={"count": count, **modes})

    def simulate(
        self,
        end_time: Quantity | None = None,
        step: Quantity | None = None,
        *,
        every: Quantity | None = None,
        start: Checkpoint | None = None,
        **analysis: Any,
    ) -> Simulation:
        """The same as a run that is taken step by step: `for snapshot in model.simulate(...)`. `start` is a checkpoint to go
        on from. CaseError as with `run`."""
        built, findings = self._built({"end_time": end_time, "step": step, **analysis}, every)
        tell(findings)
        if built.analysis in ("modes", "buckling"):
            raise ValueError(f'there are no steps to take in an analysis of the type "{built.analysis}"; use run')
        if start is not None and not isinstance(start, Checkpoint):
            raise TypeError(f"start is {start!r}; expected a Checkpoint: simulation.checkpoint or Checkpoint.load(file)")
        if start is not None and built.analysis != "dynamic":
            raise ValueError(f'no motion goes on in an analysis of the type "{built.analysis}"; leave start out')
        return self._begin(built, start)

    def _begin(self, built: _core.BuiltCase, start: Checkpoint | None) -> Simulation:
        signals = self._signals()
        states = start._signals if start else [None] * len(signals)
        if len(states) != len(signals):
            raise ValueError(f"start: the checkpoint is of a model with {len(states)} signals, this one has {len(signals)}")
        for signal, state in zip(signals, states):
            signal._begin(state)
        return Simulation(_core.LiveRun.begin(built, self._functions(), start._core if start else None), built, signals)

    def system(self, **analysis: Any) -> System:
        """The equations of motion in the reference configuration; those of other states are `simulation.system`."""
        from .system import System

        return System(_core.Equations.drawn(self._built(self._or_static(analysis))[0], self._functions()))

    def _repr_html_(self) -> str:
        """In a notebook: the reference configuration, in the 3-D view of the report page."""
        built = self._built(self._or_static({}))[0]
        return Results._of(_core.drawn(built), {"status": "drawn"}, built.summary())._repr_html_()

    def __repr__(self) -> str:
        parts = [f"{len(v)} {k}" for k, v in self.case.items() if isinstance(v, list) and v]
        return f'<Model "{self.name}": {", ".join(parts) or "empty"}>'


def _with(kind: type[Model], state: dict[str, Any]) -> Model:
    model = kind.__new__(kind)
    model.__dict__.update(state)
    return model


@functools.lru_cache(maxsize=None)
def _case_keys() -> frozenset[str]:
    return frozenset(json.loads(_core.schema())["properties"])


@functools.lru_cache(maxsize=None)
def _case_lists() -> frozenset[str]:
    properties = json.loads(_core.schema())["properties"]
    return frozenset(key for key, of in properties.items() if of.get("type") == "array" and key != "gravity")


def _has_text(value: Any) -> bool:
    return isinstance(value, str) or (isinstance(value, Sequence) and any(isinstance(item, str) for item in value))


def _finite(value: Any) -> Any:
    """With 0 for the numbers that JSON has no words for."""
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_finite(item) for item in value]
    return 0 if isinstance(value, float) and not math.isfinite(value) else value


def _put(case: Any, changed: Any, place: Sequence[Any], value: Any) -> None:
    """Puts a value where a changed case has it; the items on the way remain those that the user may hold."""
    *way, last = place
    for key in way:
        if isinstance(changed, dict) and key not in changed:
            return  # nothing is there to be removed
        held = case[key] if isinstance(case, list) else case.get(key)
        if not isinstance(held, (dict, list)) or type(held) is not type(changed[key]):
            case[key] = changed[key]
        case, changed = case[key], changed[key]
    if value is not None and isinstance(case, list) and last == len(case):
        case.append(value)
    elif value is not None:
        case[last] = value
    elif isinstance(case, list):
        del case[last]
    else:
        case.pop(last, None)


def load(file: str | os.PathLike[str], set: Mapping[str, Any] | None = None) -> Model:
    """The model of a case file, with values changed as by `--set`: `load("zipline.json", set={"analysis.end_time": 1})`.
    Files that it names are relative to its folder. CaseError where it is no JSON,
    also a FileNotFoundError where it is not there; the rest is checked when it is run."""
    overrides = [f"{path}={json.dumps(_json(value))}" for path, value in (set or {}).items()]
    text, plain = _core.case_json(os.fspath(file), overrides)
    findings = findings_of(plain)
    if not text:
        raise (CaseError if os.path.exists(file) else MissingCase)(findings)
    case = json.loads(text)
    model = Model.__new__(Model)
    model.case = case if isinstance(case, dict) else {"": case}
    model._file = os.fspath(file)
    model._folder = os.path.dirname(os.path.abspath(file))
    model._laws = []
    model._motions = []
    model._wind = None
    return model


def schema() -> dict[str, Any]:
    """The JSON schema of the case file: all keys with what they mean."""
    found: dict[str, Any] = json.loads(_core.schema())
    return found
