"""Pictures of results, by matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from .drawing import plane_of
from .errors import unknown

if TYPE_CHECKING:
    import matplotlib.axes

    from .results import Results

__all__: list[str] = []


def _axes(ax: matplotlib.axes.Axes | None) -> matplotlib.axes.Axes:
    if ax is not None:
        return ax
    import matplotlib.pyplot

    return matplotlib.pyplot.subplots()[1]


def histories(results: Results, names: Sequence[str], ax: matplotlib.axes.Axes | None) -> matplotlib.axes.Axes:
    """Over time; without names the energies."""
    of = results.histories
    names = names or [name for name in of if name.startswith("energy.")]
    columns = {name: (of[name], of.unit(name)) for name in names}
    ax = _axes(ax)
    for name, (values, unit) in columns.items():
        parts = [(name, values)] if values.ndim == 1 else [(f"{name}.{c}", values[:, i]) for i, c in enumerate("xyz")]
        for label, part in parts:
            ax.plot(results.times, part, label=f"{label} [{unit}]")
    ax.set_xlabel("time [s]")
    units = {unit for _, unit in columns.values()}
    if len(columns) == 1 and ax.lines[-1] is not None and next(iter(columns.values()))[0].ndim == 1:
        ax.set_ylabel(ax.lines[-1].get_label())
    else:
        ax.set_ylabel(f"[{units.pop()}]" if len(units) == 1 else "")
        ax.legend()
    return ax


def shapes(results: Results, times: Sequence[float] | None, ax: matplotlib.axes.Axes | None) -> matplotlib.axes.Axes:
    """At times, the later the darker."""
    if times is None:
        chosen = [results[int(i)] for i in np.unique(np.linspace(0, len(results) - 1, 6).round())]
    else:
        chosen = [results.at(time) for time in times]
    lines = [[beam.points() for beam in snapshot.beams.values()] for snapshot in chosen]
    axes, names = plane_of(np.concatenate([line for at_time in lines for line in at_time]))
    ax = _axes(ax)
    for i, (snapshot, at_time) in enumerate(zip(chosen, lines)):
        colour = (0.1, 0.3, 0.5, 0.3 + 0.7 * (i + 1) / len(chosen))
        for k, line in enumerate(at_time):
            ax.plot(*(line @ axes.T).T, color=colour, label=f"{snapshot.time:.4g} s" if k == 0 else None)
        for motion in snapshot.bodies.values():
            ax.plot(*(motion.position @ axes.T), "o", color=colour)
    ax.set_xlabel(f"{names[0]} [m]")
    ax.set_ylabel(f"{names[1]} [m]")
    ax.axis("equal")
    ax.legend()
    return ax


def along(
    results: Results, field: str, beam: str | None, time: float | None, ax: matplotlib.axes.Axes | None
) -> matplotlib.axes.Axes:
    """Over reference arc length."""
    snapshot = results[-1] if time is None else results.at(time)
    name = results.beams[0] if beam is None else beam
    if name not in snapshot.beams:
        raise KeyError(unknown("beam", name, snapshot.beams))
    shape = snapshot.beams[name]
    values = shape.field(field)
    ax = _axes(ax)
    ax.plot(shape.s, values, label=[f"{field}.{c}" for c in "xyz"] if values.ndim == 2 else f"{snapshot.time:.4g} s")
    ax.set_xlabel("s [m]")
    ax.set_ylabel(f"{field} of {name}")
    ax.legend()
    return ax
