"""The equations of motion, for research on top of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import unknown

if TYPE_CHECKING:
    import scipy.sparse

__all__ = ["System"]

Array = npt.NDArray[np.float64]


class System:
    """M(q) a + G' multipliers = f(q, v, t), g(q, t) = 0 of a model in one mesh, at a state.

    n coordinates, m constraints; all in SI units and in the model's own coordinates (of a planar model its plane's x and
    y). Every method takes another state part by part: `system.residual(q=..., v=...)`; what is left out is that of the
    state.
    """

    def __init__(self, core: _core.Equations):
        self._core = core

    @property
    def coordinates(self) -> list[str]:
        """The name of each coordinate, (n): "cable[3].x", "cable[3].slope.y", "trolley.x", "trolley.s", ... The position of
        a body that slides on several beams has the beam's name too, "trolley.cable.s". A node on which a body slides has
        its position in the body's coordinates."""
        return self._core.coordinates()

    @property
    def rows(self) -> list[str]:
        """The name of each row of the constraints, (m): of the support, the joint, the body, the rod or the stop that
        asks for it, "reaction.cable.start[2]" where it asks for several."""
        return self._core.rows()

    def index(self, name: str) -> int:
        """The number of a coordinate."""
        names = self.coordinates
        if name not in names:
            raise KeyError(unknown("coordinate", name, names))
        return names.index(name)

    @property
    def t(self) -> float:
        """[s]"""
        return self._core.t

    @property
    def q(self) -> Array:
        """(n,) positions"""
        return self._core.q

    @property
    def v(self) -> Array:
        """(n,) dq/dt"""
        return self._core.v

    @property
    def a(self) -> Array:
        """(n,) d2q/dt2"""
        return self._core.a

    @property
    def multipliers(self) -> Array:
        """(m,), in the order of `rows`"""
        return self._core.multipliers

    @property
    def energy(self) -> float:
        """Kinetic, strain and gravity energy [J], this against the start of the first beam."""
        return self._core.energy()

    def residual(
        self,
        t: float | None = None,
        q: npt.ArrayLike | None = None,
        v: npt.ArrayLike | None = None,
        a: npt.ArrayLike | None = None,
        multipliers: npt.ArrayLike | None = None,
    ) -> tuple[Array, Array]:
        """M a - f + G' multipliers, (n,), and g, (m,)."""
        return self._core.residual(t, q, v, a, multipliers)

    def tangent(
        self,
        mass: float = 0,
        damping: float = 0,
        stiffness: float = 0,
        t: float | None = None,
        q: npt.ArrayLike | None = None,
        v: npt.ArrayLike | None = None,
        a: npt.ArrayLike | None = None,
        multipliers: npt.ArrayLike | None = None,
    ) -> scipy.sparse.csc_matrix:
        """[[mass dF/da + damping dF/dv + stiffness dF/dq, G'], [G, 0]], (n + m, n + m), F the first part of the
        residual."""
        return self._core.tangent(mass, damping, stiffness, t, q, v, a, multipliers)

    def _block(self, matrix: scipy.sparse.csc_matrix) -> scipy.sparse.csc_matrix:
        n = len(self.q)
        return matrix[:n, :n]

    def mass(self, q: npt.ArrayLike | None = None) -> scipy.sparse.csc_matrix:
        """M, (n, n)."""
        return self._block(self.tangent(mass=1, q=q))

    def stiffness(
        self, q: npt.ArrayLike | None = None, multipliers: npt.ArrayLike | None = None
    ) -> scipy.sparse.csc_matrix:
        """dF/dq, (n, n): of elements, loads, inertia and the curvature of constraints."""
        return self._block(self.tangent(stiffness=1, q=q, multipliers=multipliers))

    def damping(self, q: npt.ArrayLike | None = None, v: npt.ArrayLike | None = None) -> scipy.sparse.csc_matrix:
        """dF/dv, (n, n)."""
        return self._block(self.tangent(damping=1, q=q, v=v))

    def constraint_gradient(self, q: npt.ArrayLike | None = None) -> scipy.sparse.csc_matrix:
        """G = dg/dq, (m, n)."""
        n = len(self.q)
        return self.tangent(q=q)[n:, :n]
