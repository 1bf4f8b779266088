import json
import os
import signal
import subprocess
import sys
import threading
import warnings

import numpy as np
import pytest
from models import bead_on_a_wire, straight_cantilever

import nurbeam as nb

RUN = {"end_time": 0.05, "step": 1e-3, "every": 5e-3}


def swinging():
    model = straight_cantilever(tip=[0, -1, 0])
    model.add_probe("tip", "rod", "end")
    return model


def same(a, b):
    return all(np.array_equal(values, b[name], equal_nan=True) for name, values in a.items())


def test_step_by_step_is_the_same_run():
    whole = swinging().run(**RUN)
    simulation = swinging().simulate(**RUN)
    count = 0
    while simulation.step():
        count += 1
    assert count >= 50 and simulation.ended and not simulation.step()
    assert same(whole.histories, simulation.results.histories)
    assert simulation.report["status"] == "done" and simulation.report["steps"] == 50


def test_iterating_stops_at_output_times_and_goes_on():
    simulation = swinging().simulate(**RUN)
    times = []
    for snapshot in simulation:
        times.append(snapshot.time)
        if len(times) == 4:
            break
    assert simulation.time == pytest.approx(0.015)
    times += [snapshot.time for snapshot in simulation]
    assert times == pytest.approx(np.arange(11) * 5e-3)
    assert same(swinging().run(**RUN).histories, simulation.results.histories)


def test_a_checkpoint_goes_on_bit_by_bit(tmp_path):
    simulation = swinging().simulate(**RUN)
    simulation.run_until(0.0235)
    simulation.checkpoint.save(tmp_path / "point.nc")
    point = nb.Checkpoint.load(tmp_path / "point.nc")
    assert point.time == simulation.time
    rest = swinging().simulate(**RUN, start=point).run()
    whole = swinging().run(**RUN)
    count = len(rest)
    assert 0 < count < len(whole)
    for name, values in whole.histories.items():
        assert np.array_equal(values[-count:], rest.histories[name], equal_nan=True), name


def test_a_motion_goes_on_with_the_steps_that_it_is_given():
    simulation = swinging().simulate(end_time=0.1, step=1e-3)
    simulation.run_until(0.0305)
    rest = swinging().simulate(end_time=0.1, step=5e-4, start=simulation.checkpoint).run()
    assert len(rest.steps) == pytest.approx(140, abs=2)


def test_a_motion_goes_on_to_the_output_times_that_it_is_given():
    simulation = swinging().simulate(end_time=0.1, step=1e-3, every=0.005)
    simulation.run_until(0.0305)
    rest = swinging().simulate(end_time=0.1, step=1e-3, every=0.01, start=simulation.checkpoint).run()
    assert [snapshot.time for snapshot in rest] == pytest.approx([0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1])


def test_what_is_no_checkpoint_and_no_time_is_refused(tmp_path):
    (tmp_path / "other.nc").write_text("no results")
    with pytest.raises(ValueError, match="is no checkpoint that can be read"):
        nb.Checkpoint.load(tmp_path / "other.nc")
    with pytest.raises(FileNotFoundError):
        nb.Checkpoint.load(tmp_path / "none.nc")
    with pytest.raises(ValueError, match="time is not a number"):
        swinging().simulate(**RUN).run_until(float("nan"))


def test_there_is_no_checkpoint_before_the_first_step():
    with pytest.raises(ValueError, match="motion that has begun"):
        swinging().simulate(**RUN).checkpoint


def test_a_load_changed_between_steps_acts_from_then_on():
    # A bead on a wire, pushed through a law-free load on the wire itself would shake it: a rod's tip force instead.
    # The load taken away at once is the model that never had it, but for the accelerations of the first moment.
    model = straight_cantilever()
    load = model.add_load("rod", at="end", force=[0, -1, 0])
    simulation = model.simulate(**RUN)
    simulation.step()
    simulation.set_load(load, [0, 0, 0])
    results = simulation.run()
    assert np.abs(results[-1].beams["rod"].nodes[:, 1]).max() < 1e-12

    # The value that it has changes nothing.
    simulation = model.simulate(**RUN)
    while simulation.step():
        simulation.set_load(load, [0, -1, 0])
    same = simulation.run()
    assert np.array_equal(same.histories["rod.displacement.max"], model.run(**RUN).histories["rod.displacement.max"])

    # Doubled at 25 ms: until then the same motion, afterwards another one; and the energy is kept.
    simulation = model.simulate(**RUN)
    simulation.run_until(0.025)
    simulation.set_load(load, [0, -2, 0])
    changed = simulation.run()
    plain = model.run(**RUN)
    assert np.array_equal(changed.histories["rod.length"][:6], plain.histories["rod.length"][:6])
    assert changed.histories["rod.displacement.max"][-1] != plain.histories["rod.displacement.max"][-1]
    energy = changed.histories["energy.total"]
    assert np.ptp(energy) < 0.02 * changed.histories["energy.bending"].max()


