"""Runs of analyses, each a process of its own that may be stopped, or die, without harm to the document."""

import os
import shutil
import tempfile

import FreeCAD
from PySide import QtCore

from .. import objects
from ..case.places_of_case import object_at
from ..case.write_case import written_case
from .command import LineReader, Missing, module, program
from .results import take_results

STOPPED, DONE, NOT_CONVERGED = 130, 0, 3
WAIT_FOR_EDIT = 200  # ms

edited_documents = set()
"""Names of documents of which a panel is editing an object."""


class Finding(tuple):
    """(severity, object or None, property, message)"""

    def __new__(cls, severity, obj, prop, message):
        return super().__new__(cls, (severity, obj, prop, message))

    severity = property(lambda self: self[0])
    obj = property(lambda self: self[1])
    prop = property(lambda self: self[2])
    message = property(lambda self: self[3])


def check(analysis):
    """(case, findings): what FreeCAD knows to be wrong, and if that is nothing what nurbeam says of the model."""
    case = written_case(analysis)
    findings = [Finding("error", *fault) for fault in case.faults] + [Finding("note", *note) for note in case.notes]
    if not case.faults:
        findings += _findings_of_nurbeam(case)
    show_at_objects(analysis, findings)
    return case, findings


def _findings_of_nurbeam(case):
    nurbeam = module()
    with tempfile.TemporaryDirectory() as folder:
        path = case.write_into(folder)
        try:
            found = nurbeam.load(path).check()
        except nurbeam.CaseError as problem:
            found = problem.findings
    return [finding_of(case, each.severity, each.where, each.message) for each in found or []]


def finding_of(case, severity, where, message):
    place = object_at(case.places, where)
    return Finding(severity, place.obj if place else None, place.prop if place else "", message)


def show_at_objects(analysis, findings):
    """Marks the objects that errors are about, by their proxies; a recompute says the same until the next check."""
    for obj in [analysis, *analysis.Group]:
        if isinstance(getattr(obj, "Proxy", None), objects.Feature):
            errors = [f for f in findings if f.obj is obj and f.severity == "error"]
            obj.Proxy.complaint = "; ".join(f"{f.prop}: {f.message}" for f in errors)
            if errors or obj.State != ["Up-to-date"]:
                obj.touch()
    analysis.Document.recompute()


