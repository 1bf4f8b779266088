"""What Python costs: a run from Python against the same run by the command line, and one call of a function.

    PYTHONPATH=build/release/python /usr/bin/python3 tests/benchmarks/python_overhead.py build/release/pipelines/nurbeam

Instructions are counted (by valgrind), which other work on the machine does not change; of runs of two lengths, so that
what starting takes (of Python, of imports) is told apart from what a run takes. A call is what a law that is called often
adds, in instructions and in time.
"""

import json
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import nurbeam as nb

ROOT = Path(__file__).resolve().parents[2]
CASE = ROOT / "samples/zipline/zipline.json"
ENDS = (0.1, 0.6)  # [s]: the longer less the shorter is the run itself
CALLS = (200, 1200)  # steps, likewise


def changed(end):
    return {"analysis.end_time": end, "output.cad": None, "output.report": False, "output.every": end / 4}


def instructions(*command):
    """That a program takes from its start to its end."""
    done = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *map(str, command)],
                          check=True, capture_output=True, text=True)
    return int(re.search(r"Collected : (\d+)", done.stderr)[1])


def of_command(program, end):
    with tempfile.TemporaryDirectory() as out:
        settings = [word for key, value in changed(end).items() for word in ("--set", f"{key}={json.dumps(value)}")]
        return instructions(program, "run", CASE, "--out", out, "--quiet", *settings)


def of_python(end):
    with tempfile.TemporaryDirectory() as out:
        run = f"import nurbeam as nb; nb.load({str(CASE)!r}, set={changed(end)!r}).run(out={out!r})"
        return instructions(sys.executable, "-c", run)


def overhead(program):
    """Of a run without functions, a part of it."""
    command, python = (of(ENDS[1]) - of(ENDS[0]) for of in (lambda end: of_command(program, end), of_python))
    print(f"a run without functions: command {command:.4g} instructions, Python {python:.4g}")
    return python / command - 1


def calls(laws, steps):
    """Runs `laws` functions that do nothing for some steps: the time that this takes [s], and how often they are called."""
    nothing = [0.0, 0.0, 0.0]
    count = 0

    def law(t, position, velocity):
        nonlocal count
        count += 1
        return nothing

    model = nb.Model(gravity=[0, 0, 0])
    rod = model.add_beam(nb.Curve.line([0, 0, 0], [1, 0, 0]), section=nb.Circle(0.005), elements=1, name="rod",
                         material=nb.Material(7850, 2.1e11))
    model.add_support(rod, at="start", type="clamped")
    for _ in range(laws):
        model.add_force(law, beam=rod, at="end")
    simulation = model.simulate(end_time=1e-3 * steps, step=1e-3, every=1)
    simulation.step()
    before = time.thread_time(), count
    simulation.run()
    return time.thread_time() - before[0], count - before[1]


def per_call():
    """Of a function that does nothing, with what is made for it and read of its answer: instructions and seconds."""
    many, few = 21, 1
    counted = {}
    for laws in (few, many):
        programs = [f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r}); import python_overhead; "
                    f"python_overhead.calls({laws}, {steps})" for steps in CALLS]
        counted[laws] = instructions(sys.executable, "-c", programs[1]) - instructions(sys.executable, "-c", programs[0])
    called = {laws: calls(laws, CALLS[1])[1] - calls(laws, CALLS[0])[1] for laws in (few, many)}
    seconds = min(calls(many, CALLS[1])[0] - calls(few, CALLS[1])[0] for _ in range(5))
    timed = calls(many, CALLS[1])[1] - calls(few, CALLS[1])[1]
    return (counted[many] - counted[few]) / (called[many] - called[few]), seconds / timed, timed


if __name__ == "__main__":
    print(f"overhead of Python: {100 * overhead(sys.argv[1]):+.2f} %")
    counted, seconds, count = per_call()
    print(f"a call of a function: {counted:.0f} instructions, {1e6 * seconds:.2f} microseconds ({count} calls, with what the "
          "force element does for each)")
