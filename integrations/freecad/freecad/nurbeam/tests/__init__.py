"""Tests that need no window: `freecadcmd -t freecad.nurbeam.tests`, or in FreeCAD by the workbench Test."""

import importlib
import os

HERE = os.path.dirname(__file__)


def load_tests(loader, standard, pattern):
    for name in sorted(os.listdir(HERE)):
        if name.startswith("test_") and name.endswith(".py"):
            standard.addTests(loader.loadTestsFromModule(importlib.import_module(f"{__name__}.{name[:-3]}")))
    return standard
