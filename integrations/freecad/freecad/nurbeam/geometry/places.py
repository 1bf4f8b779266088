"""What a link to parts of a document points at, in its world place."""

from typing import NamedTuple

import FreeCAD
import Part


PLANE = "Part::GeomPlane"
AXES = {"X": FreeCAD.Vector(1, 0, 0), "Y": FreeCAD.Vector(0, 1, 0), "Z": FreeCAD.Vector(0, 0, 1)}


class NoPlace(ValueError):
    """A link that leads nowhere, or to something of another kind; the text says which would do."""


class End(NamedTuple):
    """Where a cable is clamped."""

    point: FreeCAD.Vector
    """[mm]"""
    outward: FreeCAD.Vector
    """Of unit length: the way in which it leaves the point."""


def links_of(value):
    """The links, each to parts of one object, of an `App::PropertyXLinkSub` or an `App::PropertyXLinkSubList`.

    A list has them in the order of addresses in memory, which is another after loading: they are sorted by names, so that a
    beam has its start at the same end for ever."""
    if not value:
        return []
    is_list = isinstance(value, list) and isinstance(value[0], tuple)
    return sorted(value, key=lambda link: (link[0].Document.Name, link[0].Name)) if is_list else [value]


def parts_of_link(link):
    """(root object, path) of each part that a property of links names; the path is "" for the whole object."""
    return [part for each in links_of(link) for part in _parts_of_one(each)]


def _parts_of_one(link):
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


def has_body(link):
    """Whether the link names a solid or curved faces, as those of a pipe; the faces of closed lines are plane."""
    faces = [(shape, face) for shape in shapes_of_link(link) for face in shape.Faces]
    return any(shape.Solids or face.Surface.TypeId != PLANE for shape, face in faces)


def body_of_link(link):
    """All that the link names as one shape."""
    shapes = shapes_of_link(link)
    return shapes[0] if len(shapes) == 1 else Part.makeCompound(shapes)


def whole_bodies(links):
    """The links with the solid that a face bounds in the place of the face, as a click in the view names a face; where it
    bounds none, the whole object."""
    paths = {}
    for root, path in parts_of_link(links):
        prefix, _, element = path.rpartition(".")
        if element.startswith("Face"):
            path = _path_of_solid(root, f"{prefix}." if prefix else "", int(element[len("Face") :]))
        if path not in paths.setdefault(root, []):
            paths[root].append(path)
    return list(paths.items())


def _path_of_solid(root, prefix, number):
    owner = shape_of(root, prefix)
    if len(owner.Solids) < 2:
        return prefix
    face = owner.Faces[number - 1]
    owners = [i for i, solid in enumerate(owner.Solids, 1) if any(face.isSame(each) for each in solid.Faces)]
    return f"{prefix}Solid{owners[0]}" if owners else f"{prefix}Face{number}"


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
    along its axis, another edge at its end, or at that of its vertices which is named with it, along its tangent; a coordinate
    system at its origin along its x axis, or along that of its axes which is named."""
    end = _end_of_coordinate_system(link) or _end_of_shapes(shapes_of_link(link))
    return End(end.point, end.outward.negative()) if flip else end


def _end_of_shapes(shapes):
    if len(shapes) == 1 and shapes[0].ShapeType == "Face":
        return End(shapes[0].CenterOfMass, _outward_normal(shapes[0]))
    vertices = [s for s in shapes if s.ShapeType == "Vertex"]
    edges = [e for s in shapes if s.ShapeType != "Vertex" for e in s.Edges]
    if len(edges) == 1 and len(vertices) <= 1:
        return _end_of_edge(edges[0], vertices[0].Point if vertices else None)
    raise NoPlace("choose a plane face, a circle, a coordinate system, or an edge, with one of its two points where it matters which")


def is_coordinate_system(obj):
    """Whether an object is one of PartDesign, or of FreeCAD 1.0."""
    return any(obj.isDerivedFrom(kind) for kind in ("PartDesign::CoordinateSystem", "App::LocalCoordinateSystem"))


def _end_of_coordinate_system(link):
    """None where the link names something else."""
    parts = parts_of_link(link)
    if len(parts) != 1:
        return None
    root, path = parts[0]
    obj = root.getSubObject(path, retType=_OBJECT)
    if obj is None or not is_coordinate_system(obj):
        return None
    prefix, _, axis = path.rpartition(".")
    placement = root.getSubObject(f"{prefix}." if prefix else "", retType=_PLACEMENT)
    return End(placement.Base, placement.Rotation.multVec(AXES.get(axis, AXES["X"])))


_OBJECT, _PLACEMENT = 1, 3  # what getSubObject is asked for


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
    if face.Surface.TypeId != PLANE:
        raise NoPlace("the face is not plane; choose a plane face, or the circle around it")
    return FreeCAD.Vector(face.normalAt(0, 0)).normalize()
