"""A cable of 102 m hangs over a span of 100 m: sag and pull of the catenary."""

import sys

import numpy as np

import nurbeam as nb

weight, span, length = 10.0, 100.0, 102.0  # [N/m], [m], [m]

# The catenary of that length: y = a cosh(x / a) with a = H / weight, by bisection. EA = 1e6 N stretches the cable a
# little, so that it hangs lower and pulls less.
low, high = 10.0, 1000.0
while high - low > 1e-12 * high:
    a = (low + high) / 2
    low, high = (a, high) if 2 * a * np.sinh(span / (2 * a)) > length else (low, a)
pull, sag = weight * a, a * (np.cosh(span / (2 * a)) - 1)

# Drawn as an arc of that length, without tension.
angle = 0.7
for _ in range(100):
    angle -= (np.sin(angle) / angle - span / length) / ((np.cos(angle) - np.sin(angle) / angle) / angle)
radius = length / (2 * angle)
arc = nb.Curve.arc([span / 2, radius * np.cos(angle), 0], [0, 0, 0], [span, 0, 0], [0, 0, 1], name="cable")
assert abs(arc.length - length) < 1e-9

model = nb.Model(gravity=[0, 0, 0], name="catenary")
cable = model.add_beam(arc, section=nb.Section(area=1e-3, second_moment=1e-11), elements=40,
                       material=nb.Material(density=1000, youngs_modulus="1 GPa"))
model.add_support(cable, at="start", name="left")
model.add_support(cable, at="end", name="right")
model.add_load(cable, force_per_length=[0, -weight, 0])
results = model.run(type="static")

found = -results[-1].beams["cable"].nodes[:, 1].min()
print(f"sag {found:.4f} m (inextensible: {sag:.4f} m), pull {-results[-1]['left.fx']:.2f} N ({pull:.2f} N)")
assert abs(found / 9.03621513 - 1) < 1e-5  # with EA = 1e6 N
assert abs(results[-1]["left.fx"] / -1396.162404 - 1) < 1e-5

if sys.argv[1:]:
    results.plot_along("axial_force").figure.savefig(sys.argv[1])
