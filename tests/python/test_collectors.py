"""Collectors, and histories with rows between frames, from Python."""

import nurbeam as nb
import numpy as np
import pytest


def level_wire():
    model = nb.Model()
    model.add("beams", name="wire", rigid=True, axis={"polyline": [[0, 0, 0], [40, 0, 0]]})
    model.add_collector(
        "pan", "wire", "start", [1, 0, 0], masses=[15, 7.2], stiffness=[50, 4200], force=120, motion={"speed": 20},
        damping=[90, 10], evaluate=[5, 25],
    )  # fmt: skip
    return model


MEAN = 120 / (1 + 50 * (1 / 4200 + 1 / 50e3))
RUN = {"end_time": 1.5, "step": 1e-3, "initial": "equilibrium", "every": 0.5}


def test_histories_have_a_row_at_every_step():
    results = level_wire().run(**RUN)
    assert len(results.times) == 4
    histories = results.histories
    assert len(histories["time"]) == 1501
    assert np.allclose(np.diff(histories["time"]), 1e-3)
    assert np.allclose(histories["pan.force"], MEAN, atol=1e-6)
    assert np.allclose(histories["pan.mass_2.x"], 20 * histories["time"])


def test_the_report_has_the_statistics():
    simulation = level_wire().simulate(**RUN)
    for _ in simulation:
        pass
    (pan,) = simulation.report["collectors"]
    assert pan["name"] == "pan"
    assert pan["samples"] == pytest.approx(1001, abs=1)
    assert pan["force"]["mean [N]"] == pytest.approx(MEAN, rel=1e-8)
    assert pan["force"]["standard deviation [N]"] < 1e-6
    assert pan["loss of contact"]["number"] == 0


def test_results_of_a_directory_have_the_same_rows(tmp_path):
    model = level_wire()
    here = model.run(**RUN)
    stored = model.run(**RUN, out=tmp_path / "results")
    assert np.array_equal(stored.histories["pan.force"], here.histories["pan.force"])
    assert np.array_equal(stored.histories["time"], here.histories["time"])
    assert len(stored.times) == 4
    assert stored.report["collectors"][0]["samples"] == pytest.approx(1001, abs=1)


def test_rows_may_be_asked_for_without_collectors():
    model = nb.Model()
    steel = nb.Material(density=7800, youngs_modulus=2e11)
    rod = model.add_beam([[0, 0, 0], [1, 0, 0]], nb.Circle(radius=0.005), steel, elements=4)
    model.add_support(rod, "start", "clamped")
    model.case["output"] = {"histories_every": "2 ms"}
    results = model.run(end_time=0.02, step=1e-3, every=0.01)
    assert np.allclose(results.histories["time"], np.arange(11) * 2e-3)
    between = np.isnan(results.histories[f"{rod.name}.length"])
    assert between.tolist() == [False] + 4 * [True] + [False] + 4 * [True] + [False]
