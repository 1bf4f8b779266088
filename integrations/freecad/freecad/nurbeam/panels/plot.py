"""Histories in a dock of the main window."""

import FreeCADGui
from PySide import QtCore, QtGui

_NAME = "nurbeam plot"
HEIGHT = 260  # pixels


def show_plot(results, name):
    """Shows a history over time; returns the axes."""
    from matplotlib.backends.backend_qtagg import FigureCanvasQTAgg
    from matplotlib.figure import Figure

    figure = Figure(layout="constrained")
    axes = figure.add_subplot()
    results.plot(name, ax=axes)
    window = FreeCADGui.getMainWindow()
    dock = window.findChild(QtGui.QDockWidget, _NAME)
    if dock is None:
        dock = QtGui.QDockWidget(_NAME, window)
        dock.setObjectName(_NAME)
        window.addDockWidget(QtCore.Qt.BottomDockWidgetArea, dock)
    canvas = FigureCanvasQTAgg(figure)
    canvas.setMinimumHeight(HEIGHT // 2)
    dock.setWidget(canvas)
    dock.show()
    window.resizeDocks([dock], [HEIGHT], QtCore.Qt.Vertical)
    return axes
