"""Models, runs and their functions leave nothing behind."""

import gc
import os
import weakref
from pathlib import Path

import pytest
from models import bead_on_a_wire, straight_cantilever

import nurbeam as nb


def resident():
    """Memory of this process [bytes]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096


def make_and_drop(i):
    model = straight_cantilever(tip=[0, -1, 0])
    model.add_probe("tip", "rod", "end")
    model.add_force(lambda t, position, velocity: (0.0, 0.1 * i, 0.0), beam="rod", at="end")
    simulation = model.simulate(end_time=0.01, step=1e-3)
    simulation.step()
    simulation.step()
    if i % 3 == 0:
        simulation.run()
    simulation.system.stiffness()
    results = model.run(type="static")
    results.histories["tip.y"]
    results[-1].beams["rod"].curve.closest_point([0, 0, 0])
    with pytest.raises(nb.CaseError):
        model.run(type="statics")


@pytest.mark.skipif("libasan" in os.environ.get("LD_PRELOAD", ""), reason="the sanitizer keeps what is freed")
def test_a_thousand_models_leave_no_memory_behind():
    for i in range(200):
        make_and_drop(i)
    gc.collect()
    before = resident()
    for i in range(1000):
        make_and_drop(i)
    gc.collect()
    # What one model takes is some 100 kB; a tenth of that left by each would be 10 MB.
    assert resident() - before < 4e6


def test_functions_are_dropped_with_what_holds_them():
    class Law:
        def __call__(self, t, position, velocity):
            return 0.0, 0.0, 0.0

    law = Law()
    held = weakref.ref(law)
    model = straight_cantilever()
    model.add_force(law, beam="rod", at="end")
    simulation = model.simulate(end_time=0.01, step=1e-3)
    system = simulation.system
    del law, model, simulation
    gc.collect()
    assert held() is not None  # the equations hold it still
    system.residual()
    del system
    gc.collect()
    assert held() is None


class Follower:
    """A force and a motion that know what they act in."""

    simulation = system = model = None

    def __call__(self, t, position=None, velocity=None):
        return (0.0, 0.0, 0.0) if position is not None else 1.0


@pytest.mark.parametrize("kept", ["simulation", "system", "model"])
def test_functions_that_refer_back_go_with_what_holds_them(kept):
    law = Follower()
    held = weakref.ref(law)
    model = bead_on_a_wire(motion=law)
    model.add_force(law, beam="wire", at="end")
    simulation = model.simulate(end_time=0.01, step=1e-3)
    simulation.step()
    setattr(law, kept, {"simulation": simulation, "system": simulation.system, "model": model}[kept])
    law = model = None
    gc.collect()
    assert held() is not None and simulation.step()
    simulation = None
    gc.collect()
    assert held() is None


def test_snapshots_outlive_their_simulation():
    simulation = straight_cantilever(tip=[0, -1, 0]).simulate(end_time=0.01, step=1e-3)
    first = next(iter(simulation))
    results = simulation.results
    for _ in simulation:
        pass
    del simulation
    gc.collect()
    assert first.beams["rod"].nodes[-1, 0] == pytest.approx(1)
    assert len(results) == 11 and results[-1].time == pytest.approx(0.01)
