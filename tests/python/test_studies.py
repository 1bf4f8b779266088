"""Studies from Python."""

import numpy as np
import pytest

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


def test_what_is_wrong_is_a_list_of_findings(tmp_path):
    wrong = {**ISHIGAMI, "plan": {"grid": [2, 2]}, "constraints": ["x4 < 1"]}
    with pytest.raises(nb.CaseError) as raised:
        nb.study(wrong, out=tmp_path)
    messages = str(raised.value)
    assert 'there is no variable "x4"; did you mean' in messages
    assert "has 2 numbers for 3 variables" in messages
    with pytest.raises(KeyError, match='did you mean "x1"'):
        nb.study({**ISHIGAMI, "plan": {"list": [[0, 0, 0]]}}, out=tmp_path)["x11"]
