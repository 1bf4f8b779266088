"""A spring, rope or rod between bodies, beams and points."""

from FreeCAD import Vector

from .feature import Feature, Property, type_of
from .place import PLACE_KINDS, SLOPES, about


def _end(prefix):
    return (
        Property("Link", f"{prefix}Object", prefix, "A beam or a sliding body; none: a point in space"),
        Property("Enumeration", f"{prefix}PlaceKind", prefix, "How the position on the beam is given", "Start", choices=PLACE_KINDS),
        Property("Distance", f"{prefix}PlaceLength", prefix, "Length along the axis from the start of the beam"),
        Property("Float", f"{prefix}Fraction", prefix, "Part of the length of the axis, from 0 to 1", 0.5),
        Property("XLinkSub", f"{prefix}Point", prefix, "A vertex: the point in space, or the one whose nearest point of the beam is meant"),
        Property("Quantity", f"{prefix}Mass", prefix, "Mass of a clamp there", "0 kg", "kg"),
        Property("Vector", f"{prefix}Position", prefix, "The position in space", Vector(0, 0, 0), output=True),
        Property("Enumeration", f"{prefix}Slope", prefix, "Whether the beam may have a slope discontinuity there", "Automatic", choices=SLOPES),
    )


class Connector(Feature):
    TYPE = "Nurbeam::Connector"
    PROPERTIES = (
        *_end("From"),
        *_end("To"),
        Property("Enumeration", "ConnectorKind", "Connector", "Kind of connector", "Spring",
                 choices=("Spring", "Tension only", "Compression only", "Rod", "Rotational")),
        Property("Quantity", "Stiffness", "Connector", "Force per stretch", "1000 N/m", "N/m"),
        Property("Quantity", "Damping", "Connector", "Force per speed of the stretch", "0 N*s/m", "N*s/m"),
        Property("Enumeration", "LengthKind", "Connector", "What is known of its free length", "Drawn",
                 choices=("Drawn", "Length", "Force")),
        Property("Length", "FreeLength", "Connector", "Length without force"),
        Property("Force", "Force", "Connector", "Force at the start, positive where it pulls"),
        Property("Vector", "Direction", "Connector", "It acts along this direction alone; 0 0 0: along itself", Vector(0, 0, 0)),
        Property("Quantity", "RotationalStiffness", "Connector", "Moment per angle", "1000 N*m/rad", "N*m/rad"),
        Property("Quantity", "RotationalDamping", "Connector", "Moment per speed of the angle", "0 N*m*s/rad", "N*m*s/rad"),
        Property("Vector", "RotationAxis", "Connector", "Axis about which the angle counts; 0 0 0: any turn is resisted",
                 Vector(0, 0, 0)),
        Property("Quantity", "FreeAngle", "Connector", "Angle since the drawing at which it is free", "0 deg", "deg"),
        Property("Quantity", "Moment", "Connector", "Additional moment, positive where it turns the second end back", "0 N*m",
                 "N*m"),
    )  # fmt: skip

    def compute(self, obj):
        from ..case.positions import position_of_end

        for prefix in ("From", "To"):
            with about(f"{prefix}Object"):
                self._check_end(obj, prefix)
            setattr(obj, f"{prefix}Position", position_of_end(obj, prefix))

    @staticmethod
    def _check_end(obj, prefix):
        from .beam import Beam
        from .sliding_body import SlidingBody

        target = getattr(obj, f"{prefix}Object")
        if target is not None and type_of(target) not in (Beam.TYPE, SlidingBody.TYPE):
            raise ValueError(f"{target.Label} is neither a beam nor a sliding body")
        by_point = target is None or (type_of(target) == Beam.TYPE and getattr(obj, f"{prefix}PlaceKind") == "At a point")
        if by_point and not getattr(obj, f"{prefix}Point"):
            raise ValueError("nothing is chosen; choose a beam, a body, or a vertex as point")