class Run(QtCore.QObject):
    """The run of an analysis."""

    progressed = QtCore.Signal(object)
    """Line: a phase, its fraction and time."""
    told = QtCore.Signal(object)
    """Finding"""
    ended = QtCore.Signal(int)
    """Exit code; -1 where it was killed or died."""

    running = {}
    """Runs that go on, by document and name of their analysis."""

    def __init__(self, analysis, case):
        super().__init__()
        self.analysis, self.case = analysis, case
        self.key = (analysis.Document.Name, analysis.Name)
        self.findings, self.lines = [], []
        self.code = None
        self._reader = LineReader()
        self._own_folder = "" if analysis.Folder else tempfile.mkdtemp(prefix="nurbeam-")
        self.folder = analysis.Folder or self._own_folder
        self._process = QtCore.QProcess()
        self._process.readyReadStandardError.connect(self._read)
        self._process.finished.connect(self._finish)
        self._process.errorOccurred.connect(self._fail)

    def start(self):
        if is_running(self.analysis):
            raise RuntimeError(f"{self.analysis.Label} is running already; stop it first")
        path = self.case.write_into(self.folder)
        arguments = ["run", path, "--progress", "json", "--out", os.path.join(self.folder, "results")]
        if self.analysis.Threads:
            arguments += ["--threads", str(self.analysis.Threads)]
        Run.running[self.key] = self
        self._before = self.analysis.Status, self.analysis.Message
        self.analysis.Status, self.analysis.Message = "Running", ""
        self._process.start(program(), arguments)

    def stop(self):
        """Ends it after the step that it is in, with results until then; asked again at once, without any."""
        if self._process.state() == QtCore.QProcess.NotRunning:
            return
        if getattr(self, "_asked_to_stop", False):
            self._process.kill()
            return
        self._asked_to_stop = True
        import signal

        os.kill(self._process.processId(), signal.SIGINT)

    def kill(self):
        self._process.kill()

    def wait(self, seconds):
        """For scripts: lets the run go on until it has ended; whether it has."""
        timer = QtCore.QElapsedTimer()
        timer.start()
        while self.code is None and timer.elapsed() < 1000 * seconds:
            QtCore.QCoreApplication.processEvents(QtCore.QEventLoop.AllEvents, 50)
        return self.code is not None

    def _read(self):
        for line in self._reader.take(self._process.readAllStandardError().data()):
            self._take(line)

    def _take(self, line):
        self.lines.append(line)
        if line.severity:
            finding = finding_of(self.case, line.severity, line.where, line.message)
            if finding not in self.findings:  # what the check before has found, the run finds again
                self.findings.append(finding)
                self.told.emit(finding)
        elif line.phase:
            self.progressed.emit(line)

    def _fail(self, error):
        if error == QtCore.QProcess.FailedToStart:
            self._end(-1, "the command could not be started: " + self._process.errorString())

    def _finish(self, code, status):
        self._read()
        for line in self._reader.finish():
            self._take(line)
        crashed = status == QtCore.QProcess.CrashExit
        self._end(-1 if crashed else code, "the command was killed or has died" if crashed else "")

    def _end(self, code, message):
        """Keeps what the run has left. Where something is being edited it waits for that: else Cancel would take the results
        with it, or find its own step of undo ended."""
        if self._document_is_open() and self.key[0] in edited_documents:
            QtCore.QTimer.singleShot(WAIT_FOR_EDIT, lambda: self._end(code, message))
            return
        if Run.running.get(self.key) is self:
            del Run.running[self.key]
        try:
            if self._document_is_open():
                self._keep(code, message)
        finally:
            self.code = code
            if self._own_folder:
                shutil.rmtree(self._own_folder, ignore_errors=True)
            self.ended.emit(code)

    def _document_is_open(self):
        """Whether the analysis still stands in its document, and no other one that bears their names."""
        document = FreeCAD.listDocuments().get(self.key[0])
        return document is not None and document.getObject(self.key[1]) is self.analysis

    def _keep(self, code, message):
        document = self.analysis.Document
        self.analysis.Status, self.analysis.Message = self._before  # what undo leads back to
        document.openTransaction("Run")
        errors = [f.message for f in self.findings if f.severity == "error"]
        texts = [line.message for line in self.lines if line.message and not line.severity and self.folder not in line.message]
        self.analysis.Status = {DONE: "Done", STOPPED: "Interrupted"}.get(code, "Failed")
        self.analysis.Message = message or (errors[-1] if errors else texts[0] if texts else "")
        if code in (DONE, STOPPED, NOT_CONVERGED):
            take_results(self.analysis, self.case.text, os.path.join(self.folder, "results"), self.findings)
        show_at_objects(self.analysis, self.findings)
        document.commitTransaction()


def is_running(analysis):
    run = Run.running.get((analysis.Document.Name, analysis.Name))
    return run is not None and run.analysis is analysis


def start_run(analysis):
    """(run or None, findings): checks the analysis and, where nothing is wrong, starts its run."""
    if is_running(analysis):
        return None, [Finding("error", analysis, "Status", "is running already; stop it first")]
    try:
        case, findings = check(analysis)
        program()
    except Missing as problem:
        return None, [Finding("error", analysis, "Status", str(problem))]
    if any(f.severity == "error" for f in findings):
        return None, findings
    run = Run(analysis, case)
    run.findings += [f for f in findings if f.severity != "error"]
    try:
        run.start()
    except OSError as problem:
        return None, [*findings, Finding("error", analysis, "Folder", f"the case cannot be written: {problem}")]
    return run, findings


def stop_runs_of(document):
    """Stops the runs of a document that is closed."""
    edited_documents.discard(document.Name)
    for (name, _), run in list(Run.running.items()):
        if name == document.Name:
            run.blockSignals(True)  # whoever listens shows what is no longer there
            run.kill()
