"""The properties of what stands at a place of a beam."""

from FreeCAD import Vector

from .feature import Feature, Property

BEAM = Property("Link", "Beam", "Place", "The beam")
PLACE_KINDS = ("Start", "End", "Length", "Fraction", "At a point")
PLACE = (
    BEAM,
    Property("Enumeration", "PlaceKind", "Place", "How the place is given", "Start", choices=PLACE_KINDS),
    Property("Distance", "PlaceLength", "Place", "Drawn length from the start of the beam, with Length"),
    Property("Float", "Fraction", "Place", "Part of the drawn length, from 0 to 1, with Fraction", 0.5),
    Property("XLinkSub", "Point", "Place", "A vertex, of which the nearest place of the beam is meant, with At a point"),
    Property("Vector", "Position", "Place", "Where that is", Vector(0, 0, 0), output=True),
)
TABLE = (
    Property("Link", "Table", "Table", "Spreadsheet with rows over time"),
    Property("String", "Range", "Table", "Cells of the table, the first row of which has the units: A1:D9"),
)
SLOPES = ("Automatic", "Continuous", "Discontinuous")
SLOPE = Property("Enumeration", "Slope", "More", "Whether the beam may have a kink there", "Automatic", choices=SLOPES)


class Placed(Feature):
    """An object at a place of a beam; a recompute finds its position."""

    def compute(self, obj):
        from ..case.positions import position_of

        if obj.Beam is not None:
            obj.Position = position_of(obj)
