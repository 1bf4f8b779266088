"""Beams of a document as those of a case."""

from .axes import axis_of
from .sections import material_of, section_of
from .values import si, vector

STRESS_FREE = {"As drawn": "as-drawn", "Straight": "straight", "As drawn without torsion": "as-drawn-without-torsion"}


def beam_keys(beam, name, writer, path):
    """The keys of a beam; what is wrong with it goes to the writer."""
    keys = {"name": name}
    writer.place(path, beam, "Axis")
    with writer.faults_of(beam, "Axis"):
        axis = axis_of(beam)
        keys["axis"] = {"nurbs": axis.nurbs}
        if axis.deviation > 0:
            writer.note(beam, "Axis", f"the curve is no NURBS and is taken within {axis.deviation:.2g} mm")
        if not beam.Guide:
            _write_section(beam, axis, keys, writer, path)
    if beam.Guide:
        keys["rigid"] = True
        return keys
    with writer.faults_of(beam, "Material"):
        writer.place(f"{path}.material", beam, "Material")
        keys["material"] = material_of(beam)
    _write_choices(beam, keys, writer, path)
    _write_length(beam, keys, writer, path)
    writer.place(f"{path}.elements", beam, "Elements")
    keys["elements"] = {"count": beam.Elements} if beam.Elements else {"tolerance": beam.ElementTolerance}
    if not beam.Elements:
        writer.place(f"{path}.elements", beam, "ElementTolerance")
    return keys


def _write_section(beam, axis, keys, writer, path):
    with writer.faults_of(beam, "SectionKind"):
        writer.place(f"{path}.section", beam, "SectionKind")
        keys["section"], properties, profile = section_of(beam, axis)
        for key, prop in properties.items():
            writer.place(f"{path}.section.{key}", beam, prop)
        if profile:
            writer.files[profile.file] = profile.edges


def _write_choices(beam, keys, writer, path):
    if beam.StressFree in STRESS_FREE:
        keys["stress_free"] = STRESS_FREE[beam.StressFree]
    for prop, key in (("Torsion", "torsion"), ("Ring", "closed")):
        if getattr(beam, prop) != "Automatic":
            keys[key] = getattr(beam, prop) == "Yes"
        writer.place(f"{path}.{key}", beam, prop)
    if beam.Corners != "Automatic":
        keys["corners"] = beam.Corners.lower()
    if beam.Orientation != "Automatic":
        key = {"Up": "up", "At the start": "start", "Centre of curvature": "frenet"}[beam.Orientation]
        keys["orientation"] = {key: True if key == "frenet" else vector(beam.Up)}
    for key, prop in (("stress_free", "StressFree"), ("corners", "Corners"), ("orientation", "Orientation")):
        writer.place(f"{path}.{key}", beam, prop)


def _write_length(beam, keys, writer, path):
    if beam.LengthKind == "Unstressed length":
        keys["unstressed_length"] = si(beam.UnstressedLength, "m")
    elif beam.LengthKind == "Tension":
        keys["tension"] = si(beam.Tension, "N")
    if temperature := si(beam.Temperature, "K"):
        keys["temperature"] = temperature
    for key, prop in (("unstressed_length", "UnstressedLength"), ("tension", "Tension"), ("temperature", "Temperature")):
        writer.place(f"{path}.{key}", beam, prop)
