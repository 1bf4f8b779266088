"""A cable between two connectors, of a given length, slack or bend radius, as it hangs."""

from FreeCAD import Vector

from .feature import Feature, Property


class CableOfLength(Feature):
    TYPE = "Nurbeam::CableOfLength"
    CONTAINER = "Part::FeaturePython"
    PROPERTIES = (
        Property("XLinkSub", "From", "Ends", "A plane face, a circle, a coordinate system, or an edge with one of its two points"),
        Property("XLinkSub", "To", "Ends", "A plane face, a circle, a coordinate system, or an edge with one of its two points"),
        Property("Bool", "FromFlip", "Ends", "The cable leaves the other way"),
        Property("Bool", "ToFlip", "Ends", "The cable leaves the other way"),
        Property("Enumeration", "Goal", "Length", "What is known of the length", "Slack", choices=("Length", "Slack", "Bend radius")),
        Property("Length", "CableLength", "Length", "Length without stress"),
        Property("Float", "Slack", "Length", "Excess of the length over the distance of the ends, in percent", 10.0),
        Property("Length", "BendRadius", "Length", "Minimum bend radius; the shortest length that respects it is found"),
        Property("Length", "Diameter", "Cable", "Outer diameter of the cable", "6 mm"),
        Property("Quantity", "MassPerLength", "Cable", "Mass of each metre", "0.1 kg/m", "kg/m"),
        Property("Quantity", "BendingStiffness", "Cable", "Bending stiffness EI", "0.02 N*m^2", "N*m^2"),
        Property("Force", "AxialStiffness", "Cable", "Axial stiffness EA", "100 kN"),
        Property("Vector", "GravityDirection", "Cable", "Direction of gravity; 0 0 0: no weight", Vector(0, 0, -1)),
        Property("Bool", "Solid", "Cable", "Makes a solid of that diameter, instead of the axis alone"),
        Property("Bool", "RunNow", "Cable", "Whether the next recompute may take its time", False, hidden=True, output=True),
        Property("Length", "LengthFound", "Found", "Length without stress", output=True),
        Property("Length", "LeastRadius", "Found", "Minimum bend radius: EI over the maximum moment", output=True),
        Property("Force", "LargestTension", "Found", "Maximum tension", output=True),
    )  # fmt: skip

    failed = None
    """What the last search was asked that has found nothing, and the message."""

    def compute(self, obj):
        from ..run.route import found_route

        route = found_route(obj)
        obj.Shape = route.shape
        obj.LengthFound = route.length
        obj.LeastRadius = route.least_radius
        obj.LargestTension = route.largest_tension
