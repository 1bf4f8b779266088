"""A cable between two connectors, of a given length, slack or bend radius, as it hangs."""

from FreeCAD import Vector

from .feature import Feature, Property


class CableOfLength(Feature):
    TYPE = "Nurbeam::CableOfLength"
    CONTAINER = "Part::FeaturePython"
    PROPERTIES = (
        Property("XLinkSub", "From", "Ends", "A plane face, a circle, or an edge with one of its two points"),
        Property("XLinkSub", "To", "Ends", "A plane face, a circle, or an edge with one of its two points"),
        Property("Bool", "FromFlip", "Ends", "The cable leaves the other way"),
        Property("Bool", "ToFlip", "Ends", "The cable leaves the other way"),
        Property("Enumeration", "Goal", "Length", "What is known of its length", "Slack", choices=("Length", "Slack", "Bend radius")),
        Property("Length", "CableLength", "Length", "Unstressed, with Length"),
        Property("Float", "Slack", "Length", "Length over the distance of the ends, less 1, in percent", 10.0),
        Property("Length", "BendRadius", "Length", "That no place may fall below, with Bend radius; the shortest length is taken"),
        Property("Length", "Diameter", "Cable", "As it is drawn", "6 mm"),
        Property("Quantity", "MassPerLength", "Cable", "", "0.1 kg/m", "kg/m"),
        Property("Quantity", "BendingStiffness", "Cable", "EI", "0.02 N*m^2", "N*m^2"),
        Property("Force", "AxialStiffness", "Cable", "EA", "100 kN"),
        Property("Vector", "GravityDirection", "Cable", "The way down; 0 0 0: no weight", Vector(0, 0, -1)),
        Property("Bool", "Solid", "Cable", "A solid of that diameter, not its axis alone"),
        Property("Bool", "RunNow", "Cable", "Whether the next recompute may take its time", False, hidden=True, output=True),
        Property("Length", "LengthFound", "Found", "Unstressed", output=True),
        Property("Length", "LeastRadius", "Found", "Of bending: EI over the largest moment", output=True),
        Property("Force", "LargestTension", "Found", "", output=True),
    )  # fmt: skip

    def compute(self, obj):
        from ..run.route import found_route

        route = found_route(obj)
        obj.Shape = route.shape
        obj.LengthFound = route.length
        obj.LeastRadius = route.least_radius
        obj.LargestTension = route.largest_tension
