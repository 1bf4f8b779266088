"""Error against processor time of bodies that take a node along, with several thresholds, and of points of the mesh.

    /usr/bin/python3 tests/benchmarks/node_or_point.py build/release/pipelines/nurbeam docs/images/node_or_point.svg

The error is the largest distance of the body from where the finest mesh with a moving node has it, over the length of the
beam; times are those of the whole program, the least of three runs, or of as many as a third word says. It prints every
run, and how the ways compare at errors of 1e-3 and 1e-5 of the length.
"""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib import ticker

ROOT = Path(__file__).resolve().parents[2]
MESHES = (5, 10, 20, 40, 80, 160, 320)  # the finest one is what the others are compared with
ERRORS = (1e-3, 1e-5)


def node(least, most):
    return {"length_control": {"min": least, "max": most}}


WAYS = {  # label: colour, and what is said besides
    "node, 0.1/1.15": ("C0", node(0.1, 1.15)),
    "node, 0.3/1.3": ("C2", node(0.3, 1.3)),
    "node, 0.5/1.5": ("C3", node(0.5, 1.5)),
    "point": ("C1", {"carried_as": "point"}),
}


def line(start, end):
    return [[*(np.array(start) + (np.array(end) - start) * i / 3), 1] for i in range(4)]


def quarter(centre, radius, start):
    """Of a circle in the plane, from an angle on: a rational cubic."""
    at = [np.array(centre) + radius * f * np.array([math.cos(a), math.sin(a)])
          for a, f in ((start, 1), (start + math.pi / 4, math.sqrt(2)), (start + math.pi / 2, 1))]
    w = math.sqrt(0.5)
    inner = (1 + 2 * w) / 3
    return [[*at[0], 1], *([*((at[i] + 2 * w * at[1]) / 3 / inner), inner] for i in (0, 2)), [*at[2], 1]]


def chain(*pieces):
    """Rational cubics, each from where the one before it ends, as one curve."""
    points = [pieces[0][0]] + [point for piece in pieces for point in piece[1:]]
    knots = [0] * 4 + [i for i in range(1, len(pieces)) for _ in range(3)] + [len(pieces)] * 4
    return {"nurbs": {"degree": 3, "knots": knots, "control_points": [[x, y, 0] for x, y, _ in points],
                      "weights": [w for *_, w in points]}}


def model(axis, radius, modulus, density, mass, place, supports, end, step, **beam):
    return {"nurbeam": 1, "gravity": [0, -9.81, 0],
            "beams": [{"name": "beam", "axis": axis, "section": {"radius": radius},
                       "material": {"density": density, "youngs_modulus": modulus}, **beam}],
            "bodies": [{"name": "body", "mass": mass}],
            "supports": [{"beam": "beam", "at": at, "type": kind} for at, kind in supports],
            "sliding_joints": [{"body": "body", "beam": "beam", "at": {"length": place}, "at_beam_end": "stop"}],
            "analysis": {"end_time": end, "step": step}}


PINNED = (("start", "pinned"), ("end", "pinned"))
H = math.sqrt(0.5)
LINE_AND_ARC = line((-H - H, 0), (-H, -H)), quarter((0, 0), 1, -3 * math.pi / 4)
LINE_ARC_LINE = chain(*LINE_AND_ARC, line((H, -H), (2 * H, 0)))
LINE_ARC_SPLINE = chain(*LINE_AND_ARC, [[H, -H, 1], [H + 0.35, -H + 0.35, 1], [H + 0.9, -H + 0.5, 1], [H + 1, -H + 1.1, 1]])


def chain_model(axis, place, end):
    return model(axis, 0.02, 200e6, 7200, 0.8, place, PINNED, end, 2e-4)


def taut_string():
    case = model({"polyline": [[0, 0, 0], [10, 0, 0]]}, 0.003, 210e9, 7850, 2, 1, PINNED, 0.8, 1e-4, tension=5000)
    case["sliding_joints"][0]["speed"] = 10
    return case


def rail_in_space():
    """A steel rail without a plane, 3.7 m long: a bead slides down one side of its valley and up the other."""
    points = [[0, 0.8, 0], [0.4, 0.3, 0.3], [1, 0, 0.4], [1.5, 0, 0], [2, 0.1, -0.3], [2.6, 0.3, -0.1], [3, 0.7, 0.2]]
    axis = {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4], "control_points": points, "weights": [1] * 7}}
    case = model(axis, 0.006, 210e9, 7850, 1, 0.3, (("start", "clamped"), ("end", "clamped")), 0.6, 5e-5,
                 stress_free="as-drawn-without-torsion")
    case["analysis"]["integrator"] = {"type": "generalized-alpha", "rho_infinity": 0.6}
    return case


