"""Curves alone: exact circles, knots, pieces, files."""

import sys
import tempfile
from pathlib import Path

import numpy as np

import nurbeam as nb

circle = nb.Curve.arc([0, 0, 0], [1, 0, 0], [1, 0, 0], [0, 0, 1], name="circle")
print(circle)
assert abs(circle.length - 2 * np.pi) < 1e-12
assert np.abs(np.linalg.norm(circle.sample(1000), axis=1) - 1).max() < 1e-15 * 4

# Its area, by Green's theorem and Gauss's rule on every piece.
x, w = np.polynomial.legendre.leggauss(20)
area = 0.0
for piece in circle.to_bezier():
    for u, weight in zip((x + 1) / 2, w / 2):
        (px, py, _), (dx, dy, _) = piece.derivatives(u)
        area += weight * (px * dy - py * dx) / 2
assert abs(area - np.pi) < 1e-12

# A knot more changes nothing; neither does a way through a file.
finer = circle.insert_knot(0.5, times=2)
assert np.abs(finer.sample(100) - circle.sample(100)).max() < 1e-14
near = circle.closest_point([2, 2, 1])
assert np.allclose(near.point, [np.sqrt(0.5), np.sqrt(0.5), 0], atol=1e-12)

with tempfile.TemporaryDirectory() as folder:
    nb.write(Path(folder) / "circle.step", circle)
    assert abs(nb.read(Path(folder) / "circle.step")["circle"].length - 2 * np.pi) < 1e-10

if sys.argv[1:]:
    Path(sys.argv[1]).write_text(circle._repr_svg_())
