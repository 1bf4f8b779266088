"""Studies from Python."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from models import straight_cantilever

import nurbeam as nb

ISHIGAMI = {
    "nurbeam_study": 1,
    "variables": [{"name": f"x{i}", "range": [-np.pi, np.pi]} for i in (1, 2, 3)],
    "quantities": [{"name": "y", "value": "sin(x1) + 7 * sin(x2)^2 + 0.1 * x3^4 * sin(x1)", "unit": "m"}],
}


def test_a_plan_is_columns(tmp_path):
    study = nb.study({**ISHIGAMI, "plan": {"sobol": {"count": 64}}}, out=tmp_path / "out", jobs=2)
    assert list(study) == ["x1", "x2", "x3", "y"]
    x1, x2, x3 = study["x1"], study["x2"], study["x3"]
    np.testing.assert_allclose(study["y"], np.sin(x1) + 7 * np.sin(x2) ** 2 + 0.1 * x3**4 * np.sin(x1), rtol=1e-14)
    assert study.units == {"y": "m"} and study.statuses == ["done"] * 64 and study.answer is None
    assert repr(study) == "<Study of 64 variants, 64 done: x1, x2, x3, y>"
    again = nb.study({**ISHIGAMI, "plan": {"sobol": {"count": 64}}}, out=tmp_path / "out", resume=True)
    np.testing.assert_array_equal(again["y"], study["y"])


def test_an_answer_comes_with_the_variants(tmp_path):
    study = nb.study({**ISHIGAMI, "sensitivity": {"count": 256}}, out=tmp_path)
    assert len(study["y"]) == 256 * 5
    first = study.answer["sobol_indices"]["y"]["x2"]["first_order"]
    assert first["lower"] - 0.05 < 0.4424 < first["upper"] + 0.05


def test_an_optimum_holds_its_probability(tmp_path):
    normal = [("R", {"mean": "r", "sd": 2}), ("S", {"mean": 10, "sd": 1.5})]
    variables = [{"name": name, "distribution": {"normal": moments}} for name, moments in normal]
    study = nb.study({
        "nurbeam_study": 1,
        "variables": [{"name": "r", "range": [5, 40]}, *variables],
        "quantities": [{"name": "cost", "value": "r"}, {"name": "margin", "value": "R - S"}],
        "optimise": {"minimise": "cost", "subject_to": ["probability(margin < 0) <= 1e-3"], "check": {"count": 300}},
    }, out=tmp_path, jobs=1)  # fmt: skip
    found = study.answer["probabilities"][0]
    assert found["design_point"]["r"] == pytest.approx(10 + 2.5 * 3.090232306, abs=1e-3)
    assert found["reliability_index_gradient"]["r"] == pytest.approx(0.4, abs=1e-6)
    assert found["check"]["probability"] == pytest.approx(1e-3, rel=0.5)


def test_what_is_wrong_is_a_list_of_findings(tmp_path):
    wrong = {**ISHIGAMI, "plan": {"grid": [2, 2]}, "constraints": ["x4 < 1"]}
    with pytest.raises(nb.CaseError) as raised:
        nb.study(wrong, out=tmp_path)
    messages = str(raised.value)
    assert 'there is no variable "x4"; did you mean' in messages
    assert "has 2 numbers for 3 variables" in messages
    with pytest.raises(KeyError, match='did you mean "x1"'):
        nb.study({**ISHIGAMI, "plan": {"list": [[0, 0, 0]]}}, out=tmp_path)["x11"]


def test_what_is_no_error_is_a_warning(tmp_path):
    model = straight_cantilever(tip=[0, -1e-3, 0])
    model.set("analysis", {"type": "static"})
    model.add_probe("tip", "rod", "end")
    model.save(tmp_path / "case.json")
    counts = {"nurbeam_study": 1, "case": str(tmp_path / "case.json"), "plan": {"monte_carlo": {"count": 2}},
              "variables": [{"name": "n", "path": "beams[0].elements.count", "range": [4, 8]}],
              "quantities": [{"name": "y", "value": "at(end, tip.y)"}]}
    with pytest.warns(nb.CaseWarning, match="is a whole number") as told, pytest.raises(nb.RunError) as failed:
        nb.study(counts, out=tmp_path / "out")
    assert told[0].filename == __file__ and "is a whole number" not in str(failed.value)
    with pytest.raises(nb.CaseError) as wrong:
        nb.study({**counts, "constraints": ["m > 1"]}, out=tmp_path / "out")
    assert sorted(finding.severity for finding in wrong.value.findings) == ["error", "warning"]
    assert "whole number" not in str(wrong.value)


def test_arrays_may_stand_for_lists(tmp_path):
    model = straight_cantilever()
    model.set("analysis", {"type": "static"})
    model.save(tmp_path / "case.json")
    ranges = np.array([[0, 1], [2, 4.5]])
    study = nb.study({"nurbeam_study": np.int64(1), "case": tmp_path / "case.json",
                      "variables": ({"name": name, "range": of} for name, of in zip("ab", ranges)),
                      "quantities": [{"name": "q", "value": "a + b"}],
                      "plan": {"grid": np.array([2, 2])}, "time_limit": np.float32(60)}, out=tmp_path / "out")
    np.testing.assert_array_equal(np.stack([study["a"], study["b"]], axis=1), [[0, 2], [0, 4.5], [1, 2], [1, 4.5]])
    assert study.statuses == ["done"] * 4


def test_what_no_study_can_hold_is_named(tmp_path):
    with pytest.raises(nb.CaseError, match=r"^study: plan\.list\[0\]\[1\]: is nan; expected a finite number$"):
        nb.study({**ISHIGAMI, "plan": {"list": np.array([[0, np.nan, 0]])}}, out=tmp_path / "out")
    with pytest.raises(TypeError, match="^<object object at .* is nothing that a case or a study can hold; expected a number"):
        nb.study({**ISHIGAMI, "plan": {"grid": object()}}, out=tmp_path / "out")
    with pytest.raises(nb.CaseError, match="case: .*expected a text"):
        nb.study({**ISHIGAMI, "plan": {"grid": 2}, "case": 3}, out=tmp_path / "wrong")
    assert not (tmp_path / "out").exists()


def test_a_study_of_a_mapping_leaves_nothing_of_itself_behind(tmp_path, monkeypatch):
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    with pytest.raises(nb.CaseError, match="has 2 numbers for 3 variables"):
        nb.study({**ISHIGAMI, "plan": {"grid": [2, 2]}}, out=tmp_path / "out")
    assert not (tmp_path / "out").exists()
    study = nb.study({**ISHIGAMI, "plan": {"grid": 2}})
    assert (study.directory / "study.html").exists()
    del study
    assert list((tmp_path / "temporary").iterdir()) == []


@pytest.mark.parametrize("jobs", [-1, 0, 1.5, "2"])
def test_jobs_that_are_none_are_refused(tmp_path, jobs):
    with pytest.raises(ValueError, match=rf"^jobs is {jobs!r}; must be a whole number of at least 1, or None: one for each"):
        nb.study({**ISHIGAMI, "plan": {"list": [[0, 0, 0]]}}, out=tmp_path / "out", jobs=jobs)
    assert not (tmp_path / "out").exists()
    assert len(nb.study({**ISHIGAMI, "plan": {"list": [[0, 0, 0]]}}, out=tmp_path / "out", jobs=np.int64(1))["y"]) == 1


def children(process):
    """The ids of all processes that it has begun, and theirs."""
    try:
        listed = [int(child) for task in Path(f"/proc/{process}/task").iterdir() for child in (task / "children").read_text().split()]
    except (FileNotFoundError, ProcessLookupError):  # it has ended meanwhile
        return []
    return listed + [below for child in listed for below in children(child)]


def runs(process):
    """Whether it is more than an entry in the list of processes."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def test_control_c_ends_a_study_and_all_its_processes(tmp_path):
    model = straight_cantilever(tip=[0, -1, 0])
    model.add_probe("tip", "rod", "end")
    model.set("analysis", {"end_time": 1000, "step": 1e-3})
    model.save(tmp_path / "case.json")
    study = {"nurbeam_study": 1, "case": str(tmp_path / "case.json"), "plan": {"grid": [4]},
             "variables": [{"name": "end", "path": "analysis.end_time", "range": [1000, 2000]}],
             "quantities": [{"name": "y", "value": "last(tip.y)"}]}
    code = f"""
import nurbeam as nb
try:
    nb.study({study!r}, out={str(tmp_path / "out")!r}, jobs=2)
except KeyboardInterrupt:
    print("interrupted")
"""
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    began = time.monotonic()
    while len(begun := children(process.pid)) < 3 and time.monotonic() < began + 30 and process.poll() is None:
        time.sleep(0.05)
    sent = time.monotonic()
    process.send_signal(signal.SIGINT)
    said, wrong = process.communicate(timeout=30)
    assert said == "interrupted\n", wrong
    assert time.monotonic() - sent < 5
    assert len(begun) >= 3  # the study and two that run variants
    while any(map(runs, begun)) and time.monotonic() < sent + 5:
        time.sleep(0.05)
    assert not [pid for pid in begun if runs(pid)]


