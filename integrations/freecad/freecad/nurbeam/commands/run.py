"""Commands that check and run an analysis, and write its case."""

import os

import FreeCADGui
from PySide import QtGui

from ..case.export_case import NoCase, export_case
from ..language import tr
from ..run.command import Missing
from .command import Command, active_analysis


class OfAnalysis(Command):
    def IsActive(self):
        return super().IsActive() and active_analysis() is not None


def _panel_of_analysis():
    from ..panels.run import RunPanel

    analysis = active_analysis()
    panel = RunPanel(analysis)
    FreeCADGui.Control.showDialog(panel)
    return panel


class Check(OfAnalysis):
    NAME, TITLE, ICON = "Nurbeam_Check", "Check", "check"
    HELP = "What is wrong with the model, each thing at its object"

    def Activated(self):
        panel = _panel_of_analysis()
        panel.check()
        return panel


class RunAnalysis(OfAnalysis):
    NAME, TITLE, ICON = "Nurbeam_Run", "Run", "run"
    HELP = "Runs the active analysis in a process of its own"

    def Activated(self):
        panel = _panel_of_analysis()
        panel.run()
        return panel


class ExportCase(OfAnalysis):
    NAME, TITLE, ICON = "Nurbeam_ExportCase", "Export case", "export"
    HELP = "Writes the case file of the active analysis, which runs on the command line with the same results"

    def Activated(self):
        file, _ = QtGui.QFileDialog.getSaveFileName(FreeCADGui.getMainWindow(), self.TITLE, "case.json", "Case (*.json)")
        if not file:
            return
        question = tr("Write the axes of the beams as axes.step beside the case, too?")
        answer = QtGui.QMessageBox.question(FreeCADGui.getMainWindow(), self.TITLE, question)
        try:
            export_case(active_analysis(), os.path.dirname(file), os.path.basename(file), answer == QtGui.QMessageBox.Yes)
        except (NoCase, Missing, OSError) as problem:
            QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), self.TITLE, str(problem))
