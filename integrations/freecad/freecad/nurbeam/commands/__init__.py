"""The commands of the workbench, in the order of menu and toolbar."""

import FreeCADGui

from . import create, fem, material, results, run

TOOLBARS = (
    ("model", (create.NewAnalysis, material.NewMaterial, create.NewBeam, create.NewSupport, create.NewBody, create.NewLoad, create.NewJoint,
               create.NewConnector, create.NewStop, create.NewProbe)),
    ("cable", (create.NewCable,)),
    ("solve", (run.Check, run.RunAnalysis, run.ExportCase, fem.TakeOverFem)),
    ("results", (results.Results, results.KeepFrame, results.Plot)),
)  # fmt: skip


def toolbars():
    """(title, names of commands) of each toolbar; makes the commands known to FreeCAD."""
    for _, classes in TOOLBARS:
        for cls in classes:
            FreeCADGui.addCommand(cls.NAME, cls())
    return [(title, [cls.NAME for cls in classes]) for title, classes in TOOLBARS]
