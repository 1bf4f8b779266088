"""The command that gives beams a material."""

import FreeCAD
import FreeCADGui

from .. import objects
from ..panels.material import MaterialPanel
from .command import Command, active_analysis


class NewMaterial(Command):
    NAME, TITLE, ICON = "Nurbeam_Material", "Material", "material"
    HELP = "A material card for the selected beams, or for all of the active analysis"

    def Activated(self):
        panel = MaterialPanel(FreeCAD.ActiveDocument, beams_meant())
        FreeCADGui.Control.showDialog(panel)
        return panel


def beams_meant():
    """The beams that are selected; where none is, all of the active analysis."""
    chosen = [obj for obj in FreeCADGui.Selection.getSelection() if objects.type_of(obj) == objects.Beam.TYPE]
    analysis = active_analysis()
    return chosen or (objects.members(analysis, objects.Beam) if analysis else [])
