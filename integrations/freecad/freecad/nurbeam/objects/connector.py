"""A spring, rope or rod between bodies, beams and points."""

from FreeCAD import Vector

from .feature import Feature, Property, type_of
from .place import PLACE_KINDS, SLOPES, about


def _end(prefix):
    return (
        Property("Link", f"{prefix}Object", prefix, "A beam or a sliding body; where nothing is chosen a point in space"),
        Property("Enumeration", f"{prefix}PlaceKind", prefix, "How the place of the beam is given", "Start", choices=PLACE_KINDS),
        Property("Distance", f"{prefix}PlaceLength", prefix, "Drawn length from the start of the beam, with Length"),
        Property("Float", f"{prefix}Fraction", prefix, "Part of the drawn length, with Fraction", 0.5),
        Property("XLinkSub", f"{prefix}Point", prefix, "A vertex: the point in space, or that near which the beam is meant"),
        Property("Quantity", f"{prefix}Mass", prefix, "Of a clamp there", "0 kg", "kg"),
        Property("Enumeration", f"{prefix}Slope", prefix, "Whether the beam may have a kink there", "Automatic", choices=SLOPES),
    )


class Connector(Feature):
    TYPE = "Nurbeam::Connector"
    PROPERTIES = (
        *_end("From"),
        *_end("To"),
        Property("Enumeration", "ConnectorKind", "Connector", "What it is", "Spring",
                 choices=("Spring", "Tension only", "Compression only", "Rod", "Rotational")),
        Property("Quantity", "Stiffness", "Connector", "Force per stretch", "1000 N/m", "N/m"),
        Property("Quantity", "Damping", "Connector", "Force per speed of the stretch", "0 N*s/m", "N*s/m"),
        Property("Enumeration", "LengthKind", "Connector", "What is known of its free length", "Drawn",
                 choices=("Drawn", "Length", "Force")),
        Property("Length", "FreeLength", "Connector", "With Length"),
        Property("Force", "Force", "Connector", "At the start, positive where it pulls, with Force"),
        Property("Vector", "Direction", "Connector", "It acts along this direction alone; 0 0 0: along itself", Vector(0, 0, 0)),
        Property("Quantity", "RotationalStiffness", "Connector", "Of Rotational: moment per angle", "1000 N*m/rad", "N*m/rad"),
        Property("Quantity", "RotationalDamping", "Connector", "Of Rotational: moment per speed of the angle", "0 N*m*s/rad", "N*m*s/rad"),
        Property("Vector", "RotationAxis", "Connector", "Of Rotational: about which the angle counts; 0 0 0: any turn is resisted",
                 Vector(0, 0, 0)),
        Property("Quantity", "FreeAngle", "Connector", "Of Rotational: the angle since the drawing where it is free", "0 deg", "deg"),
        Property("Quantity", "Moment", "Connector", "Of Rotational: a moment besides, positive where it turns the second end back", "0 N*m",
                 "N*m"),
    )  # fmt: skip

    def compute(self, obj):
        for prefix in ("From", "To"):
            with about(f"{prefix}Object"):
                self._check_end(obj, prefix)

    @staticmethod
    def _check_end(obj, prefix):
        from ..geometry.places import point_of_link
        from .beam import Beam
        from .sliding_body import SlidingBody

        target = getattr(obj, f"{prefix}Object")
        if target is not None and type_of(target) not in (Beam.TYPE, SlidingBody.TYPE):
            raise ValueError(f"{target.Label} is neither a beam nor a sliding body")
        by_point = target is None or (type_of(target) == Beam.TYPE and getattr(obj, f"{prefix}PlaceKind") == "At a point")
        if by_point and not getattr(obj, f"{prefix}Point"):
            raise ValueError("nothing is chosen; choose a beam, a body, or a vertex as point")
        if by_point:
            point_of_link(getattr(obj, f"{prefix}Point"))
