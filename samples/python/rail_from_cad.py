"""A bead on a rail out of a solid that a CAD system wrote: a case file, looked at, changed and run."""

import sys
from pathlib import Path

import numpy as np

import nurbeam as nb

folder = Path(__file__).resolve().parents[1] / "rail"
curves = nb.read(folder / "rhino-sliced-cylinder.step")
for number, curve in enumerate(curves, 1):
    print(number, curve.facts["entity"], f"{curve.length:.4f} m", "free" if curve.facts["free"] else "edge of a face")

model = nb.load(folder / "rail.json", set={"analysis.end_time": 0.2, "output.cad": None})
model.add_probe("middle", "rail", {"fraction": 0.5})
results = model.run()

# The bead is on the deformed rail at every time.
gaps = [snapshot.beams["rail"].curve.closest_point(snapshot.bodies["bead"].position).distance for snapshot in results[::8]]
print(f"the bead is within {max(gaps):.1e} m of its rail, which bends by {np.nanmax(results.histories['rail.displacement.max']):.1e} m")
assert max(gaps) < 1e-9

if sys.argv[1:]:
    results.plot("bead.position").figure.savefig(sys.argv[1])
