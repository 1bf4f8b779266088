"""The panel that chooses a material card for beams: one of the document, or one that FreeCAD brings."""

import FreeCADGui
from PySide import QtCore, QtGui

from ..language import tr
from ..objects.material_card import cards_of, make_card, standard_cards

SHOWN = ("Density", "YoungsModulus", "PoissonRatio", "ThermalExpansionCoefficient")


class MaterialPanel:
    """OK makes the card, where the document lacks it, and gives it to the beams, in one step of undo."""

    def __init__(self, document, beams):
        self.document, self.beams = document, beams
        self.form = QtGui.QWidget()
        self.form.setWindowTitle(tr("Material"))
        layout = QtGui.QVBoxLayout(self.form)
        self.of = QtGui.QLabel(tr("For {}").format(", ".join(beam.Label for beam in beams)) if beams else tr("For beams that are made later"))
        self.of.setWordWrap(True)
        self.filter = QtGui.QLineEdit()
        self.filter.setPlaceholderText(tr("Part of a name, as S235"))
        self.list, self.texts = QtGui.QListWidget(), QtGui.QLabel()
        for widget in (self.of, self.filter, self.list, self.texts):
            layout.addWidget(widget)
        self.choices = [*((card.Label, dict(card.Material), card) for card in cards_of(document)),
                        *((name, texts, None) for name, texts in standard_cards().items())]  # fmt: skip
        for i, (name, _, card) in enumerate(self.choices):
            item = QtGui.QListWidgetItem(tr("{} (in this document)").format(name) if card else name, self.list)
            item.setData(QtCore.Qt.UserRole, i)
        self.filter.textChanged.connect(self.show_matching)
        self.list.currentRowChanged.connect(lambda _: self.show_texts())
        self.list.setCurrentRow(self._row_of_present())

    def _row_of_present(self):
        present = self.beams[0].Material if self.beams else None
        return next((i for i, choice in enumerate(self.choices) if present is not None and choice[2] is present), 0)

    def show_matching(self, text):
        for row in range(self.list.count()):
            self.list.item(row).setHidden(text.lower() not in self.list.item(row).text().lower())
        current = self.list.currentItem()
        if current is None or current.isHidden():
            shown = [row for row in range(self.list.count()) if not self.list.item(row).isHidden()]
            self.list.setCurrentRow(shown[0] if shown else -1)

    def chosen(self):
        item = self.list.currentItem()
        return None if item is None else self.choices[item.data(QtCore.Qt.UserRole)]

    def show_texts(self):
        chosen = self.chosen()
        self.texts.setText("\n".join(f"{entry}: {chosen[1][entry]}" for entry in SHOWN if chosen[1].get(entry)) if chosen else "")

    def accept(self):
        chosen = self.chosen()
        if chosen is not None:
            name, texts, card = chosen
            self.document.openTransaction("Material")
            card = card or make_card(self.document, texts, name)
            for beam in self.beams:
                beam.Material = card
            self.document.recompute()
            self.document.commitTransaction()
        FreeCADGui.Control.closeDialog()
        return True

    def reject(self):
        FreeCADGui.Control.closeDialog()
        return True
