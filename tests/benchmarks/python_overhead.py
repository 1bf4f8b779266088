"""What Python costs: a run from Python against the same run by the command line, and one call of a function.

    PYTHONPATH=build/release/python /usr/bin/python3 tests/benchmarks/python_overhead.py build/release/pipelines/nurbeam

User time of this process and of the command's is compared over runs of growing length, so that what starting takes (of
Python, of imports) is told apart from what a run takes; a call is the time that a law that is called often adds.
"""

import json
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import nurbeam as nb

ROOT = Path(__file__).resolve().parents[2]
CASE = ROOT / "samples/zipline/zipline.json"
ENDS = (0.5, 5.0)  # [s]: the longer less the shorter is the run itself
ROUNDS = 9


def changed(end):
    return {"analysis.end_time": end, "output.cad": None, "output.report": False, "output.every": end / 4}


def user_seconds_of_command(program, end):
    with tempfile.TemporaryDirectory() as out:
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        settings = [word for key, value in changed(end).items() for word in ("--set", f"{key}={json.dumps(value)}")]
        subprocess.run([program, "run", CASE, "--out", out, "--quiet", *settings], check=True, capture_output=True)
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def user_seconds_of_python(end):
    with tempfile.TemporaryDirectory() as out:
        before = resource.getrusage(resource.RUSAGE_SELF).ru_utime
        nb.load(CASE, set=changed(end)).run(out=out)
        return resource.getrusage(resource.RUSAGE_SELF).ru_utime - before


def overhead(program):
    """Of a run without functions, a part of it: the median of some rounds, one beside the other."""
    ratios = []
    for _ in range(ROUNDS):
        command = user_seconds_of_command(program, ENDS[1]) - user_seconds_of_command(program, ENDS[0])
        python = user_seconds_of_python(ENDS[1]) - user_seconds_of_python(ENDS[0])
        ratios.append(python / command - 1)
        print(f"  command {command:.3f} s, Python {python:.3f} s")
    return statistics.median(ratios)


def seconds_per_call():
    """Of a function that does nothing, less nothing: with what is made for it and read of its answer."""
    nothing = [0.0, 0.0, 0.0]
    calls = 0

    def law(t, position, velocity):
        nonlocal calls
        calls += 1
        return nothing

    def run(laws):
        model = nb.Model(gravity=[0, 0, 0])
        rod = model.add_beam(nb.Curve.line([0, 0, 0], [1, 0, 0]), section=nb.Circle(0.005), elements=1, name="rod",
                             material=nb.Material(7850, 2.1e11))
        model.add_support(rod, at="start", type="clamped")
        for _ in range(laws):
            model.add_force(law, beam=rod, at="end")
        simulation = model.simulate(end_time=1, step=1e-3, every=1)
        simulation.step()
        before = time.thread_time(), calls
        simulation.run()
        return time.thread_time() - before[0], calls - before[1]

    run(1)
    few, few_calls = run(1)
    many, many_calls = run(21)
    return (many - few) / (many_calls - few_calls), many_calls


if __name__ == "__main__":
    print("a run without functions, user time:")
    print(f"overhead of Python: {100 * overhead(sys.argv[1]):+.2f} %")
    per_call, count = seconds_per_call()
    print(f"a call of a function: {1e6 * per_call:.2f} microseconds ({count} calls, with what the force element does for each)")
