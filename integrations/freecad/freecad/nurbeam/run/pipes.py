"""The centre line of a pipe."""

import functools
import os
import tempfile
from typing import NamedTuple

from ..geometry.edges import edge_of_nurbs
from ..geometry.wires import BrokenWire, nurbs_of_edges
from .command import module


class Pipe(NamedTuple):
    nurbs: dict
    """Its centre line, a curve in metres."""
    radius: float
    """[m]"""
    bore: float
    """[m]; 0 of a solid rod."""


class NoPipe(ValueError):
    """A body that is no pipe."""


def pipe_of_body(body):
    """The centre line and radii of a solid, or of the faces of one, in its world place. NoPipe where it is no round rod or pipe."""
    with tempfile.TemporaryDirectory() as folder:
        brep = os.path.join(folder, "body.brep")
        body.exportBrep(brep)
        with open(brep, encoding="utf-8") as stream:
            return _pipe_of_brep(stream.read())


@functools.lru_cache(maxsize=64)
def _pipe_of_brep(text):
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "body.brep")
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(text)
        curves = list(module().read(file))
    pieces = [curve for curve in curves if curve.facts.get("entity") == "centre line" and curve.facts["pipe_radius"] > 0]
    if not pieces:
        raise NoPipe("this is no round rod or pipe: it has no centre line; choose the whole of a pipe, or the edges of the axis")
    radii = {(round(c.facts["pipe_radius"], 9), round(c.facts["bore_radius"], 9)) for c in pieces}
    if len(radii) > 1:
        raise NoPipe(f"this is a pipe of {len(radii)} different sections; choose the edges of its axis, and a section")
    try:
        nurbs, _ = nurbs_of_edges([edge_of_nurbs(curve.to_dict()) for curve in pieces])
    except BrokenWire:
        raise NoPipe(f"these are {len(pieces)} pieces of pipe that do not meet end to end; choose one of the pipes") from None
    return Pipe(nurbs, pieces[0].facts["pipe_radius"], pieces[0].facts["bore_radius"])
