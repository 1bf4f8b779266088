"""The panel of a result: the slider of frames, play, exaggeration, colours, line or tube, plots, and a shape to keep."""

import FreeCADGui
import numpy as np
from PySide import QtCore, QtGui

from .. import objects
from ..language import tr
from ..run.results import radii_of_beam
from ..view.animation import COLOURS, UNITS

PLAY_INTERVAL = 40  # ms
NOUGHT = 1e-4  # of the other end of the colours: what is less is shown as 0
PLAY_SECONDS = 5.0  # in which a motion is shown where it is much shorter or longer


class Legend(QtGui.QWidget):
    """The colours with the numbers at their ends."""

    def __init__(self):
        super().__init__()
        layout = QtGui.QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        self.low, self.bar, self.high = QtGui.QLabel(), QtGui.QLabel(), QtGui.QLabel()
        stops = ", ".join(f"stop:{i / (len(COLOURS) - 1):.2f} rgb({', '.join(str(int(255 * c)) for c in colour)})"
                          for i, colour in enumerate(COLOURS))  # fmt: skip
        self.bar.setStyleSheet(f"background: qlineargradient(x1:0, y1:0, x2:1, y2:0, {stops})")
        self.bar.setMinimumSize(80, 14)
        for widget in (self.low, self.bar, self.high):
            layout.addWidget(widget)
        layout.setStretch(1, 1)

    def show_scale(self, scale, unit):
        low = scale.low if abs(scale.low) > NOUGHT * abs(scale.high) else 0
        self.low.setText(f"{low:.4g}")
        self.high.setText(f"{scale.high:.4g} {unit}".strip())
        text = tr("Colours span 98 % of all values; the minimum is {}, the maximum {}")
        self.setToolTip(text.format(f"{scale.least:.6g}", f"{scale.greatest:.6g}"))


