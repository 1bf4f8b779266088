"""The panel of an analysis: what is asked for, Check, Run, Stop, progress, and messages that lead to their objects."""

import FreeCADGui
from PySide import QtGui

from .. import objects
from ..language import tr
from ..run.run_analysis import Finding, Run, check, edited_documents, start_run
from ..run.command import Missing
from .parts import PartPanel, label_of
from .task import when_closed

COLOURS = {"error": "#b00020", "warning": "#a06000"}



class RunPanel(PartPanel):
    def build(self):
        super().build()
        self.check_button, self.run_button = QtGui.QPushButton(tr("Check")), QtGui.QPushButton(tr("Run"))
        self.stop_button, self.results_button = QtGui.QPushButton(tr("Stop")), QtGui.QPushButton(tr("Results"))
        buttons = QtGui.QHBoxLayout()
        for button, does in ((self.check_button, self.check), (self.run_button, self.run), (self.stop_button, self.stop),
                             (self.results_button, self.open_results)):  # fmt: skip
            button.clicked.connect(does)
            buttons.addWidget(button)
        self.progress, self.phase = QtGui.QProgressBar(), QtGui.QLabel()
        self.phase.setWordWrap(True)
        self.messages = QtGui.QListWidget()
        self.messages.setWordWrap(True)
        self.messages.itemClicked.connect(self.open_object)
        self.layout.addLayout(buttons)
        for widget in (self.progress, self.phase, self.messages):
            self.layout.addWidget(widget)
        self.process, self.findings = None, []
        self.obj.Proxy.end_lost_run(self.obj)
        going_on = Run.running.get((self.document.Name, self.obj.Name))
        if going_on:
            self._follow(going_on)
        self._show_state()

    def show_findings(self, findings):
        self.findings = list(findings)
        self.messages.clear()
        for finding in self.findings:
            item = QtGui.QListWidgetItem(f"{finding.severity}: {_of(finding)}{finding.message}", self.messages)
            if finding.severity in COLOURS:
                item.setForeground(QtGui.QColor(COLOURS[finding.severity]))

    def check(self):
        try:
            _, findings = check(self.obj)
        except Missing as problem:
            findings = [Finding("error", self.obj, "Status", str(problem))]
        self.show_findings(findings)
        self.phase.setText(_faults() if any(f.severity == "error" for f in findings) else tr("Nothing is wrong."))

    def run(self):
        if self.process:
            return
        run, findings = start_run(self.obj)
        self.show_findings(findings)
        if run:
            _show_in_status_bar(run, self.obj)
            self._follow(run)
        self._show_state()
        if not run:
            self.phase.setText(f"{tr('Not run.')} {_faults()}")

    def _follow(self, run):
        self.document.commitTransaction()  # what was said until now; the run is a step of undo of its own
        edited_documents.discard(self.document.Name)
        self.process = run
        self._followed = ((run.progressed, self._show_progress), (run.told, self._show_told), (run.ended, self._ended))
        for signal, slot in self._followed:
            signal.connect(slot)

    def _show_told(self, _):
        self.show_findings(self.process.findings)

    def leave(self):
        """The run goes on; the status bar tells of it."""
        if self.process:
            for signal, slot in self._followed:
                signal.disconnect(slot)
        super().leave()

    def stop(self):
        if self.process:
            self.process.stop()
            self.phase.setText(tr("Stopping after this step; once more ends it at once."))

    def _show_progress(self, line):
        if line.fraction is None:
            self.progress.setRange(0, 0)
        else:
            self.progress.setRange(0, 1000)
            self.progress.setValue(int(1000 * line.fraction))
        self.phase.setText(_progress_text(line))

    def _ended(self, code):
        run, self.process = self.process, None
        if not self.document.HasPendingTransaction:
            self.document.openTransaction(f"Edit {self.obj.Label}")
        self.show_findings(run.findings)
        self._show_state()

    def _show_state(self):
        runs = self.process is not None
        self.run_button.setEnabled(not runs)
        self.stop_button.setEnabled(runs)
        self.results_button.setEnabled(not runs and objects.result_of(self.obj) is not None)
        if not runs:
            self.progress.setRange(0, 1000)
            self.progress.setValue(1000 if self.obj.Status == "Done" else 0)
            self.phase.setText(f"{tr(self.obj.Status)}. {self.obj.Message}".strip())

    def open_object(self, item):
        """One click selects the object that a message is about, and opens its panel at the property."""
        finding = self.findings[self.messages.row(item)]
        if finding.obj is None or finding.obj is self.obj:
            self.show_property(finding.prop)
            return
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(finding.obj)
        self.accept()
        when_closed(lambda: _open(finding))

    def open_results(self):
        result = objects.result_of(self.obj)
        self.accept()
        when_closed(lambda: FreeCADGui.getDocument(result.Document.Name).setEdit(result.Name))


def _faults():
    return tr("Correct the errors below; a click leads to their objects.")


def _progress_text(line):
    at = f", t = {line.time:.4g} s" if line.time is not None else ""
    to_go = ", " + tr("{} s to go").format(f"{line.seconds_to_go:.0f}") if line.seconds_to_go is not None else ""
    return f"{tr(line.phase.capitalize())}{at}{to_go}"


def _show_in_status_bar(run, analysis):
    """Also while no panel of the analysis is open."""
    bar, label = FreeCADGui.getMainWindow().statusBar(), analysis.Label
    run.progressed.connect(lambda line: bar.showMessage(f"{label}: {_progress_text(line)}"))
    run.ended.connect(lambda _: bar.showMessage(f"{label}: {tr(analysis.Status)}"))


def _of(finding):
    """As "Beam, Radius: "; no property where it is of the object as a whole."""
    if finding.obj is None:
        return ""
    known = any(row.name == finding.prop for row in finding.obj.Proxy.table())
    return f"{finding.obj.Label}, {label_of(finding.prop)}: " if known else f"{finding.obj.Label}: "


def _open(finding):
    from . import open_panel

    open_panel(finding.obj, finding.prop)
