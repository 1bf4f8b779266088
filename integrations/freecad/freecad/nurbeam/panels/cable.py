"""The panel of a cable of a given length: its ends, its goal, and what was found."""

from PySide import QtGui

from ..language import tr
from .parts import PartPanel

GOALS = {"CableLength": "Length", "Slack": "Slack", "BendRadius": "Bend radius"}


class CablePanel(PartPanel):
    def build(self):
        super().build()
        self.fields["Goal"].currentIndexChanged.connect(lambda _: self.show_goal())
        self.run = QtGui.QPushButton(tr("Run"))
        self.run.setToolTip(tr("Find the cable now, also where it takes longer than a recompute may"))
        self.run.clicked.connect(self.find)
        self.found = QtGui.QLabel()
        self.found.setWordWrap(True)
        self.layout.addWidget(self.run)
        self.layout.addWidget(self.found)
        self.show_goal()
        self.show_found()

    def show_goal(self):
        for name, goal in GOALS.items():
            shown = self.obj.Goal == goal
            self.fields[name].setVisible(shown)
            self.labels[name].setVisible(shown)

    def find(self):
        self.obj.RunNow = True
        try:
            self.obj.touch()
            self.document.recompute()
        finally:
            self.obj.RunNow = False
        self.show_found()

    def show_found(self):
        self._show_message()
        if "Invalid" in self.obj.State or self.obj.LengthFound.Value == 0:
            self.found.setText("")
            return
        found = (self.obj.LengthFound, self.obj.LeastRadius, self.obj.LargestTension)
        text = tr("Length {}, minimum bend radius {}, maximum tension {}")
        self.found.setText(text.format(*(quantity.UserString for quantity in found)))
