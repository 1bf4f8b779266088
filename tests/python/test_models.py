import json
import pickle

import numpy as np
import pytest
from models import STEEL, bead_on_a_wire, bending_stiffness, straight_cantilever

import nurbeam as nb


def test_a_cantilever_bends_as_a_beam_does():
    force = 1e-3  # small: linear theory is right to (deflection / length)^2
    results = straight_cantilever(tip=[0, -force, 0]).run(type="static")
    tip = results[-1].beams["rod"].nodes[-1]
    assert tip[1] == pytest.approx(-force / (3 * bending_stiffness()), rel=1e-5)
    moment = results[-1].beams["rod"].field("bending_moment")
    s = results[-1].beams["rod"].s
    assert np.abs(moment) == pytest.approx(force * (1 - s), abs=1e-8)


def test_a_model_saved_elsewhere_names_the_same_files(tmp_path, monkeypatch):
    drawn, saved = tmp_path / "drawn", tmp_path / "saved"
    for folder, length in (drawn, 2.0), (saved, 3.0):
        folder.mkdir()
        nb.write(folder / "axis.step", nb.Curve.line([0, 0, 0], [length, 0, 0]))

    def length_of(model):
        return model.summary()["beams"][0]["length [m]"]

    def modelled():
        model = nb.Model(gravity=[0, 0, -9.81])
        beam = model.add_beam({"file": "axis.step"}, section=nb.Circle(radius=0.01), material="steel", elements=2)
        model.add_support(beam, at="start", type="clamped")
        model.set("analysis", {"type": "static"})
        return model

    monkeypatch.chdir(drawn)
    modelled().save("case.json")
    assert nb.load("case.json").case["beams"][0]["axis"]["file"] == "axis.step"
    modelled().save(saved / "modelled.json")
    loaded = nb.load("case.json")
    monkeypatch.chdir(tmp_path)
    assert length_of(loaded) == pytest.approx(2), "from another working directory"
    loaded.save(saved / "loaded.json")
    loaded.copy().save("copied.json")
    for file in saved / "modelled.json", saved / "loaded.json", tmp_path / "copied.json":
        assert length_of(nb.load(file)) == pytest.approx(2), file


def test_a_model_saved_is_the_case_that_the_command_line_runs(command, tmp_path):
    model = straight_cantilever(tip=[0, -1, 0])
    model.add_probe("tip", "rod", "end")
    model.set("analysis.type", "static")
    model.save(tmp_path / "case.json")
    command("run", tmp_path / "case.json", "--out", tmp_path / "out", "--quiet")
    stored = nb.Results(tmp_path / "out")
    mine = model.run()
    assert len(stored) == len(mine) == 1
    for name, values in mine.histories.items():
        assert np.array_equal(values, stored.histories[name], equal_nan=True), name
    assert stored.histories["tip.y"][0] < 0
    assert stored.report["status"] == "done" and stored.report["model"]["dimension"] == 2


def test_units_are_those_of_the_case_file():
    plain = straight_cantilever(tip=[0, -1, 0]).run(type="static")
    model = nb.Model(gravity=[0, 0, 0])
    rod = model.add_beam([[0, 0, 0], ["1 m", 0, 0]], section=nb.Circle(radius="5 mm"), material=STEEL, elements=8,
                         name="rod")
    model.add_support(rod, at=0, type="clamped")
    model.add_load(rod, at="1000 mm", force=[0, "-1 N", 0])
    texts = model.run(type="static")
    assert np.allclose(texts[-1].beams["rod"].nodes, plain[-1].beams["rod"].nodes, atol=1e-12)


def test_curves_go_from_cad_to_a_run_and_back(tmp_path, root):
    cable = nb.read(root / "samples/zipline/cable.step")["Zip cable"]
    model = nb.Model()
    model.add_beam(cable, section=nb.Circle("6 mm"), material=nb.Material(5200, "60 GPa"), elements=20,
                   stress_free="straight")
    model.add_support(cable.name, at="start")
    model.add_support(cable.name, at="end")
    results = model.run(type="static")
    results.export(tmp_path / "hanging.step")
    back = nb.read(tmp_path / "hanging.step")["Zip cable"]
    assert back.length == pytest.approx(results[-1].beams["Zip cable"].length, rel=1e-10)
    assert back.length == pytest.approx(results[-1].beams["Zip cable"].curve.length, rel=1e-10)


