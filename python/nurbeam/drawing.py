"""Curves as SVG, for notebooks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

__all__: list[str] = []


def plane_of(points: npt.NDArray[np.float64]) -> tuple[npt.NDArray[np.float64], tuple[str, str]]:
    """The two world axes along which points extend most, upright ones up: their (2, 3) unit vectors and names."""
    extent = np.ptp(points, axis=0)
    keep = sorted(np.argsort(extent, kind="stable")[1:])
    if extent[2] == 0 and extent[0] > 0 and extent[1] == 0:
        keep = [0, 2]  # a line along x: drawn in the upright plane
    return np.eye(3)[keep], ("xyz"[keep[0]], "xyz"[keep[1]])


def svg(lines: Sequence[npt.NDArray[np.float64]], width: int = 480) -> str:
    """Lines through points (n, 3), seen along the world axis along which they extend least."""
    axes, _ = plane_of(np.concatenate(lines))
    flat = [line @ axes.T * [1, -1] for line in lines]
    low = np.min([line.min(axis=0) for line in flat], axis=0)
    high = np.max([line.max(axis=0) for line in flat], axis=0)
    size = max(float(np.max(high - low)), 1e-12)
    margin = 0.03 * size
    x, y = low - margin
    w, h = high - low + 2 * margin
    h = max(h, 0.1 * w)
    paths = "".join(
        '<polyline fill="none" stroke="#1f6f8b" vector-effect="non-scaling-stroke" stroke-width="2" points="'
        + " ".join(f"{a:.6g},{b:.6g}" for a, b in line)
        + '"/>'
        for line in flat
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{max(40, round(width * h / w))}" '
        f'viewBox="{x:.6g} {y:.6g} {w:.6g} {h:.6g}">{paths}</svg>'
    )
