"""Where places of beams are in space."""

from ..geometry import places
from ..geometry.edges import edge_of_nurbs
from .axes import axis_of


def position_of(obj):
    """Of an object at a place of a beam, as drawn [mm]; of a load along the whole beam its middle. ValueError where the place
    is not on the beam."""
    edge = edge_of_nurbs(axis_of(obj.Beam).nurbs)
    return edge.valueAt(_parameter(obj, edge))


def _parameter(obj, edge):
    if getattr(obj, "LoadKind", "").endswith("per length"):
        return edge.getParameterByLength(0.5 * edge.Length)
    if obj.PlaceKind == "End":
        return edge.LastParameter
    if obj.PlaceKind == "Length":
        return edge.getParameterByLength(_within(obj.PlaceLength.Value, edge.Length, "PlaceLength", "mm"))
    if obj.PlaceKind == "Fraction":
        return edge.getParameterByLength(_within(obj.Fraction, 1, "Fraction", "") * edge.Length)
    if obj.PlaceKind == "At a point":
        return edge.Curve.parameter(places.point_of_link(obj.Point))
    return edge.FirstParameter


def _within(value, greatest, name, unit):
    if not 0 <= value <= greatest * (1 + 1e-9):
        raise ValueError(f"{name}: is {value:.10g} {unit}; must be between 0 and {greatest:.10g} {unit}".replace(" ;", ";").rstrip())
    return min(value, greatest)