def pulled_rod():
    """On a pin and a guided support that pulls it, with a load across it: the model and that load."""
    model = nb.Model(gravity=[0, 0, 0])
    rod = model.add_beam([[0, 0, 0], [2, 0, 0]], section=nb.Circle(radius=0.01), material="steel", elements=8)
    model.add_support(rod, at="start", type="pinned")
    model.add_support(rod, at="end", type="guided", direction=[1, 0, 0], force=500)
    load = model.add_load(rod, at={"fraction": 0.5}, force=[0, 0, -10])
    model.add_probe("middle", rod, {"fraction": 0.5})
    return model, load


def test_a_changed_load_is_that_of_the_case_and_no_other_force():
    steps = {"type": "static", "load_steps": [1, 2]}
    model, load = pulled_rod()
    simulation = model.simulate(**steps)
    simulation.step()
    simulation.set_load(load, [0, 0, -20])
    changed = simulation.run()[-1]
    model.case["loads"][0]["force"] = [0, 0, -20]
    assert changed["middle.z"] == pytest.approx(model.run(**steps)[-1]["middle.z"], rel=1e-6)


def test_a_checkpoint_changes_the_loads_of_the_case_and_no_other_force():
    model, load = pulled_rod()
    run = {"end_time": 0.02, "step": 1e-4, "initial": "equilibrium"}
    simulation = model.simulate(**run)
    simulation.run_until(0.005)
    simulation.set_load(load, [0, 0, -20])
    simulation.run_until(0.01)
    rest = model.simulate(**run, start=simulation.checkpoint).run()
    assert simulation.run()[-1]["middle.z"] == rest[-1]["middle.z"]


def test_a_changed_load_of_several_beams_is_changed_on_each(tmp_path):
    rods = [nb.Curve.line([0, y, 0], [1, y, 0]) for y in (0, 1)]
    nb.write(tmp_path / "rods.step", rods)
    model = nb.Model(gravity=[0, 0, 0])
    net = model.add_beam({"file": str(tmp_path / "rods.step"), "chains": "all"}, section=nb.Circle(radius=0.01),
                         material="steel", elements=4, name="net")
    model.add_support(net, at="start", type="clamped")
    of_all = model.add_load(net, at="end", force=[0, 0, -1])
    of_one = model.add_load("net 1", at="end", force=[0, 0, -1])
    for number in 1, 2:
        model.add_probe(f"tip {number}", f"net {number}", "end")
    steps = {"type": "static", "load_steps": [1, 2]}
    for load, value in ((of_all, [0, 0, -3]), (of_one, [0, 0, -5])):
        simulation = model.simulate(**steps)
        simulation.step()
        simulation.set_load(load, value)
        changed, other = simulation.run()[-1], model.copy()
        other.case["loads"][load.number]["force"] = value
        expected = other.run(**steps)[-1]
        for tip in "tip 1.z", "tip 2.z":
            assert changed[tip] == pytest.approx(expected[tip], rel=1e-6)


def test_a_changed_load_leaves_held_bodies_where_they_are():
    model = nb.Model(gravity=[0, 0, -9.81])
    wire = model.add_beam([[0, 0, 0], [2, 0, 0]], section=nb.Circle(radius=0.01), material="steel", elements=8)
    model.add_support(wire, at="start", type="pinned")
    model.add_support(wire, at="end", type="pinned")
    model.add_sliding_joint(model.add_body("bead", mass=3), wire, {"fraction": 0.4}, equilibrium="held")
    load = model.add_load(wire, at={"fraction": 0.5}, force=[0, 0, -1])
    simulation = model.simulate(type="static", load_steps=[1, 2])
    simulation.step()
    before = simulation.snapshot["bead.holding_force"]
    simulation.set_load(load, [0, 0, -1])
    assert abs(before) > 0.01 and simulation.snapshot["bead.holding_force"] == pytest.approx(before, rel=1e-6)


