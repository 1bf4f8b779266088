"""Natural frequencies of a cantilever: by the analysis, and by hand from its matrices."""

import sys

import numpy as np
import scipy.linalg

import nurbeam as nb

length, radius, density, E = 1.0, 0.005, 7850.0, 210e9
model = nb.Model(gravity=[0, 0, 0], name="cantilever")
rod = model.add_beam(nb.Curve.line([0, 0, 0], [length, 0, 0]), section=nb.Circle(radius), elements=12,
                     material=nb.Material(density, E), name="rod")
model.add_support(rod, at="start", type="clamped")

beta = np.array([1.8751040687119611, 4.694091132974174, 7.854757438237612])
exact = beta**2 * np.sqrt(E * radius**2 / 4 / density) / length**2 / (2 * np.pi)

modes = model.modes(count=3).modes
found = np.array([mode.frequency for mode in modes])

system = model.system()
K, M, G = system.stiffness(), system.mass(), system.constraint_gradient()
free = np.linalg.svd(G.toarray())[2][G.shape[0]:].T  # where the constraints let it move
omega = np.sqrt(scipy.linalg.eigh(free.T @ K @ free, free.T @ M @ free, eigvals_only=True)[:3])

print("exact ", exact, "Hz\nmodes ", found, "Hz\nmatrix", omega / (2 * np.pi), "Hz")
assert np.abs(found / exact - 1).max() < 1e-3
assert np.abs(omega / (2 * np.pi) / found - 1).max() < 1e-6

if sys.argv[1:]:
    import matplotlib.pyplot as plt

    for mode in modes:
        points = mode.shape.beams["rod"].points()
        plt.plot(points[:, 0], points[:, 1], label=f"{mode.frequency:.1f} Hz")
    plt.legend()
    plt.savefig(sys.argv[1])
