"""The report page of a run that is in memory."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

from . import _core

__all__: list[str] = []


def page_of(recording: _core.Recording, report: Mapping[str, Any], summary: str) -> str:
    """The page, as HTML that needs nothing else; `summary` describes the model, "" where it is not known."""
    return _core.report_page(recording, json.dumps(_without_nan(_run_json(recording, report, summary)), allow_nan=False))


def _run_json(recording: _core.Recording, report: Mapping[str, Any], summary: str) -> dict[str, Any]:
    """What the page asks of run.json."""
    run: dict[str, Any] = {
        "nurbeam": _core.version,
        "case": recording.title,
        "status": report["status"],
        "steps": report.get("steps", 0),
        "rejected_steps": report.get("rejected_steps", 0),
        "newton_iterations": report.get("newton_iterations", 0),
        "energy_drift [J]": report.get("energy_drift", 0),
        "extremes": report.get("extremes", []),
        "wall_times [s]": {"motion": report.get("seconds", 0)},
        "inputs": [],
        "events": [
            {**event, "time [s]": event["time"], "s [m]": event["s"], "energy_before [J]": None, "energy_after [J]": None}
            for event in report.get("events", [])
        ],
        "diagnostics": [dict(zip(("severity", "where", "message"), each)) for each in report.get("warnings", [])],
    }
    if summary:
        run["model"] = json.loads(summary)
    if table := recording.modes():
        buckling, _, rows = table
        run["buckling" if buckling else "modes"] = [
            {"number": i, "factor": factor} if buckling else {"number": i, "frequency [Hz]": omega / (2 * math.pi)}
            for i, (omega, factor, *_) in enumerate(rows, 1)
        ]
    return run


def _without_nan(value: Any) -> Any:
    """JSON's null for numbers that it has no words for."""
    if isinstance(value, dict):
        return {key: _without_nan(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_without_nan(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
