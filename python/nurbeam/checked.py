"""Pickles with checksums: damaged ones are refused."""

from __future__ import annotations

import hashlib
import json
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np

from . import _core

__all__ = ["reduced"]


def recording_of(pickled: bytes) -> _core.Recording:
    """Of what its __reduce__ gives."""
    return _core.recording_of(pickled)


def frame_of(pickled: bytes) -> _core.Frame:
    """Of what its __reduce__ gives."""
    return _core.frame_of(pickled)


def nurbs_of(pickled: bytes) -> _core.Nurbs:
    """Of what its __reduce__ gives."""
    return _core.nurbs_of(pickled)


def _plain(value: Any) -> Any:
    """What JSON does not know. Objects of other modules are pickled by themselves, as they like."""
    if isinstance(value, np.ndarray):
        return [str(value.dtype), value.shape, value.tobytes().hex()]
    return type(value).__name__


def _checksum(parts: Any) -> str:
    return hashlib.sha256(json.dumps(parts, sort_keys=True, default=_plain).encode()).hexdigest()


def restored(make: Callable[..., Any], parts: tuple[Any, ...], checksum: str) -> Any:
    """make(*parts), where these are the parts that were pickled."""
    if _checksum(parts) != checksum:
        raise pickle.UnpicklingError(
            "the pickle is damaged or was changed: it has not the checksum (SHA-256) that it was written with; "
            "take an undamaged copy, or make it anew"
        )
    return make(*parts)


def reduced(make: Callable[..., Any], *parts: Any) -> Any:
    """What __reduce__ returns: an object is made anew by make(*parts)."""
    return restored, (make, parts, _checksum(parts))
