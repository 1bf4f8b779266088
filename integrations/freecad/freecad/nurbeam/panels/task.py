"""What all panels have in common: one step of undo, OK that keeps it, and Cancel that takes it back."""

import FreeCADGui
from PySide import QtCore, QtGui

from ..run.run_analysis import edited_documents


CLOSING, TRIES = 50, 100  # ms between looks whether a panel has closed, and how many


def when_closed(action, tries=TRIES):
    """Does something once the present panel is gone: FreeCAD closes it later than it is told to."""
    if not FreeCADGui.Control.activeDialog():
        action()
    elif tries:
        QtCore.QTimer.singleShot(CLOSING, lambda: when_closed(action, tries - 1))


class TaskPanel:
    """A panel of an object. OK keeps what was changed since it was opened, Cancel restores what was before."""

    def __init__(self, obj, title):
        self.obj, self.document = obj, obj.Document
        self.form = QtGui.QWidget()
        self.form.setWindowTitle(title)
        self.layout = QtGui.QVBoxLayout(self.form)
        if not self.document.HasPendingTransaction:
            self.document.openTransaction(f"Edit {obj.Label}")
        edited_documents.add(self.document.Name)
        self.build()

    def build(self):
        """Fills the layout."""

    def show_property(self, prop):
        """Brings a property into view."""

    def accept(self):
        self.leave()
        self.document.recompute()
        self.document.commitTransaction()
        FreeCADGui.getDocument(self.document.Name).resetEdit()
        FreeCADGui.Control.closeDialog()
        return True

    def reject(self):
        self.leave()
        self.document.abortTransaction()
        self.document.recompute()
        FreeCADGui.getDocument(self.document.Name).resetEdit()
        FreeCADGui.Control.closeDialog()
        return True

    def leave(self):
        """Ends what the panel has begun, as picking."""
        FreeCADGui.Selection.removeSelectionGate()
        edited_documents.discard(self.document.Name)
