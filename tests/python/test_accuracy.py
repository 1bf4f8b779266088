import pickle
import warnings

import numpy as np
import pytest
from models import bead_on_a_wire, bending_stiffness, straight_cantilever

import nurbeam as nb


def cantilever():
    model = straight_cantilever(tip=[0, 0, -0.1])
    model.add_probe("tip", "rod", "end")
    return model


def test_errors_hold_a_known_answer():
    results = cantilever().run(type="static", accuracy=True)
    error = results.accuracy["tip.uz"][-1]
    small = -0.1 / (3 * bending_stiffness())  # P L^3/3EI, without what large angles change
    assert abs(results["tip.uz"][-1] - small) < error + 1e-6 * abs(small)
    assert error < 1e-3 * abs(small)
    assert results.accuracy.reached and results.accuracy.parted is None
    assert results.directory is None and results.times.tolist() == [0]


def test_errors_stand_beside_histories():
    results = bead_on_a_wire(speed=0.5).run(end_time=0.2, step=1e-3, every=0.05, accuracy=True)
    assert set(results.accuracy) == set(results.histories) - {"time"}
    assert results.accuracy["bead.x"].shape == results["bead.x"].shape
    assert np.all(np.diff(results.accuracy["bead.x"]) >= 0)
    number = next(number for number in results.accuracy.table() if number.quantity == "bead.x")
    assert number.unit == "m" and number.value == results["bead.x"][-1]
    assert results.accuracy.converged("bead.x")
    with pytest.raises(KeyError, match="bead.x"):
        results.accuracy["beed.x"]
    assert str(pickle.loads(pickle.dumps(results)).accuracy.table()) == str(results.accuracy.table())


def test_a_target_is_reached_or_told():
    results = cantilever().run(type="static", accuracy="0.01 %")
    assert results.accuracy.reached and results.accuracy.runs[0]["level"] >= 0
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        results = cantilever().run(type="static", accuracy={"target": 1e-6, "limit": 1})
    assert results.accuracy.reached or any("is not reached" in str(one.message) for one in told)


def test_modes_have_errors():
    modes = straight_cantilever(elements=12).run(type="modes", modes={"count": 3}, accuracy=True).modes
    assert modes.errors.shape == (3,) and np.all(modes.errors > 0)
    known = 1.875104068711961**2 / (2 * np.pi) * np.sqrt(bending_stiffness() / (7850 * np.pi * 0.005**2))
    assert abs(modes[0].frequency - known) < modes.errors[0]


def test_a_run_that_was_not_asked_says_so():
    with pytest.raises(nb.Error, match="accuracy=True"):
        cantilever().run(type="static").accuracy
