"""Supports, forces, sections and material of a FEM analysis."""

import FreeCAD

from .. import objects
from ..geometry import places
from ..geometry.edges import edge_of_nurbs


def fem_analyses(document):
    return [obj for obj in document.Objects if obj.TypeId == "Fem::FemAnalysis"]


def take_over(fem, analysis):
    """Makes beams, supports and loads in an analysis by a FEM analysis: (objects made, notes on what was left out)."""
    made, notes = [], []
    for section in (o for o in fem.Group if _kind(o) == "Fem::ElementGeometry1D"):
        made += _beams_of(section, fem, analysis, notes)
    beams = objects.members(analysis, objects.Beam)
    analysis.Document.recompute()
    if not any(_kind(each) == "Fem::ConstraintSelfWeight" for each in fem.Group):
        analysis.Gravity = 0  # FEM has no weight unless it is asked for
    for constraint in fem.Group:
        if constraint.TypeId == "Fem::ConstraintFixed":
            made += _at_references(constraint, objects.Support, beams, analysis, notes)
        elif constraint.TypeId == "Fem::ConstraintForce":
            made += _forces_of(constraint, beams, analysis, notes)
        elif _kind(constraint) == "Fem::ConstraintSelfWeight":
            analysis.GravityDirection = _gravity_of(constraint)
        elif "Constraint" in (_kind(constraint) or constraint.TypeId):
            notes.append(f"{constraint.Label}: this kind of constraint is not taken over; give the beams what stands for it")
    return made, notes


def _material_of(fem, root, name):
    """The card that refers to an edge; where none does, the one for all the rest."""
    cards = [obj for obj in fem.Group if isinstance(getattr(obj, "Material", None), dict)]
    own = [card for card in cards if any(obj is root and name in names for obj, names in getattr(card, "References", []))]
    rest = [card for card in cards if not getattr(card, "References", [])]
    return next(iter(own + rest), None)


def _edges_of(section, fem, notes):
    """(object, edge) of each edge that has a section; of one without references all that the mesh is made of."""
    if section.References:
        return [(root, name) for root, names in section.References for name in names]
    drawn = [each.Part for each in fem.Group if getattr(each, "Part", None) is not None]
    if not drawn:
        notes.append(f"{section.Label}: it refers to no edge, and there is no mesh whose edges it could mean; choose edges")
    return [(root, f"Edge{i}") for root in drawn for i in range(1, len(root.Shape.Edges) + 1)]


def _gravity_of(weight):
    """Three numbers in FreeCAD 0.20 and 0.21, a vector later."""
    if "GravityDirection" in weight.PropertiesList:
        return FreeCAD.Vector(weight.GravityDirection)
    return FreeCAD.Vector(weight.Gravity_x, weight.Gravity_y, weight.Gravity_z)


def _newtons(force):
    """FEM's `Force` is a number in newtons in FreeCAD 0.20, a quantity later."""
    return force.getValueAs("N").Value if hasattr(force, "getValueAs") else force


def _kind(obj):
    return getattr(getattr(obj, "Proxy", None), "Type", "")


def _beams_of(section, fem, analysis, notes):
    made = []
    for root, name in _edges_of(section, fem, notes):
        beam = objects.make(objects.Beam, analysis.Document, f"{root.Label} {name}", analysis)
        beam.Axis, beam.Material = (root, [name]), _material_of(fem, root, name)
        if not _take_section(beam, section):
            notes.append(f"{section.Label}: a section of type {section.SectionType} is not known; give the beam another")
        made.append(beam)
    return made


def _take_section(beam, section):
    """Whether the section is of a known type."""
    if section.SectionType == "Circular":
        beam.SectionKind, beam.Radius = "Round", section.CircDiameter / 2
    elif section.SectionType == "Pipe":
        beam.SectionKind, beam.Radius = "Pipe", section.PipeDiameter / 2
        beam.Bore = section.PipeDiameter / 2 - section.PipeThickness
    elif section.SectionType == "Rectangular":
        beam.SectionKind, beam.Width, beam.Height = "Rectangle", section.RectWidth, section.RectHeight
    else:
        return False
    return True


def _at_references(constraint, cls, beams, analysis, notes):
    """An object for each vertex that a constraint refers to, on the beam that it is an end or a place of."""
    made = []
    for root, names in constraint.References:
        for name in names:
            shape = places.shape_of(root, name)
            beam = _beam_at(shape, beams)
            if shape.ShapeType != "Vertex" or beam is None:
                notes.append(f"{constraint.Label}: {root.Label}.{name} is no point of a beam and is left out")
                continue
            obj = objects.make(cls, analysis.Document, f"{constraint.Label} {name}", analysis)
            obj.Beam, obj.PlaceKind, obj.Point = beam, "At a point", (root, [name])
            made.append(obj)
    return made


def _beam_at(vertex, beams):
    from ..case.axes import axis_of

    near = [(vertex.distToShape(edge_of_nurbs(axis_of(beam).nurbs))[0], i) for i, beam in enumerate(beams)]
    return beams[min(near)[1]] if near and min(near)[0] < 1e-3 else None


def _forces_of(constraint, beams, analysis, notes):
    """All references of a force share it."""
    loads = _at_references(constraint, objects.Load, beams, analysis, notes)
    direction = constraint.DirectionVector
    for load in loads:
        load.Force = f"{_newtons(constraint.Force) / len(loads)!r} N"
        load.Direction = direction
    return loads
