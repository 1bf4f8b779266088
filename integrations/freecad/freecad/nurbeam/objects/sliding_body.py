"""A body that slides on a beam."""

from .feature import Property
from .place import PLACE, SLOPE, TABLE, Placed


class SlidingBody(Placed):
    TYPE = "Nurbeam::SlidingBody"
    TABLE_UNITS = ("s", "m")
    PROPERTIES = (
        *PLACE,
        Property("Quantity", "Mass", "Body", "Mass of the body", "1 kg", "kg"),
        Property("Quantity", "RollInertia", "Body", "Moment of inertia about the beam, of a body that rolls with a beam that twists",
                 "0 kg*m^2", "kg*m^2"),
        Property("Area", "DragArea", "Body", "Drag coefficient times area"),
        Property("Speed", "Speed", "Motion", "Speed at the start, along the beam"),
        Property("Quantity", "Release", "Motion", "Time until which the body is locked; 0: free from the start", "0 s", "s"),
        *TABLE,
        Property("Float", "Friction", "Friction", "Coefficient of sliding"),
        Property("Float", "StaticFriction", "Friction", "Coefficient of sticking; 0: that of sliding"),
        Property("Force", "Brake", "Friction", "Resisting force, whatever presses on the beam"),
        Property("Enumeration", "AtEnd", "Motion", "What happens at the end of the beam", "Leave", choices=("Leave", "Stop")),
        Property("Link", "MovesWith", "View", "A solid that is shown at the body while results are looked at"),
        SLOPE,
    )  # fmt: skip
