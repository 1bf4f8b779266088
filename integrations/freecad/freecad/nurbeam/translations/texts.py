"""All texts that the workbench shows in the language of the window, for the files of translations; needs no window."""

import ast
import os

from .. import objects

HERE = os.path.dirname(os.path.dirname(__file__))
# What nurbeam says by name: phases of runs, quantities along beams.
PHASES = ("Model", "Equilibrium", "Motion", "Modes", "Buckling", "Accuracy", "Results", "Ended")
FIELDS = ("Axial force", "Shear force", "Bending moment", "Moment 1", "Moment 2", "Torque", "Stress", "Von mises", "Curvature", "Displacement",
          "Twist", "Velocity")  # fmt: skip


def all_texts():
    """{(context, text)}"""
    return {*_of_tables(), *_of_sources(), *(("nurbeam", text) for text in PHASES + FIELDS)}


def _of_tables():
    """Names, groups, choices and meanings of properties."""
    for cls in objects.CLASSES:
        for row in cls.table():
            if row.help:
                yield "App::Property", row.help
            if row.hidden:
                continue
            if not row.output:
                yield "nurbeam", label(row.name)
                yield "nurbeam", row.group
            yield from (("nurbeam", choice) for choice in row.choices)


# Captions of properties where the name alone would not do.
LABELS = {
    "BendRadius": "Minimum bend radius", "BetweenBodies": "Between two bodies", "Bore": "Inner radius", "ColourBy": "Colour", "DirectionOf": "Along edge or face",
    "Every": "Store every", "ExtremeFibre": "Extreme fibre", "FromFlip": "Flip start", "FromFraction": "Start: fraction",
    "FromMass": "Start: mass", "FromObject": "Start", "FromPlaceKind": "Start: position by", "FromPlaceLength": "Start: length",
    "FromPoint": "Start: point", "FromSlope": "Start: slope", "Guide": "Rigid curve", "LengthKind": "Length by", "MovesWith": "Shown by solid",
    "PlaceKind": "Position by", "PlaceLength": "Length from start", "Pull": "Pulling force", "PullMass": "Pulling mass",
    "SecondMoment": "Second moment of area", "SecondMomentY": "About the upright axis", "SectionKind": "Kind of section", "Slack": "Slack [%]",
    "Start": "State at time 0", "StressFree": "Stress-free shape", "Table": "Table over time", "ToFlip": "Flip end",
    "ToFraction": "End: fraction", "ToMass": "End: mass", "ToObject": "End", "ToPlaceKind": "End: position by", "ToPlaceLength": "End: length",
    "ToPoint": "End: point", "ToSlope": "End: slope", "Up": "Upright direction",
}  # fmt: skip


def label(name):
    """"PlaceType" as "Place type"."""
    return LABELS.get(name) or "".join(" " + c.lower() if c.isupper() and i > 0 else c for i, c in enumerate(name))


def _of_sources():
    """Texts given to `tr`, and titles and helps of commands and toolbars."""
    for folder in ("panels", "commands", "view"):
        for name in sorted(os.listdir(os.path.join(HERE, folder))):
            if name.endswith(".py"):
                with open(os.path.join(HERE, folder, name), encoding="utf-8") as stream:
                    yield from _of_tree(ast.parse(stream.read()))
    yield "Workbench", "nurbeam"


def _of_tree(tree):
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "tr" and isinstance(node.args[0], ast.Constant):
            yield "nurbeam", node.args[0].value
        elif isinstance(node, ast.ClassDef):
            yield from _of_command(node)
        elif isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "TOOLBARS":
            yield from (("Workbench", f"nurbeam {row.elts[0].value}") for row in node.value.elts)


def _of_command(cls):
    """FreeCAD translates title and help of a command in the context of its name."""
    values = {}
    for node in (each for each in cls.body if isinstance(each, ast.Assign)):
        target = node.targets[0]
        pairs = zip(target.elts, node.value.elts) if isinstance(target, ast.Tuple) else [(target, node.value)]
        values.update((t.id, v.value) for t, v in pairs if isinstance(t, ast.Name) and isinstance(v, ast.Constant))
    if values.get("NAME"):
        yield values["NAME"], values["TITLE"]
        yield values["NAME"], values["HELP"]
