"""Where the command and the module of nurbeam are, and what the command says."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
from typing import Any, NamedTuple, Optional

import FreeCAD

from ..case.places_of_case import PLACE

PREFERENCES = "User parameter:BaseApp/Preferences/Mod/Nurbeam"


class Missing(RuntimeError):
    """The command or the module is not installed; the text says which package has it."""


class Line(NamedTuple):
    """A line of `nurbeam run --progress json`."""

    severity: str = ""
    """"error", "warning" or "note" of a finding; "" of other lines."""
    where: str = ""
    message: str = ""
    """Of a finding, or a line for people."""
    phase: str = ""
    fraction: Optional[float] = None
    time: Optional[float] = None
    seconds_to_go: Optional[float] = None
    code: Optional[int] = None


def _chosen(name):
    """A preference, or what stands for it in the environment."""
    return FreeCAD.ParamGet(PREFERENCES).GetString(name, "") or os.environ.get(f"NURBEAM_{name.upper()}", "")


def program():
    """The path of the command. Missing where there is none."""
    found = _chosen("Command") or shutil.which("nurbeam") or ""
    if found and os.access(found, os.X_OK):
        return found
    where = f"{found} is no program" if found else "the command nurbeam is not found"
    raise Missing(f"{where}; install the package nurbeam, or give its path in the preferences")


def module():
    """The Python module, also of the folder that the preferences name. Missing where it cannot be imported, and where a
    folder of that name is all there is."""
    folder = _chosen("Module")
    if folder and folder not in sys.path:  # FreeCAD's window empties PYTHONPATH
        sys.path.insert(0, folder)
    try:
        import nurbeam
    except ImportError as problem:
        raise Missing(f"the Python module nurbeam is not found ({problem}); install the package python3-nurbeam") from None
    if not hasattr(nurbeam, "__version__"):
        raise Missing("the Python module nurbeam is an empty folder; install the package python3-nurbeam")
    return nurbeam


class TooLong(RuntimeError):
    """The command did not end within its time."""


def run_program(arguments, problem, seconds):
    """What the command prints; its errors are raised as that problem, a time beyond the limit as TooLong."""
    process = subprocess.Popen([program(), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True, start_new_session=True)  # fmt: skip
    try:
        out, err = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)  # also the reader of CAD files that it has started
        process.communicate()
        raise TooLong(f"takes longer than {seconds:g} s") from None
    if process.returncode != 0:
        lines = [line_of(line) for line in err.splitlines()]
        errors = [line.message for line in lines if line and line.severity == "error"]
        raise problem("; ".join(errors) or err.strip() or f"the command has ended with {process.returncode}")
    return out


def line_of(text: str) -> Optional[Line]:
    """A line of the command; None for an empty one."""
    text = text.strip()
    if not text:
        return None
    keys: "dict[str, Any]" = {}
    if text.startswith("{"):
        try:
            keys = json.loads(text)
        except ValueError:
            pass
    if keys:
        known = {name: keys[name] for name in Line._fields if name in keys}
        return Line(**{"message": keys.get("text", ""), **known})
    finding = re.match(r"(error|warning|note): (.*)$", text)
    if finding:
        place = re.match(rf"((?:[^:]+: )?{PLACE}): (.*)$", finding[2])
        return Line(finding[1], *((place[1], place[2]) if place else ("", finding[2])))
    return Line(message=text)


class LineReader:
    """Lines out of fragments, as a process sends them."""

    def __init__(self):
        self._rest = b""

    def take(self, fragment):
        *whole, self._rest = (self._rest + bytes(fragment)).split(b"\n")
        lines = (line_of(text.decode("utf-8", "replace")) for text in whole)
        return [line for line in lines if line is not None]

    def finish(self):
        rest, self._rest = self._rest, b""
        line = line_of(rest.decode("utf-8", "replace"))
        return [line] if line else []
