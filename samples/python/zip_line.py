"""A trolley runs down a cable that is drawn in CAD; the deformed cable goes back to CAD."""

import sys
import tempfile
from pathlib import Path

import numpy as np

import nurbeam as nb

samples = Path(__file__).resolve().parents[1]
curve = nb.read(samples / "zipline" / "cable.step")["Zip cable"]

model = nb.Model(gravity=[0, 0, -9.81], name="zip line")
cable = model.add_beam(curve, section=nb.Circle(radius="6 mm"), stress_free="straight", elements=40,
                       material=nb.Material(density=5200, youngs_modulus="60 GPa"))
model.add_support(cable, at="start")
model.add_support(cable, at="end")
trolley = model.add_body("trolley", mass=80)
model.add_sliding_joint(trolley, cable, at="1.5 m", slope="discontinuous", at_beam_end="stop")

results = model.run(end_time=1, step="2 ms", every=0.02, initial="equilibrium")
print(f"after {results.times[-1]:.2f} s the trolley runs at {results.histories['trolley.speed'][-1]:.2f} m/s")

energy = results.histories["energy.total"]
assert np.ptp(energy) < 1e-2 * results.histories["energy.kinetic"].max()

with tempfile.TemporaryDirectory() as folder:
    results.export(Path(folder) / "deformed.step")
    back = nb.read(Path(folder) / "deformed.step")[curve.name]
    assert abs(back.length - results[-1].beams[curve.name].length) < 1e-9 * back.length

if sys.argv[1:]:
    results.plot_shape(times=[0, 0.25, 0.5, 0.75, 1]).figure.savefig(sys.argv[1])
