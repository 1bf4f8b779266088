"""Forces by functions."""

import numpy as np
import pytest
from models import bead_on_a_wire, bending_stiffness, straight_cantilever

import nurbeam as nb


def spring(t, position, velocity):
    return [-50 * (position[0] - 2), 0, 0]


def oscillation(t, mass=2.0, stiffness=50.0):
    return 2 - np.cos(np.sqrt(stiffness / mass) * t)


def test_a_spring_by_a_function_swings_as_springs_do():
    model = bead_on_a_wire()
    model.add_force(spring, body="bead")
    results = model.run(end_time=1, step=1e-3)
    assert np.abs(results.histories["bead.x"] - oscillation(results.times)).max() < 2e-5
    work = results.histories["energy.input"]
    assert results.histories["energy.total"] == pytest.approx(results.histories["energy.total"][0], abs=1e-4)
    assert np.abs(work).max() > 10


def test_given_derivatives_are_those_taken_by_differences():
    K = np.diag([-50.0, 0, 0])
    model = bead_on_a_wire()
    model.add_force(lambda t, r, v: (spring(t, r, v), K, np.zeros((3, 3))), body="bead")
    exact = model.run(end_time=0.2, step=1e-3).histories["bead.x"]
    model = bead_on_a_wire()
    model.add_force(spring, body="bead")
    assert exact == pytest.approx(model.run(end_time=0.2, step=1e-3).histories["bead.x"], abs=1e-9)


def test_a_force_on_a_place_is_the_load_of_the_case():
    force = [0, -1.0, 0]
    expected = straight_cantilever(tip=force).run(type="static")[-1].beams["rod"].nodes
    model = straight_cantilever()
    model.add_force(lambda t, r, v: force, beam="rod", at="end")
    assert np.abs(model.run(type="static")[-1].beams["rod"].nodes - expected).max() < 1e-10
    assert abs(expected[-1, 1]) > 1 / (4 * bending_stiffness())


def test_buckling_multiplies_loads_and_no_laws():
    def column():
        model = nb.Model(gravity=[0, 0, 0])
        model.add_beam([[0, 0, 0], [1, 0, 0]], section=nb.Circle(0.005), material="steel", elements=16, name="b")
        model.add_support("b", at="start", type="clamped")
        model.add_load("b", at="end", force=[-1, 0, 0])
        return model

    held = column()
    held.add("connectors", name="k", **{"from": {"beam": "b", "at": "end"}}, to={"point": [1, -1, 0]},
             direction=[0, -1, 0], stiffness=100)
    by_law = column()
    by_law.add_force(lambda t, r, v: [0, -100 * r[1], 0], beam="b", at="end")
    expected = [mode.factor for mode in held.run(type="buckling").modes]
    assert [mode.factor for mode in by_law.run(type="buckling").modes][:2] == pytest.approx(expected[:2], rel=1e-6)
    pulled = column()
    pulled.add_force(lambda t, r, v: [100, 0, 0], beam="b", at="end")
    alone = column().run(type="buckling").modes[0].factor
    assert pulled.run(type="buckling").modes[0].factor == pytest.approx(alone + 100, rel=1e-3)


def test_laws_see_world_coordinates_wherever_the_model_lies():
    seen = []

    def law(t, position, velocity):
        seen.append((position.copy(), velocity.copy()))
        return np.zeros(3)

    model = nb.Model(gravity=[0, 0, 0])
    model.add_beam(nb.Curve.line([5, 6, 7], [5, 6, 9]), section=nb.Circle(0.005), material=nb.Material(7850, 2e11),
                   elements=4, name="rod", initial={"velocity": {"translation": [0, 3, 0]}})
    model.add_force(law, beam="rod", at={"fraction": 0.5})
    model.run(end_time=0.01, step=1e-3)
    assert seen[0][0] == pytest.approx([5, 6, 8]) and seen[0][1] == pytest.approx([0, 3, 0])
    assert seen[-1][0] == pytest.approx([5, 6.03, 8], abs=1e-2)


