"""A force or a moment on a beam."""

from FreeCAD import Vector

from .feature import Property
from .place import PLACE, SLOPE, TABLE, Placed, about


class Load(Placed):
    TYPE = "Nurbeam::Load"
    TABLE_UNITS = ("s", "1")
    PROPERTIES = (
        *PLACE,
        Property("Enumeration", "LoadKind", "Load", "Force and moment act at a position, the others along the whole beam", "Force",
                 choices=("Force", "Moment", "Force per length", "Torque per length")),
        Property("Force", "Force", "Load", "Magnitude"),
        Property("Quantity", "Moment", "Load", "Magnitude", "0 N*m", "N*m"),
        Property("Quantity", "ForcePerLength", "Load", "Magnitude", "0 N/m", "N/m"),
        Property("Quantity", "TorquePerLength", "Load", "Torque about the axis, for each metre", "0 N", "N"),
        Property("Vector", "Direction", "Load", "Direction of the load; of any length", Vector(0, 0, -1)),
        Property("XLinkSub", "DirectionOf", "Load", "A straight edge or a plane face whose direction is taken instead"),
        Property("Bool", "Follower", "Load", "The load turns with the section"),
        *TABLE,
        SLOPE,
    )  # fmt: skip

    def compute(self, obj):
        from ..geometry.places import direction_of_link

        super().compute(obj)
        if obj.DirectionOf:
            with about("DirectionOf"):
                direction_of_link(obj.DirectionOf)
