"""What can go wrong, with the messages of the command line."""

from __future__ import annotations

import difflib
import sys
import warnings
from typing import Any, Dict, Iterable, Mapping, NamedTuple, Sequence, TypeVar

from .checked import reduced

T = TypeVar("T")

__all__ = ["Error", "CaseError", "CadError", "CaseWarning", "Finding"]


class Finding(NamedTuple):
    """One thing that is to be said of a case or a file."""

    severity: str
    """"error", "warning" or "note"."""
    where: str
    """The case or file, and the path in it: `"zip line: beams[0].section.radius"`."""
    message: str
    """What was found, the rule, and the nearest valid alternative."""

    def __str__(self) -> str:
        return f"{self.where}: {self.message}"


class Error(Exception):
    """Base class of the errors of nurbeam."""


class CaseError(Error, ValueError):
    """An invalid model or study. `findings` lists its errors, warnings and notes (`severity`), each with its position.
    The text has the errors."""

    def __init__(self, findings: Sequence[Finding]):
        self.findings = list(findings)
        super().__init__("\n".join(str(f) for f in self.findings if f.severity == "error"))

    def __reduce__(self) -> Any:
        """Pickled as its findings: other processes raise it whole."""
        return reduced(type(self), self.findings)


class CadError(Error, OSError):
    """A CAD file that cannot be read or written. `findings` says why; the text has the errors."""

    def __init__(self, findings: Sequence[Finding]):
        self.findings = list(findings)
        super().__init__("\n".join(str(f) for f in self.findings if f.severity == "error"))

    def __reduce__(self) -> Any:
        """Pickled as its findings: other processes raise it whole."""
        return reduced(type(self), self.findings)


class MissingCase(CaseError, FileNotFoundError):
    """A case file that is not there."""


class MissingResults(Error, FileNotFoundError):
    """There are no results."""


class MissingCadFile(CadError, FileNotFoundError):
    """A CAD file that is not there."""


class CaseWarning(UserWarning):
    """Something about a model or a run that its user must know."""


def findings_of(plain: Iterable[tuple[str, str, str]]) -> list[Finding]:
    return [Finding(*each) for each in plain]


def tell(findings: Iterable[Finding]) -> None:
    """Gives the warnings among the findings to Python's, of the line that has called this module."""
    frame, level = sys._getframe(), 1
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith(f"{__package__}."):
        frame, level = frame.f_back, level + 1
    for finding in findings:
        if finding.severity == "warning":
            warnings.warn(CaseWarning(str(finding)), stacklevel=level)


class ByName(Dict[str, T]):
    """Things by their names; a KeyError for a wrong one says which there are."""

    def __init__(self, what: str, things: Mapping[str, T]):
        super().__init__(things)
        self._what = what

    def __missing__(self, name: str) -> T:
        raise KeyError(unknown(self._what, name, self))


def unknown(what: str, name: object, known: Iterable[str]) -> str:
    """The message of a name that there is none of."""
    names = sorted(known)
    near = difflib.get_close_matches(str(name), names, 1)
    known_names = f'; did you mean "{near[0]}"? Known' if near else "; known"
    some = ", ".join(f'"{each}"' for each in names[:30])
    return f'there is no {what} "{name}"{known_names}: {some or "none"}'