class ResultsPanel:
    """Looking changes nothing in the document: the frame is written to it when the panel is closed by OK."""

    def __init__(self, obj):
        self.obj, self.document = obj, obj.Document
        self.animation = obj.ViewObject.Proxy.begin()
        kind = obj.Analysis.AnalysisType if obj.Analysis else "Motion"
        self.unit, self.of_modes = "s" if kind == "Motion" else "", kind in ("Modes", "Buckling")
        self.form = QtGui.QWidget()
        self.form.setWindowTitle(obj.Label)
        layout = QtGui.QFormLayout(self.form)
        self.slider = QtGui.QSlider(QtCore.Qt.Horizontal)
        self.slider.setRange(0, len(self.animation.times) - 1)
        self.time, self.play_button = QtGui.QLabel(), QtGui.QPushButton(tr("Play"))
        self.play_button.setCheckable(True)
        self.exaggeration = QtGui.QDoubleSpinBox()
        self.exaggeration.setRange(0, 1e6)
        self.exaggeration.setValue(obj.Exaggeration)
        self.colour, self.legend = QtGui.QComboBox(), Legend()
        for field in self.animation.fields:
            self.colour.addItem(name_of_field(field), field)
        self.colour.setCurrentIndex(max(0, self.colour.findData(obj.ColourBy)))
        self.tube = QtGui.QCheckBox(tr("Tube"))
        self.tube.setChecked(obj.Show == "Tube")
        self.plots = QtGui.QComboBox()
        self.plots.addItems(sorted(name for name in self.animation.results.histories if name != "time"))
        self.plot_button, self.keep_button = QtGui.QPushButton(tr("Plot")), QtGui.QPushButton(tr("Keep this frame"))
        self.events = QtGui.QPlainTextEdit("\n".join([*obj.Warnings, *obj.Events]))
        self.events.setReadOnly(True)
        self._lay_out(layout)
        self._connect()
        self.slider.setValue(min(obj.Frame, self.slider.maximum()))
        self.colour_changed()

    def _lay_out(self, layout):
        for name, widget in ((tr("Frame"), self.slider), (tr("Time") if self.unit else tr("State"), self.time),
                             ("", self.play_button), (tr("Exaggeration"), self.exaggeration),
                             (tr("Colour"), self.colour), ("", self.legend), ("", self.tube), (tr("History"), self.plots),
                             ("", self.plot_button), ("", self.keep_button), (tr("Events"), self.events)):  # fmt: skip
            layout.addRow(name, widget)

        over_time = (self.play_button, self.plots, self.plot_button)
        of_one_state = len(self.animation.times) == 1  # as an equilibrium
        for widget in (self.slider, self.time, *over_time) if of_one_state else over_time if self.of_modes else ():
            widget.hide()
            label = layout.labelForField(widget)
            if label:
                label.hide()

    def _connect(self):
        self.timer = QtCore.QTimer()
        self.timer.setInterval(PLAY_INTERVAL)
        self.timer.timeout.connect(self.advance)
        self.clock = QtCore.QElapsedTimer()
        self.slider.valueChanged.connect(lambda _: self.show())
        self.exaggeration.valueChanged.connect(lambda _: self.show())
        self.tube.toggled.connect(lambda _: self.show())
        self.colour.currentIndexChanged.connect(lambda _: self.colour_changed())
        self.play_button.toggled.connect(self.play)
        self.plot_button.clicked.connect(self.plot)
        self.keep_button.clicked.connect(self.keep)

    def show(self):
        frame = self.slider.value()
        self.animation.show(frame, self.exaggeration.value(), self.tube.isChecked())
        self.time.setText(tr("{} ({} of {})").format(self._state(self.animation.times[frame]), frame + 1, len(self.animation.times)))

    def _state(self, time):
        """A time, or what else the states are numbered by."""
        if self.of_modes:
            return tr("at rest") if time == 0 else self.obj.Events[int(time) - 1]
        return f"{time:.6g} {self.unit}".strip()

    def colour_changed(self):
        field = self.colour.currentData()
        if field in self.animation.fields:
            self.legend.show_scale(self.animation.colour_by(field), UNITS.get(field, ""))
        self.show()

    def play(self, goes):
        """From the present frame on; frames are left out so that time runs true."""
        if not goes:
            self.timer.stop()
            return
        if self.slider.value() == self.slider.maximum():
            self.slider.setValue(0)
        self.started_at = self.animation.times[self.slider.value()]
        self.clock.start()
        self.timer.start()

    def advance(self):
        times = self.animation.times
        span = times[-1] - times[0]
        pace = 1.0 if 0.5 < span < 60 else span / PLAY_SECONDS
        now = self.started_at + pace * self.clock.elapsed() / 1000
        self.slider.setValue(int(np.searchsorted(times, now, side="right") - 1))
        if now >= times[-1]:
            self.slider.setValue(self.slider.maximum())
            self.play_button.setChecked(False)

    def plot(self):
        from .plot import show_plot

        show_plot(self.animation.results, self.plots.currentText())

    def keep(self):
        """A DeformedShape of each beam at the frame that is shown."""
        self.document.openTransaction("Keep this frame")
        kept = [keep_frame(self.obj, name, self.slider.value(), self.exaggeration.value()) for name in self.animation.names]
        self.document.recompute()
        self.document.commitTransaction()
        return kept

    def leave(self):
        self.timer.stop()
        self.obj.ViewObject.Proxy.end()
        FreeCADGui.getDocument(self.document.Name).resetEdit()
        FreeCADGui.Control.closeDialog()

    def accept(self):
        values = {"Frame": self.slider.value(), "Exaggeration": self.exaggeration.value(), "ColourBy": self.colour.currentData(),
                  "Show": "Tube" if self.tube.isChecked() else "Line"}  # fmt: skip
        changed = {name: value for name, value in values.items() if getattr(self.obj, name) != value}
        if changed:
            self.document.openTransaction("View of results")
            for name, value in changed.items():
                setattr(self.obj, name, value)
            self.document.commitTransaction()
        self.leave()
        return True

    def reject(self):
        self.leave()
        return True

    def show_property(self, prop):
        """All that there is, is shown."""


def name_of_field(field):
    """"bending_moment" as "Bending moment"."""
    return tr(field.replace("_", " ").capitalize())


def keep_frame(result, beam, frame, exaggeration=1.0):
    """The beam of a result at a frame as a shape that stays."""
    shape = objects.make(objects.DeformedShape, result.Document)
    shape.Result, shape.BeamName = result, beam
    shape.Time = f"{result.Times[frame]!r} s"
    shape.Exaggeration = exaggeration
    shape.Radius, shape.Bore = radii_of_beam(result, beam)
    shape.Label = f"{beam} at {result.Times[frame]:.6g} s"
    return shape
