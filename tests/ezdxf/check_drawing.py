# check_drawing.py FILE JSON: the splines of a DXF file are sound, and those that nurbeam finds in it.
import json
import sys

import ezdxf
from ezdxf import units

document = ezdxf.readfile(sys.argv[1])
problems = [str(error) for error in document.audit().errors]
with open(sys.argv[2]) as file:
    curves = {curve['layer']: curve for curve in json.load(file)[0]['curves']}
to_metres = units.conversion_factor(document.units, units.M)
splines = {entity.dxf.layer: entity for entity in document.modelspace()}
if sorted(splines) != sorted(curves):
    problems.append(f'layers {sorted(splines)}, not {sorted(curves)}')
for layer, entity in splines.items():
    if entity.dxftype() != 'SPLINE':
        problems.append(f'{layer} is a {entity.dxftype()}')
        continue
    curve = entity.construction_tool()
    points = list(curve.approximate(20000))
    length = to_metres * sum(a.distance(b) for a, b in zip(points, points[1:]))
    if abs(length / curves[layer]['length [m]'] - 1) > 1e-6:
        problems.append(f'{layer} is {length} m long, not {curves[layer]["length [m]"]}')
    if entity.dxf.degree != curves[layer]['degree']:
        problems.append(f'{layer} has degree {entity.dxf.degree}')
    # C1: no interior knot is as often there as the degree.
    knots = list(entity.knots)
    inner = [u for u in knots if knots[0] < u < knots[-1]]
    if any(inner.count(u) >= entity.dxf.degree for u in inner):
        problems.append(f'{layer} is only C0')
print('\n'.join(problems) or f'{sys.argv[1]}: {len(splines)} splines as they should be')
sys.exit(bool(problems) or not splines)
