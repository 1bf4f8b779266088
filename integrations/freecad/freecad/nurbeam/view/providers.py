"""View providers: icon, panel, and symbol of each kind of object."""

import FreeCADGui
from pivy import coin

from .. import objects
from . import icon, symbols
from .animation import Animation

ICON_OF = {
    objects.Analysis.TYPE: "analysis", objects.Beam.TYPE: "beam", objects.Support.TYPE: "support",
    objects.SlidingBody.TYPE: "body", objects.Load.TYPE: "load", objects.Joint.TYPE: "joint",
    objects.Connector.TYPE: "connector", objects.Stop.TYPE: "stop", objects.Probe.TYPE: "probe",
    objects.Result.TYPE: "results", objects.DeformedShape.TYPE: "keep", objects.CableOfLength.TYPE: "cable",
}  # fmt: skip


class Provider:
    """Of objects with values alone."""

    NODE = ""
    """The attribute that has the node which is shown; "" of an object that shows none."""

    def __init__(self, view):
        view.Proxy = self
        if not hasattr(self, "Object"):  # FreeCAD attaches one view only, here that of a file which had lost its class
            self.attach(view)
            if self.NODE:
                view.RootNode.addChild(getattr(self, self.NODE))

    def attach(self, view):
        self.Object = view.Object

    def getIcon(self):
        return icon(ICON_OF.get(self.Object.NurbeamType, "nurbeam"))

    def doubleClicked(self, view):
        return FreeCADGui.ActiveDocument.setEdit(view.Object.Name)

    def setEdit(self, view, mode=0):
        from ..panels import open_panel

        return open_panel(view.Object)

    def unsetEdit(self, view, mode=0):
        FreeCADGui.Control.closeDialog()
        return True

    def dumps(self):
        return None

    def loads(self, state):
        return None

    __getstate__ = dumps
    __setstate__ = loads


class PlainProvider(Provider):
    """Of objects that show nothing of their own; without a display mode the tree greys them as if they were hidden."""

    def attach(self, view):
        super().attach(view)
        view.addDisplayMode(coin.SoSeparator(), "Plain")

    def getDisplayModes(self, view):
        return ["Plain"]

    def getDefaultDisplayMode(self):
        return "Plain"

    def setDisplayMode(self, mode):
        return mode


class AnalysisProvider(Provider):
    """Of an analysis: a double click also makes it the active one."""

    def doubleClicked(self, view):
        from ..commands.command import activate

        activate(view.Object)
        return super().doubleClicked(view)


class SymbolProvider(Provider):
    """Of objects that stand at a place of a beam."""

    NODE = "node"
    LAST = "Position"
    """The property without which the symbol has no place; an object that is being made or loaded may lack it."""

    def attach(self, view):
        super().attach(view)
        self.symbol = self.new_symbol(view.Object)
        self.node = self.symbol.node
        view.addDisplayMode(self.node, "Symbol")
        self.updateData(view.Object, "Position")

    def getDisplayModes(self, view):
        return ["Symbol"]

    def getDefaultDisplayMode(self):
        return "Symbol"

    def setDisplayMode(self, mode):
        return mode

    def new_symbol(self, obj):
        return symbols.Symbol(obj.NurbeamType)

    def updateData(self, obj, prop):
        if hasattr(self, "symbol") and self.LAST in obj.PropertiesList:
            self.symbol.update(obj)


class SpanProvider(SymbolProvider):
    """Of connectors, which are shown as a line."""

    LAST = "ToSlope"

    def new_symbol(self, obj):
        return symbols.Span()


class ResultProvider(Provider):
    """Of results: the frame that is shown is its own, so that looking changes no document."""

    NODE = "root"

    def attach(self, view):
        super().attach(view)
        self.root = coin.SoSeparator()
        self.animation = None
        view.addDisplayMode(self.root, "Frame")

    def getDisplayModes(self, view):
        return ["Frame"]

    def getDefaultDisplayMode(self):
        return "Frame"

    def setDisplayMode(self, mode):
        return mode

    def begin(self):
        """The animation of the present data, made anew."""
        self.end()
        self.animation = Animation(self.Object)
        self.root.addChild(self.animation.node)
        return self.animation

    def end(self):
        if self.animation is not None:
            self.animation.release()
            self.root.removeAllChildren()
            self.animation = None


SHOWN = {objects.Analysis.TYPE: AnalysisProvider, objects.Result.TYPE: ResultProvider,
         objects.Connector.TYPE: SpanProvider, objects.Beam.TYPE: PlainProvider}  # fmt: skip


def provider_of(obj):
    """The class for an object of the workbench; None for another one."""
    kind = objects.type_of(obj)
    if kind in symbols.SYMBOLS:
        return SymbolProvider
    return SHOWN.get(kind, Provider) if kind in objects.BY_TYPE else None
