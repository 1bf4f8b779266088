"""The panel of beams, supports, bodies, loads and the like: a form made of the table of the object."""

import re

import FreeCAD
from PySide import QtCore, QtGui

from .. import objects
from ..language import tr, tr_help
from ..objects.place import Placed
from ..translations.texts import label
from .fields import field_of
from .task import TaskPanel

# Rows that are of use only with some choices of another row.
SHOWN_WITH = {
    objects.Analysis.TYPE: {
        "AnalysisType": {"EndTime": ("Motion",), "Step": ("Motion",), "Tolerance": ("Motion",), "Every": ("Motion",),
                         "Start": ("Motion",), "LoadSteps": ("Equilibrium",), "ModeCount": ("Modes", "Buckling")},
    },
    objects.Beam.TYPE: {
        "SectionKind": {
            "Radius": ("Round", "Pipe"), "Bore": ("Pipe",), "Width": ("Rectangle", "I"), "Height": ("Rectangle", "I"),
            "Flange": ("I",), "Web": ("I",), "RopeDiameter": ("Rope",), "MetallicArea": ("Rope",), "Wires": ("Rope",),
            "Profile": ("Profile",), "Area": ("Numbers",), "SecondMoment": ("Numbers",), "SecondMomentY": ("Numbers",),
            "TorsionConstant": ("Numbers",), "ExtremeFibre": ("Numbers",),
        },
        "LengthKind": {"UnstressedLength": ("Unstressed length",), "Tension": ("Tension",)},
        "Orientation": {"Up": ("Up", "At the start")},
    },
    objects.Support.TYPE: {
        "SupportKind": {"Direction": ("Guided",), "Pull": ("Guided",), "PullMass": ("Guided",), "HingeAxis": ("Pinned",)},
    },
    objects.Load.TYPE: {
        "LoadKind": {
            "Force": ("Force",), "Moment": ("Moment",), "ForcePerLength": ("Force per length",),
            "TorquePerLength": ("Torque per length",), "Follower": ("Force", "Moment"), "Slope": ("Force",),
            "PlaceKind": ("Force", "Moment"),
        },
    },
    objects.Stop.TYPE: {
        "StopKind": {"Restitution": ("Hard",), "Stiffness": ("Buffer",), "Damping": ("Buffer",)},
    },
    objects.Connector.TYPE: {
        "ConnectorKind": {
            **dict.fromkeys(("Stiffness", "Damping"), ("Spring", "Tension only", "Compression only")),
            **dict.fromkeys(("LengthKind", "FreeLength", "Force", "Direction", "FromMass", "ToMass"), ("Spring", "Tension only", "Compression only", "Rod")),
            **dict.fromkeys(("RotationalStiffness", "RotationalDamping", "RotationAxis", "FreeAngle", "Moment"), ("Rotational",)),
        },
        "LengthKind": {"FreeLength": ("Length",), "Force": ("Force",)},
    },
    objects.DeformedShape.TYPE: {"Form": {"Radius": ("Solid",), "Bore": ("Solid",)}},
}  # fmt: skip
LAST, PLACE = "More", "Place"  # groups: the last tab; the one that shares a page with what stands at the place
PLACES = {"PlaceLength": ("Length",), "Fraction": ("Fraction",), "Point": ("At a point",)}


def rules_of(obj):
    """{choice: {row: values with which it is shown}} of the kind of an object."""
    rules = dict(SHOWN_WITH.get(objects.type_of(obj), {}))
    for prefix in ("", "From", "To"):
        if f"{prefix}PlaceKind" in obj.PropertiesList:
            rules[f"{prefix}PlaceKind"] = {prefix + name: values for name, values in PLACES.items()}
    return rules


def _ends(obj):
    """Of a connector, whose ends may be of a beam, a body, or a point in space."""
    return [prefix for prefix in ("From", "To") if f"{prefix}Object" in obj.PropertiesList]


def _is_of_beam(obj, end):
    return objects.type_of(getattr(obj, f"{end}Object")) == objects.Beam.TYPE


RECOMPUTE_AFTER = 200  # ms without another change


