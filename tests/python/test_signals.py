"""Inputs of a run that goes on: forces, drives and wind that are set between steps."""

import math
import pickle
import time

import numpy as np
import pytest
from models import straight_cantilever

import nurbeam as nb

STEP = 5e-4


def pushed(force):
    """A cantilever whose tip a force pushes, and nothing else."""
    model = straight_cantilever(tip=[0, 0, 0])
    model.case["loads"] = []
    model.add_probe("tip", "rod", "end")
    model.add_force(force, beam="rod", at="end")
    return model


def push(t):
    return np.array([0, -2 * (1 + math.sin(25 * t)), 0])


def rate(t):
    return np.array([0, -50 * math.cos(25 * t), 0])


def reached(every, sloped, end=0.16):
    """Where the tip is, with the force set in such intervals."""
    signal = nb.Signal(push(0))
    simulation = pushed(signal).simulate(end_time=end, step=STEP)
    simulation.step()
    for k in range(round(end / every)):
        t = k * every
        simulation.set(signal, push(t), rate(t) if sloped else None)
        simulation.run_until(t + every - STEP / 2)
    return simulation.snapshot.probes["tip"].position


def test_held_forces_are_of_first_order_and_sloped_ones_of_second():
    exact = pushed(lambda t, r, v: push(t)).run(end_time=0.16, step=STEP)[-1].probes["tip"].position
    held = [np.linalg.norm(reached(every, False) - exact) for every in (16e-3, 8e-3, 4e-3)]
    sloped = [np.linalg.norm(reached(every, True) - exact) for every in (16e-3, 8e-3, 4e-3)]
    assert held[0] / held[1] == pytest.approx(2, rel=0.25) and held[1] / held[2] == pytest.approx(2, rel=0.25)
    assert sloped[0] / sloped[1] == pytest.approx(4, rel=0.3) and sloped[1] / sloped[2] == pytest.approx(4, rel=0.3)
    assert sloped[2] < held[2] / 10


def test_setting_a_force_costs_no_restart():
    def taken(set_it):
        signal = nb.Signal([0, -2, 0])
        simulation = pushed(signal).simulate(end_time=0.2, step=STEP)
        simulation.step()
        begin = time.process_time()
        while simulation.step():
            if set_it:
                simulation.set(signal, [0, -2, 0])
        return time.process_time() - begin, simulation.snapshot.probes["tip"].position

    alone, set_again = taken(False), taken(True)
    assert np.array_equal(alone[1], set_again[1])  # to the last bit
    assert min(taken(True)[0], set_again[0]) < 1.5 * max(taken(False)[0], alone[0]) + 0.02


def driven(speed):
    model = nb.Model(gravity=[0, 0, -9.81])
    model.add("beams", name="rail", rigid=True, axis={"polyline": [[0, 0, 0], [4, 0, 0]]})
    car = model.add_body("car", mass=2)
    model.add_sliding_joint(car, "rail", at={"length": 1}, motion=speed)
    return model


def test_a_drive_follows_its_speed():
    speed = nb.Signal(0)
    simulation = driven(speed).simulate(end_time=2, step=1e-2)
    simulation.step()
    simulation.ramp(speed, 0.8, by=0.5)
    simulation.run_until(1 - 1e-6)
    # A quarter of a second's way on the ramp counts half: 0.8 (0.25 + 0.5).
    assert simulation.values("car.s", "car.speed") == pytest.approx([1 + 0.8 * 0.75, 0.8], abs=1e-6)
    with pytest.raises(ValueError, match="cannot jump from 0.8 to 0.1 m/s.*ramp"):
        simulation.set(speed, 0.1)
    simulation.set(speed, 0.8, slope=-0.4)
    simulation.run_until(2)
    assert simulation.values("car.speed")[0] == pytest.approx(0.4, abs=1e-6)


