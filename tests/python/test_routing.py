"""Cables between two clamps, against an independent elastica."""

import json
import time

import numpy as np
import pytest
from scipy.integrate import solve_bvp

import nurbeam as nb

EI, EA, MASS, G = 0.02, 1e5, 0.1, 9.81
NUMBERS = {"mass_per_length": MASS, "bending_stiffness": EI, "axial_stiffness": EA}
PATIENT = {**NUMBERS, "time_limit": 60}  # on a machine that does much else besides
ENDS = {
    "facing": (([0, 0, 0], [1, 0, 0]), ([0.6, 0, 0], [-1, 0, 0])),
    "U": (([0, 0, 0], [0, 0, -1]), ([0.4, 0, 0], [0, 0, -1])),
    "in space": (([0, 0, 0], [1, 0.2, 0.1]), ([0.5, 0.3, 0.2], [0, -1, 0.3])),
}
RATIOS = [1.001, 1.01, 1.03, 1.06, 1.1, 1.25, 1.5, 2, 2.5, 3]


def elastica(start, end, length, guess):
    """The equilibrium of a rod that is straight when free, without torque: its points and their curvature.

    With the tangent t, the stretch c, the force n in the section and the weight q of each unstressed metre: r' = c t,
    n' = -q, and the balance of moments EI t x t'' = -c t x n gives EI t'' = l t - c n with l = c n.t - EI |t'|^2, which keeps
    |t| = 1 where it is so at both ends. The stretch is that of Green's law, n.t = EA (c^3 - c) / 2. Solved as a boundary value problem by collocation; `guess`: places s, (9, places) r, t, t', and the force n at the start. Returns s, r (3, s) and |t'| (s)."""
    a, b = np.array(start[0], float), np.array(end[0], float)
    ta = np.array(start[1], float) / np.linalg.norm(start[1])
    tb = -np.array(end[1], float) / np.linalg.norm(end[1])
    weight = np.array([0, 0, -MASS * G])

    def slopes(s, y, n0):
        t, d = y[3:6], y[6:9]
        n = n0[:, None] - weight[:, None] * s
        tension = np.sum(n * t, axis=0)
        c = np.ones_like(tension)
        for _ in range(6):
            c = c - (c**3 - c - 2 * tension / EA) / (3 * c**2 - 1)
        pull = c * tension / EI - np.sum(d * d, axis=0)
        return np.vstack([c * t, d, pull * t - c * n / EI])

    def ends(ya, yb, _):
        return np.concatenate([ya[:3] - a, ya[3:6] - ta, yb[:3] - b, yb[3:6] - tb])

    found = solve_bvp(slopes, ends, *guess, tol=1e-7, max_nodes=20000)
    assert found.success, found.message
    places = np.linspace(0, length, 4001)
    y = found.sol(places)
    assert np.abs(np.linalg.norm(y[3:6], axis=0) - 1).max() < 1e-7
    return places, y[:3], np.linalg.norm(y[6:9], axis=0)


def guess_of(route):
    """Where the search for the elastica starts."""
    curve = route.curve
    u = np.linspace(curve.start, curve.end, 4001)
    d = curve.derivatives(u, 2)
    speed = np.linalg.norm(d[:, 1], axis=1)
    t = d[:, 1] / speed[:, None]
    bend = (d[:, 2] - np.sum(d[:, 2] * t, axis=1)[:, None] * t) / speed[:, None] ** 2
    s = np.concatenate([[0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(u))])
    s *= route.length / s[-1]
    few = slice(None, None, 10)  # more where the elements are short
    return s[few], np.hstack([d[:, 0], t, bend])[few].T, -route.from_force


@pytest.mark.parametrize("kind", ENDS)
@pytest.mark.parametrize("ratio", RATIOS)
def test_a_routed_cable_is_the_elastica(kind, ratio):
    start, end = ENDS[kind]
    distance = np.linalg.norm(np.subtract(end[0], start[0]))
    length = ratio * distance
    begun = time.process_time()
    route = nb.route(start, end, length=length, time_limit=60, **NUMBERS)
    assert time.process_time() - begun < 3
    curve = route.curve
    assert np.linalg.norm(curve(curve.start) - start[0]) < 1e-12
    assert np.linalg.norm(curve(curve.end) - end[0]) < 1e-12
    for at, (_, direction), sign in ((curve.start, start, 1), (curve.end, end, -1)):
        tangent = curve.derivatives(at, 1)[1]
        across = np.cross(tangent / np.linalg.norm(tangent), np.array(direction) / np.linalg.norm(direction))
        assert np.linalg.norm(across) < 1e-8 and sign * np.dot(tangent, direction) > 0
    # The strain of the axial force, at most that of the largest, is part of the length.
    stretch = max(route.largest_tension, route.largest_thrust) / EA
    assert curve.length == pytest.approx(length, rel=1e-5 + stretch)
    _, points, bend = elastica(start, end, length, guess_of(route))
    assert route.least_radius == pytest.approx(1 / bend.max(), rel=1e-3)
    assert curve.sample(1)[0] == pytest.approx(points[:, 0], abs=1e-9)
    off = max(np.linalg.norm(curve.closest_point(p).point - p) for p in points[:, ::100].T)
    assert off < 1e-4 * length


