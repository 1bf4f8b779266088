"""The equations of motion as matrices, against differences and closed forms."""

import numpy as np
import pytest
import scipy.sparse.linalg
from models import bead_on_a_wire, bending_stiffness, straight_cantilever

import nurbeam as nb


@pytest.fixture
def moving():
    model = bead_on_a_wire(speed=0.5)
    model.case["gravity"] = [0, 0, -9.81]
    simulation = model.simulate(end_time=0.1, step=1e-3)
    simulation.run_until(0.05)
    return simulation.system


def test_matrices_are_the_derivatives_of_the_residual(moving):
    n, m = len(moving.q), len(moving.multipliers)
    direction = np.random.default_rng(4).normal(size=n)
    for keyword, matrix in (("q", moving.stiffness()), ("v", moving.damping()), ("a", moving.mass())):
        at = getattr(moving, keyword)
        errors = []
        scale = 1e-4 if keyword == "q" else 1.0
        for h in (scale, scale / 2):
            up, down = ({keyword: at + s * h * direction} for s in (1, -1))
            difference = (moving.residual(**up)[0] - moving.residual(**down)[0]) / (2 * h)
            errors.append(np.abs(difference - matrix @ direction).max())
        size = np.abs(matrix @ direction).max()
        # Differences of order 2, or exact where the residual is linear.
        assert errors[1] < 1e-6 * size or errors[0] / errors[1] == pytest.approx(4, rel=0.2), keyword
    h = 1e-6
    up, down = (moving.residual(q=moving.q + s * h * direction)[1] for s in (1, -1))
    G = moving.constraint_gradient()
    assert G.shape == (m, n)
    assert (up - down) / (2 * h) == pytest.approx(G @ direction, abs=1e-7)


def test_the_state_of_a_run_fulfils_its_equations(moving):
    dynamics, constraints = moving.residual()
    assert np.abs(dynamics).max() < 1e-2 and np.abs(constraints).max() < 1e-9


def test_coordinates_have_names(moving):
    names = moving.coordinates
    assert len(set(names)) == len(names) == len(moving.q)
    assert {"bead.x", "bead.y", "bead.s", "wire[0].x", "wire[0].slope.x"} <= set(names)
    assert moving.q[moving.index("bead.s")] == pytest.approx(1.025, abs=1e-4)
    with pytest.raises(KeyError, match="did you mean"):
        moving.index("beed.s")
    with pytest.raises(ValueError, match="q has 2 components; expected"):
        moving.residual(q=[1, 2])


def test_rows_have_names(moving):
    names = moving.rows
    assert len(set(names)) == len(names) == len(moving.multipliers)
    assert {"reaction.wire.start[1]", "reaction.wire.start[2]", "reaction.wire.end[1]"} <= set(names)
    # A node is held in x where x is in the gradient of its row.
    gradient = moving.constraint_gradient()
    assert gradient[names.index("reaction.wire.start[1]"), moving.index("wire[0].x")] == 1


def test_places_of_a_body_on_several_beams_are_told_apart():
    model = nb.Model(gravity=[0, 0, 0])
    bead = model.add_body("bead", mass=1)
    for name, ends in (("along", [[0, 0, 0], [2, 0, 0]]), ("across", [[1, -1, 0], [1, 1, 0]])):
        wire = model.add_beam(ends, section=nb.Circle(radius=0.01), material="steel", elements=4, name=name)
        model.add_support(wire, at="start", type="pinned")
        model.add_support(wire, at="end", type="pinned")
        model.add_sliding_joint(bead, wire, at={"fraction": 0.5})
    names = model.system().coordinates
    assert len(set(names)) == len(names)
    assert {"bead.along.s", "bead.across.s"} <= set(names) and "bead.s" not in names


def test_a_state_with_held_bodies_fulfils_its_equations():
    model = bead_on_a_wire(at=1.5, equilibrium="held")
    model.case["gravity"] = [0, 0, -9.81]
    simulation = model.simulate(type="static")
    simulation.step()
    dynamics, constraints = simulation.system.residual()
    assert len(constraints) == len(simulation.system.multipliers)
    assert np.abs(dynamics).max() < 1e-5 and abs(simulation.snapshot["bead.holding_force"]) > 1e-3


def test_frequencies_follow_from_the_matrices():
    system = straight_cantilever(elements=10).system()
    K, M, G = system.stiffness(), system.mass(), system.constraint_gradient()
    # On the null space of the constraints.
    _, _, vh = np.linalg.svd(G.toarray())
    N = vh[G.shape[0]:].T
    import scipy.linalg

    omega2 = scipy.linalg.eigh(N.T @ K @ N, N.T @ M @ N, eigvals_only=True)
    expected = 1.8751040687119611**4 * bending_stiffness() / (7850 * np.pi * 0.005**2)
    assert omega2[0] == pytest.approx(expected, rel=1e-3)
    assert isinstance(K, scipy.sparse.csc_matrix)


def test_a_static_state_by_newton_of_ones_own():
    model = straight_cantilever(tip=[0, -1.0, 0])
    system = model.system()
    n = len(system.q)
    q, multipliers, zero = system.q, system.multipliers, np.zeros(n)
    for _ in range(30):
        r, g = system.residual(q=q, v=zero, a=zero, multipliers=multipliers)
        matrix = system.tangent(stiffness=1, q=q, v=zero, a=zero, multipliers=multipliers)
        change = scipy.sparse.linalg.spsolve(matrix, -np.concatenate([r, g]))
        q, multipliers = q + change[:n], multipliers + change[n:]
        if np.abs(change[:n]).max() < 1e-12:
            break
    tip = model.run(type="static")[-1].beams["rod"].nodes[-1]
    assert q[system.index("rod[8].y")] == pytest.approx(tip[1] - 0.0, rel=1e-8)
