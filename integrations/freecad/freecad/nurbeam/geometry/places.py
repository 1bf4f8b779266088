"""What a link to parts of a document points at, in its world place."""

from typing import NamedTuple

import FreeCAD
import Part


class NoPlace(ValueError):
    """A link that leads nowhere, or to something of another kind; the text says which would do."""


class End(NamedTuple):
    """Where a cable is clamped."""

    point: FreeCAD.Vector
    """[mm]"""
    outward: FreeCAD.Vector
    """Of unit length: the way in which it leaves the point."""


def parts_of_link(link):
    """(root object, path) of each part that an `App::PropertyXLinkSub` names; the path is "" for the whole object."""
    if not link:
        return []
    root, paths = link if isinstance(link, (tuple, list)) else (link, [])
    paths = [paths] if isinstance(paths, str) else list(paths)
    return [(root, path) for path in (paths or [""])]


def shape_of(root, path):
    """The shape at a path of an object in its world place, through parts and links. NoPlace where there is none."""
    shape = Part.getShape(root, path, needSubElement=bool(path) and not path.endswith("."))
    if shape.isNull():
        raise NoPlace(f"{root.Label}.{path} is no shape" if path else f"{root.Label} has no shape")
    return shape


def shapes_of_link(link):
    return [shape_of(*part) for part in parts_of_link(link)]


def edges_of_link(link):
    """All edges that the link names, of wires, sketches and whole objects all of theirs."""
    return [edge for shape in shapes_of_link(link) for edge in shape.Edges]


def is_solid(link):
    """Whether the link names one solid as a whole, as a pipe is one."""
    shapes = shapes_of_link(link)
    return len(shapes) == 1 and len(shapes[0].Solids) >= 1


def point_of_link(link):
    """The vertex, or the centre of the one shape, that the link names [mm]."""
    shapes = shapes_of_link(link)
    if len(shapes) != 1:
        raise NoPlace("choose one point")
    shape = shapes[0]
    return shape.Point if shape.ShapeType == "Vertex" else shape.CenterOfMass


def direction_of_link(link):
    """The direction of a straight edge, or the normal of a plane face, that the link names; of unit length."""
    shapes = shapes_of_link(link)
    if len(shapes) != 1:
        raise NoPlace("choose one straight edge or one plane face")
    shape = shapes[0]
    if shape.ShapeType == "Face":
        return _outward_normal(shape)
    if shape.Edges:
        return _tangent(shape.Edges[0], shape.Edges[0].FirstParameter)
    raise NoPlace(f"a {shape.ShapeType.lower()} has no direction; choose a straight edge or a plane face")


def end_of_link(link, flip=False):
    """Where a cable leaves what the link names: a plane face at its centre along its outward normal, a circle at its centre
    along its axis, another edge at the end that is nearest to nothing else, along its tangent; an end of an edge where its
    vertex is named with it."""
    shapes = shapes_of_link(link)
    end = _end_of_shapes(shapes)
    return End(end.point, end.outward.negative()) if flip else end


def _end_of_shapes(shapes):
    if len(shapes) == 1 and shapes[0].ShapeType == "Face":
        return End(shapes[0].CenterOfMass, _outward_normal(shapes[0]))
    vertices = [s for s in shapes if s.ShapeType == "Vertex"]
    edges = [e for s in shapes if s.ShapeType != "Vertex" for e in s.Edges]
    if len(edges) == 1 and len(vertices) <= 1:
        return _end_of_edge(edges[0], vertices[0].Point if vertices else None)
    raise NoPlace("choose a plane face, a circle, or an edge, with one of its two points where it matters which")


def _end_of_edge(edge, near):
    curve = edge.Curve
    if curve.TypeId == "Part::GeomCircle" and near is None:
        return End(curve.Center, FreeCAD.Vector(curve.Axis).normalize())
    first, last = edge.FirstParameter, edge.LastParameter
    at_start = near is not None and edge.valueAt(first).distanceToPoint(near) < edge.valueAt(last).distanceToPoint(near)
    tangent = _tangent(edge, first if at_start else last)
    return End(edge.valueAt(first if at_start else last), tangent.negative() if at_start else tangent)


def _tangent(edge, parameter):
    return FreeCAD.Vector(edge.tangentAt(parameter)).normalize()


def _outward_normal(face):
    if face.Surface.TypeId != "Part::GeomPlane":
        raise NoPlace("the face is not plane; choose a plane face, or the circle around it")
    return FreeCAD.Vector(face.normalAt(0, 0)).normalize()
