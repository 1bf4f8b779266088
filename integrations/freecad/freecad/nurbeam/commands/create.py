"""Commands that make parts of a model of what is selected."""

import FreeCAD
import FreeCADGui

from .. import objects
from ..geometry import places
from ..objects.material_card import first_card
from ..panels.references import links_of_selection, only_link
from .command import Command, activate, active_analysis


def new_analysis(document):
    analysis = objects.make(objects.Analysis, document, "Analysis")
    activate(analysis)
    return analysis


class NewPart(Command):
    """Makes an object of `CLASS` in the active analysis, which is made where there is none, and opens its panel."""

    CLASS = None

    def Activated(self):
        document = FreeCAD.ActiveDocument
        document.openTransaction(self.TITLE)
        links, selected = links_of_selection(), FreeCADGui.Selection.getSelection()
        analysis = active_analysis() or new_analysis(document)
        obj = objects.make(self.CLASS, document, analysis=analysis)
        self.fill(obj, analysis, links, selected)
        FreeCADGui.Selection.clearSelection()
        document.recompute()
        FreeCADGui.ActiveDocument.setEdit(obj.Name)
        return obj

    def fill(self, obj, analysis, links, selected):
        """Takes over what is selected."""
        beams = objects.members(analysis, objects.Beam)
        chosen = [each for each in selected if each in beams]
        if "Beam" in obj.PropertiesList and (chosen or beams):
            obj.Beam = (chosen or beams)[0]
        vertices = [(root, [path]) for root, path in places.parts_of_link(links) if "Vertex" in path]
        if vertices and "Point" in obj.PropertiesList:
            obj.Point = only_link(vertices)
            if "PlaceKind" in obj.PropertiesList:
                obj.PlaceKind = "At a point"


class NewAnalysis(NewPart):
    NAME, TITLE, ICON = "Nurbeam_Analysis", "Analysis", "analysis"
    HELP = "A new analysis: it holds the parts of a model and says what is asked of it"

    def Activated(self):
        document = FreeCAD.ActiveDocument
        document.openTransaction(self.TITLE)
        analysis = new_analysis(document)
        FreeCADGui.ActiveDocument.setEdit(analysis.Name)
        return analysis


class NewBeam(NewPart):
    NAME, TITLE, ICON, CLASS = "Nurbeam_Beam", "Beam", "beam", objects.Beam
    HELP = "A beam along the selected edges, wire or sketch, or of a selected pipe"

    def fill(self, obj, analysis, links, selected):
        obj.Material = first_card(obj.Document)
        if not links:
            return
        obj.Label = f"Beam {links[0][0].Label}"
        try:
            obj.Axis = links = places.whole_bodies(links)
            if places.has_body(links):
                obj.SectionKind = "Of the pipe"
        except (places.NoPlace, ValueError):
            pass  # the recompute says so at the object


class NewSupport(NewPart):
    NAME, TITLE, ICON, CLASS = "Nurbeam_Support", "Support", "support", objects.Support
    HELP = "What holds a place of a beam"

    def fill(self, obj, analysis, links, selected):
        super().fill(obj, analysis, links, selected)
        others = [each for each in objects.members(analysis, objects.Support) if each is not obj and each.Beam is obj.Beam]
        if any(each.PlaceKind == "Start" for each in others) and obj.PlaceKind == "Start":
            obj.PlaceKind = "End"


class NewBody(NewPart):
    NAME, TITLE, ICON, CLASS = "Nurbeam_SlidingBody", "Sliding body", "body", objects.SlidingBody
    HELP = "A body that slides on a beam"

    def fill(self, obj, analysis, links, selected):
        super().fill(obj, analysis, links, selected)
        solids = [each for each in selected if hasattr(each, "Shape") and each.Shape.Solids]
        if solids:
            obj.MovesWith = solids[0]


class NewLoad(NewPart):
    NAME, TITLE, ICON, CLASS = "Nurbeam_Load", "Load", "load", objects.Load
    HELP = "A force or a moment on a beam, at a place or along it"

    def fill(self, obj, analysis, links, selected):
        obj.PlaceKind = "End"  # the start has the first support
        super().fill(obj, analysis, links, selected)


class NewJoint(NewPart):
    NAME, TITLE, ICON, CLASS = "Nurbeam_Joint", "Joint", "joint", objects.Joint
    HELP = "What ties the selected beams, which meet"

    def fill(self, obj, analysis, links, selected):
        beams = objects.members(analysis, objects.Beam)
        obj.Beams = [each for each in selected if each in beams] or beams[:2]


class NewConnector(NewPart):
    NAME, TITLE, ICON, CLASS = "Nurbeam_Connector", "Connector", "connector", objects.Connector
    HELP = "A spring, rope or rod between beams, bodies and points"

    def fill(self, obj, analysis, links, selected):
        parts = [*objects.members(analysis, objects.Beam), *objects.members(analysis, objects.SlidingBody)]
        for prop, each in zip(("FromObject", "ToObject"), (each for each in selected if each in parts)):
            setattr(obj, prop, each)


class NewStop(NewPart):
    NAME, TITLE, ICON, CLASS = "Nurbeam_Stop", "Stop", "stop", objects.Stop
    HELP = "What sliding bodies come up against"


class NewProbe(NewPart):
    NAME, TITLE, ICON, CLASS = "Nurbeam_Probe", "Probe", "probe", objects.Probe
    HELP = "A place of a beam whose motion is stored"


class NewCable(Command):
    NAME, TITLE, ICON = "Nurbeam_CableOfLength", "Cable of given length", "cable"
    HELP = "A cable between two selected faces, circles, coordinate systems or ends of edges, of a given length, slack or bend radius"

    def Activated(self):
        document = FreeCAD.ActiveDocument
        document.openTransaction(self.TITLE)
        cable = objects.make(objects.CableOfLength, document, "Cable")
        for prop, link in zip(("From", "To"), _ends_of_selection()):
            setattr(cable, prop, link)
        FreeCADGui.Selection.clearSelection()
        document.recompute()
        FreeCADGui.ActiveDocument.setEdit(cable.Name)
        return cable


def _ends_of_selection():
    """The first two elements that are selected, each as a link."""
    chosen = FreeCADGui.Selection.getSelectionEx("", 0)
    return [(each.Object, [name]) for each in chosen for name in each.SubElementNames or ("",)][:2]
