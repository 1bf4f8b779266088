"""A curved pendulum falls: how its error goes with the number of elements."""

import sys
from pathlib import Path

import numpy as np

import nurbeam as nb

case = Path(__file__).resolve().parents[1] / "papers" / "pendulum.json"


def distance(elements):
    """|AB| at 0.2 s [m]: from the pin to the end."""
    model = nb.load(case, set={"beams[0].elements": {"count": elements}, "beams[0].axial_strain": None})
    end = model.run(end_time=0.2, step=1e-3).histories["B.position"][-1]
    return np.linalg.norm(end)


counts = np.array([4, 8, 16])
found = np.array([distance(int(count)) for count in counts])
best = distance(48)
errors = np.abs(found - best)
order = np.log(errors[0] / errors[-1]) / np.log(counts[-1] / counts[0])
print(f"|AB| = {best:.6f} m; errors {errors}, order {order:.2f}")
assert abs(best - 0.423721) < 2e-5
assert order > 3.5

if sys.argv[1:]:
    import matplotlib.pyplot as plt

    plt.loglog(counts, errors, "o-")
    plt.xlabel("elements")
    plt.ylabel("error of |AB| [m]")
    plt.savefig(sys.argv[1])