def measured_study(case, file, column):
    return {"nurbeam_study": 1, "case": case, "variables": [{"name": "g", "path": "gravity[2]", "range": [-12, -8]}],
            "calibrate": {"observations": [{"value": "ball.z", "measured": {"file": file, "columns": ["t", column]},
                                            "sd": 0.001}]}}


def falling_ball(directory, unit):
    """A case of a ball on what hardly holds it, and z = -9 t^2 / 2 in a file, in that unit."""
    model = nb.Model(gravity=[0, 0, -9.81])
    model.add("beams", name="far", rigid=True, axis={"polyline": [[5, 0, 0], [6, 0, 0]]})
    model.add("bodies", name="ball", mass=1, position=[0, 0, 0])
    model.add("connectors", name="thread", **{"from": {"body": "ball"}}, to={"point": [0, 0, 1]}, direction=[0, 0, 1],
              stiffness=1e-9, length="drawn")
    model.set("analysis", {"end_time": 0.5, "step": "10 ms"})
    model.set("output.every", 0.1)
    model.save(directory / "case.json")
    scale = {"mm": 1e3, "m": 1}.get(unit, 1)
    rows = [f"{1e3 * t:.0f},{-4.5 * t * t * scale:.12g}" for t in (0.1, 0.2, 0.3, 0.4, 0.5)]
    (directory / "measured.csv").write_text("\n".join([f"t [ms],z [{unit}]", *rows]) + "\n")


