"""A case in a folder of the user's."""

import os

from .. import objects
from .write_case import written_case


class NoCase(ValueError):
    """An analysis that is no case; the text says why."""


def export_case(analysis, folder, name="case.json", with_axes=False):
    """Writes the case of an analysis into a folder, and the axes of its beams as axes.step where asked; returns its path."""
    case = written_case(analysis)
    if case.faults:
        raise NoCase("; ".join(f"{fault.obj.Label}.{fault.prop}: {fault.message}" for fault in case.faults))
    path = case.write_into(folder, name)
    if with_axes:
        _write_axes(objects.members(analysis, objects.Beam), case, os.path.join(folder, "axes.step"))
    return path


def _write_axes(beams, case, file):
    """By nurbeam, which keeps the names, and each axis as one curve."""
    from ..run.command import module

    nurbeam = module()
    axes = {item["name"]: item["axis"]["nurbs"] for item in case.keys["beams"]}
    nurbeam.write(file, [nurbeam.Curve.from_dict({**axes[case.names[b]], "name": case.names[b]}) for b in beams])
