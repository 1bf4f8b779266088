"""What sliding bodies come up against."""

from .feature import Property
from .place import PLACE, Placed


class Stop(Placed):
    TYPE = "Nurbeam::Stop"
    PROPERTIES = (
        *PLACE,
        Property("LinkList", "Bodies", "Stop", "Bodies that it stops; none: all on the beam"),
        Property("Bool", "BetweenBodies", "Stop", "Keeps its two bodies apart, and stands at no position"),
        Property("Length", "Gap", "Stop", "Minimum distance of the two bodies along the beam"),
        Property("Enumeration", "Side", "Stop", "From where bodies come that it stops", "Both", choices=("Both", "Before", "After")),
        Property("Enumeration", "StopKind", "Stop", "Hard, or a buffer that gives way", "Hard", choices=("Hard", "Buffer")),
        Property("Float", "Restitution", "Stop", "Speed after an impact over the speed before"),
        Property("Quantity", "Stiffness", "Stop", "Force over how far the buffer is pressed in", "10000 N/m", "N/m"),
        Property("Quantity", "Damping", "Stop", "Force over the speed at which it is pressed in", "0 N*s/m", "N*s/m"),
    )  # fmt: skip
