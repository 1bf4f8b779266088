"""What ties beams that meet."""

from FreeCAD import Vector

from .feature import Feature, Property, type_of
from .place import SLOPE, about


class Joint(Feature):
    TYPE = "Nurbeam::Joint"
    PROPERTIES = (
        Property("LinkList", "Beams", "Joint", "Two or more beams that meet"),
        Property("Enumeration", "JointKind", "Joint", "Rigid: the angle between the beams stays", "Hinged", choices=("Hinged", "Rigid")),
        Property("XLinkSub", "Point", "Joint", "A vertex near which the beams meet; none: at an end of one of them"),
        Property("Vector", "HingeAxis", "Joint", "Beams that twist turn about this direction alone; 0 0 0: about all"),
        Property("Vector", "Position", "Joint", "The position in space", Vector(0, 0, 0), output=True),
        SLOPE,
    )  # fmt: skip

    def compute(self, obj):
        from ..case.positions import position_of_joint
        from .beam import Beam

        beams = [each for each in obj.Beams if type_of(each) == Beam.TYPE]
        if len(beams) < max(2, len(obj.Beams)):
            raise ValueError(f"Beams: {len(beams)} beams are chosen; expected {max(2, len(obj.Beams))}")
        with about("Point" if obj.Point else "Beams"):
            obj.Position = position_of_joint(obj)
