"""A place whose motion is stored."""

from .feature import Property
from .place import PLACE, Placed


class Probe(Placed):
    TYPE = "Nurbeam::Probe"
    PROPERTIES = (
        *PLACE,
        Property("Enumeration", "Side", "Probe", "Where forces jump: of the part before or after the position", "After",
                 choices=("Before", "After")),
    )  # fmt: skip
