"""Symbols at places of beams, of one size on the screen."""

import FreeCAD
from pivy import coin

from .. import objects
from ..case.axes import axis_of
from ..geometry import places
from ..geometry.edges import edge_of_nurbs

PIXELS = 8.0


def _cone():
    cone = coin.SoCone()
    cone.bottomRadius, cone.height = 0.5, 1.0
    return _moved(cone, (0, -0.5, 0))  # its tip at the place


def _box():
    box = coin.SoCube()
    box.width = box.height = box.depth = 0.9
    return _moved(box, (0, 0, 0))


def _ball():
    ball = coin.SoSphere()
    ball.radius = 0.35
    return _moved(ball, (0, 0, 0))


def _arrow():
    group = coin.SoSeparator()
    shaft, head = coin.SoCylinder(), coin.SoCone()
    shaft.radius, shaft.height = 0.08, 1.4
    head.bottomRadius, head.height = 0.3, 0.8
    group.addChild(_moved(shaft, (0, -1.5, 0)))
    group.addChild(_moved(head, (0, -0.4, 0)))
    return group


def _moved(shape, by):
    group, shift = coin.SoSeparator(), coin.SoTranslation()
    shift.translation = by
    group.addChild(shift)
    group.addChild(shape)
    return group


SYMBOLS = {
    objects.Support.TYPE: (_cone, (0.1, 0.45, 0.75)), objects.Load.TYPE: (_arrow, (0.8, 0.15, 0.1)),
    objects.SlidingBody.TYPE: (_box, (0.85, 0.55, 0.1)), objects.Stop.TYPE: (_box, (0.35, 0.35, 0.35)),
    objects.Probe.TYPE: (_ball, (0.2, 0.6, 0.25)),
}  # fmt: skip


class Symbol:
    """The node of one object; empty while its place is not known."""

    def __init__(self, kind):
        shape, colour = SYMBOLS[kind]
        self.node = coin.SoSeparator()
        self._switch = coin.SoSwitch()
        self._place = coin.SoTransform()
        material = coin.SoMaterial()
        material.diffuseColor = colour
        self._switch.addChild(material)
        self._switch.addChild(self._place)
        self._switch.addChild(_of_one_size(shape()))
        self.node.addChild(self._switch)
        self._switch.whichChild = coin.SO_SWITCH_NONE

    def update(self, obj):
        """Puts it where the object stands now."""
        try:
            point, direction = place_and_direction(obj)
        except (ValueError, RuntimeError, AttributeError, ReferenceError):  # half said as yet
            self._switch.whichChild = coin.SO_SWITCH_NONE
            return
        self._place.translation = (point.x, point.y, point.z)
        turn = FreeCAD.Rotation(FreeCAD.Vector(0, 1, 0), direction).Q
        self._place.rotation = turn
        self._switch.whichChild = coin.SO_SWITCH_ALL


def _of_one_size(shape):
    """The shape in pixels of the screen, by a node of FreeCAD's own."""
    scale = coin.SoType.fromName("SoShapeScale").createInstance()
    scale.setPart("shape", shape)
    scale.getField("scaleFactor").set(str(PIXELS))
    return scale


def place_and_direction(obj):
    """Where an object stands [mm], and where its symbol points. ValueError where that is not said."""
    if obj.Beam is None:
        raise ValueError("no beam is chosen")
    edge = edge_of_nurbs(axis_of(obj.Beam).nurbs)
    point = edge.valueAt(_parameter(obj, edge))
    return point, _direction(obj)


def _parameter(obj, edge):
    if getattr(obj, "LoadKind", "").endswith("per length"):
        return edge.getParameterByLength(0.5 * edge.Length)
    if obj.PlaceKind == "End":
        return edge.LastParameter
    if obj.PlaceKind == "Length":
        return edge.getParameterByLength(min(max(obj.PlaceLength.Value, 0), edge.Length))
    if obj.PlaceKind == "Fraction":
        return edge.getParameterByLength(min(max(obj.Fraction, 0), 1) * edge.Length)
    if obj.PlaceKind == "At a point":
        return edge.Curve.parameter(places.point_of_link(obj.Point))
    return edge.FirstParameter


def _direction(obj):
    up = FreeCAD.Vector(0, 0, 1)
    if objects.type_of(obj) != objects.Load.TYPE:
        return up
    direction = places.direction_of_link(obj.DirectionOf) if obj.DirectionOf else obj.Direction
    return direction if direction.Length > 0 else up
