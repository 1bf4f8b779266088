"""Choosing parts of the document in the 3-D view."""

import FreeCAD
import FreeCADGui
from PySide import QtGui

from ..geometry import places
from ..language import tr

KINDS = {"Axis": "Edge Solid Wire Face", "Profile": "Edge Face Wire", "Point": "Vertex", "FromPoint": "Vertex", "ToPoint": "Vertex",
         "DirectionOf": "Edge Face", "From": "Face Edge Vertex", "To": "Face Edge Vertex"}  # fmt: skip


class Gate:
    """Lets only those elements be chosen that are of use."""

    def __init__(self, prop):
        self.kinds = KINDS.get(prop, "").split()
        self.is_of_end = prop in ("From", "To")

    def allow(self, document, obj, sub):
        element = sub.rsplit(".", 1)[-1].rstrip("0123456789")
        return not element or not self.kinds or element in self.kinds or (self.is_of_end and places.is_coordinate_system(obj))


def links_of_selection():
    """The selection as links, each to parts of one object; as the value of an `App::PropertyXLinkSubList`."""
    chosen = FreeCADGui.Selection.getSelectionEx("", 0)
    return [(each.Object, [name for name in each.SubElementNames if name] or [""]) for each in chosen]


def only_link(links):
    """The first link, for what takes parts of one object; the others are named in the report view."""
    if len(links) > 1:
        FreeCAD.Console.PrintWarning(f"nurbeam: of what is selected only {links[0][0].Label} is taken\n")
    return links[0] if links else None


class ReferenceList(QtGui.QWidget):
    """The parts that a link names, a button that takes the selection, and one that empties it."""

    def __init__(self, obj, row):
        super().__init__()
        self.obj, self.prop = obj, row.name
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        self.setSizePolicy(QtGui.QSizePolicy.Preferred, QtGui.QSizePolicy.Maximum)
        self.list = QtGui.QListWidget()
        self.list.setMaximumHeight(64)
        self.pick = QtGui.QPushButton(tr("Pick"))
        self.pick.setCheckable(True)
        self.pick.setToolTip(tr("Select in the 3-D view, then press again to take the selection"))
        self.clear = QtGui.QPushButton(tr("Clear"))
        buttons = QtGui.QHBoxLayout()
        buttons.addWidget(self.pick)
        buttons.addWidget(self.clear)
        layout.addWidget(self.list)
        layout.addLayout(buttons)
        self.pick.toggled.connect(self._picked)
        self.clear.clicked.connect(lambda: self.set_link(None))
        self.show_link()

    def _picked(self, begins):
        if begins:
            FreeCADGui.Selection.addSelectionGate(Gate(self.prop))
            self.pick.setText(tr("Take the selection"))
            return
        self.end_picking()
        links = links_of_selection()
        if links:
            self.set_link(places.whole_bodies(links) if self.prop == "Axis" else only_link(links))

    def end_picking(self):
        FreeCADGui.Selection.removeSelectionGate()
        self.pick.setText(tr("Pick"))

    def set_link(self, link):
        setattr(self.obj, self.prop, link)
        self.show_link()

    def show_link(self):
        self.list.clear()
        for root, path in places.parts_of_link(getattr(self.obj, self.prop)):
            self.list.addItem(f"{root.Label}.{path}".rstrip("."))
