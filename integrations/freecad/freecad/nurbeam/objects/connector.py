"""A spring, rope or rod between bodies, beams and points."""

from FreeCAD import Vector

from .feature import Feature, Property
from .place import PLACE_KINDS


def _end(prefix):
    return (
        Property("Link", f"{prefix}Object", prefix, "A beam or a sliding body; where nothing is chosen a point in space"),
        Property("Enumeration", f"{prefix}PlaceKind", prefix, "How the place of the beam is given", "Start", choices=PLACE_KINDS),
        Property("Distance", f"{prefix}PlaceLength", prefix, "Drawn length from the start of the beam, with Length"),
        Property("Float", f"{prefix}Fraction", prefix, "Part of the drawn length, with Fraction", 0.5),
        Property("XLinkSub", f"{prefix}Point", prefix, "A vertex: the point in space, or that near which the beam is meant"),
    )


class Connector(Feature):
    TYPE = "Nurbeam::Connector"
    PROPERTIES = (
        *_end("From"),
        *_end("To"),
        Property("Enumeration", "ConnectorKind", "Connector", "What it is", "Spring",
                 choices=("Spring", "Tension only", "Compression only", "Rod")),
        Property("Quantity", "Stiffness", "Connector", "Force per stretch; not of Rod", "1000 N/m", "N/m"),
        Property("Quantity", "Damping", "Connector", "Force per speed of the stretch", "0 N*s/m", "N*s/m"),
        Property("Enumeration", "LengthKind", "Connector", "What is known of its free length", "Drawn",
                 choices=("Drawn", "Length", "Force")),
        Property("Length", "FreeLength", "Connector", "With Length"),
        Property("Force", "Force", "Connector", "At the start, positive where it pulls, with Force"),
        Property("Vector", "Direction", "Connector", "It acts along this direction alone; 0 0 0: along itself", Vector(0, 0, 0)),
    )  # fmt: skip
