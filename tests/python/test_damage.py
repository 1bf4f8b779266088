"""Damaged pickles and files: they are refused, or say what they said."""

import os
import pickle
import random
import shutil

import numpy as np
import pytest

import nurbeam as nb

from models import bead_on_a_wire, straight_cantilever

RUN = {"end_time": 0.02, "step": 1e-3}
TRIES = int(os.environ.get("NURBEAM_DAMAGE_TRIES", 300))


def curve():
    return nb.Curve([[0, 0, 0], [1, 0, 0.1], [2, 0, 0], [3, 0, 0]], weights=[1, 2, 1, 1], name="a curve")


MADE = {
    "results": lambda: bead_on_a_wire(speed=1.0).run(**RUN),
    "modes": lambda: straight_cantilever().run(type="modes"),
    "snapshot": lambda: straight_cantilever(tip=[0, 1, 0]).run(type="static")[-1],
    "beam": lambda: straight_cantilever(tip=[0, 1, 0]).run(type="static")[-1].beams["rod"],
    "curve": curve,
    "model": lambda: straight_cantilever(tip=[0, 1, 0]),
}


def said(thing):
    """All that it says, as bytes."""
    if isinstance(thing, nb.Results):
        modes = thing.modes if "frequency" in str(thing.report) or thing.histories["time"].size == 0 else []
        return (thing.name, str(thing.report), [(name, values.tobytes()) for name, values in thing.histories.items()],
                [said(snapshot) for snapshot in thing], [(m.frequency, m.factor) for m in modes])
    if isinstance(thing, nb.Snapshot):
        return thing.time, [said(beam) for beam in thing.beams.values()], str(thing.bodies), str(thing.probes)
    if hasattr(thing, "control_points") and hasattr(thing, "fields"):
        return thing.name, thing.control_points.tobytes(), [thing.field(name).tobytes() for name in thing.fields]
    if isinstance(thing, nb.Curve):
        return thing.name, str(thing.facts), thing.control_points.tobytes(), thing.knots.tobytes(), thing.weights.tobytes()
    return thing.name, str(thing.case)


def in_a_process_of_its_own(work):
    """What it returns, 0 to 100, or minus the signal that has ended it."""
    child = os.fork()
    if child == 0:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        code = 101
        try:
            code = work()
        finally:
            os._exit(code)
    status = os.waitpid(child, 0)[1]
    return -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)


@pytest.mark.parametrize("kind", MADE)
def test_a_damaged_pickle_is_refused_or_says_the_same(kind):
    thing = MADE[kind]()
    whole, expected = pickle.dumps(thing), said(thing)
    assert said(pickle.loads(whole)) == expected
    random_ = random.Random(1)
    damaged = []
    for _ in range(TRIES):
        bits = bytearray(whole)
        bits[random_.randrange(len(bits))] ^= 1 << random_.randrange(8)
        damaged.append(bytes(bits))
    damaged += [whole[:random_.randrange(len(whole))] for _ in range(20)]

    def load(some):
        for bits in some:
            try:
                again = pickle.loads(bits)
                same = type(again) is not type(thing) or said(again) == expected
            except (Exception, MemoryError):
                continue
            if not same:
                return 1
        return 0

    for first in range(0, len(damaged), 20):
        assert in_a_process_of_its_own(lambda: load(damaged[first:first + 20])) == 0, f"{kind}, {first}"


def flipped(file, at, bit):
    with open(file, "r+b") as f:
        f.seek(at)
        byte = f.read(1)[0]
        f.seek(at)
        f.write(bytes([byte ^ 1 << bit]))


def test_a_damaged_checkpoint_is_refused(tmp_path):
    simulation = straight_cantilever(tip=[0, 1, 0]).simulate(**RUN)
    simulation.run_until(0.01)
    simulation.checkpoint.save(tmp_path / "point.nc")
    assert nb.Checkpoint.load(tmp_path / "point.nc").time == simulation.time
    random_ = random.Random(2)
    for _ in range(100):
        shutil.copy(tmp_path / "point.nc", tmp_path / "damaged.nc")
        flipped(tmp_path / "damaged.nc", random_.randrange((tmp_path / "point.nc").stat().st_size), random_.randrange(8))
        with pytest.raises(ValueError, match="damaged.nc"):
            nb.Checkpoint.load(tmp_path / "damaged.nc")


@pytest.mark.parametrize("name", ["results.nc", "run.json"])
def test_a_damaged_directory_of_results_is_refused(name, tmp_path):
    whole = straight_cantilever(tip=[0, 1, 0]).run(**RUN, out=tmp_path / "whole")
    random_ = random.Random(3)
    refused = 0
    for _ in range(60):
        shutil.rmtree(tmp_path / "damaged", ignore_errors=True)
        shutil.copytree(tmp_path / "whole", tmp_path / "damaged")
        size = (tmp_path / "damaged" / name).stat().st_size
        flipped(tmp_path / "damaged" / name, random_.randrange(size), random_.randrange(8))
        try:
            again = nb.Results(tmp_path / "damaged")
        except nb.Error as problem:
            assert name in str(problem)
            refused += 1
            continue
        assert again.report == whole.report  # a space became another one
        assert all(np.array_equal(values, whole.histories[key], equal_nan=True) for key, values in again.histories.items())
    assert refused > 50
