"""nurbeam: curves of CAD files as flexible beams with sliding bodies, and back.

A model is built from curves, or loaded from a case file; running it gives results, and simulating it goes step by step::

    import nurbeam as nb

    model = nb.Model()
    cable = model.add_beam(nb.Curve.line([0, 0, 0], [10, 0, 0]), section=nb.Circle(radius="6 mm"),
                           material=nb.Material(density=5200, youngs_modulus="60 GPa"), elements=20)
    model.add_support(cable, at="start")
    model.add_support(cable, at="end")
    results = model.run(end_time=1, step="2 ms")
    results.plot("energy.total")

Everything is in SI units; quantities may be texts with a unit. `help(nb.Model)` lists the parts of a model; the names are
those of the case file (docs/case-reference.md).
"""

from ._core import version as __version__
from .accuracy import Accuracy, NumberWithError
from .curves import ClosestPoint, Curve, Curves, read, write
from .errors import CadError, CaseError, CaseWarning, Error, Finding
from .loads import Load
from .model import Beam, Body, Circle, IBeam, Material, Model, Pipe, Rectangle, Rope, Section, load, schema
from .results import BeamShape, ConnectorPull, Extreme, Histories, Mode, Modes, Motion, Results, RunError, Snapshot
from .routing import Route, route, routes
from .signals import Signal
from .simulation import Checkpoint, Simulation
from .study import Study, study, vary
from .system import System

__all__ = [
    "Model", "load", "Circle", "Pipe", "Rectangle", "IBeam", "Rope", "Section", "Material", "Beam", "Body", "Load", "schema",
    "Curve", "Curves", "ClosestPoint", "read", "write",
    "Results", "Extreme", "Histories", "Snapshot", "BeamShape", "Motion", "ConnectorPull", "Mode", "Modes",
    "Accuracy", "NumberWithError",
    "route", "routes", "Route",
    "Simulation", "Checkpoint", "Signal", "System", "study", "Study", "vary",
    "Error", "CaseError", "CadError", "RunError", "CaseWarning", "Finding",
]  # fmt: skip
