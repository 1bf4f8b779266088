"""Rigid bodies from Python: the builder says what the case file says."""

import nurbeam as nb
import numpy as np
import pytest


def pendulum():
    """A double pendulum on pins along y, with an arm at the second body."""
    model = nb.Model(name="double pendulum")
    first = model.add_body("first", 3, position=[0, 0, -0.4], inertia=[0.05, 0.05, 0.05], points={"knee": [0, 0, -0.9]})
    second = model.add_body("second", 2, position=[0, 0, -1.4], inertia=[0.03, 0.03, 0.03], angular_velocity=[0, -2, 0])
    model.add_support(first.at([0, 0, 0]), type="pinned", axis=[0, 1, 0], name="pin")
    model.add_joint([first.at("knee"), second.at([0, 0, -0.9])], "hinged", axis=[0, 1, 0], name="knee")
    model.add_load(second, force=[1, 0, 0])
    return model


def test_bodies_are_joined_and_told():
    results = pendulum().run(end_time=0.5, step=1e-3, every=0.01)
    knee, centre = results["first.knee.position"], results["second.position"]
    np.testing.assert_allclose(np.linalg.norm(centre - knee, axis=1), 0.5, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(knee, axis=1), 0.9, atol=1e-9)
    energy = results["energy.total"]
    assert np.ptp(energy) < 1e-3
    quaternion = np.stack([results[f"second.q{axis}"] for axis in "wxyz"], axis=1)
    np.testing.assert_allclose(np.linalg.norm(quaternion, axis=1), 1, atol=1e-12)
    assert results["knee.fz"][0] < -2 * 9.81  # on the first body: the second hangs on it, and swings


def test_a_case_of_bodies_needs_no_beam():
    model = nb.Model(name="free")
    model.add_body("body", 1, position=[0, 0, 0], inertia=[1, 2, 2.5], velocity=[1, 0, 2])
    results = model.run(end_time=1, step=1e-2)
    np.testing.assert_allclose(results["body.position"][-1], [1, 0, 2 - 9.81 / 2], atol=1e-9)


def test_wrong_points_complain_where_they_stand():
    model = pendulum()
    model.add_load(nb.Body("first").at("kne"), force=[1, 0, 0])
    with pytest.raises(nb.CaseError, match='has no point "kne"; did you mean "knee"'):
        model.run(end_time=0.5, step=1e-3)
