"""What ties beams that meet."""

from .feature import Feature, Property
from .place import SLOPE


class Joint(Feature):
    TYPE = "Nurbeam::Joint"
    PROPERTIES = (
        Property("LinkList", "Beams", "Joint", "Two or more beams that meet"),
        Property("Enumeration", "JointKind", "Joint", "Rigid: the angle between them stays", "Hinged", choices=("Hinged", "Rigid")),
        Property("XLinkSub", "Point", "Joint", "A vertex near which they meet; where nothing is chosen at an end of one of them"),
        Property("Vector", "HingeAxis", "Joint", "Of Hinged, of beams that twist: they turn about this direction alone; 0 0 0: about all"),
        SLOPE,
    )  # fmt: skip