def test_bodies_feel_the_wind_that_is_set():
    model = nb.Model(gravity=[0, 0, 0], air={"density": 1.2, "wind": [0, 0, 0]})
    model.add("beams", name="rail", rigid=True, axis={"polyline": [[0, 0, 0], [40, 0, 0]]})
    kite = model.add_body("kite", mass=3, drag_area=0.5)
    model.add_sliding_joint(kite, "rail", at={"length": 1})
    wind = nb.Signal([5.0, 0, 0])
    model.set_wind(wind)
    simulation = model.simulate(end_time=3, step=5e-3)
    simulation.run_until(1.5)
    # u = wind - v falls as 1/(1/u0 + k t), with k = rho A/(2 m).
    k = 1.2 * 0.5 / (2 * 3)
    now = simulation.time
    assert simulation.values("kite.vx")[0] == pytest.approx(5 - 1 / (1 / 5 + k * now), rel=1e-4)
    assert abs(simulation.report["energy_drift"]) < 1e-3
    before = simulation.values("kite.vx")[0]
    simulation.set(wind, [before, 0, 0])
    simulation.run_until(now + 0.02)
    # The step in which the wind dropped has half of the force before it.
    after = simulation.values("kite.vx")[0]
    assert after == pytest.approx(before + 5e-3 / 2 * k * (5 - before) ** 2, abs=2e-4)
    simulation.run_until(3)
    assert simulation.values("kite.vx")[0] == pytest.approx(after, rel=1e-5)


def test_wrong_signals_are_refused():
    with pytest.raises(ValueError, match="expected a number or"):
        nb.Signal([1, 2])
    other, pull = nb.Signal([0, 0, 0]), nb.Signal([0, -1, 0])
    simulation = pushed(pull).simulate(end_time=0.01, step=1e-3)
    simulation.step()
    with pytest.raises(ValueError, match="not of this model"):
        simulation.set(other, [0, 0, 0])
    with pytest.raises(ValueError, match="shape"):
        simulation.set(pull, 3)
    with pytest.raises(ValueError, match="finite"):
        simulation.set(pull, [0, float("nan"), 0])
    with pytest.raises(ValueError, match="later time"):
        simulation.ramp(pull, [0, 0, 0], by=0)
    with pytest.raises(KeyError, match='did you mean "tip.y"'):
        simulation.values("tip.yy")
    with pytest.raises(ValueError, match="numbers; expected 3"):
        pushed(nb.Signal(1.0)).run(end_time=0.01, step=1e-3)
    with pytest.raises(nb.Error, match="signals"):
        pushed(pull).save("never.json")


def test_values_are_those_of_the_snapshot():
    simulation = pushed(lambda t, r, v: push(t)).simulate(end_time=0.05, step=1e-3)
    simulation.run_until(0.02)
    names = [name for name in simulation.results.histories if name != "time" and simulation.results.histories[name].ndim == 1]
    now = simulation.snapshot
    for name, value in zip(names, simulation.values(*names)):
        assert value == now[name] or (math.isnan(value) and math.isnan(now[name])), name


def test_a_checkpoint_in_memory_goes_on_and_is_checked():
    pull = nb.Signal([0, -2, 0])
    simulation = pushed(pull).simulate(end_time=0.1, step=1e-3)
    simulation.run_until(0.03)
    simulation.set(pull, [0, -2, 0], slope=[0, 30, 0])
    kept = pickle.loads(pickle.dumps(simulation.checkpoint)).to_bytes()
    simulation.run()
    again = pushed(pull).simulate(end_time=0.1, step=1e-3, start=nb.Checkpoint.from_bytes(kept))
    assert again.time == pytest.approx(0.03, abs=1e-3)
    again.run()
    assert np.array_equal(again.snapshot.probes["tip"].position, simulation.snapshot.probes["tip"].position)
    for at in (3, 20, 45, 60, len(kept) // 2, len(kept) - 1):
        damaged = bytearray(kept)
        damaged[at] ^= 1
        with pytest.raises(ValueError, match="checkpoint"):
            nb.Checkpoint.from_bytes(bytes(damaged))
    with pytest.raises(ValueError, match="to_bytes"):
        nb.Checkpoint.from_bytes(kept).save("never.nc")
