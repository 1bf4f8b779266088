import copy
import multiprocessing
import pickle
import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
from models import bead_on_a_wire, straight_cantilever

import nurbeam as nb


@pytest.fixture(scope="module")
def results():
    model = bead_on_a_wire(speed=0.5)
    model.case["gravity"] = [0, 0, -9.81]
    model.add_probe("middle", "wire", {"fraction": 0.5})
    return model.run(end_time=0.2, step=1e-3, every=0.05)


def test_histories_have_names_units_and_vectors(results):
    h = results.histories
    assert h["bead.position"].shape == (5, 3)
    assert np.array_equal(h["bead.position"][:, 0], h["bead.x"])
    assert h.unit("bead.velocity") == "m/s" and h.unit("energy.total") == "J" and h.unit("bead.speed") == "m/s"
    assert h["bead.speed"] == pytest.approx(np.linalg.norm(h["bead.velocity"], axis=1))
    assert h["reaction.wire.start.force"].shape == (5, 3)
    assert np.array_equal(h["time"], results.times)
    assert "middle.moment" in h and len(h) == len(list(h))
    with pytest.raises(KeyError, match='did you mean \\\\?"bead.x'):
        h["beed.x"]


def test_snapshots_are_a_sequence(results):
    assert len(results) == 5 and results[-1].time == pytest.approx(0.2)
    assert [snapshot.time for snapshot in results[1:3]] == pytest.approx([0.05, 0.1])
    with pytest.raises(IndexError, match="there is no snapshot 5; there are 5"):
        results[5]
    with pytest.raises(ValueError, match="not among those of the run, from 0 to 0.2 s"):
        results.at(0.3)
    with pytest.raises(TypeError, match="the time is '0.1 s'; expected a number in seconds"):
        results.at("0.1 s")
    assert results.at(0.06).time == pytest.approx(0.05)


def test_beams_hold_their_shape_and_what_they_carry(results):
    beam = results[-1].beams["wire"]
    points = beam.points(per_element=5)
    assert points.shape == (5 * len(beam.control_points) + 1, 3)
    assert beam.curve(beam.curve.start) == pytest.approx(points[0], abs=1e-12)
    assert beam.curve.length == pytest.approx(beam.length, rel=1e-9)
    assert beam.material_curve.end == pytest.approx(4, rel=1e-9)
    assert beam.field("velocity").shape == (len(beam.s), 3)
    assert np.all(np.diff(beam.node_s) > 0) and beam.nodes.shape == (len(beam.node_s), 3)
    assert set(beam.fields) >= {"axial_force", "bending_moment", "stress", "velocity"}
    with pytest.raises(KeyError, match="did you mean"):
        beam.field("bending_momnet")
    with pytest.raises(KeyError, match='there is no beam "wier"; did you mean "wire"'):
        results[-1].beams["wier"]
    with pytest.raises(KeyError, match='there is no probe "center"; known: "middle"'):
        results[-1].probes["center"]


def test_snapshots_know_single_values(results):
    assert results[2]["energy.total"] == results.histories["energy.total"][2]
    assert results[2].probes["middle"].position[2] == results.histories["middle.z"][2]


def test_steps_are_those_of_the_run(results):
    steps = results.steps
    assert steps.shape == (200, 4)
    assert np.all(np.diff(steps[:, 0]) > 0) and steps[-1, 0] == pytest.approx(0.2)


def test_pandas_and_xarray_get_the_histories(results):
    frame = results.to_dataframe()
    assert frame.index.name == "time" and frame["bead.x"].iloc[-1] == results.histories["bead.x"][-1]
    assert frame.attrs["units"]["bead.x"] == "m"
    data = results.to_xarray()
    assert data["bead.x"].attrs["units"] == "m"
    assert float(data["bead.x"].sel(time=0.1, method="nearest")) == results.histories["bead.x"][2]


def test_plots_show_what_they_are_asked_for(results):
    ax = results.plot("bead.x")
    assert ax.get_ylabel() == "bead.x [m]" and np.array_equal(ax.lines[0].get_ydata(), results.histories["bead.x"])
    assert len(results.plot("bead.velocity").lines) == 3
    assert len(results.plot().lines) == 7  # energies
    assert len(results.plot_shape(times=[0, 0.1, 0.2]).lines) == 6  # beams and bodies
    along = results.plot_along("bending_moment", time=0.1)
    assert np.array_equal(along.lines[0].get_ydata(), results[2].beams["wire"].field("bending_moment"))
    with pytest.raises(KeyError, match='there is no beam \\\\?"rope'):
        results.plot_along("bending_moment", beam="rope")


def test_directories_without_results_say_so(tmp_path):
    with pytest.raises(nb.Error, match="does not exist"):
        nb.Results(tmp_path / "absent")
    with pytest.raises(nb.Error, match="expected a directory that `nurbeam run` has written"):
        nb.Results(tmp_path)


