"""Gives objects their view, and mends those that a FreeCAD without the workbench has saved."""

import FreeCAD
import FreeCADGui

from .. import objects
from ..run.run_analysis import stop_runs_of
from .providers import provider_of


def give_view(obj):
    """The view provider of an object, where it has none yet."""
    view = getattr(obj, "ViewObject", None)
    cls = provider_of(obj)
    if view is None or cls is None or isinstance(getattr(view, "Proxy", None), cls):
        return
    cls(view)


class _DocumentWatch:
    """Of documents that are made, loaded, and closed."""

    def slotChangedObject(self, obj, prop):
        if prop == "NurbeamType" and not obj.Document.Restoring:  # a file that is being read has a view of its own
            give_view(obj)

    def slotActivateDocument(self, document):
        self.mend(document)

    def slotFinishRestoreDocument(self, document):  # of FreeCAD after 0.20
        self.mend(document)

    def slotDeletedDocument(self, document):
        stop_runs_of(document)

    @staticmethod
    def mend(document):
        objects.mend(document)
        for obj in document.Objects:
            if objects.type_of(obj) in objects.BY_TYPE:
                give_view(obj)


_watch = None


def watch_documents():
    global _watch
    if _watch is None:
        _watch = _DocumentWatch()
        FreeCAD.addDocumentObserver(_watch)
        FreeCADGui.addDocumentObserver(_GuiWatch(_watch))


class _GuiWatch:
    """FreeCAD 0.20 tells of a document that was loaded when its window becomes active."""

    def __init__(self, watch):
        self._watch = watch

    def slotActivateDocument(self, gui_document):
        self._watch.mend(gui_document.Document)