def test_a_body_slides_at_its_speed_where_nothing_holds_it():
    model = bead_on_a_wire(speed=0.5)
    results = model.run(end_time=1, step=0.01)
    assert results.histories["bead.x"][-1] == pytest.approx(1.5, abs=1e-6)
    assert results.histories["bead.speed"] == pytest.approx(0.5, abs=1e-6)
    assert results.at(0.5).bodies["bead"].position[0] == pytest.approx(1.25, abs=1e-6)


def test_a_connector_says_where_its_ends_are_and_what_it_pulls():
    model = bead_on_a_wire(speed=0)
    model.add("bodies", name="load", mass=3, position=[0.75, 0, -0.5])
    model.add("connectors", name="rope", **{"from": {"body": "bead"}, "to": {"body": "load"}}, type="rod")
    rope = model.run(end_time=0.1, step=0.01)[-1].connectors["rope"]
    assert rope.ends.shape == (2, 3)
    assert np.linalg.norm(rope.ends[1] - rope.ends[0]) == pytest.approx(rope.length, abs=1e-12)
    assert rope.length == pytest.approx(np.hypot(0.25, 0.5), rel=1e-9)


def test_modes_are_those_of_a_cantilever():
    results = straight_cantilever(elements=20).modes(count=3)
    omega = 1.8751040687119611**2 * np.sqrt(bending_stiffness() / (7850 * np.pi * 0.005**2))
    assert results.modes[0].frequency == pytest.approx(omega / (2 * np.pi), rel=1e-4)
    assert np.isnan(results.modes[0].factor)
    assert results.modes[0].shape.time == 1


def test_buckling_is_eulers():
    model = straight_cantilever(elements=20, tip=[-1, 0, 0])
    results = model.run(type="buckling", modes={"count": 1})
    assert results.modes[0].factor == pytest.approx(np.pi**2 / 4 * bending_stiffness(), rel=1e-3)


def test_wrong_models_say_all_that_is_wrong():
    model = nb.Model(name="wrong")
    beam = model.add_beam(nb.Curve.line([0, 0, 0], [1, 0, 0]), section=nb.Circle(radius="5 mm"), material="steel")
    model.add_support("beem 1", at="start", type="pinned")
    model.add_load(beam, at={"fraction": 1}, force=[0, 0, 1])
    model.case["beams"][0].update(section={"radius": "5 mn"}, material={"density": 7850, "youngs_modulos": 1e9})
    model.case["loads"][0]["at"]["fraction"] = 2
    with pytest.raises(nb.CaseError) as caught:
        model.run(end_time=1)
    places = [finding.where for finding in caught.value.findings]
    assert "wrong: beams[0].section.radius" in places
    assert any("youngs_modulos" in where or "material" in where for where in places)
    assert "wrong: supports[0].beam" in places
    assert "wrong: loads[0].at.fraction" in places
    assert 'did you mean "youngs_modulus"' in str(caught.value)
    assert 'did you mean "beam 1"' in str(caught.value)
    assert all(finding.severity == "error" for finding in caught.value.findings)


def test_what_no_case_can_hold_is_refused_with_its_place():
    model = straight_cantilever()
    with pytest.raises(TypeError, match="Curve of degree.* for a beam or a body its name"):
        model.add_load(nb.Curve.line([0, 0, 0], [1, 0, 0]), at="end", force=[0, 0, 1])
    with pytest.raises(TypeError, match="start is 3; expected a Checkpoint"):
        model.simulate(end_time=1, step=1e-2, start=3)
    with pytest.raises(nb.CaseError, match=r"loads: force\[1\]: is nan; expected a finite number"):
        model.add_load("rod", at="end", force=[0, np.nan, 0])
    model.add_load("rod", at="end", force=[0, 1, 0])
    model.case["loads"][0]["force"][1] = np.nan
    for use in (lambda: model.run(type="static"), lambda: model.save("case.json")):
        with pytest.raises(nb.CaseError, match=r"model: loads\[0\].force\[1\]: is nan; expected a finite number"):
            use()


