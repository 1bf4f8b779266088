#!/usr/bin/python3
"""Instructions that a step of nurbeam takes, as callgrind counts them: the figure without noise.

usage: tests/benchmarks/instructions.py build/release/pipelines/nurbeam

Example 1 of Ding & Ouyang 2022 with 10, 40 and 160 elements, and the same beam without a body: what 300 steps take more
than 100, over 200. Counted for the registers that valgrind knows (AVX2).
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile


def case(elements, steps, slider):
    model = {
        "nurbeam": 1,
        "gravity": [0, -9.81, 0],
        "beams": [{"name": "beam", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": 0.01},
                   "material": {"density": 7200, "youngs_modulus": "20 MPa"}, "elements": {"count": elements},
                   "curvature": "spatial"}],
        "supports": [{"beam": "beam", "at": "start", "type": "clamped"}],
        "analysis": {"type": "dynamic", "end_time": steps * 1e-4, "step": 1e-4},
        "output": {"every": steps * 1e-4, "report": False},
    }
    if slider:
        model["bodies"] = [{"name": "mass", "mass": 0.8}]
        model["sliding_joints"] = [{"body": "mass", "beam": "beam", "at": {"length": 0.1}}]
    return model


def instructions(program, model, directory):
    file = directory / "case.json"
    file.write_text(json.dumps(model))
    run = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={directory}/callgrind", program, "run",
                          file, "--out", tempfile.mktemp(dir=directory), "--quiet"], capture_output=True, text=True, check=True)
    return int(re.search(r"refs:\s+([\d,]+)", run.stderr).group(1).replace(",", ""))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print(f"{'elements':>8}  {'body':>4}  {'instructions a step':>19}  {'an element':>10}")
    with tempfile.TemporaryDirectory() as name:
        for elements in (10, 40, 160):
            for slider in (False, True):
                few, many = (instructions(sys.argv[1], case(elements, steps, slider), pathlib.Path(name))
                             for steps in (100, 300))
                step = (many - few) / 200
                print(f"{elements:8}  {'yes' if slider else 'no':>4}  {step:19,.0f}  {step / elements:10,.0f}")


if __name__ == "__main__":
    main()
