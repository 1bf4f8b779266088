"""Loads of a model, by which they are changed while it runs."""

from __future__ import annotations

__all__ = ["Load"]


class Load:
    """A load of a model; `number` is its position among the loads of the case."""

    def __init__(self, number: int):
        self.number = number

    def __repr__(self) -> str:
        return f"<Load {self.number}>"