def test_the_messages_are_those_of_the_command_line(command, tmp_path):
    model = straight_cantilever()
    with pytest.raises(nb.CaseError) as at_once:
        model.set("beams.rod.elements.count", 0)
    model.case["beams"][0]["elements"] = {"count": 0}
    with pytest.raises(nb.CaseError) as caught:
        model.run(type="static")
    assert at_once.value.findings[0].message == caught.value.findings[0].message
    model.set("analysis.type", "static")
    model.save(tmp_path / "case.json")
    said = command("check", tmp_path / "case.json", expect=2)
    assert caught.value.findings[0].message in said


def test_paths_set_values_as_the_command_line_does():
    model = straight_cantilever()
    model.set("beams[0].elements.count", 12)
    assert model.case["beams"][0]["elements"] == {"count": 12}
    model.set("beams.rod.name", "stick")
    assert model.case["beams"][0]["name"] == "stick"
    model.set("output.every", "1 ms")
    assert model.case["output"] == {"every": "1 ms"}
    model.set("output.every", None)
    assert model.case["output"] == {}
    for force in ([0, 1, 0], [0, 2, 0]):
        model.set("loads[+]", {"beam": "stick", "at": "end", "force": force})
    assert [load["force"] for load in model.case["loads"]] == [[0, 1, 0], [0, 2, 0]]
    with pytest.raises(KeyError, match='did you mean \\\\?"stick'):
        model.set("beams.stik.name", "x")
    with pytest.raises(KeyError, match=r"there is no \[3\]"):
        model.set("beams[3].name", "x")


@pytest.mark.parametrize("path, value", [
    ("beams[0].name.x", None), ("beams[0].name.x", 3), ("bems[0].x", 3), ("beams[0].elemets.count", 3),
    ("beams[0].elements.cuont", None), ("supports[0].motion[2]", 1), ("supports[1].type", "pinned"),
    ("beams[0.name", "x"), ("", 1),
])
def test_a_path_that_leads_nowhere_changes_nothing_and_has_the_message_of_the_command_line(path, value, command, tmp_path):
    model = straight_cantilever()
    before = model.copy().case
    model.save(tmp_path / "case.json")
    with pytest.raises(KeyError) as caught:
        model.set(path, value)
    assert model.case == before
    assert caught.value.args[0] in command("check", tmp_path / "case.json", "--set", f"{path}={json.dumps(value)}", expect=2)


def test_what_is_set_leaves_the_items_that_a_user_holds():
    model = straight_cantilever()
    support = model.case["supports"][0]
    load = model.add("loads", beam="rod", at="end", force=[0, 1, 0])
    load["force"][1] = np.nan
    model.set("loads[0].force[1]", 2)
    model.set("output.every", None)
    model.set("supports[0].name", "wall")
    with pytest.raises(nb.CaseError, match=r"gravity\[0\]: is inf; expected a finite number"):
        model.set("gravity[0]", np.inf)
    model.set("gravity[0]", 1.5)
    model.set("beams.rod.material", "steel")
    model.set("beams.rod.material.density", 7000)
    assert load["force"] == [0, 2, 0] and model.case["loads"][0] is load
    assert support["name"] == "wall" and "output" not in model.case
    assert model.case["gravity"][0] == 1.5
    assert model.case["beams"][0]["material"] == {"name": "steel", "density": 7000}
    model.set("loads[0]", None)
    assert model.case["loads"] == []


def test_a_copy_is_a_model_of_its_own():
    model = straight_cantilever()
    other = model.copy()
    other.set("beams.rod.elements.count", 3)
    assert model.case["beams"][0]["elements"]["count"] == 8


