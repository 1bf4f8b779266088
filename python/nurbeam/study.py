"""Many variants of a case, and what they answer."""

from __future__ import annotations

import csv
import hashlib
import io
import itertools
import json
import math
import operator
import os
import shutil
import subprocess
import tempfile
import weakref
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import CaseError, Error, Finding, MissingCase, tell, unknown
from .model import Model, _json, _not_finite, _rename_files
from .results import Results, RunError

if TYPE_CHECKING:
    import pandas

__all__ = ["study", "Study", "vary"]

Array = npt.NDArray[np.float64]


class Study(Mapping[str, Array]):
    """What a study has left in its directory: columns over its variants, by the names of variables and quantities;
    NaN where a variant failed.

    `units` are those of the quantities that have one, `statuses` and `reasons` say how each variant ended; `answer` is what
    the study found: Sobol indices, a probability, the best variants, derivatives of quantities; None for another plan. Of
    an optimum that is subject to probabilities, `answer["probabilities"]` has for each: "constraint",
    "least_reliability_index", FORM's "probability", "reliability_index", "design_point" and "importance", the
    "reliability_index_gradient" by the design variables, and "check", the simulation, where the study asks for one.
    `surrogates` has, where the study asks for them, one for each quantity: "quantity", "q2" (1: exact), "largest_error" at
    the variants held back, "sobol_indices".
    """

    def __init__(self, directory: str | os.PathLike[str]):
        self.directory = Path(directory)
        try:
            summary = json.loads(_core.checked_json(self.directory / "study.json"))
        except (RuntimeError, ValueError) as problem:
            raise Error(str(problem)) from None
        table = self.directory / "study.csv"
        if not table.is_file():
            raise Error(f"{table}: there is no such file; expected a directory that a study has left")
        text = table.read_bytes()
        for each in summary.get("files", []):
            if each["file"] == table.name and each["sha256"] != hashlib.sha256(text).hexdigest():
                raise Error(
                    f"{table}: is damaged or was changed: it has not the checksum (SHA-256) that study.json says; "
                    "take an undamaged copy, or make it anew with resume=True"
                )
        rows = list(csv.reader(io.StringIO(text.decode("utf-8"), newline="")))
        heading, rows = rows[0], rows[1:]
        last = heading.index("status")
        self.statuses: list[str] = [row[last] for row in rows]
        """"done", "rejected", "refused", "failed", "timed out" or "crashed"."""
        self.reasons: list[str] = [row[last + 2] for row in rows]
        """Why a variant failed; empty where it did not."""
        self._columns: dict[str, Array] = {}
        self.units: dict[str, str] = {}
        """Of the quantities that have one."""
        names = {each["name"] for key in ("variables", "quantities") for each in summary["study"].get(key, [])}
        for i, title in enumerate(heading[1:last], start=1):
            has_unit = title not in names and title.endswith("]")
            name, unit = title.removesuffix("]").rsplit(" [", 1) if has_unit else (title, "")
            if unit:
                self.units[name] = unit
            self._columns[name] = np.array([float(row[i]) if row[i] else math.nan for row in rows])
        self.answer: dict[str, Any] | None = summary["answer"]
        self.surrogates: list[dict[str, Any]] = summary["surrogates"]
        """Of each quantity, where the study asks for surrogates: q2, largest_error, sobol_indices."""

    def __getitem__(self, name: str) -> Array:
        if name not in self._columns:
            raise KeyError(unknown("column", name, self._columns))
        return self._columns[name]

    def __iter__(self) -> Any:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        done = self.statuses.count("done")
        return f"<Study of {len(self.statuses)} variants, {done} done: {', '.join(self._columns)}>"

    def to_dataframe(self) -> pandas.DataFrame:
        """The columns and the statuses, a row for each variant."""
        import pandas

        columns: dict[str, Any] = {**self._columns, "status": self.statuses}
        return pandas.DataFrame(columns)


def _jobs(jobs: int | None) -> int:
    cores = os.cpu_count() or 1
    try:
        count = cores if jobs is None else operator.index(jobs)
    except TypeError:
        count = 0
    if count < 1:
        raise ValueError(f"jobs is {jobs!r}; must be a whole number of at least 1, or None: one for each core, here {cores}")
    return count


def _finding(line: str, file: Path) -> Finding:
    """What the program says in a line: "warning: study.json: variables[0].path: ..."."""
    severity, _, rest = line.partition(": ")
    if severity not in ("error", "warning", "note"):
        severity, rest = "error", line
    where, _, message = rest.partition(": ")
    return Finding(severity, where, message) if message else Finding(severity, str(file), rest)


