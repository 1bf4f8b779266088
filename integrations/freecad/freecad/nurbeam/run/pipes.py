"""The centre line of a solid pipe."""

import functools
import os
import tempfile
from typing import NamedTuple

from ..geometry.edges import edge_of_nurbs
from ..geometry.wires import nurbs_of_edges
from .command import module


class Pipe(NamedTuple):
    nurbs: dict
    """Its centre line, a curve in metres."""
    radius: float
    """[m]"""
    bore: float
    """[m]; 0 of a solid rod."""


class NoPipe(ValueError):
    """A solid that is no pipe."""


def pipe_of_solid(solid):
    """The centre line and radii of a solid in its world place. NoPipe where it is no round rod or pipe."""
    with tempfile.TemporaryDirectory() as folder:
        brep = os.path.join(folder, "solid.brep")
        solid.exportBrep(brep)
        with open(brep, encoding="utf-8") as stream:
            return _pipe_of_brep(stream.read())


@functools.lru_cache(maxsize=64)
def _pipe_of_brep(text):
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "solid.brep")
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(text)
        curves = list(module().read(file))
    pieces = [curve for curve in curves if curve.facts.get("entity") == "centre line" and curve.facts["pipe_radius"] > 0]
    if not pieces:
        raise NoPipe("the solid is no round rod or pipe: it has no centre line; choose the edges of its axis instead")
    radii = {(round(c.facts["pipe_radius"], 9), round(c.facts["bore_radius"], 9)) for c in pieces}
    if len(radii) > 1:
        raise NoPipe(f"the solid is a pipe of {len(radii)} different sections; choose the edges of its axis, and a section")
    nurbs, _ = nurbs_of_edges([edge_of_nurbs(curve.to_dict()) for curve in pieces])
    return Pipe(nurbs, pieces[0].facts["pipe_radius"], pieces[0].facts["bore_radius"])