def test_no_body_without_a_place_and_no_run_without_a_beam():
    model = straight_cantilever()
    model.add_body("lost", mass=1)
    with pytest.raises(nb.CaseError, match="no sliding joint and no connector holds"):
        model.check(type="static")
    with pytest.raises(nb.CaseError, match="beams"):
        nb.Model().run(type="static")


def test_case_files_that_are_none_say_so(tmp_path):
    with pytest.raises(nb.CaseError, match="cannot be read"):
        nb.load(tmp_path / "absent.json")
    (tmp_path / "case.json").write_text("{ not json")
    with pytest.raises(nb.CaseError, match="line 1"):
        nb.load(tmp_path / "case.json")
    (tmp_path / "list.json").write_text("[1, 2]")
    with pytest.raises(nb.CaseError):
        nb.load(tmp_path / "list.json").run()


def test_loaded_cases_may_be_changed(root):
    model = nb.load(root / "samples/statics/elastica.json")
    assert model.case["nurbeam"] == 1
    model.set("output", {"report": False})
    assert len(model.run()) >= 1
    with pytest.raises(nb.CaseError, match="there is no"):
        nb.load(root / "samples/statics/elastica.json", set={"analyses.type": 1})


def test_a_run_that_fails_says_why_and_keeps_what_there_is(tmp_path):
    model = straight_cantilever(tip=[0, -1, 0])
    model.case["supports"] = []
    with pytest.raises(nb.RunError) as caught:
        model.run(type="static")
    assert "held" in str(caught.value) or "equilibrium" in str(caught.value)
    assert isinstance(caught.value.results, nb.Results)


def test_errors_are_pickled_as_they_are(tmp_path):
    model = straight_cantilever(tip=[0, -1, 0])
    model.case["supports"] = []
    for ask in (lambda: model.run(), lambda: nb.read(tmp_path / "absent.step")):
        with pytest.raises((nb.CaseError, nb.CadError)) as caught:
            ask()
        again = pickle.loads(pickle.dumps(caught.value))
        assert type(again) is type(caught.value) and again.findings == caught.value.findings != []
        assert str(again) == str(caught.value)
    for out in (None, tmp_path / "out"):
        with pytest.raises(nb.RunError) as failed:
            model.run(type="static", out=out)
        again = pickle.loads(pickle.dumps(failed.value))
        assert str(again) == str(failed.value)
        assert again.results.directory == out and len(again.results) == len(failed.value.results)


def test_places_are_said_in_words_numbers_and_points():
    def tip(at):
        model = straight_cantilever()
        model.add_load("rod", at=at, force=[0, -1, 0])
        return model.run(type="static")[-1].beams["rod"].nodes[-1, 1]

    ways = ["end", 1.0, "1 m", "100 cm", {"fraction": 1}, {"length": 1}, [1, 0, 0], np.array([1.0, 0, 0])]
    assert np.ptp([tip(at) for at in ways]) < 1e-12
    assert abs(tip(0.5)) < 0.5 * abs(tip("end"))
    with pytest.raises(nb.CaseError, match='"ent" is not known here; did you mean "end"'):
        tip("ent")


def test_another_type_of_analysis_leaves_the_keys_of_the_cases_own_out(root, recwarn):
    nb.load(root / "samples/zipline/zipline.json").modes(count=1)
    assert not [warning for warning in recwarn if "no effect" in str(warning.message)]


def test_summary_and_schema_are_json(root):
    model = straight_cantilever()
    assert model.summary() == model.summary(type="static")
    summary = model.summary()
    assert summary["dimension"] == 2 and summary["beams"][0]["name"] == "rod"
    assert "beams" in nb.schema()["properties"]


def test_findings_that_are_no_errors_are_warnings():
    model = straight_cantilever(tip=[0, -1, 0])
    with pytest.warns(nb.CaseWarning, match="has no effect in a static analysis") as told:
        model.run(type="static", step=0.1)
    assert [warning.filename for warning in told] == [__file__]
    assert any("no effect" in finding.message for finding in model.check(type="static", step=0.1))
