"""A place whose motion is stored."""

from .feature import Feature, Property
from .place import PLACE


class Probe(Feature):
    TYPE = "Nurbeam::Probe"
    PROPERTIES = (
        *PLACE,
        Property("Enumeration", "Side", "Probe", "Where forces jump: of the part before or after the place", "After",
                 choices=("Before", "After")),
    )  # fmt: skip