def test_loads_that_there_are_none_of_say_so():
    simulation = swinging().simulate(**RUN)
    with pytest.raises(ValueError, match="there is no load 1; the model has 1"):
        simulation.set_load(1, [0, 0, 0])
    with pytest.raises(ValueError, match="plane of the model"):
        simulation.set_load(0, [0, 0, 1])
    with pytest.raises(ValueError, match="expected"):
        simulation.set_load(0, [1, 2])
    with pytest.raises(ValueError, match=r"is \['0 N', '1 N', 0\]; expected three numbers, in N, N m or N/m"):
        simulation.set_load(0, ["0 N", "1 N", 0])
    with pytest.raises(ValueError, match="finite"):
        simulation.set_load(0, [np.nan, 0, 0])


def test_snapshots_between_output_times_are_the_present_state():
    simulation = swinging().simulate(**RUN)
    simulation.run_until(0.007)
    assert simulation.snapshot.time == pytest.approx(simulation.time) and simulation.time >= 0.007
    assert simulation.snapshot.beams["rod"].nodes.shape == (9, 3)
    whole = simulation.run()
    assert simulation.snapshot["energy.total"] == whole.histories["energy.total"][-1]
    assert simulation.snapshot["energy.input"] == whole.histories["energy.input"][-1] != 0


def test_statics_go_step_by_step_too():
    simulation = straight_cantilever(tip=[0, -1, 0]).simulate(type="static", load_steps=4)
    deflections = [snapshot.beams["rod"].nodes[-1, 1] for snapshot in simulation]
    assert len(deflections) == 4 and all(np.diff(deflections) < 0)


def test_a_body_that_leaves_its_beam_is_an_event():
    model = bead_on_a_wire(speed=3.0, at=3.5)
    model.case["supports"] = [dict(model.case["supports"][0], type="clamped")]
    simulation = model.simulate(end_time=0.3, step=2e-3)
    simulation.run()
    kinds = [event["kind"] for event in simulation.report["events"]]
    assert any("left" in kind for kind in kinds)
    assert np.isnan(simulation.results.histories["bead.s"][-1])


def test_two_models_run_in_two_threads(tmp_path):
    expected = swinging().run(**RUN).histories
    found = {}

    def work(i):
        for k in range(3):
            results = swinging().run(**RUN, out=tmp_path / f"out{i}_{k}")
            found[i, k] = results.histories

    threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 6
    assert all(same(expected, histories) for histories in found.values())


def test_python_goes_on_while_a_run_computes():
    ticks = []
    done = threading.Event()

    def tick():
        while not done.wait(1e-3):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    swinging().run(end_time=40, step=1e-3, every=40)  # one call of the compiled part
    done.set()
    thread.join()
    assert len(ticks) > 10


def test_a_simulation_belongs_to_one_thread_at_a_time():
    simulation = swinging().simulate(end_time=5, step=1e-3)
    inside = []

    def law(t, position, velocity):
        if not inside:
            inside.append(True)
            with pytest.raises(RuntimeError, match="being advanced already"):
                nested.step()
        return 0.0, 0.0, 0.0

    model = swinging()
    model.add_force(law, beam="rod", at="end")
    nested = model.simulate(**RUN)
    nested.step()
    assert inside
    assert simulation.step()


INTERRUPTED = """
import os, signal, sys, threading, time
sys.path.insert(0, {tests!r})
from models import bending_stiffness, straight_cantilever
import nurbeam as nb

# Rolled up to five turns: one equilibrium, of a great many iterations.
roll = straight_cantilever(elements=3000)
roll.add_load("rod", at="end", moment=[0, 0, 10 * 3.1416 * bending_stiffness()])
rod = straight_cantilever(tip=[0, -1, 0], elements=40)
many = straight_cantilever(elements=3000)
adapted = straight_cantilever(elements={{"tolerance": 1e-9}})
adapted.add_load("rod", at="end", moment=[0, 0, 6 * 3.1416 * bending_stiffness()])
sent = []

def interrupt():
    sent.append(time.monotonic())
    os.kill(os.getpid(), signal.SIGINT)

threading.Timer(1.0, interrupt).start()
try:
    {what}
except KeyboardInterrupt:
    print("interrupted after", time.monotonic() - sent[0])
"""

@pytest.mark.parametrize(
    "what",
    [
        "rod.run(end_time=1e4, step=1e-3)",
        "rod.run(end_time=1e4, step=1e-3, out={out!r})",
        "list(rod.simulate(end_time=1e4, step=1e-3))",
        "rod.run(type='static', load_steps=10000)",
        "roll.run(type='static')",
        "roll.run(type='static', out={out!r})",
        "roll.run(end_time=1, step=1e-3, initial='equilibrium')",
        "roll.run(type='modes')",
        "many.modes(count=300)",
        "[rod.modes(count=20) for _ in range(100000)]",
        "[adapted.check(type='static') for _ in range(100000)]",
    ],
)
def test_control_c_ends_a_run_at_once(what, tmp_path):
    assert seconds_to_end(what.format(out=str(tmp_path / "out"))) < 3


