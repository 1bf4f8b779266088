"""How far a run has come."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from . import _core

__all__: list[str] = []


@contextlib.contextmanager
def progress_bar(case: _core.BuiltCase, shown: bool | None) -> Iterator[Callable[[float], None] | None]:
    """Takes the times that a run has reached. None where nothing is to be shown, or tqdm is not installed."""
    wanted = sys.stderr.isatty() if shown is None else shown
    if not wanted or case.analysis != "dynamic":
        yield None
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    form = "{l_bar}{bar}| {n:.4g} of {total:.4g} s [{elapsed}<{remaining}]"
    with tqdm(total=case.end_time, desc=case.name, bar_format=form, delay=0 if shown else 1) as bar:

        def told(time: float) -> None:
            bar.update(time - bar.n)

        yield told
