"""Task panels: one for each kind of object."""

import FreeCADGui
from PySide import QtGui

from .. import objects
from ..run.command import Missing
from ..run.results import NoResults


def panel_of(obj):
    """A new panel for an object; None where it has none."""
    from .cable import CablePanel
    from .parts import PartPanel
    from .results import ResultsPanel
    from .run import RunPanel

    special = {objects.Analysis.TYPE: RunPanel, objects.Result.TYPE: ResultsPanel, objects.CableOfLength.TYPE: CablePanel}
    kind = objects.type_of(obj)
    return special.get(kind, PartPanel)(obj) if kind in objects.BY_TYPE else None


def open_panel(obj, prop=""):
    """Opens the panel of an object, at a property where one is named; whether there is one."""
    if FreeCADGui.Control.activeDialog():
        return False
    try:
        panel = panel_of(obj)
    except (Missing, NoResults) as problem:
        QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), obj.Label, str(problem))
        return False
    if panel is None:
        return False
    FreeCADGui.Control.showDialog(panel)
    if prop:
        panel.show_property(prop)
    return True
