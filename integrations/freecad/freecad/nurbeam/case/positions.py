"""Where places of beams are in space."""

from ..geometry import places
from ..geometry.edges import edge_of_nurbs
from .axes import axis_of


def position_of(obj):
    """Of an object at a place of a beam, as drawn [mm]; of a load along the whole beam its middle. ValueError where the place
    is not on the beam."""
    edge = _edge_of(obj.Beam)
    if getattr(obj, "LoadKind", "").endswith("per length"):
        return edge.valueAt(edge.getParameterByLength(0.5 * edge.Length))
    return edge.valueAt(_parameter(obj, edge))


def position_of_end(obj, prefix):
    """Of an end of a connector: on a beam, at a sliding body, or a point in space."""
    target = getattr(obj, f"{prefix}Object")
    if target is None:
        return places.point_of_link(getattr(obj, f"{prefix}Point"))
    if "Axis" not in target.PropertiesList:
        return target.Position
    edge = _edge_of(target)
    return edge.valueAt(_parameter(obj, edge, prefix))


def position_of_joint(joint):
    """The point, or where the first two beams are nearest to each other."""
    if joint.Point:
        return places.point_of_link(joint.Point)
    first, second = (_edge_of(beam) for beam in joint.Beams[:2])
    return first.distToShape(second)[1][0][0]


def _edge_of(beam):
    return edge_of_nurbs(axis_of(beam).nurbs)


def _parameter(obj, edge, prefix=""):
    def value(name):
        return getattr(obj, prefix + name)

    kind = value("PlaceKind")
    if kind == "End":
        return edge.LastParameter
    if kind == "Length":
        return edge.getParameterByLength(_within(value("PlaceLength").Value, edge.Length, f"{prefix}PlaceLength", "mm"))
    if kind == "Fraction":
        return edge.getParameterByLength(_within(value("Fraction"), 1, f"{prefix}Fraction", "") * edge.Length)
    if kind == "At a point":
        return edge.Curve.parameter(places.point_of_link(value("Point")))
    return edge.FirstParameter


def _within(value, greatest, name, unit):
    if not 0 <= value <= greatest * (1 + 1e-9):
        raise ValueError(f"{name}: is {value:.10g} {unit}; must be between 0 and {greatest:.10g} {unit}".replace(" ;", ";").rstrip())
    return min(value, greatest)