class PartPanel(TaskPanel):
    """A tab for each group of properties. Symbols and messages follow what is said, where that takes no time."""

    def __init__(self, obj):
        self.timer = QtCore.QTimer()
        self.timer.setSingleShot(True)
        self.timer.setInterval(RECOMPUTE_AFTER)
        super().__init__(obj, obj.Label)
        self.timer.timeout.connect(self.recompute)
        if isinstance(obj.Proxy, (Placed, objects.Beam)):
            FreeCAD.addDocumentObserver(self)

    def slotChangedObject(self, obj, prop):
        """Called by FreeCAD."""
        if obj is self.obj and any(row.name == prop and not row.output for row in obj.Proxy.table()):
            self.timer.start()

    def recompute(self):
        self.obj.recompute()
        self._show_message()

    def leave(self):
        self.timer.stop()
        if isinstance(self.obj.Proxy, (Placed, objects.Beam)):
            FreeCAD.removeDocumentObserver(self)
        self.fields, self.labels, self.tab_of = {}, {}, {}  # widgets that FreeCAD deletes
        super().leave()

    def build(self):
        self.fields, self.labels, self.tab_of = {}, {}, {}
        self.message = QtGui.QLabel()
        self.message.setWordWrap(True)
        self.tabs = QtGui.QTabWidget()
        self.layout.addWidget(self.tabs)
        self.layout.addWidget(self.message)
        pages, rows = {}, [row for row in self.obj.Proxy.table() if not (row.hidden or row.output)]
        main = next(row.group for row in rows if row.group not in (LAST, PLACE))
        for row in rows:
            group = main if row.group == PLACE else row.group
            if group not in pages:
                pages[group] = self._page(group)
            self._add(row, pages[group])
        self._order_tabs()
        for choice in [*rules_of(self.obj), *(f"{end}Object" for end in _ends(self.obj))]:
            self.fields[choice].currentIndexChanged.connect(lambda _: self.show_rows())
        self.show_rows()
        self._show_message()

    def _page(self, group):
        page = QtGui.QWidget()
        layout = QtGui.QFormLayout(page)
        self.tabs.addTab(page, tr(group))
        return layout

    def _add(self, row, layout):
        field = field_of(self.obj, row)
        caption = QtGui.QLabel(label_of(row.name))
        for widget in (field, caption):
            widget.setToolTip(tr_help(row.help))
        layout.addRow(caption, field)
        self.fields[row.name], self.labels[row.name] = field, caption
        self.tab_of[row.name] = layout.parentWidget()

    def _order_tabs(self):
        for i in range(self.tabs.count()):
            if self.tabs.tabText(i) == tr(LAST):
                self.tabs.tabBar().moveTab(i, self.tabs.count() - 1)
                break
        self.tabs.setCurrentIndex(0)

    def show_rows(self):
        """Hides rows that the present choices do not use."""
        hidden = {name: False for rows in rules_of(self.obj).values() for name in rows}
        for end in _ends(self.obj):
            hidden.update({f"{end}{name}": not _is_of_beam(self.obj, end) for name in ("PlaceKind", "PlaceLength", "Fraction", "Slope")})
        for choice, rows in rules_of(self.obj).items():
            for name, values in rows.items():
                hidden[name] |= getattr(self.obj, choice) not in values
        for end in _ends(self.obj):
            if not _is_of_beam(self.obj, end):
                hidden[f"{end}Point"] = getattr(self.obj, f"{end}Object") is not None  # else it is the point in space
        for name, is_hidden in hidden.items():
            self.fields[name].setVisible(not is_hidden)
            self.labels[name].setVisible(not is_hidden)

    def _show_message(self):
        wrong = "Invalid" in self.obj.State
        self.message.setText(self._in_words(self.obj.getStatusString()) if wrong else "")
        self.message.setStyleSheet("color: #b00020" if wrong else "")

    def _in_words(self, text):
        """With captions in place of the names of properties."""
        return re.sub(r"(^|; )(\w+): ", lambda m: f"{m[1]}{label_of(m[2])}: " if m[2] in self.fields else m[0], text)

    def show_property(self, prop):
        if prop in self.fields:
            self.tabs.setCurrentWidget(self.tab_of[prop])
            self.fields[prop].setFocus(QtCore.Qt.OtherFocusReason)


def label_of(name):
    return tr(label(name))
