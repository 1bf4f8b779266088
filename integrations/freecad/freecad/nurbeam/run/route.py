"""Cables of a given length, by `nurbeam route`."""

import json
import os
import tempfile
from typing import Any, NamedTuple

import Part

from ..case.values import merged, metres, rounded, si, times_unit, vector
from ..geometry.edges import edge_of_nurbs
from ..geometry.places import NoPlace, end_of_link
from .command import TooLong, run_program

RECOMPUTE_LIMIT, RUN_LIMIT = 3.0, 120.0  # s
RADIUS_SEARCHES = 10  # that a bend radius takes as long as a length, at most
DENSITY = 1000.0  # kg/m^3, of the area that stands for the section


class NoRoute(RuntimeError):
    """There is no such cable; the text says why."""


class FoundRoute(NamedTuple):
    shape: Any
    length: float
    """Unstressed [mm]."""
    least_radius: float
    """[mm]"""
    largest_tension: str
    """With its unit."""


def found_route(obj):
    """The cable of a CableOfLength, within the time of a recompute, or of a run where it asks for one."""
    limit = RUN_LIMIT if obj.RunNow else RECOMPUTE_LIMIT
    asked = (limit, obj.Solid, obj.Diameter.Value, json.dumps(cable_file(obj)))
    if obj.Proxy.failed and obj.Proxy.failed[0] == asked and not obj.RunNow:
        raise NoRoute(obj.Proxy.failed[1])  # an object that is invalid is asked at each recompute of the document
    try:
        return _found_within(obj, limit)
    except NoRoute as problem:
        obj.Proxy.failed = (asked, str(problem))
        raise


def _found_within(obj, limit):
    with tempfile.TemporaryDirectory() as folder:
        cables, out = os.path.join(folder, "cables.json"), os.path.join(folder, "cable.brep" if obj.Solid else "cable.json")
        with open(cables, "w", encoding="utf-8") as stream:
            json.dump(cable_file(obj), stream)
        share = limit / (RADIUS_SEARCHES if obj.Goal == "Bend radius" else 1)
        arguments = ["route", cables, "--json", "--time-limit", repr(share), "--to", out]
        arguments += ["--solid", repr(_positive(obj, "Diameter", obj.Diameter.Value) / 2000)] if obj.Solid else ["--unit", "m"]
        facts = json.loads(_run(arguments, limit))["cables"][0]
        shape = Part.read(out).Solids[0] if obj.Solid else _shape_of(out)
        return FoundRoute(shape, 1000 * facts["length [m]"], 1000 * (facts["least_radius [m]"] or 0),
                          f"{facts['largest_tension [N]']!r} N")  # fmt: skip


def _run(arguments, limit):
    try:
        return run_program(arguments, NoRoute, limit)
    except TooLong:
        raise NoRoute(f"takes longer than {limit:g} s: press Run in its panel") from None


def _shape_of(file):
    with open(file, encoding="utf-8") as stream:
        curve = json.load(stream)["curves"][0]
    return edge_of_nurbs(curve)


def cable_file(obj):
    """The file of cables for a CableOfLength. NoRoute where its ends or its goal are none."""
    section, material = _numbers(obj)
    gravity = times_unit(9.81, obj.GravityDirection) or [0, 0, 0]
    cable = {"name": obj.Label.replace('"', "_").replace(",", "_"), "from": _end(obj, "From"), "to": _end(obj, "To"),
             **_goal(obj), "section": section, "material": material}  # fmt: skip
    try:
        cable = merged(cable, obj.ExtraKeys)
    except ValueError as problem:
        raise NoRoute(f"ExtraKeys: {problem}") from None
    return {"nurbeam_route": 1, "gravity": gravity, "cables": [cable]}


def _end(obj, prop):
    link = getattr(obj, prop)
    if not link:
        raise NoRoute(f"{prop}: nothing is chosen; choose a plane face, a circle, or an edge with one of its points")
    try:
        end = end_of_link(link, getattr(obj, f"{prop}Flip"))
    except (NoPlace, ValueError) as problem:
        raise NoRoute(f"{prop}: {problem}") from None
    return {"point": metres(end.point), "direction": vector(end.outward)}


def _goal(obj):
    if obj.Goal == "Length":
        return {"length": _positive(obj, "CableLength", si(obj.CableLength, "m"))}
    if obj.Goal == "Slack":
        return {"slack": _positive(obj, "Slack", rounded(obj.Slack / 100))}
    return {"least_bend_radius": _positive(obj, "BendRadius", si(obj.BendRadius, "m"))}


def _positive(obj, prop, value):
    if not value > 0:
        unit = next(row.unit for row in obj.Proxy.table() if row.name == prop)
        shown = f"{value:.10g} {unit}" if unit else getattr(obj, prop)
        raise NoRoute(f"{prop}: is {shown}; must be greater than 0")
    return value


def _numbers(obj):
    mass = _positive(obj, "MassPerLength", si(obj.MassPerLength, "kg/m"))
    bending = _positive(obj, "BendingStiffness", si(obj.BendingStiffness, "N*m^2"))
    axial = _positive(obj, "AxialStiffness", si(obj.AxialStiffness, "N"))
    area = mass / DENSITY
    return {"area": area, "second_moment": bending * area / axial}, {"density": DENSITY, "youngs_modulus": axial / area}
