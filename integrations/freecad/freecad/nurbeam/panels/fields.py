"""Widgets for properties: each shows the value that the object has and writes it there; no value lives in a widget."""

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from .. import objects
from ..language import tr
from ..objects.material_card import cards_of, make_card, standard_cards
from .references import ReferenceList

QUANTITIES = ("Length", "Distance", "Area", "Force", "Speed", "Acceleration", "Quantity")
DIGITS = 10  # that are shown of quantities
OF_THEIR_OWN = ("kg", "kg*m^2", "N*m", "N*m^2", "N*s/m", "kg/m", "N*m/rad", "N*m*s/rad")  # units that FreeCAD shows as µg, J, mm^3*kg/s^2, ...
TARGETS = {
    "Beam": (objects.Beam,), "FromObject": (objects.Beam, objects.SlidingBody), "ToObject": (objects.Beam, objects.SlidingBody),
}  # fmt: skip


def field_of(obj, row):
    """A widget for a row of the table of an object."""
    if row.unit in OF_THEIR_OWN:
        return _quantity_in_unit(obj, row)
    if row.type in QUANTITIES:
        return _quantity(obj, row)
    if row.name == "Material":
        return _material(obj, row)
    makers = {"Enumeration": _enumeration, "Bool": _bool, "Integer": _integer, "Float": _float, "Vector": _vector,
              "Link": _link, "XLinkSub": ReferenceList, "XLinkSubList": ReferenceList, "LinkList": _link_list}  # fmt: skip
    return makers.get(row.type, _text)(obj, row)


def _quantity(obj, row):
    """FreeCAD's own box, which takes units and expressions. It shows two decimals of what has no format of its own."""
    box = _new_box()
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


def _new_box():
    """PySide takes a new box for one that was deleted where it stands at the address of that and Python still refers to it: then
    another one is made, while the first keeps its address."""
    boxes = []
    for _ in range(20):
        boxes.append(FreeCADGui.UiLoader().createWidget("Gui::QuantitySpinBox"))
        try:
            boxes[-1].objectName()
            break
        except RuntimeError:
            continue
    return boxes[-1]


def _quantity_in_unit(obj, row):
    """A line that shows a quantity in the unit of the table, and takes any other; with "=" before it an expression."""
    expression = dict(obj.ExpressionEngine).get(row.name)
    value = getattr(obj, row.name).getValueAs(row.unit)
    edit = QtGui.QLineEdit(f"={expression}" if expression else f"{getattr(value, 'Value', value):.{DIGITS}g} {row.unit}")

    def changed(text):
        try:
            _write_quantity(obj, row, text.strip())
            edit.setStyleSheet("")
        except (ValueError, ArithmeticError, RuntimeError, TypeError):
            edit.setStyleSheet("color: red")

    edit.textChanged.connect(changed)
    return edit


def _write_quantity(obj, row, text):
    is_expression = text.startswith("=")
    quantity = FreeCAD.Units.Quantity(obj.evalExpression(text[1:]) if is_expression else text)
    if quantity.Unit == FreeCAD.Units.Unit() and not is_expression:
        quantity = FreeCAD.Units.Quantity(f"{quantity.Value!r} {row.unit}")
    if quantity.Unit != FreeCAD.Units.Unit(row.unit):
        raise ValueError(f"{text} is no quantity in {row.unit}")
    if is_expression:
        obj.setExpression(row.name, text[1:])
        return
    if row.name in dict(obj.ExpressionEngine):
        obj.setExpression(row.name, None)
    setattr(obj, row.name, quantity)


def _material(obj, row):
    """The cards of the document, and below them those that FreeCAD brings, of which one that is chosen comes into the document."""
    box = QtGui.QComboBox()
    own, standard = cards_of(obj.Document), standard_cards()
    box.addItem(tr("(none)"), None)
    for card in own:
        box.addItem(card.Label, card.Name)
    box.insertSeparator(box.count())
    box.addItems(list(standard))
    box.setMaxVisibleItems(20)
    present = obj.Material
    box.setCurrentIndex(own.index(present) + 1 if present in own else 0)

    def take(index):
        name = box.itemText(index)
        if index == 0:
            obj.Material = None
        elif box.itemData(index):
            obj.Material = obj.Document.getObject(box.itemData(index))
        elif name in standard:
            obj.Material = make_card(obj.Document, standard[name], name)
            box.setItemData(index, obj.Material.Name)  # chosen again, it is the same card

    box.currentIndexChanged.connect(take)
    return box


def _enumeration(obj, row):
    box = QtGui.QComboBox()
    for choice in row.choices:
        box.addItem(tr(choice), choice)
    box.setCurrentIndex(list(row.choices).index(getattr(obj, row.name)))
    box.currentIndexChanged.connect(lambda index: setattr(obj, row.name, row.choices[index]))
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
    box.addItems([tr("(none)"), *(each.Label for each in targets[1:])])
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
