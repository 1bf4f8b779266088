"""Read by FreeCAD at its start where it has a window."""

import os

import FreeCAD
import FreeCADGui

_HERE = os.path.dirname(__file__)


class NurbeamWorkbench(FreeCADGui.Workbench):
    MenuText = "nurbeam"
    ToolTip = "Flexible beams along curves, with bodies that slide on them"
    Icon = os.path.join(_HERE, "resources", "icons", "nurbeam.svg")

    def Initialize(self):
        from freecad.nurbeam import commands

        for title, names in commands.toolbars():
            self.appendToolbar(f"nurbeam {title}", names)
            self.appendMenu("nurbeam", [*names, "Separator"])

    def GetClassName(self):
        return "Gui::PythonWorkbench"


FreeCADGui.addLanguagePath(os.path.join(_HERE, "translations"))
FreeCADGui.updateLocale()
FreeCADGui.addPreferencePage(os.path.join(_HERE, "resources", "ui", "preferences.ui"), "nurbeam")
FreeCADGui.addWorkbench(NurbeamWorkbench())

from freecad.nurbeam.view import attach  # noqa: E402  (objects of documents need their view before the workbench is opened)

attach.watch_documents()
