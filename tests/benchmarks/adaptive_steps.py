"""Newton iterations for the same error: error control, of generalized-alpha and of Radau IIA, against fixed steps.

    /usr/bin/python3 tests/benchmarks/adaptive_steps.py build/release/pipelines/nurbeam

For Examples 1 to 3 of node_or_point.py on one mesh each (20 elements, or as many as a second word says): the error is the
largest distance of the body, at 50 times of output, from where steps of 1e-5 s have it, over the length of the beam. It prints
every run, and at some errors the iterations of all ways, between runs logarithmic, and their ratios to those of fixed steps.
Of a way the fewest iterations count that reach the error: between two runs, or of a run that is better.
"""

import csv
import json
import math
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from node_or_point import CASES

NAMES = ("Example 1", "Example 2", "Example 3")
FINEST = {"step": 1e-5}
STEPS = [{"step": 8e-3 / math.sqrt(2) ** k} for k in range(18)]
TOLERANCES = [{"tolerance": 10 ** (-k / 2)} for k in range(2, 15)]
RADAU = [{**tolerance, "integrator": {"type": "radau"}} for tolerance in TOLERANCES[:9]]
ERRORS = (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 5e-6)


def run(program, name, elements, steps):
    """The body's path, the beam's length and the iterations."""
    case = json.loads(json.dumps(CASES[name]))
    case["beams"][0]["elements"] = {"count": elements}
    del case["analysis"]["step"]
    case["analysis"].update(steps)
    case["output"] = {"every": case["analysis"]["end_time"] / 50, "report": False}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "case.json"
        file.write_text(json.dumps(case))
        subprocess.run([program, "run", file, "--out", Path(folder) / "out", "--quiet"], check=True, capture_output=True)
        with open(Path(folder) / "out/histories.csv", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        iterations = json.loads((Path(folder) / "out/run.json").read_text())["newton_iterations"]
    path = np.array([[float(row[f"body.{axis} [m]"]) for axis in "xyz"] for row in rows])
    return path, float(rows[0]["beam.length [m]"]), iterations


def fewest(points, error):
    """Iterations between runs that enclose an error, from long steps to short ones, or of a run that has less; not a number
    where there are none."""
    found = [n0 * (n1 / n0) ** (math.log(e0 / error) / math.log(e0 / e1))
             for (n0, e0), (n1, e1) in zip(points, points[1:]) if e0 >= error > e1]
    found += [n for n, e in points if e <= error]
    return min(found, default=math.nan)


def main():
    program = Path(sys.argv[1]).resolve()
    elements = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    settings = [FINEST, *STEPS, *TOLERANCES, *RADAU]
    lines = []
    for name in NAMES:
        with ThreadPoolExecutor(2) as pool:
            (finest, length, _), *runs = pool.map(lambda steps: run(program, name, elements, steps), settings)
        points = []
        for steps, (path, _, iterations) in zip(settings[1:], runs):
            points.append((iterations, np.linalg.norm(path - finest, axis=1).max() / length))
            said = " ".join(f"{key} {value:.2e}" for key, value in steps.items() if key != "integrator")
            said = ("radau " if "integrator" in steps else "") + said
            print(f"{name}  {said:26} {points[-1][0]:7} iterations  {points[-1][1]:.2e}", flush=True)
        for error in ERRORS:
            first, second = len(STEPS), len(STEPS) + len(TOLERANCES)
            fixed, adaptive, radau = (fewest(some, error) for some in (points[:first], points[first:second], points[second:]))
            lines.append(f"{name}  {error:.0e} {fixed:9.0f} {adaptive:9.0f} {radau:9.0f} {adaptive / fixed:6.2f} {radau / fixed:6.2f}")
    print("\nerror, iterations with fixed steps, with error control, with that of Radau, ratios", *lines, sep="\n")


if __name__ == "__main__":
    main()