CASES = {
    "Example 1": model({"polyline": [[0, 0, 0], [1, 0, 0]]}, 0.01, 20e6, 7200, 0.8, 0.1, (("start", "clamped"),), 0.55, 1e-4),
    "Example 2": model({"polyline": [[0, 0, 0], [1, 0, 0]]}, 0.01, 20e6, 7200, 5, 0.1, PINNED, 1, 1e-4),
    "Example 3": model(chain(quarter((0, 0), 1, -math.pi), quarter((0, 0), 1, -math.pi / 2)), 0.02, 200e6, 7200, 0.8,
                       math.pi / 16, PINNED, 1.5, 2e-4),
    "line, arc, line": chain_model(LINE_ARC_LINE, 0.3, 1.5),
    "line, arc, spline": chain_model(LINE_ARC_SPLINE, 0.3, 1.5),
    "line, arc, line, and back": chain_model(LINE_ARC_LINE, 0.8, 2),
    "taut string": taut_string(),
    "rail in space": rail_in_space(),
}
STIFF = ("rail in space",)  # 320 elements of it would take many short steps


def run(program, case, elements, more, repeated):
    """The body's path, its beam's length, and the processor time."""
    case = json.loads(json.dumps(case))
    case["beams"][0]["elements"] = {"count": elements}
    if "length_control" in more:
        case["analysis"]["length_control"] = more["length_control"]
    else:
        case["sliding_joints"][0].update(more)
    case["output"] = {"every": case["analysis"]["end_time"] / 50, "report": False}
    least = math.inf
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "case.json"
        file.write_text(json.dumps(case))
        for _ in range(repeated):
            started = subprocess.Popen([program, "run", file, "--out", Path(folder) / "out", "--quiet"], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            _, status, used = os.wait4(started.pid, 0)
            started.returncode = os.waitstatus_to_exitcode(status)
            if started.returncode:
                return None
            least = min(least, used.ru_utime + used.ru_stime)
        with open(Path(folder) / "out/histories.csv", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
    name = case["bodies"][0]["name"]
    path = np.array([[float(row[f"{name}.{axis} [m]"]) for axis in "xyz"] for row in rows])
    return path, float(rows[0][f"{case['beams'][0]['name']}.length [m]"]), least


def time_at(points, error):
    """Between the two meshes that enclose an error, both logarithmic; nothing beyond the finest mesh."""
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e0 >= error > e1:
            part = math.log(e0 / error) / math.log(e0 / e1)
            return t0 * (t1 / t0) ** part
    return points[0][0] if points and points[0][1] < error else math.nan


def measure(program, name, repeated):
    case = CASES[name]
    meshes = MESHES[:-1] if name in STIFF else MESHES
    finest, length, _ = run(program, case, meshes[-1], WAYS["node, 0.1/1.15"][1], 1)
    curves = {}
    for way, (_, more) in WAYS.items():
        points = []
        for elements in meshes[:-1]:
            if elements < len(case["beams"][0]["axis"].get("nurbs", {}).get("control_points", [])) // 3:
                continue
            found = run(program, case, elements, more, repeated)
            if found is None:
                print(f"{name:26} {way:15} {elements:4} ends early", flush=True)
                continue
            path, _, used = found
            error = np.linalg.norm(path - finest, axis=1).max() / length
            points.append((used, error))
            print(f"{name:26} {way:15} {elements:4} {used:8.3f} s  {error:.2e}", flush=True)
        curves[way] = points
    return curves


def draw(curves_of, picture):
    figure, axes = plt.subplots(2, 4, figsize=(13, 6), layout="constrained")
    for plot in axes.flat[len(curves_of):]:
        plot.set_axis_off()
    for (name, curves), plot in zip(curves_of.items(), axes.flat):
        for way, points in curves.items():
            plot.loglog(*zip(*points), "o-", color=WAYS[way][0], label=way, markersize=3, linewidth=1)
        plot.set_title(name, fontsize=9)
        plot.grid(linewidth=0.4)
        plot.xaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        plot.xaxis.set_major_formatter("{x:g}")
        plot.xaxis.set_minor_formatter(ticker.NullFormatter())
        plot.tick_params(labelsize=7)
    axes[0, 0].legend(fontsize=7)
    figure.supxlabel("processor time [s]", fontsize=9)
    figure.supylabel("error / length", fontsize=9)
    figure.savefig(picture, metadata={"Date": None})


def compare(curves_of):
    print(f"\n{'time [s] at an error of':34}", *(f"{way:>15}" for way in WAYS))
    for name, curves in curves_of.items():
        for error in ERRORS:
            print(f"{name:26} {error:7.0e}", *(f"{time_at(points, error):15.3f}" for points in curves.values()))


def main():
    program, picture = Path(sys.argv[1]).resolve(), sys.argv[2]
    repeated = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    curves_of = {name: measure(program, name, repeated) for name in CASES}
    draw(curves_of, picture)
    compare(curves_of)


if __name__ == "__main__":
    main()
