"""What sliding bodies come up against."""

from .feature import Property
from .place import PLACE, Placed


class Stop(Placed):
    TYPE = "Nurbeam::Stop"
    PROPERTIES = (
        *PLACE,
        Property("LinkList", "Bodies", "Stop", "Bodies that it stops; none: all on the beam"),
        Property("Bool", "BetweenBodies", "Stop", "It keeps its two bodies apart, and stands at no place"),
        Property("Length", "Gap", "Stop", "Least distance of its two bodies along the beam"),
        Property("Enumeration", "Side", "Stop", "From where bodies come that it stops", "Both", choices=("Both", "Before", "After")),
        Property("Enumeration", "StopKind", "Stop", "Hard, or a buffer that gives way", "Hard", choices=("Hard", "Buffer")),
        Property("Float", "Restitution", "Stop", "Of Hard: speed after over speed before"),
        Property("Quantity", "Stiffness", "Stop", "Of Buffer: force over how far it is pressed in", "10000 N/m", "N/m"),
        Property("Quantity", "Damping", "Stop", "Of Buffer: force over the speed of that", "0 N*s/m", "N*s/m"),
    )  # fmt: skip