def test_the_numbers_of_a_cable_hung_between_facing_ends():
    """Against the elastica above, and numbers of one without stretch: sag, thrust and least bend radius."""
    start, end = ENDS["facing"]
    route = nb.route(start, end, length=1, tolerance=1e-6, **PATIENT)
    s, points, bend = elastica(start, end, 1, guess_of(route))
    assert 1 / bend.max() == pytest.approx(0.0978144, abs=2e-6)
    assert -points[2].min() == pytest.approx(0.350830666, rel=8.5e-6)  # the thrust over EA
    assert route.sag == pytest.approx(-points[2].min(), abs=1e-6)
    assert route.least_radius == pytest.approx(0.0978144, rel=2e-5)
    assert abs(route.from_force[0]) == pytest.approx(0.85333283, rel=1e-4)
    assert route.from_force[2] + route.to_force[2] == pytest.approx(MASS * G, rel=1e-6)


def test_the_shortest_length_that_keeps_a_bend_radius():
    start, end = ENDS["in space"]
    route = nb.route(start, end, least_bend_radius=0.12, **PATIENT)
    assert route.least_radius >= 0.12
    shorter = nb.route(start, end, length=0.999 * route.length, **PATIENT)
    assert shorter.least_radius < 0.12


def test_a_radius_that_no_length_keeps_names_the_largest():
    start, end = ENDS["facing"]
    with pytest.raises(nb.CaseError, match="no length up to .* the largest possible is about 0.8"):
        nb.route(start, end, least_bend_radius=2, **PATIENT)


def test_slack_is_a_part_of_the_distance():
    start, end = ENDS["U"]
    assert nb.route(start, end, slack=0.5, **PATIENT).length == pytest.approx(0.6, rel=1e-12)


def test_a_cable_that_is_too_short_names_both_lengths():
    start, end = ENDS["facing"]
    with pytest.raises(nb.CaseError, match="cable of 0.5 m, and its ends are 0.6 m apart; it must be longer"):
        nb.route(start, end, length=0.5, **NUMBERS)


def test_a_time_limit_ends_the_search():
    start, end = ([0, 0, 0], [-1, 0, 0]), ([0.77, 0, 0], [1, 0, 0])
    begun = time.perf_counter()
    with pytest.raises(nb.CaseError, match="no equilibrium is found within the time limit of 0.01 s"):
        nb.route(start, end, length=0.95, time_limit=0.01, **NUMBERS)
    assert time.perf_counter() - begun < 2


def test_wrong_arguments_are_named():
    start, end = ENDS["facing"]
    with pytest.raises(TypeError, match="all of mass_per_length"):
        nb.route(start, end, length=1, mass_per_length=0.1)
    with pytest.raises(ValueError, match="bending_stiffness is -1"):
        nb.route(start, end, length=1, mass_per_length=0.1, bending_stiffness=-1, axial_stiffness=1e5)
    with pytest.raises(nb.CaseError, match="exclude each other; give one"):
        nb.route(start, end, length=1, slack=0.1, **NUMBERS)
    with pytest.raises(nb.CaseError, match=r"cables\[0\].section.radius"):
        nb.route(start, end, length=1, section={"radius": -1}, material="steel")


def test_several_cables_of_a_cad_file(tmp_path):
    """The rims of two plugs, and the end of a wire that the cable continues."""
    nb.write(tmp_path / "plugs.step", [
        nb.Curve.circle([0, 0, 0], 0.01, [1, 0, 0], "rim a"), nb.Curve.circle([0.6, 0, 0], 0.01, [-1, 0, 0], "rim b"),
        nb.Curve.line([-0.1, 0, 0.3], [0, 0, 0.3], "wire"),
    ])  # fmt: skip
    numbers = {"section": {"radius": "3 mm"}, "material": {"density": 1400, "youngs_modulus": "0.3 GPa"}}
    rim = {"file": "plugs.step", "at": "centre"}
    cables = [
        {"name": "a to b", "from": {**rim, "curve": "rim a"}, "to": {**rim, "curve": "rim b"}, "slack": 0.3, **numbers},
        {"name": "wire to b", "from": {"file": "plugs.step", "curve": "wire"}, "to": {**rim, "curve": "rim b"}, "length": "900 mm", **numbers},
    ]
    file = tmp_path / "cables.json"
    file.write_text(json.dumps({"nurbeam_route": 1, "cables": cables}))
    first, second = nb.routes(file)
    assert first.length == pytest.approx(0.78, rel=1e-9)
    for route, at, way in ((first, [0, 0, 0], [1, 0, 0]), (second, [0, 0, 0.3], [1, 0, 0])):
        d = route.curve.derivatives(route.curve.start, 1)
        assert d[0] == pytest.approx(at, abs=1e-9)
        assert d[1] / np.linalg.norm(d[1]) == pytest.approx(way, abs=1e-8)
    cables[0]["from"]["curve"] = "rim c"
    file.write_text(json.dumps({"nurbeam_route": 1, "cables": cables}))
    with pytest.raises(nb.CaseError, match=r"cables\[0\].from.curve: .*rim c.* is not there"):
        nb.routes(file)
