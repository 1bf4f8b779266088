"""Sections and materials of beams."""

import FreeCAD

from ..geometry import places
from ..geometry.edges import nurbs_of_edge
from .values import rounded, si


class Profile:
    """A drawn section: the edges that go into a file beside the case."""

    def __init__(self, link):
        self.edges = places.edges_of_link(link)
        if not self.edges:
            raise ValueError("no profile is chosen; choose a closed sketch or a face")
        self.file = f"profile_{_fingerprint(self.edges)}.step"


def _fingerprint(edges):
    """Of the shape, so that a case with another profile names another file."""
    import hashlib

    numbers = repr([[[round(1e9 * x) for x in point] for point in nurbs_of_edge(edge)["control_points"]] for edge in edges])
    return hashlib.sha256(numbers.encode()).hexdigest()[:12]


def section_of(beam, axis):
    """(keys of the section, their properties, profile or None)."""
    kind = beam.SectionKind

    def length(name):
        return si(getattr(beam, name), "m")

    if kind == "Round":
        return {"radius": length("Radius")}, {"radius": "Radius"}, None
    if kind == "Pipe":
        return {"radius": length("Radius"), "bore": length("Bore")}, {"radius": "Radius", "bore": "Bore"}, None
    if kind == "Rectangle":
        return {"rectangle": [length("Width"), length("Height")]}, {"rectangle": "Width", "rectangle[0]": "Width", "rectangle[1]": "Height"}, None
    if kind == "I":
        names = {"width": "Width", "height": "Height", "flange": "Flange", "web": "Web"}
        return {"i_section": {k: length(n) for k, n in names.items()}}, {f"i_section.{k}": n for k, n in names.items()}, None
    if kind == "Rope":
        rope = {"diameter": length("RopeDiameter"), "metallic_area": si(beam.MetallicArea, "m^2")}
        if beam.Wires:
            rope["wires"] = beam.Wires
        return {"rope": rope}, {"rope.diameter": "RopeDiameter", "rope.metallic_area": "MetallicArea", "rope.wires": "Wires"}, None
    if kind == "Profile":
        profile = Profile(beam.Profile)
        return {"profile": {"file": profile.file}}, {"profile": "Profile"}, profile
    if kind == "Numbers":
        return _numbers(beam), _NUMBERS, None
    if not axis.radius:
        raise ValueError("the axis is that of no solid pipe; choose another kind of section, or a solid pipe as axis")
    return {"radius": rounded(axis.radius), **({"bore": rounded(axis.bore)} if axis.bore else {})}, {"radius": "Axis", "bore": "Axis"}, None


_NUMBERS = {"area": "Area", "second_moment": "SecondMoment", "second_moments": "SecondMomentY",
            "torsion_constant": "TorsionConstant", "extreme_fibre": "ExtremeFibre"}  # fmt: skip


def _numbers(beam):
    keys = {"area": si(beam.Area, "m^2")}
    about_x, about_y = si(beam.SecondMoment, "m^4"), si(beam.SecondMomentY, "m^4")
    keys.update({"second_moments": [about_x, about_y]} if about_y else {"second_moment": about_x})
    for key, name, unit in (("torsion_constant", "TorsionConstant", "m^4"), ("extreme_fibre", "ExtremeFibre", "m")):
        if value := si(getattr(beam, name), unit):
            keys[key] = value
    return keys


_MATERIAL = {"density": ("Density", "kg/m^3"), "youngs_modulus": ("YoungsModulus", "Pa"), "poissons_ratio": ("PoissonRatio", None),
             "thermal_expansion": ("ThermalExpansionCoefficient", "1/K")}  # fmt: skip


def material_of(beam):
    """The keys of the material card of a beam. ValueError where it has none, or the card lacks a number."""
    if beam.Material is None:
        raise ValueError("no material is chosen; choose one of the cards")
    card = getattr(beam.Material, "Material", None)
    if not isinstance(card, dict):
        raise ValueError(f"{beam.Material.Label} is no material of Arch or FEM")
    keys = {}
    for key, (entry, unit) in _MATERIAL.items():
        text = card.get(entry, "").strip()
        if text:
            keys[key] = _number(text, unit, entry, beam.Material.Label)
        elif key in ("density", "youngs_modulus"):
            raise ValueError(f"{beam.Material.Label} has no {entry}; give it in the material card")
    return keys


def _number(text, unit, entry, label):
    try:
        quantity = FreeCAD.Units.Quantity(text)
        value = quantity.getValueAs(unit) if unit else quantity
        return rounded(getattr(value, "Value", value))
    except (ValueError, ArithmeticError):
        raise ValueError(f"{label}: {entry} is {text}; expected " + (f"a quantity in {unit}" if unit else "a number")) from None
