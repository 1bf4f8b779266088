"""Commands that show results."""

import FreeCADGui

from .. import objects
from ..panels.results import keep_frame
from .command import Command, active_analysis


def active_result():
    """The result that is selected, or that of the active analysis; None where there is none."""
    for obj in FreeCADGui.Selection.getSelection():
        if objects.type_of(obj) == objects.Result.TYPE:
            return obj
    analysis = active_analysis()
    return objects.result_of(analysis) if analysis is not None else None


class OfResult(Command):
    def IsActive(self):
        return super().IsActive() and active_result() is not None


class Results(OfResult):
    NAME, TITLE, ICON = "Nurbeam_Results", "Results", "results"
    HELP = "The motion of the active analysis, with colours and plots"

    def Activated(self):
        FreeCADGui.ActiveDocument.setEdit(active_result().Name)


class KeepFrame(OfResult):
    NAME, TITLE, ICON = "Nurbeam_KeepFrame", "Keep this frame", "keep"
    HELP = "The beams at the present frame as shapes that stay"

    def Activated(self):
        from ..run.results import read

        result = active_result()
        document = result.Document
        document.openTransaction(self.TITLE)
        kept = [keep_frame(result, name, result.Frame, result.Exaggeration) for name in read(result).beams]
        document.recompute()
        document.commitTransaction()
        return kept


class Plot(OfResult):
    NAME, TITLE, ICON = "Nurbeam_Plot", "Plot energies", "plot"
    HELP = "The energy over time; other histories are in the panel of the results"

    def Activated(self):
        from ..panels.plot import show_plot
        from ..run.results import read

        return show_plot(read(active_result()), "energy.total")
