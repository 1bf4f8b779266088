"""The properties of what stands at a place of a beam."""

from .feature import Property

BEAM = Property("Link", "Beam", "Place", "The beam")
PLACE_KINDS = ("Start", "End", "Length", "Fraction", "At a point")
PLACE = (
    BEAM,
    Property("Enumeration", "PlaceKind", "Place", "How the place is given", "Start", choices=PLACE_KINDS),
    Property("Distance", "PlaceLength", "Place", "Drawn length from the start of the beam, with Length"),
    Property("Float", "Fraction", "Place", "Part of the drawn length, from 0 to 1, with Fraction", 0.5),
    Property("XLinkSub", "Point", "Place", "A vertex, of which the nearest place of the beam is meant, with At a point"),
)
TABLE = (
    Property("Link", "Table", "Table", "Spreadsheet with rows over time"),
    Property("String", "Range", "Table", "Cells of the table, the first row of which has the units: A1:D9"),
)
SLOPES = ("Automatic", "Continuous", "Discontinuous")
SLOPE = Property("Enumeration", "Slope", "More", "Whether the beam may have a kink there", "Automatic", choices=SLOPES)
