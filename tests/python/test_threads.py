"""Simulations that several threads look at, and threads that outlive the interpreter. NURBEAM_THREAD_SECONDS says how
long each of the first is looked at (60); by hand ten minutes under ThreadSanitizer: scripts/thread_sanitizer."""

import os
import pickle
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import nurbeam as nb

from models import bead_on_a_wire, straight_cantilever

SECONDS = float(os.environ.get("NURBEAM_THREAD_SECONDS", 60))
RUN = {"end_time": 0.2, "step": 1e-3}


def swinging():
    model = straight_cantilever(tip=[0, -5, 0])
    model.add_probe("tip", "rod", at="end")
    return model


def with_a_law():
    model = straight_cantilever()
    model.add_probe("tip", "rod", at="end")
    model.add_force(lambda t, position, velocity: (0.0, -5.0 - position[1], -velocity[2]), beam="rod", at="end")
    return model


def sliding():
    model = bead_on_a_wire(speed=4.0, slope="discontinuous")
    model.add_probe("tip", "wire", at={"fraction": 0.5})
    return model


def states(simulation):
    """Of each step, by its time."""
    found = {}
    more = True
    while more:
        more = simulation.step()
        found[simulation.time] = (simulation.snapshot["energy.total"], simulation.system.q)
    return found


@pytest.mark.parametrize("make", [swinging, with_a_law, sliding])
@pytest.mark.parametrize("advance", ["step", "run"])
def test_readers_beside_a_stepper_see_the_state_between_two_steps(make, advance):
    alone = states(make().simulate(**RUN))
    whole = make().run(**RUN).histories
    ended, problems = time.monotonic() + SECONDS / 6, []
    seen = 0

    def guarded(work):
        try:
            work()
        except BaseException as problem:
            problems.append(problem)
            raise

    while time.monotonic() < ended and not problems:
        simulation = make().simulate(**RUN)
        simulation.step()
        over = threading.Event()

        def read(simulation=simulation, over=over):
            nonlocal seen
            while not over.is_set():
                snapshot, system = simulation.snapshot, simulation.system
                assert snapshot["energy.total"] == alone[snapshot.time][0]
                assert np.array_equal(system.q, alone[system.t][1])
                assert all(np.isfinite(part).all() for part in system.residual())
                seen += 1

        def keep(simulation=simulation, over=over):
            while not over.is_set():
                point = simulation.checkpoint
                rest = make().simulate(**RUN, start=point).run()
                for name, values in rest.histories.items():
                    assert np.array_equal(values, whole[name][len(whole[name]) - len(values):], equal_nan=True), name
                assert simulation.report["steps"] >= 0

        def look_back(simulation=simulation, over=over):
            while not over.is_set():
                results = simulation.results
                histories = results.histories
                count = len(histories["time"])
                for name, values in histories.items():
                    assert np.array_equal(values, whole[name][:count], equal_nan=True), name
                assert len(pickle.loads(pickle.dumps(results))) >= count

        def second(simulation=simulation, over=over):
            while not over.is_set():
                try:
                    simulation.step()
                except RuntimeError as problem:
                    assert "is being advanced already" in str(problem)
                time.sleep(0.003)

        threads = [threading.Thread(target=guarded, args=(work,)) for work in (read, read, keep, look_back, second)]
        for thread in threads:
            thread.start()
        more = True
        while more:
            try:
                more = simulation.step() if advance == "step" else bool(simulation.run()) and False
            except RuntimeError as problem:
                assert "is being advanced already" in str(problem)
        over.set()
        for thread in threads:
            thread.join()
    assert not problems, problems
    assert seen > 0


def test_a_law_that_looks_at_its_simulation_is_told():
    found = []

    def law(t, position, velocity):
        for ask in ("snapshot", "checkpoint", "system", "report"):
            with pytest.raises(RuntimeError, match="is being advanced already, by another thread or by the law"):
                getattr(simulation[0], ask)
        found.append(simulation[0].time)
        return 0.0, 0.0, 0.0

    model = straight_cantilever()
    model.add_force(lambda *now: law(*now) if simulation else (0.0, 0.0, 0.0), beam="rod", at="end")
    simulation = []
    begun = model.simulate(**RUN)
    simulation.append(begun)
    begun.step()
    begun.step()
    assert found


OUTLIVED = """
import sys, threading, time
sys.path.insert(0, {tests!r})
import nurbeam as nb
from test_threads import RUN, swinging, with_a_law
long = {{**RUN, "end_time": 1e4}}
begun = threading.Event()
def law(t, position, velocity):
    begun.set()
    return 0.0, -5.0, 0.0
def work():
    begun.set()
    while True:
        {what}
threading.Thread(target=work, daemon=True).start()
begun.wait()
time.sleep({wait})
"""


@pytest.mark.parametrize(
    "what",
    [
        "swinging().run(**RUN)",
        "swinging().run(**long)",
        "swinging().run(**long, out={out!r})",
        "with_a_law().run(**long)",
        "with_a_law().run(**long, out={out!r})",
        "with_a_law().simulate(**long).run()",
        "[snapshot.beams for snapshot in swinging().simulate(**long)]",
        "swinging().run(type='static', load_steps=10000)",
        "swinging().modes(count=3)",
        "nb.write({out!r} + '.step', nb.Curve.line([0, 0, 0], [1, 0, 0])), nb.read({out!r} + '.step')",
        "nb.Curve.line([0, 0, 0], [1, 0, 0]).length",
    ],
)
def test_a_thread_that_outlives_the_interpreter_does_not_abort_it(what, tmp_path):
    for wait in (0.01, 0.1, 0.3):
        code = OUTLIVED.format(tests=os.path.dirname(__file__), what=what.format(out=str(tmp_path / "out")), wait=wait)
        start = time.monotonic()
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
        assert (done.returncode, done.stderr) == (0, ""), what
        assert time.monotonic() - start < 20


def test_what_runs_at_the_end_of_the_interpreter_may_compute(tmp_path):
    code = f"""
import atexit, sys
sys.path.insert(0, {os.path.dirname(__file__)!r})
atexit.register(lambda: print(len(with_a_law().run(**RUN))))
from test_threads import RUN, with_a_law
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and int(done.stdout) > 1, done.stderr