def test_results_are_pickled_as_their_place(tmp_path, monkeypatch):
    model = straight_cantilever(tip=[0, -1, 0])
    monkeypatch.chdir(tmp_path)
    pickled = pickle.dumps(model.run(type="static", out="there"))
    monkeypatch.chdir("/")
    again = pickle.loads(pickled)
    assert again.directory == tmp_path / "there" and len(again) > 0
    in_memory = model.run(type="static")
    assert np.array_equal(copy.copy(in_memory).times, in_memory.times)


def assert_alike(a, b):
    assert a.time == b.time and list(a.beams) == list(b.beams) and repr(a) == repr(b)
    for name, beam in a.beams.items():
        other = b.beams[name]
        assert beam.length == other.length and np.array_equal(beam.control_points, other.control_points)
        for field in beam.fields:
            assert np.array_equal(beam.field(field), other.field(field), equal_nan=True), field
    for of in ("bodies", "probes", "connectors"):
        mine, others = getattr(a, of), getattr(b, of)
        assert list(mine) == list(others)
        for name in mine:
            for x, y in zip(mine[name], others[name]):
                assert np.array_equal(x, y, equal_nan=True), name


def test_snapshots_are_numbered(results):
    assert results[np.int64(1)].time == results[1].time
    with pytest.raises(TypeError, match="the number of a snapshot is 1.5; expected a whole number, a slice or the name of a history"):
        results[1.5]
    with pytest.raises(KeyError, match='there is no beam "rope"; known: "wire"'):
        results[0].beams["rope"]


def test_what_is_in_memory_is_pickled_to_the_bit(results):
    for again in (pickle.loads(pickle.dumps(results)), copy.deepcopy(results)):
        assert again.directory is None and again.name == results.name
        assert again.report == results.report and np.array_equal(again.steps, results.steps)
        assert list(again.histories) == list(results.histories)
        for name in results.histories:
            assert np.array_equal(again.histories[name], results.histories[name], equal_nan=True), name
        for a, b in zip(again, results):
            assert_alike(a, b)
    assert_alike(pickle.loads(pickle.dumps(results[2])), results[2])
    shape = pickle.loads(pickle.dumps(results[2].beams["wire"]))
    assert shape.name == "wire" and np.array_equal(shape.points(), results[2].beams["wire"].points())


def test_modes_are_pickled_to_the_bit():
    modes = straight_cantilever().modes(count=3)
    for again, mode in zip(pickle.loads(pickle.dumps(modes)).modes, modes.modes, strict=True):
        assert again.frequency == mode.frequency and np.array_equal(again.effective_mass, mode.effective_mass)
        assert_alike(again.shape, mode.shape)


def test_runs_of_other_processes_hand_over_what_they_have():
    model = straight_cantilever(tip=[0, -1, 0])
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as others:
        there = others.submit(model.run, type="static").result()
    assert_alike(there[-1], model.run(type="static")[-1])


def test_events_are_alike_in_memory_and_in_a_directory(tmp_path):
    model = bead_on_a_wire(at=3.5, speed=2)
    model.case["supports"] = [dict(model.case["supports"][0], type="clamped")]
    in_memory = model.run(end_time=0.5, step=2e-3).events
    stored = model.run(end_time=0.5, step=2e-3, out=tmp_path / "there").events
    keys = ("time", "kind", "beam", "body", "s")
    assert [event["body"] for event in in_memory if "left" in event["kind"]] == ["bead"]
    assert [{key: event[key] for key in keys} for event in stored] == in_memory


def test_stored_results_are_those_in_memory(tmp_path):
    model = straight_cantilever(tip=[0, -1, 0])
    stored = model.run(end_time=0.02, step=1e-3, out=tmp_path / "out")
    memory = model.run(end_time=0.02, step=1e-3)
    for a, b in zip(stored, memory):
        assert np.array_equal(a.beams["rod"].control_points, b.beams["rod"].control_points)
        for name in a.beams["rod"].fields:
            assert np.array_equal(a.beams["rod"].field(name), b.beams["rod"].field(name), equal_nan=True), name
    assert (tmp_path / "out/report.html").exists()


def test_results_of_a_run_that_goes_on_are_not_there_yet(tmp_path):
    out = tmp_path / "out"
    model = straight_cantilever(tip=[0, -1, 0])
    seen = []

    def look(t, r, v):
        seen.append((out / "results.nc").exists())
        return 0, 0, 0

    model.add_force(look, beam="rod", at="end")
    model.run(end_time=0.02, step=1e-3, out=out)
    assert seen and not any(seen) and (out / "results.nc").exists()


def test_progress_shows_a_bar(capsys):
    straight_cantilever(tip=[0, -1, 0]).run(end_time=0.05, step=1e-3, progress=True)
    assert "0.05 of 0.05 s" in capsys.readouterr().err
