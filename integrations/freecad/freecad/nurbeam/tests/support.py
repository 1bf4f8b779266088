"""Documents and models that tests share."""

import importlib.util
import math
import os
import tempfile
import unittest

import FreeCAD
import Part
from FreeCAD import Placement, Rotation, Vector

from .. import objects


class DocumentTest(unittest.TestCase):
    """A new document, closed at the end."""

    def setUp(self):
        self.document = FreeCAD.newDocument("Test")
        self._folder = tempfile.TemporaryDirectory()
        self.folder = self._folder.name

    def tearDown(self):
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)
        self._folder.cleanup()

    def add(self, shape, label="Shape"):
        obj = self.document.addObject("Part::Feature", label)
        obj.Shape = shape
        return obj

    def reopened(self):
        """The document as it is after saving and loading."""
        file = os.path.join(self.folder, "test.FCStd")
        self.document.saveAs(file)
        FreeCAD.closeDocument(self.document.Name)
        self.document = FreeCAD.openDocument(file)
        return self.document


def material(document, density="7850 kg/m^3", modulus="210 GPa"):
    card = document.addObject("App::MaterialObjectPython", "Material")
    card.Material = {"Name": "Test", "Density": density, "YoungsModulus": modulus, "PoissonRatio": "0.3"}
    return card


def arc_wire():
    """Line 100 mm, quarter circle of radius 50 mm, line 150 mm: length 250 + 25 pi mm."""
    circle = Part.ArcOfCircle(Part.Circle(Vector(100, 50, 0), Vector(0, 0, 1), 50), -math.pi / 2, 0)
    return [Part.makeLine(Vector(0, 0, 0), Vector(100, 0, 0)), circle.toShape(), Part.makeLine(Vector(150, 50, 0), Vector(150, 200, 0))]


def bent_pipe(outer=10.0, inner=8.0):
    """A pipe along the arc wire; radii in mm."""
    wire = Part.Wire(arc_wire())

    def rod(radius):
        ring = Part.Wire(Part.makeCircle(radius, Vector(0, 0, 0), Vector(1, 0, 0)))
        return wire.makePipeShell([ring], True, False)

    return rod(outer).cut(rod(inner)) if inner else rod(outer)


def cantilever(document, folder=""):
    """A bar of 1 m that is held at its start and loaded by 10 N at its end."""
    bar = document.addObject("Part::Feature", "Bar")
    bar.Shape = Part.makeLine(Vector(0, 0, 0), Vector(1000, 0, 0))
    analysis = objects.make(objects.Analysis, document, "cantilever")
    analysis.AnalysisType, analysis.Gravity, analysis.Folder = "Equilibrium", 0, folder
    beam = objects.make(objects.Beam, document, "bar", analysis)
    beam.Axis, beam.Radius, beam.Material, beam.Elements = (bar, ["Edge1"]), "5 mm", material(document), 10
    support = objects.make(objects.Support, document, "wall", analysis)
    support.Beam = beam
    load = objects.make(objects.Load, document, "weight", analysis)
    load.Beam, load.PlaceKind, load.Force = beam, "End", "10 N"
    document.recompute()
    return analysis, beam, support, load


def zip_line(document, samples, end_time):
    """The sample samples/freecad/zip_line.py, for a shorter time."""
    spec = importlib.util.spec_from_file_location("zip_line_sample", os.path.join(samples, "freecad", "zip_line.py"))
    sample = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(sample)
    analysis = sample.make(document)
    analysis.EndTime = end_time
    document.recompute()
    return analysis


def place():
    return Placement(Vector(10, 20, 30), Rotation(Vector(1, 2, 3), 40))


def application():
    """The application that processes need, where FreeCAD has none."""
    from PySide import QtCore

    return QtCore.QCoreApplication.instance() or QtCore.QCoreApplication([])