@pytest.mark.parametrize("column", ["z", "z [mm]"])
def test_files_of_a_mapping_are_relative_and_their_units_are_read(tmp_path, monkeypatch, column):
    falling_ball(tmp_path, "mm")
    monkeypatch.chdir(tmp_path)
    study = nb.study(measured_study("case.json", "measured.csv", column))
    assert study.answer["estimates"]["g"]["value"] == pytest.approx(-9, rel=1e-6)


def test_a_column_in_an_unknown_unit_is_refused(tmp_path, monkeypatch):
    falling_ball(tmp_path, "px")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(nb.CaseError, match=r'the column "z \[px\]" has an unknown unit "px"'):
        nb.study(measured_study("case.json", "measured.csv", "z"))


def test_an_estimate_at_the_edge_of_a_constraint_is_told(tmp_path, monkeypatch):
    falling_ball(tmp_path, "mm")
    monkeypatch.chdir(tmp_path)
    study = {**measured_study("case.json", "measured.csv", "z"), "constraints": ["g < -9.5"]}
    with pytest.warns(nb.CaseWarning, match='the estimate lies at the edge of "g < -9.5"'):
        answer = nb.study(study).answer
    assert answer["active_constraints"] == ["g < -9.5"] and "sd" not in answer["estimates"]["g"]
    assert answer["estimates"]["g"]["value"] == pytest.approx(-9.5, rel=1e-5)


def test_columns_have_the_names_of_variables_and_quantities():
    study = nb.study({"nurbeam_study": 1, "variables": [{"name": "mass [kg]", "range": [1, 2]}, {"name": "mass [lb]", "range": [5, 6]}],
                      "quantities": [{"name": "f [x]", "value": "'mass [kg]' + 'mass [lb]'"}], "plan": {"grid": 2}}, jobs=1)
    assert list(study) == ["mass [kg]", "mass [lb]", "f [x]"]
    assert np.array_equal(study["f [x]"], study["mass [kg]"] + study["mass [lb]"])


def test_small_studies_run_in_this_process():
    model = straight_cantilever(tip=[0, 0, -1])
    model.add_probe("tip", "rod", "end")
    radii = np.linspace(0.004, 0.008, 20)
    begin = time.process_time()
    found = nb.vary(model, {"beams[rod].section.radius": radii}, {"sink": "tip.uz", "force": lambda r: r["reaction.rod.start.fz"][-1]},
                    type="static")  # fmt: skip
    assert time.process_time() - begin < 0.3
    assert np.array_equal(found["beams[rod].section.radius"], radii)
    # F L^3/(3 E I), less what a large deflection has of it.
    assert np.allclose(found["sink"], -1 / (3 * 210e9 * np.pi / 4 * radii**4), rtol=2e-3)
    assert np.allclose(found["force"], 1, rtol=1e-6)
    assert model.case["beams"][0]["section"]["radius"] == 0.005


def test_variants_that_are_none_are_told():
    model = straight_cantilever(tip=[0, 0, -1])
    model.add_probe("tip", "rod", "end")
    with pytest.warns(nb.CaseWarning, match="2 of 4 variants are not done; variant 2: .*radius"):
        found = nb.vary(model, {"beams[rod].section.radius": [0.005, -1], "loads[0].force[2]": [-1, -2]}, {"sink": "tip.uz"},
                        grid=True, type="static")  # fmt: skip
    assert found["sink"][1] == pytest.approx(2 * found["sink"][0], rel=1e-2)
    assert np.isnan(found["sink"][2:]).all()
    with pytest.raises(ValueError, match="different numbers"):
        nb.vary(model, {"loads[0].force[2]": [1], "loads[0].force[1]": [1, 2]}, {"sink": "tip.uz"}, type="static")
    with pytest.raises(KeyError, match="radus"):
        nb.vary(model, {"beams[rod].section.radus": [1]}, {"sink": "tip.uz"}, type="static")
