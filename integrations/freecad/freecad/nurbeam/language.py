"""Texts of panels in the language of FreeCAD's window. Names and values in documents, and messages of checks, stay English."""

from PySide import QtCore


def tr(text: str) -> str:
    return QtCore.QCoreApplication.translate("nurbeam", text)


def tr_help(text: str) -> str:
    """What a property is; FreeCAD's own editor of properties translates it, too."""
    return QtCore.QCoreApplication.translate("App::Property", text) if text else ""
