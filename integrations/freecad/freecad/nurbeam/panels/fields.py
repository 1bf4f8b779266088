"""Widgets for properties: each shows the value that the object has and writes it there; no value lives in a widget."""

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from .. import objects
from .references import ReferenceList

QUANTITIES = ("Length", "Distance", "Area", "Force", "Speed", "Acceleration", "Quantity")
DIGITS = 10  # that are shown of quantities
TARGETS = {
    "Beam": (objects.Beam,), "FromObject": (objects.Beam, objects.SlidingBody), "ToObject": (objects.Beam, objects.SlidingBody),
}  # fmt: skip


def field_of(obj, row):
    """A widget for a row of the table of an object."""
    if row.type in QUANTITIES:
        return _quantity(obj, row)
    makers = {"Enumeration": _enumeration, "Bool": _bool, "Integer": _integer, "Float": _float, "Vector": _vector,
              "Link": _link, "XLinkSub": ReferenceList, "XLinkSubList": ReferenceList, "LinkList": _link_list}  # fmt: skip
    return makers.get(row.type, _text)(obj, row)


def _quantity(obj, row):
    """FreeCAD's own box, which takes units and expressions. It shows two decimals of what has no format of its own."""
    box = FreeCADGui.UiLoader().createWidget("Gui::QuantitySpinBox")
    quantity = FreeCAD.Units.Quantity(getattr(obj, row.name))  # of its own: the format of the property's would be written to it
    quantity.Format = {"Precision": DIGITS, "NumberFormat": "g", "Denominator": 8}
    box.setProperty("unit", quantity.getUserPreferred()[2])
    box.setProperty("minimum", 0.0 if row.type in ("Length", "Area") else -1e300)
    box.setProperty("maximum", 1e300)
    box.setProperty("value", quantity)
    FreeCADGui.ExpressionBinding(box).bind(obj, row.name)
    unit = quantity.Unit
    QtCore.QObject.connect(box, QtCore.SIGNAL("valueChanged(double)"),
                           lambda value: setattr(obj, row.name, FreeCAD.Units.Quantity(value, unit)))  # fmt: skip
    return box


def _enumeration(obj, row):
    box = QtGui.QComboBox()
    box.addItems(list(row.choices))
    box.setCurrentText(getattr(obj, row.name))
    box.currentTextChanged.connect(lambda text: setattr(obj, row.name, text))
    return box


def _bool(obj, row):
    box = QtGui.QCheckBox()
    box.setChecked(getattr(obj, row.name))
    box.toggled.connect(lambda on: setattr(obj, row.name, bool(on)))
    return box


def _integer(obj, row):
    box = QtGui.QSpinBox()
    box.setRange(0, 100000)
    box.setValue(getattr(obj, row.name))
    box.valueChanged.connect(lambda value: setattr(obj, row.name, int(value)))
    return box


def _number_edit(value, take):
    """A line that takes numbers; what is none is not taken, and shown red."""
    edit = QtGui.QLineEdit(f"{value:.12g}")

    def changed(text):
        try:
            take(float(text.replace(",", ".")))
            edit.setStyleSheet("")
        except ValueError:
            edit.setStyleSheet("color: red")

    edit.textChanged.connect(changed)
    return edit


def _float(obj, row):
    return _number_edit(getattr(obj, row.name), lambda value: setattr(obj, row.name, value))


def _vector(obj, row):
    box = QtGui.QWidget()
    layout = QtGui.QHBoxLayout(box)
    layout.setContentsMargins(0, 0, 0, 0)
    for axis in ("x", "y", "z"):

        def take(value, axis=axis):
            vector = FreeCAD.Vector(getattr(obj, row.name))
            setattr(vector, axis, value)
            setattr(obj, row.name, vector)

        layout.addWidget(_number_edit(getattr(getattr(obj, row.name), axis), take))
    return box


def candidates(obj, prop):
    """The objects that a link may point at."""
    if prop == "Material":
        return [each for each in obj.Document.Objects if isinstance(getattr(each, "Material", None), dict)]
    if prop == "Table":
        return [each for each in obj.Document.Objects if each.TypeId == "Spreadsheet::Sheet"]
    if prop == "MovesWith":
        return [each for each in obj.Document.Objects if objects.type_of(each) is None and hasattr(each, "Shape")]
    analysis = objects.analysis_of(obj)
    kinds = TARGETS.get(prop, ())
    return [each for cls in kinds for each in (objects.members(analysis, cls) if analysis else [])]


def _link(obj, row):
    box = QtGui.QComboBox()
    targets = [None, *candidates(obj, row.name)]
    box.addItems(["(none)", *(each.Label for each in targets[1:])])
    present = getattr(obj, row.name)
    box.setCurrentIndex(targets.index(present) if present in targets else 0)
    box.currentIndexChanged.connect(lambda index: setattr(obj, row.name, targets[index]))
    return box


def _link_list(obj, row):
    """A list with a mark at each that is meant."""
    widget = QtGui.QListWidget()
    widget.setMaximumHeight(90)
    cls = objects.Beam if row.name == "Beams" else objects.SlidingBody
    analysis = objects.analysis_of(obj)
    targets = objects.members(analysis, cls) if analysis else []
    for each in targets:
        item = QtGui.QListWidgetItem(each.Label, widget)
        item.setCheckState(QtCore.Qt.Checked if each in getattr(obj, row.name) else QtCore.Qt.Unchecked)

    def changed(_):
        marked = [t for i, t in enumerate(targets) if widget.item(i).checkState() == QtCore.Qt.Checked]
        setattr(obj, row.name, marked)

    widget.itemChanged.connect(changed)
    return widget


def _text(obj, row):
    edit = QtGui.QLineEdit(str(getattr(obj, row.name)))
    edit.textChanged.connect(lambda text: setattr(obj, row.name, text))
    return edit
