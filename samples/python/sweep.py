"""Forty runs on two cores: threads are enough, since a run lets go of Python's lock."""

import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import nurbeam as nb

radius, density, E, load = 0.005, 7850.0, 210e9, 20.0


def deflection(length):
    """Of the end of a cantilever that a force bends far [m]."""
    model = nb.Model(gravity=[0, 0, 0], name=f"{length:.2f} m")
    rod = model.add_beam(nb.Curve.line([0, 0, 0], [length, 0, 0]), section=nb.Circle(radius), elements=20,
                         material=nb.Material(density, E), name="rod")
    model.add_support(rod, at="start", type="clamped")
    model.add_load(rod, at="end", force=[0, -load, 0])
    return -model.run(type="static")[-1].beams["rod"].nodes[-1, 1]


lengths = np.linspace(0.2, 4, 40)
with ThreadPoolExecutor(2) as pool:
    found = np.array(list(pool.map(deflection, lengths)))

stiffness = E * np.pi / 4 * radius**4
parameter = load * lengths**2 / stiffness  # P L^2 / EI
small = load * lengths**3 / (3 * stiffness)
print(f"P L^2 / EI from {parameter[0]:.3f} to {parameter[-1]:.2f}: w / L from {found[0] / lengths[0]:.5f} to {found[-1] / lengths[-1]:.5f}")
assert abs(found[0] / small[0] - 1) < 1e-3  # a small deflection is that of the linear beam
assert np.all(np.diff(found / lengths) > 0) and found[-1] < 0.75 * small[-1]  # a large one is less

if sys.argv[1:]:
    import matplotlib.pyplot as plt

    plt.plot(parameter, found / lengths, "o", parameter, small / lengths, "-")
    plt.xlabel("P L² / EI")
    plt.ylabel("w / L")
    plt.ylim(0, 1)
    plt.savefig(sys.argv[1])
