"""What holds a place of a beam."""

from FreeCAD import Vector

from .feature import Property
from .place import PLACE, SLOPE, TABLE, Placed


class Support(Placed):
    TYPE = "Nurbeam::Support"
    TABLE_UNITS = ("s", "m", "m", "m")
    PROPERTIES = (
        *PLACE,
        Property("Enumeration", "SupportKind", "Support", "What it holds: position and direction; position; position and "
                 "roll; position but for one direction", "Clamped", choices=("Clamped", "Pinned", "Fork", "Guided")),
        Property("Vector", "Direction", "Support", "Direction in which the support is free; of any length", Vector(1, 0, 0)),
        Property("Vector", "HingeAxis", "Support", "The section of a beam that twists turns about this direction alone; 0 0 0: about all"),
        Property("Force", "Pull", "Support", "Force along the direction, as of a weight over a pulley"),
        Property("Quantity", "PullMass", "Support", "Inertia of that weight", "0 kg", "kg"),
        *TABLE,
        SLOPE,
    )  # fmt: skip
