# Run by FreeCAD in the directory of the runs: names in the tree, edges, continuity, volumes. Writes "report".
import json
import math
import os
import traceback

import FreeCAD
import ImportGui
import Part

RADII = {'pipe left': 20.0, 'cable': 5.0}  # mm
report = open('report', 'w')
problems = []


def expect(what, condition):
    if not condition:
        problems.append(what)
        report.write(f'WRONG: {what}\n')


def parts_of(file):
    """The shapes of the file by the names that the tree shows."""
    document = FreeCAD.newDocument()
    ImportGui.insert(file, document.Name, merge=False)
    parts = {o.Label: o.Shape.copy() for o in document.Objects
             if hasattr(o, 'Shape') and not o.TypeId.startswith('App::') and not o.Shape.isNull()}
    FreeCAD.closeDocument(document.Name)
    return parts


def expect_one_smooth_edge(what, shape):
    expect(f'{what}: {len(shape.Edges)} edges, not one', len(shape.Edges) == 1)
    curve = shape.Edges[0].Curve
    expect(f'{what}: only {getattr(curve, "Continuity", "C1")}',
           getattr(curve, 'Continuity', 'CN') not in ('C0', 'G0'))


def check_beams(stem):
    with open(f'beams/{stem}.json') as file:
        lengths = {curve['name']: 1000 * curve['length [m]'] for curve in json.load(file)[0]['curves']}
    for ending in ('.step', '.igs'):
        file = f'beams/deformed_{stem}{ending}'
        parts = parts_of(file)
        expect(f'{file}: parts {sorted(parts)}', sorted(parts) == sorted(RADII))
        for name, shape in parts.items():
            expect_one_smooth_edge(f'{file}: {name}', shape)
            expect(f'{file}: {name} is {shape.Length} mm long, not {lengths[name]}',
                   abs(shape.Length / lengths[name] - 1) < 1e-6)
    brep = Part.read(f'beams/deformed_{stem}.brep')
    for edge, length in zip(brep.Edges, lengths.values()):
        expect(f'BREP: an edge of {edge.Length} mm, not {length}', abs(edge.Length / length - 1) < 1e-6)
    file = f'beams/deformed_{stem}_solid.step'
    solids = parts_of(file)
    expect(f'{file}: parts {sorted(solids)}', sorted(solids) == sorted(RADII))
    for name, solid in solids.items():
        expect(f'{file}: {name} is not valid', solid.isValid() and len(solid.Solids) == 1)
        volume = math.pi * RADII[name] ** 2 * lengths[name]
        report.write(f'{file}: {name}: volume off by {solid.Volume / volume - 1:.2g}\n')
        expect(f'{file}: {name} has {solid.Volume} mm^3, not {volume}', abs(solid.Volume / volume - 1) < 1e-6)


def check_source():
    before, after = parts_of('ropes.step'), parts_of('source/deformed_t0.02_source.step')
    expect(f'step-source: parts {sorted(after)}, not {sorted(before)}', sorted(after) == sorted(before))
    for name, shape in after.items():
        expect_one_smooth_edge(f'step-source: {name}', shape)
        expect(f'step-source: {name} has not moved',
               shape.BoundBox.Center.distanceToPoint(before[name].BoundBox.Center) > 1e-3)


def roots_of(file):
    """What the tree shows first, its label and its shape."""
    document = FreeCAD.newDocument()
    ImportGui.insert(file, document.Name, merge=False)
    roots = [(o.Label, o.Shape.copy()) for o in document.Objects if not o.InList and hasattr(o, 'Shape')]
    FreeCAD.closeDocument(document.Name)
    return roots


def check_added(stem):
    """The source has the deformed curve besides, as one smooth edge, and is else as it was."""
    file = f'{stem}/deformed_t0.02_source.step'
    before, after = roots_of(f'{stem}.step'), roots_of(file)
    expect(f'{file}: {[label for label, shape in after]}', len(after) == 1 and after[0][0] == before[0][0])
    old, new = before[0][1], after[0][1]
    expect(f'{file}: {len(new.Edges)} edges', len(new.Edges) == len(old.Edges) + 1)
    expect(f'{file}: {new.Volume} mm^3', abs(new.Volume - old.Volume) <= 1e-9 * old.Volume)
    added = Part.Shape(max(new.Edges, key=lambda edge: edge.Length))
    expect(f'{file}: {added.Length} mm', abs(added.Length / 1796.9911 - 1) < 1e-3)
    expect_one_smooth_edge(file, added)


try:
    for stem in ('t0', 't0.05'):
        check_beams(stem)
    check_source()
    for stem in ('bends', 'pipe'):
        check_added(stem)
    report.write('all files are as they should be\n' if not problems else f'{len(problems)} problems\n')
except Exception:
    report.write(traceback.format_exc())
report.close()
os._exit(0)  # without the questions of a window that is closed