def _described(study: Mapping[str, Any]) -> Any:
    """As a study file has it."""
    described = _json(study)
    if wrong := _not_finite(described):
        raise CaseError([Finding(f.severity, f"study: {f.where}", f.message) for f in wrong])
    if isinstance(described.get("case"), str):
        described["case"] = os.path.abspath(described["case"])
    _rename_files(described, os.path.abspath)  # they are looked for beside the study file, which is elsewhere
    return described


def _run(file: Path, directory: Path, jobs: int, resume: bool) -> Study:
    words = [str(_core.study_program()), "run", str(file), str(directory), str(jobs),
             "resume" if resume else "new", "quiet"]  # fmt: skip
    ended = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    findings = [_finding(line, file) for line in ended.stderr.splitlines()]
    if ended.returncode == 2:
        raise CaseError(findings)
    tell(findings)
    if ended.returncode != 0:
        said = [str(finding) for finding in findings if finding.severity == "error"]
        raise RunError("\n".join(said) or f"nurbeam-study ended with exit code {ended.returncode}")
    return Study(directory)


def study(what: str | os.PathLike[str] | Mapping[str, Any], out: str | os.PathLike[str] | None = None,
          jobs: int | None = None, resume: bool = False) -> Study:
    """Runs a study: a study file, or its contents (docs/studies.md, all keys in docs/study-reference.md). Arrays may
    replace lists. Its case and other files are relative to the file, or to the working directory.

    `out` is the directory of the results, by default STUDY_study (for a mapping a temporary one, which exists as long as
    the Study). `jobs` is the number of variants that run at a time, by default one for each core. With `resume` existing
    variants do not run again. Raises CaseError for a wrong study (also a FileNotFoundError for a missing one), ValueError
    for wrong `jobs`, and RunError where the study has no answer or cannot be written.
    """
    at_a_time = _jobs(jobs)
    if not isinstance(what, Mapping):
        file = Path(what)
        if not file.exists():
            raise MissingCase([Finding("error", os.fspath(file), "there is no such file")])
        return _run(file, Path(out) if out is not None else Path(f"{file.stem}_study"), at_a_time, resume)
    described = _described(what)
    scratch = Path(tempfile.mkdtemp(prefix="nurbeam_study_"))
    try:
        file = scratch / "study_file.json"
        file.write_text(json.dumps(described, indent=1), encoding="utf-8")
        found = _run(file, Path(out) if out is not None else scratch / "results", at_a_time, resume)
    except BaseException:
        shutil.rmtree(scratch, ignore_errors=True)
        raise
    weakref.finalize(found, shutil.rmtree, scratch, ignore_errors=True)
    return found


def vary(
    model: Model,
    variables: Mapping[str, Sequence[Any] | Array],
    quantities: Mapping[str, str | Callable[[Results], float]],
    *,
    grid: bool = False,
    **analysis: Any,
) -> dict[str, Array]:
    """Runs variants of a small model in this process, one after the other, without files: twenty static beams take less
    than a tenth of a second, where `study` starts processes for them.

    `variables` are values by their paths in the case, as `Model.set` has them: the first values of all make the first
    variant, and so on; with `grid` each value of one meets each of the others. `quantities` are names of histories, of which
    the last value counts, or functions of the results. The keywords are those of `Model.run`. Returns arrays by the names of
    variables and quantities; NaN, and a CaseWarning with the first reason, where a variant is no model or its run fails. The
    model stays as it is::

        found = nb.vary(model, {"beams[arm].section.radius": np.linspace(0.01, 0.02, 20)},
                        {"sink": "tip.uz", "stress": lambda r: r.extremes["arm.stress.max"].value}, type="static")
    """
    columns = [list(values) for values in variables.values()]
    if not columns or not quantities:
        raise ValueError("there are no variables or no quantities; give at least one of each")
    if not grid and len({len(column) for column in columns}) > 1:
        sizes = ", ".join(f'"{path}" has {len(column)}' for path, column in zip(variables, columns))
        raise ValueError(f"the variables have different numbers of values: {sizes}; give as many of each, or grid=True")
    rows = list(itertools.product(*columns) if grid else zip(*columns))
    found = {name: np.full(len(rows), np.nan) for name in quantities}
    reasons = []
    for i, row in enumerate(rows):
        variant = model.copy()
        try:
            for path, value in zip(variables, row):
                variant.set(path, value.item() if isinstance(value, np.generic) else value)
            results = variant.run(**analysis)
        except (CaseError, RunError) as problem:
            reasons.append(f"variant {i}: {problem}")
            continue
        for name, quantity in quantities.items():
            found[name][i] = quantity(results) if callable(quantity) else results[quantity][-1]
    if reasons:
        tell([Finding("warning", "vary", f"{len(reasons)} of {len(rows)} variants are not done; {reasons[0]}")])
    return {**{path: np.array([row[k] for row in rows]) for k, path in enumerate(variables)}, **found}