@pytest.mark.parametrize("what", ["nb.read({file!r})", "nb.load({case!r}).check()"])
def test_control_c_ends_the_reading_of_a_file_at_once(what, tmp_path):
    reader = tmp_path / "reader"
    reader.write_text("#!/bin/sh\nexec sleep 60\n")
    reader.chmod(0o755)
    file = tmp_path / "slow.step"
    file.write_text("ISO-10303-21;")
    case = tmp_path / "case.json"
    case.write_text(json.dumps({"nurbeam": 1, "beams": [{
        "name": "rod", "axis": {"file": "slow.step"}, "section": {"radius": 0.01},
        "material": {"density": 1000, "youngs_modulus": 1e7}}], "analysis": {"type": "static"}}))
    ended = seconds_to_end(what.format(file=str(file), case=str(case)), NURBEAM_CAD=str(reader))
    assert ended < 3


def seconds_to_end(what, **environment):
    code = INTERRUPTED.format(tests=os.path.dirname(__file__), what=what)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60,
                          env={**os.environ, **environment})
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("interrupted after"), done.stdout + done.stderr
    return float(done.stdout.split()[-1])


def test_a_simulation_goes_on_after_control_c():
    simulation = swinging().simulate(**RUN)
    signal_sent = []

    class Interrupting:
        def __call__(self, t, position, velocity):
            if t > 0.02 and not signal_sent:
                signal_sent.append(t)
                os.kill(os.getpid(), signal.SIGINT)
            return 0.0, 0.0, 0.0

    model = swinging()
    model.add_force(Interrupting(), beam="rod", at="end")
    simulation = model.simulate(**RUN)
    with pytest.raises(KeyboardInterrupt):
        simulation.run()
    assert 0.015 < simulation.time < 0.03
    simulation.run()
    whole = swinging().run(**RUN)
    assert np.allclose(simulation.results.histories["tip.y"], whole.histories["tip.y"], atol=1e-9)


def test_a_checkpoint_keeps_what_set_load_has_set(tmp_path):
    simulation = swinging().simulate(**RUN)
    simulation.run_until(0.01)
    simulation.set_load(0, [0, -3, 0])
    simulation.run_until(0.0235)
    simulation.checkpoint.save(tmp_path / "point.nc")
    rest = swinging().simulate(**RUN, start=nb.Checkpoint.load(tmp_path / "point.nc"))
    again = rest.checkpoint
    whole, half = simulation.run().histories, rest.run().histories
    count = len(rest.results)
    for name, values in whole.items():
        assert np.array_equal(values[-count:], half[name], equal_nan=True), name
    assert same(half, swinging().simulate(**RUN, start=again).run().histories)


def test_a_checkpoint_of_another_model_is_refused(tmp_path):
    simulation = swinging().simulate(**RUN)
    simulation.run_until(0.0235)
    simulation.checkpoint.save(tmp_path / "point.nc")
    other = swinging()
    other.set("beams[0].material.density", 7000)
    for point in (simulation.checkpoint, nb.Checkpoint.load(tmp_path / "point.nc")):
        with pytest.raises(ValueError, match='of another model, which differs in "beams"; go on'):
            other.simulate(**RUN, start=point)
    swinging().run(**RUN, out=tmp_path / "out")
    with pytest.raises(ValueError, match="of another model"):
        other.simulate(**RUN, start=nb.Checkpoint.load(tmp_path / "out" / "restart.nc"))
    swinging().simulate(**RUN, start=nb.Checkpoint.load(tmp_path / "out" / "restart.nc"))


def test_what_does_not_move_cannot_go_on_from_a_checkpoint():
    simulation = swinging().simulate(**RUN)
    simulation.run_until(0.01)
    with pytest.raises(ValueError, match='no motion goes on in an analysis of the type "static"; leave start out'):
        swinging().simulate(type="static", start=simulation.checkpoint)


