"""What a run has left in a directory: histories, shapes, section forces."""

import sys
import tempfile
from pathlib import Path

import numpy as np

import nurbeam as nb

case = Path(__file__).resolve().parents[1] / "bend45" / "bend45.json"
with tempfile.TemporaryDirectory() as folder:
    nb.load(case, set={"output.cad": None, "output.report": False}).run(out=folder)  # or: nurbeam run bend45.json

    results = nb.Results(folder)
    print(results, results.report["status"])
    print(list(results.histories))

    data = results.to_xarray()
    print(data["energy.bending"])

    beam = results[-1].beams[results.beams[0]]
    moment, s = beam.field("bending_moment"), beam.s
    print(f"the largest moment is {np.abs(moment).max():.4g} N m at s = {s[np.argmax(np.abs(moment))]:.3f} m")
    assert np.abs(moment).argmax() == 0  # at the clamp

    # The clamp holds that moment: what the beam carries there is what the support gives.
    support = next(name for name in results.histories if name.endswith(".mx")).rsplit(".", 1)[0]
    couple = results.histories[f"{support}.couple"][-1]
    tangent = beam.node_slopes[0] / np.linalg.norm(beam.node_slopes[0])
    across = couple - tangent * (couple @ tangent)
    assert abs(np.linalg.norm(across) / np.abs(moment[0]) - 1) < 1e-6

    if sys.argv[1:]:
        results.plot_along("bending_moment").figure.savefig(sys.argv[1])
