"""freecadcmd zip_line.py: makes zip_line.FCStd in the present folder, the zip line of samples/zipline as a document of the
FreeCAD workbench. Open it, double-click "zip line" in the tree, and press Run."""

import os
import sys

import FreeCAD
import Import

from freecad.nurbeam import objects

HERE = os.path.dirname(os.path.abspath(__file__))


def drawn_cable(document):
    """The edge that samples/zipline/cable.step holds."""
    before = set(document.Objects)
    Import.insert(os.path.join(HERE, os.pardir, "zipline", "cable.step"), document.Name)
    return next(obj for obj in document.Objects if obj not in before and hasattr(obj, "Shape"))


def material(document):
    card = document.addObject("App::MaterialObjectPython", "Rope")
    card.Material = {"Name": "Wire rope", "Density": "5200 kg/m^3", "YoungsModulus": "60 GPa"}
    return card


def make(document):
    """The analysis with its parts."""
    analysis = objects.make(objects.Analysis, document, "zip line")
    analysis.Start, analysis.EndTime, analysis.Step, analysis.Every = "Equilibrium", "5 s", "0.002 s", "0.02 s"

    beam = objects.make(objects.Beam, document, "cable", analysis)
    beam.Axis, beam.Radius, beam.Material = (drawn_cable(document), ["Edge1"]), "6 mm", material(document)
    beam.StressFree, beam.Elements = "Straight", 40
    for end in ("Start", "End"):
        support = objects.make(objects.Support, document, end.lower(), analysis)
        support.Beam, support.PlaceKind, support.SupportKind = beam, end, "Pinned"

    body = objects.make(objects.SlidingBody, document, "trolley", analysis)
    body.Beam, body.PlaceKind, body.PlaceLength, body.Mass = beam, "Length", "1.5 m", "80 kg"
    body.Slope, body.AtEnd = "Discontinuous", "Stop"

    probe = objects.make(objects.Probe, document, "middle", analysis)
    probe.Beam, probe.PlaceKind, probe.Fraction = beam, "Fraction", 0.5
    document.recompute()
    return analysis


if __name__ in ("zip_line", "__main__"):  # freecadcmd calls it by the name of its file
    made = FreeCAD.newDocument("zip_line")
    make(made)
    made.saveAs(os.path.join(os.getcwd(), "zip_line.FCStd"))
    sys.exit(0)
