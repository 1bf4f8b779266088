"""What commands have in common, and the analysis that they work on."""

import FreeCAD
import FreeCADGui

from .. import objects
from ..view import icon

ACTIVE = "nurbeam"


class Command:
    """`NAME`, `TITLE`, `HELP` and `ICON` of a subclass are what FreeCAD shows."""

    NAME = TITLE = HELP = ICON = ""

    def GetResources(self):
        return {"Pixmap": icon(self.ICON), "MenuText": self.TITLE, "ToolTip": self.HELP}

    def IsActive(self):
        return FreeCAD.ActiveDocument is not None and not FreeCADGui.Control.activeDialog()

    def Activated(self):
        raise NotImplementedError


def activate(analysis):
    """Makes an analysis the one that commands work on; the tree shows it bold."""
    view = FreeCADGui.getDocument(analysis.Document.Name).ActiveView
    if hasattr(view, "setActiveObject"):
        view.setActiveObject(ACTIVE, analysis)


def active_analysis():
    """The one that is selected, or of what is selected, the active one, or the only one; None where there is none."""
    document = FreeCAD.ActiveDocument
    if document is None:
        return None
    for obj in FreeCADGui.Selection.getSelection():
        analysis = objects.analysis_of(obj)
        if analysis is not None:
            return analysis
    view = FreeCADGui.ActiveDocument.ActiveView
    active = view.getActiveObject(ACTIVE) if hasattr(view, "getActiveObject") else None
    if active is not None and active.Document is document:
        return active
    found = [obj for obj in document.Objects if objects.type_of(obj) == objects.Analysis.TYPE]
    return found[0] if len(found) == 1 else None
