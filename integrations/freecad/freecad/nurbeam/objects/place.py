"""The properties of what stands at a place of a beam."""

import contextlib

from FreeCAD import Vector

from .feature import Feature, Property, type_of

BEAM = Property("Link", "Beam", "Place", "The beam on which it stands")
PLACE_KINDS = ("Start", "End", "Length", "Fraction", "At a point")
PLACE = (
    BEAM,
    Property("Enumeration", "PlaceKind", "Place", "How the position on the beam is given", "Start", choices=PLACE_KINDS),
    Property("Distance", "PlaceLength", "Place", "Length along the axis from the start of the beam"),
    Property("Float", "Fraction", "Place", "Part of the length of the axis, from 0 to 1", 0.5),
    Property("XLinkSub", "Point", "Place", "A vertex; the nearest point of the beam is meant"),
    Property("Vector", "Position", "Place", "The position in space", Vector(0, 0, 0), output=True),
)
TABLE = (
    Property("Link", "Table", "Table", "Spreadsheet with rows over time"),
    Property("String", "Range", "Table", "Cells of the table, the first row of which has the units: A1:D9"),
)
SLOPES = ("Automatic", "Continuous", "Discontinuous")
SLOPE = Property("Enumeration", "Slope", "More", "Whether the beam may have a slope discontinuity there", "Automatic", choices=SLOPES)


class Placed(Feature):
    """An object at a place of a beam; a recompute finds its position, and checks what it links to."""

    TABLE_UNITS = ()
    """Of the columns of its table."""

    def compute(self, obj):
        from ..case.positions import position_of
        from ..case.tables import rows_of_table

        check_beam(obj, "Beam")
        obj.Position = position_of(obj)
        if self.TABLE_UNITS and obj.Table is not None:
            with about("Range"):
                rows_of_table(obj.Table, obj.Range, self.TABLE_UNITS)


def check_beam(obj, prop):
    """ValueError where a link of an object leads to no beam."""
    from .beam import Beam

    target = getattr(obj, prop)
    if target is None:
        raise ValueError(f"{prop}: no beam is chosen")
    if type_of(target) != Beam.TYPE:
        raise ValueError(f"{prop}: {target.Label} is no beam")


@contextlib.contextmanager
def about(prop):
    """Puts the property before the text of what is raised."""
    try:
        yield
    except ValueError as problem:
        raise ValueError(f"{prop}: {problem}") from None