def test_resuming_a_run_with_functions_says_that_they_are_not_compared(tmp_path):
    def pushed(by):
        model = straight_cantilever()
        model.add_force(lambda t, r, v: (0, by, 0), beam="rod", at="end")
        return model

    pushed(1).run(end_time=0.01, step=1e-3, out=tmp_path / "out")
    with pytest.warns(nb.CaseWarning, match="the functions of the model cannot be compared"):
        pushed(2).run(end_time=0.01, step=1e-3, out=tmp_path / "out", resume=True)


def pressed_column(load):
    """On two pins, with an Euler load of 54 N; `load` along x."""
    model = nb.Model(gravity=[0, 0, 0])
    beam = model.add_beam([[0, 0, 0], [1, 0, 0]], section=nb.Circle(radius=0.0024), material=nb.Material(7850, 2.1e11),
                          elements=8)
    model.add_support(beam, at="start", type="pinned")
    model.add_support(beam, at="end", type="guided", direction=[1, 0, 0])
    model.add_load(beam, at="end", force=[-load, 0, 0])
    return model


@pytest.mark.parametrize("out", [None, "out"])
def test_what_a_run_rings_is_given_as_a_warning(tmp_path, out):
    where = {} if out is None else {"out": tmp_path / out, "progress": False}
    euler = np.pi**2 * 2.1e11 * np.pi / 4 * 0.0024**4
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        pressed_column(0.9 * euler).run(type="static", **where)
    with pytest.warns(nb.CaseWarning, match="snaps through or buckles") as told:
        results = pressed_column(1.5 * euler).run(type="static", **where)
    said = results.report["warnings"] if out is None else results.report["diagnostics"]
    assert len(told) == 1 and len(said) == 1
    loose = nb.Model(gravity=[0, 0, 0])
    beam = loose.add_beam([[0, 0, 0], [1, 0, 0]], section=nb.Circle(radius=0.005), material="steel", elements=4)
    loose.add_support(beam, at="start", type="pinned")
    with pytest.warns(nb.CaseWarning, match="nothing resists a motion"):
        loose.run(type="static", **where)


def test_what_is_left_out_of_a_cad_file_is_given_as_a_warning(tmp_path):
    nb.write(tmp_path / "two.step", [nb.Curve.line([x, 0, 0], [x + 1, 0, 0]) for x in (0, 1)])
    model = nb.Model(gravity=[0, 0, -9.81])
    beam = model.add_beam({"file": str(tmp_path / "two.step")}, section=nb.Circle(radius=0.01), material="steel", elements=4)
    model.add_support(beam, at="start", type="clamped")
    model.case["output"] = {"cad": {"formats": ["step-source"]}}
    with pytest.warns(nb.CaseWarning, match="is a chain of several curves") as told:
        model.run(type="static", out=tmp_path / "out", progress=False)
    assert len(told) == 1


def test_modes_that_fail_are_not_said_to_be_few():
    model = nb.Model(gravity=[0, 0, 0])
    beam = model.add_beam([[0, 0, 0], [1, 0, 0]], section=nb.Circle(radius=0.005), material="steel", elements=8,
                          tension=-3000)
    model.add_support(beam, at="start", type="clamped")
    with pytest.raises(nb.RunError, match="the state is unstable") as failed:
        model.modes(about="drawn")
    assert failed.value.results.report["warnings"] == []


def raising(t, r, v):
    raise ZeroDivisionError("my own")


@pytest.mark.parametrize(("late", "error", "message"), [
    (raising, ZeroDivisionError, "my own"),
    (lambda t, r, v: (0, np.nan, 0), ValueError, "a force must be finite"),
    (lambda t, r, v: None, TypeError, "expected the force"),
])
def test_frames_until_a_law_raises_are_there(tmp_path, late, error, message):
    model = straight_cantilever()
    model.add_force(lambda t, r, v: late(t, r, v) if t > 0.03 else (0, -1, 0), beam="rod", at="end")
    with pytest.raises(error, match=message):
        model.run(**RUN, out=tmp_path / "out", progress=False)
    results = nb.Results(tmp_path / "out")
    assert len(results) == 7 and results.times[-1] == pytest.approx(0.03)
    assert results.report["status"].startswith("interrupted at t = 0.03")
    assert not list((tmp_path / "out").glob("*.part"))


def test_a_load_that_is_none_is_refused():
    model = straight_cantilever()
    load = model.add_load("rod", at="end", force=[0, -1, 0])
    simulation = model.simulate(**RUN)
    for which in load, 0, np.int64(0):
        simulation.set_load(which, [0, -2, 0])
    for which in "x", 1.5, -1, 1:
        with pytest.raises(ValueError, match="load"):
            simulation.set_load(which, [0, -2, 0])
