"""Pictures of histories, shapes and sections, by matplotlib."""

from __future__ import annotations

import re

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .drawing import plane_of

if TYPE_CHECKING:
    import matplotlib.animation
    import matplotlib.axes

__all__: list[str] = []

Array = npt.NDArray[np.float64]


class Picture(NamedTuple):
    """What there is to see at a moment."""

    time: float
    """[s]"""
    beams: list[Array]
    """(n, 3) of points along each [m]"""
    bodies: list[Array]
    """(3,) each [m]"""


def _axes(ax: matplotlib.axes.Axes | None) -> matplotlib.axes.Axes:
    if ax is not None:
        return ax
    import matplotlib.pyplot

    return matplotlib.pyplot.subplots()[1]


def histories(
    times: Array,
    columns: Mapping[str, tuple[Array, str]],
    ax: matplotlib.axes.Axes | None,
    errors: Mapping[str, Array] | None = None,
) -> matplotlib.axes.Axes:
    """Over time, each with its unit, and with its error as a band where that is known."""
    ax = _axes(ax)
    for name, (values, unit) in columns.items():
        parts = [(name, values)] if values.ndim == 1 else [(f"{name}.{c}", values[:, i]) for i, c in enumerate("xyz")]
        for label, part in parts:
            line = ax.plot(times, part, label=f"{label} [{unit}]")[0]
            if errors is not None and label in errors and len(errors[label]) == len(part):
                low, high = part - errors[label], part + errors[label]
                ax.fill_between(times, low, high, color=line.get_color(), alpha=0.25, linewidth=0)
    ax.set_xlabel("time [s]")
    units = {unit for _, unit in columns.values()}
    if len(columns) == 1 and ax.lines[-1] is not None and next(iter(columns.values()))[0].ndim == 1:
        ax.set_ylabel(ax.lines[-1].get_label())
    else:
        ax.set_ylabel(f"[{units.pop()}]" if len(units) == 1 else "")
        ax.legend()
    return ax


def shapes(
    pictures: Sequence[Picture], ax: matplotlib.axes.Axes | None, drawn: Sequence[Array] = ()
) -> matplotlib.axes.Axes:
    """At times, the later the darker; what is drawn in grey."""
    axes, names = plane_of(np.concatenate([line for picture in pictures for line in picture.beams]))
    ax = _axes(ax)
    for k, line in enumerate(drawn):
        ax.plot(*(line @ axes.T).T, color="0.7", linewidth=1, label="drawn" if k == 0 else None)
    for i, picture in enumerate(pictures):
        colour = (0.1, 0.3, 0.5, 0.3 + 0.7 * (i + 1) / len(pictures))
        for k, line in enumerate(picture.beams):
            ax.plot(*(line @ axes.T).T, color=colour, label=f"{picture.time:.4g} s" if k == 0 else None)
        for position in picture.bodies:
            ax.plot(*(position @ axes.T), "o", color=colour)
    ax.set_xlabel(f"{names[0]} [m]")
    ax.set_ylabel(f"{names[1]} [m]")
    ax.axis("equal")
    ax.legend()
    return ax


def animation(pictures: Sequence[Picture], fps: float) -> matplotlib.animation.FuncAnimation:
    """One picture after the other."""
    import matplotlib.animation
    import matplotlib.pyplot

    every = np.concatenate([line for picture in pictures for line in [*picture.beams, *(b[None] for b in picture.bodies)]])
    axes, names = plane_of(every)
    figure, ax = matplotlib.pyplot.subplots()
    flat = every @ axes.T
    margin = 0.05 * float(np.max(np.ptp(flat, axis=0))) or 1.0
    (left, low), (right, high) = flat.min(axis=0) - margin, flat.max(axis=0) + margin
    ax.set(xlim=(left, right), ylim=(low, high), xlabel=f"{names[0]} [m]", ylabel=f"{names[1]} [m]", aspect="equal")
    lines = [ax.plot([], [], color="#1f6f8b")[0] for _ in pictures[0].beams]
    dots = [ax.plot([], [], "o", color="#1c2a3a")[0] for _ in pictures[0].bodies]

    def show(i: int) -> list[Any]:
        for line, points in zip(lines, pictures[i].beams):
            line.set_data(*(points @ axes.T).T)
        for dot, position in zip(dots, pictures[i].bodies):
            dot.set_data(*(position @ axes.T)[:, None])
        ax.set_title(f"{pictures[i].time:.4g} s")
        return [*lines, *dots]

    return matplotlib.animation.FuncAnimation(figure, show, frames=len(pictures), interval=1000 / fps)


def save_animation(shown: matplotlib.animation.FuncAnimation, file: str, fps: float) -> None:
    """As .gif, .mp4 or .html, by the ending. ValueError for another one."""
    ending = file.rpartition(".")[2].lower()
    if ending == "html":
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(_without_network(shown.to_jshtml(fps=fps)))
    elif ending in ("gif", "mp4"):
        shown.save(file, writer="pillow" if ending == "gif" else "ffmpeg", fps=fps)
    else:
        raise ValueError(f'the ending of "{file}" names no animation; known are .gif .mp4 .html')


def _without_network(page: str) -> str:
    """A page of matplotlib's, whose buttons have signs of the reader's own fonts in place of a font from the network."""
    signs = {"minus": "\N{MINUS SIGN}", "fast-backward": "|\N{BLACK LEFT-POINTING DOUBLE TRIANGLE}",
             "step-backward": "|\N{BLACK LEFT-POINTING TRIANGLE}", "play fa-flip-horizontal": "\N{BLACK LEFT-POINTING TRIANGLE}",
             "pause": "||", "play": "\N{BLACK RIGHT-POINTING TRIANGLE}", "step-forward": "\N{BLACK RIGHT-POINTING TRIANGLE}|",
             "fast-forward": "\N{BLACK RIGHT-POINTING DOUBLE TRIANGLE}|", "plus": "+"}  # fmt: skip
    page = re.sub(r"<link[^>]*https?://[^>]*>", "", page)
    for name, sign in signs.items():
        page = page.replace(f'<i class="fa fa-{name}"></i>', f"<span>{sign}</span>")
    return page


def along(
    s: Array, values: Array, what: str, field: str, time: float, ax: matplotlib.axes.Axes | None
) -> matplotlib.axes.Axes:
    """Over reference arc length."""
    ax = _axes(ax)
    ax.plot(s, values, label=[f"{field}.{c}" for c in "xyz"] if values.ndim == 2 else f"{time:.4g} s")
    ax.set_xlabel("s [m]")
    ax.set_ylabel(what)
    ax.legend()
    return ax
