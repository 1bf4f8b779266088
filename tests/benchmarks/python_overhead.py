"""What Python costs: a run from Python against the same run by the command line, and one call of a function.

    PYTHONPATH=build/release/python /usr/bin/python3 tests/benchmarks/python_overhead.py build/release/pipelines/nurbeam

Instructions are counted (by valgrind), which other work on the machine does not change; of runs of two lengths, so that
what starting takes (of Python, of imports) is told apart from what a run takes. A call is what a law that is called often
adds, in time, and what is between C++ and the function and back, in instructions.
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
LAW = ("nurbeam::python::(anonymous namespace)::PythonLaw::operator()(double, Eigen::Matrix<double, 3, -1, 0, 3, -1> const&, "
       "Eigen::Matrix<double, 3, -1, 0, 3, -1> const&) const")


def changed(end):
    return {"analysis.end_time": end, "output.cad": None, "output.report": False, "output.every": end / 4}


def instructions(*command):
    """That a program takes: a function of the name of one of its own, which is then with all that it calls; of none, all."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/counted", *map(str, command)],
                       check=True, capture_output=True)
        told = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", f"{folder}/counted"],
                              check=True, capture_output=True, text=True).stdout
    counts = re.findall(r"^\s*([\d,]+) \(.*?%\)\s+(?:\?\?\?:)?(.*?)(?: \[.*\])?$", told, re.M)

    def of(function="PROGRAM TOTALS"):
        return sum(int(count.replace(",", "")) for count, name in counts if name == function)

    return of


def of_command(program, end):
    with tempfile.TemporaryDirectory() as out:
        settings = [word for key, value in changed(end).items() for word in ("--set", f"{key}={json.dumps(value)}")]
        return of_run(instructions(program, "run", CASE, "--out", out, "--quiet", *settings))


def of_python(end):
    with tempfile.TemporaryDirectory() as out:
        run = f"import nurbeam as nb; nb.load({str(CASE)!r}, set={changed(end)!r}).run(out={out!r})"
        return of_run(instructions(sys.executable, "-c", run))


def of_run(counted):
    """Without the restart points, which are written every few seconds of the clock."""
    return counted() - counted("nurbeam::RunOutputs::write(nurbeam::Checkpoint const&)")


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
    """Of a function that does nothing, with what is made for it and read of its answer: instructions, and seconds with what
    the force element does for each."""
    many, few, steps = 21, 1, 1000
    program = (f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r}); import python_overhead; "
               f"python_overhead.calls({many}, {steps})")
    counted = instructions(sys.executable, "-c", program)(LAW)
    seconds = min(calls(many, steps)[0] - calls(few, steps)[0] for _ in range(5))
    called = {laws: calls(laws, steps)[1] for laws in (few, many)}
    return counted / called[many], seconds / (called[many] - called[few]), called[many]


if __name__ == "__main__":
    print(f"overhead of Python: {100 * overhead(sys.argv[1]):+.2f} %")
    counted, seconds, count = per_call()
    print(f"a call of a function: {counted:.0f} instructions; {1e6 * seconds:.2f} microseconds with what the force element "
          f"does for it ({count} calls)")
