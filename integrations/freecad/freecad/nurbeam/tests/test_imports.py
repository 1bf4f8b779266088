"""What the parts of the workbench may import."""

import ast
import os
import subprocess
import unittest

HERE = os.path.dirname(os.path.dirname(__file__))
WITH_WINDOW = ("view", "panels", "commands")


def sources():
    for folder, _, names in os.walk(HERE):
        for name in names:
            if name.endswith(".py"):
                yield os.path.relpath(os.path.join(folder, name), HERE)


def imported(file):
    with open(os.path.join(HERE, file), encoding="utf-8") as stream:
        tree = ast.parse(stream.read())
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield ("." * node.level) + (node.module or "")


class Imports(unittest.TestCase):
    def test_only_view_panels_and_commands_know_a_window(self):
        for file in sources():
            if file.split(os.sep)[0] in WITH_WINDOW or file == "init_gui.py":
                continue
            for name in imported(file):
                top = name.lstrip(".").split(".")[0]
                self.assertNotIn(top, ("FreeCADGui", "pivy", *WITH_WINDOW), f"{file} imports {name}")

    def test_geometry_knows_neither_nurbeam_nor_the_objects(self):
        for file in sources():
            if file.startswith("geometry"):
                for name in imported(file):
                    self.assertIn(name.lstrip("."), ("FreeCAD", "Part", "typing", "edges", "wires", "places", ""), file)

    def test_the_workbench_loads_draws_and_saves_where_nurbeam_is_missing(self):
        script = "\n".join([
            "import sys, FreeCAD, Part",
            "sys.modules['nurbeam'] = None",
            "from freecad.nurbeam import objects",
            "from freecad.nurbeam.run import run_analysis",
            "from freecad.nurbeam.tests.support import cantilever",
            "d = FreeCAD.newDocument()",
            "a = cantilever(d)[0]",
            "run, findings = run_analysis.start_run(a)",
            "assert run is None and 'install the package python3-nurbeam' in findings[0].message, findings",
            "assert abs(a.Group[0].Length.Value - 1000) < 1e-9",
            "d.saveAs(__file__ + '.FCStd')",
            "FreeCAD.closeDocument(d.Name)",
            "d = FreeCAD.openDocument(__file__ + '.FCStd')",
            "assert d.Analysis.Proxy.TYPE == 'Nurbeam::Analysis' and d.Load.Force.Value == 10000",
            "sys.exit(7)",
        ])  # fmt: skip
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "script.py")
            with open(file, "w", encoding="utf-8") as stream:
                stream.write(script)
            done = subprocess.run(["freecadcmd", file], capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, 7, done.stdout[-2000:] + done.stderr[-2000:])