def test_one_law_may_tie_several_points_together():
    shapes = []

    def between(t, r, v):
        shapes.append(r.shape)
        pull = 10 * (r[1] - r[0])
        return np.stack([pull, -pull])

    model = bead_on_a_wire(at=1.0)
    other = model.add_body("other", mass=2)
    model.add_sliding_joint(other, "wire", at=3.0)
    model.add_force(between, points=[{"body": "bead"}, {"body": other}])
    results = model.run(end_time=0.3, step=1e-3)
    assert set(shapes) == {(2, 3)}
    # Two masses m on a spring c: their distance swings with the frequency sqrt(2 c / m).
    expected = 2 - np.cos(np.sqrt(2 * 10 / 2) * results.times)
    assert results.histories["bead.x"] == pytest.approx(expected, abs=2e-4)
    assert results.histories["bead.x"] + results.histories["other.x"] == pytest.approx(4, abs=1e-7)


class Stop(Exception):
    pass


@pytest.mark.parametrize(
    "analysis", [{"end_time": 1, "step": 1e-2}, {"end_time": 1, "integrator": {"type": "radau"}}, {"type": "static"}]
)
def test_what_a_law_raises_comes_out_unchanged(analysis, tmp_path):
    raised = Stop("enough")

    def law(t, position, velocity):
        raise raised

    model = straight_cantilever()
    model.add_force(law, beam="rod", at="end")
    for where in ({}, {"out": tmp_path / "out"}):
        with pytest.raises(Stop) as caught:
            model.run(**analysis, **where)
        assert caught.value is raised


@pytest.mark.parametrize(
    ("answer", "error", "message"),
    [
        (None, TypeError, r"laws\[0\]: returned None; expected the force, three numbers in newtons"),
        ([1, 2], TypeError, "expected the force"),
        ("push", TypeError, "expected the force"),
        ([0, np.nan, 0], ValueError, "a force must be finite"),
        ([0, 0, 1.0], ValueError, "out of the plane of the model; add the law with spatial=True"),
        (([0, 0, 0], np.full((3, 3), np.nan), None), ValueError,
         r"^laws\[0\]: the derivative by positions is nan at \[0, 0\] at t = 0 s; it must be finite, or None: then"),
        (([0, 0, 0], None, np.diag([0, np.inf, 0])), ValueError, r"the derivative by velocities is inf at \[1, 1\]"),
        (([0, 0, 0], [1, 2], None), TypeError, r"derivative by positions must have the shape \(3, 3\)"),
    ],
)
def test_wrong_answers_say_what_to_do(answer, error, message):
    model = straight_cantilever()
    model.add_force(lambda t, r, v: answer, beam="rod", at="end")
    with pytest.raises(error, match=message):
        model.run(end_time=0.1, step=1e-2)


def test_a_spatial_law_makes_the_model_one_in_space():
    model = straight_cantilever()
    model.add_force(lambda t, r, v: (0, 0, -1.0), beam="rod", at="end", spatial=True)
    assert model.summary(type="static")["dimension"] == 3
    assert model.run(type="static")[-1].beams["rod"].nodes[-1, 2] < 0


def test_laws_of_nothing_are_findings():
    model = straight_cantilever()
    model.add_force(lambda t, r, v: (0, 0, 0), beam="rood", at="end")
    model.add_force(lambda t, r, v: (0, 0, 0), body="rod")
    model.add_force(lambda t, r, v: (0, 0, 0), beam="rod")
    with pytest.raises(nb.CaseError) as caught:
        model.run(type="static")
    assert "laws[2].points[0]" in str(caught.value)
    model = straight_cantilever()
    model.add_force(lambda t, r, v: (0, 0, 0), beam="rood", at="end")
    with pytest.raises(nb.CaseError, match='there is no beam "rood"; did you mean "rod"'):
        model.run(type="static")
    with pytest.raises(TypeError, match="a law is a function"):
        model.add_force(3.0, beam="rod", at="end")
    with pytest.raises(nb.Error, match="cannot hold"):
        model.save("case.json")


