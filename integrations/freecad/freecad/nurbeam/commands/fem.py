"""The command that takes over what a FEM analysis says."""

import FreeCAD

from ..fem.take_over import fem_analyses, take_over
from .command import Command, active_analysis
from .create import new_analysis


class TakeOverFem(Command):
    NAME, TITLE, ICON = "Nurbeam_TakeOverFem", "Take over FEM analysis", "fem"
    HELP = "Beams, supports, forces and material of a FEM analysis of the document"

    def IsActive(self):
        return super().IsActive() and bool(fem_analyses(FreeCAD.ActiveDocument))

    def Activated(self):
        document = FreeCAD.ActiveDocument
        document.openTransaction(self.TITLE)
        analysis = active_analysis() or new_analysis(document)
        made, notes = take_over(fem_analyses(document)[0], analysis)
        document.recompute()
        document.commitTransaction()
        for note in notes:
            FreeCAD.Console.PrintWarning(f"nurbeam: {note}\n")
        return made
