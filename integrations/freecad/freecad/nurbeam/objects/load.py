"""A force or a moment on a beam."""

from FreeCAD import Vector

from .feature import Property
from .place import PLACE, SLOPE, TABLE, Placed, about


class Load(Placed):
    TYPE = "Nurbeam::Load"
    TABLE_UNITS = ("s", "1")
    PROPERTIES = (
        *PLACE,
        Property("Enumeration", "LoadKind", "Load", "At the place: Force, Moment; along the whole beam: the others", "Force",
                 choices=("Force", "Moment", "Force per length", "Torque per length")),
        Property("Force", "Force", "Load", "Its magnitude"),
        Property("Quantity", "Moment", "Load", "Its magnitude", "0 N*m", "N*m"),
        Property("Quantity", "ForcePerLength", "Load", "Its magnitude", "0 N/m", "N/m"),
        Property("Quantity", "TorquePerLength", "Load", "About the beam", "0 N", "N"),
        Property("Vector", "Direction", "Load", "Of any length", Vector(0, 0, -1)),
        Property("XLinkSub", "DirectionOf", "Load", "A straight edge or a plane face that gives the direction in its place"),
        Property("Bool", "Follower", "Load", "Turns with the section"),
        *TABLE,
        SLOPE,
    )  # fmt: skip

    def compute(self, obj):
        from ..geometry.places import direction_of_link

        super().compute(obj)
        if obj.DirectionOf:
            with about("DirectionOf"):
                direction_of_link(obj.DirectionOf)
