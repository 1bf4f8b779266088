"""The objects of the workbench. None of them knows of a window."""

import FreeCAD

from .analysis import Analysis
from .beam import Beam
from .cable_of_length import CableOfLength
from .connector import Connector
from .deformed_shape import DeformedShape
from .feature import Feature, is_newer, type_of
from .joint import Joint
from .load import Load
from .probe import Probe
from .result import Result, result_of
from .sliding_body import SlidingBody
from .stop import Stop
from .support import Support

CLASSES = (Analysis, Beam, Support, SlidingBody, Load, Joint, Connector, Stop, Probe, Result, DeformedShape, CableOfLength)
BY_TYPE = {each.TYPE: each for each in CLASSES}

__all__ = ["make", "mend", "analysis_of", "members", "type_of", "is_newer", "result_of", "BY_TYPE", "Feature",
           *(each.__name__ for each in CLASSES)]  # fmt: skip


def make(cls, document=None, label="", analysis=None):
    """A new object of a class, in a group where an analysis is given."""
    document = document or FreeCAD.ActiveDocument
    obj = document.addObject(cls.CONTAINER, cls.__name__)
    cls(obj)
    if label:
        obj.Label = label
    if analysis is not None:
        analysis.addObject(obj)
    return obj


def mend(document):
    """Gives objects their class again which a FreeCAD without this workbench has taken from them; returns these."""
    mended = []
    for obj in document.Objects:
        cls = BY_TYPE.get(type_of(obj))
        if cls is None or isinstance(getattr(obj, "Proxy", None), cls):
            continue
        obj.Proxy = cls.__new__(cls)
        if not is_newer(obj):
            obj.Proxy.migrate(obj)
            obj.Proxy.complete(obj)
        mended.append(obj)
    return mended


def analysis_of(obj):
    """The analysis whose group holds the object, or the object itself; None where there is none."""
    if type_of(obj) == Analysis.TYPE:
        return obj
    for parent in obj.InList:
        if type_of(parent) == Analysis.TYPE and obj in parent.Group:
            return parent
    return None


def members(analysis, cls):
    """The objects of a class in the group of an analysis, also in groups of it, in their order."""
    found = []
    for obj in analysis.Group:
        if type_of(obj) == cls.TYPE:
            found.append(obj)
        elif hasattr(obj, "Group") and type_of(obj) is None:
            found += members(obj, cls)
    return found
