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


try:
    for stem in ('t0', 't0.05'):
        check_beams(stem)
    check_source()
    report.write('all files are as they should be\n' if not problems else f'{len(problems)} problems\n')
except Exception:
    report.write(traceback.format_exc())
report.close()
os._exit(0)  # without the questions of a window that is closed