def test_case_files_have_no_laws(tmp_path, command):
    model = straight_cantilever()
    model.case["laws"] = [{"points": [{"beam": "rod", "at": "end"}]}]
    model.set("analysis.type", "static")
    model.save(tmp_path / "case.json")
    assert 'unknown key "laws"' in command("check", tmp_path / "case.json", expect=2)


def swing(t):
    return 1.0 + 0.3 * (1 - np.cos(4 * t))


def test_a_body_moves_as_its_function_says():
    model = bead_on_a_wire(motion=swing)
    results = model.run(end_time=1, step=1e-3)
    t = results.times
    assert results.histories["bead.s"] == pytest.approx(swing(t), abs=1e-12)
    # What holds it there is its mass times its acceleration; the wire, which it shakes, trembles a little.
    assert results.histories["bead.holding_force"][2:] == pytest.approx(2.0 * 0.3 * 16 * np.cos(4 * t[2:]), abs=0.2)
    assert np.ptp(results.histories["energy.total"]) < 1e-3 * np.ptp(results.histories["energy.input"])


def test_given_derivatives_of_a_motion_are_those_by_differences():
    exact = bead_on_a_wire(motion=lambda t: (swing(t), 1.2 * np.sin(4 * t), 4.8 * np.cos(4 * t)))
    differences = bead_on_a_wire(motion=swing)
    a, b = (model.run(end_time=0.3, step=1e-3).histories["bead.vx"] for model in (exact, differences))
    assert a == pytest.approx(b, abs=1e-6)


def test_a_support_moves_as_its_function_says():
    model = straight_cantilever()
    model.case["supports"] = []
    model.add_support("rod", at="start", type="clamped", motion=lambda t: (0, 0.02 * (1 - np.cos(6 * t)), 0))
    results = model.run(end_time=0.5, step=1e-3)
    found = [snapshot.beams["rod"].nodes[0, 1] for snapshot in results]
    assert found == pytest.approx(0.02 * (1 - np.cos(6 * results.times)), abs=1e-10)
    assert np.ptp(results.histories["energy.total"]) < 5e-3 * results.histories["energy.input"].max()


def test_motions_that_cannot_be_say_why():
    with pytest.raises(ValueError, match="must start where \"at\" is"):
        bead_on_a_wire(motion=lambda t: 2.0).run(end_time=1, step=1e-2)
    with pytest.raises(TypeError, match="expected the reference arc length, a number in metres"):
        bead_on_a_wire(motion=lambda t: "x").run(end_time=1, step=1e-2)
    with pytest.raises(ValueError, match="a motion must be finite"):
        bead_on_a_wire(motion=lambda t: 1 if t < 0.05 else np.nan).run(end_time=1, step=1e-2)
    model = straight_cantilever()
    model.case["supports"] = []
    model.add_support("rod", at="start", motion=lambda t: (0, 1, 0))
    with pytest.raises(ValueError, match="the run starts as drawn"):
        model.run(end_time=1, step=1e-2)
    model.set("supports[0].motion", [[0, 0, 0, 0], [1, 0, 1, 0]])
    with pytest.raises(nb.CaseError, match="motion_law"):
        model.run(end_time=1, step=1e-2)
    with pytest.raises(nb.Error, match="cannot hold"):
        model.save("case.json")


def test_a_body_driven_beyond_its_beam_leaves_it():
    model = bead_on_a_wire(at=3.5, motion=lambda t: 3.5 + 2 * t * t)
    model.case["supports"] = [dict(model.case["supports"][0], type="clamped")]
    results = model.run(end_time=0.7, step=2e-3)
    assert np.isnan(results.histories["bead.s"][-1])
    left = [event["time"] for event in results.report["events"] if "left" in event["kind"]]
    assert left == pytest.approx([0.5], abs=5e-3)


def test_a_static_run_calls_a_law_at_the_factor():
    def sagged(**analysis):
        model = straight_cantilever()
        model.add_force(lambda t, r, v: (0, -t, 0), beam="rod", at="end")
        model.add_probe("tip", "rod", "end")
        return model.run(type="static", **analysis)

    assert sagged().times == [1]
    assert sagged().histories["tip.y"][-1] == sagged(load_steps=[1]).histories["tip.y"][-1] != 0
