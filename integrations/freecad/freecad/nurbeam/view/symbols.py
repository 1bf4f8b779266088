"""Symbols at places of beams, of one size on the screen."""

import FreeCAD
from pivy import coin

from .. import objects
from ..geometry import places

PIXELS = 14.0


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
    objects.Probe.TYPE: (_ball, (0.2, 0.6, 0.25)), objects.Joint.TYPE: (_ball, (0.1, 0.45, 0.75)),
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
        if getattr(obj, "Beam", None) is None and len(getattr(obj, "Beams", ())) < 2:
            self._switch.whichChild = coin.SO_SWITCH_NONE
            return
        try:
            direction = direction_of(obj)
        except (places.NoPlace, AttributeError):  # an object that is being made or loaded lacks properties
            return
        self._place.translation = tuple(obj.Position)
        turn = FreeCAD.Rotation(FreeCAD.Vector(0, 1, 0), direction).Q
        self._place.rotation = turn
        self._switch.whichChild = coin.SO_SWITCH_ALL


class Span:
    """The node of a connector: a dashed line between its ends; empty while they are not known."""

    def __init__(self):
        self.node, self._switch = coin.SoSeparator(), coin.SoSwitch()
        colour, style, self._points, line = coin.SoBaseColor(), coin.SoDrawStyle(), coin.SoCoordinate3(), coin.SoLineSet()
        colour.rgb = (0.85, 0.3, 0.1)
        style.lineWidth, style.linePattern = 2, 0x0FFF
        for child in (colour, style, self._points, line):
            self._switch.addChild(child)
        self.node.addChild(self._switch)
        self._switch.whichChild = coin.SO_SWITCH_NONE

    def update(self, obj):
        ends = [tuple(obj.FromPosition), tuple(obj.ToPosition)]
        self._points.point.setValues(0, 2, ends)
        self._switch.whichChild = coin.SO_SWITCH_NONE if ends[0] == ends[1] else coin.SO_SWITCH_ALL


def _of_one_size(shape):
    """The shape in pixels of the screen, by a node of FreeCAD's own."""
    scale = coin.SoType.fromName("SoShapeScale").createInstance()
    scale.setPart("shape", shape)
    scale.getField("scaleFactor").set(str(PIXELS))
    return scale


def direction_of(obj):
    """Where the symbol points: with a load, else up."""
    up = FreeCAD.Vector(0, 0, 1)
    if objects.type_of(obj) != objects.Load.TYPE:
        return up
    direction = places.direction_of_link(obj.DirectionOf) if obj.DirectionOf else obj.Direction
    return direction if direction.Length > 0 else up
