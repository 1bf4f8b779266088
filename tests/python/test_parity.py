"""Python and the command line give the same numbers, bit by bit."""

import csv
import json

import numpy as np
import pytest
from conftest import ROOT

import nurbeam as nb

CASES = sorted(
    path.relative_to(ROOT).as_posix() for path in ROOT.glob("samples/*/*.json") if '"nurbeam"' in path.read_text()
)
# Of long runs a part: what differs does so from the first step on.
SHORTENED = 40


def changes(path):
    """What makes a run of a case short, and keeps its files in its own folder."""
    case = nb.load(path).case
    changed = {"output.cad": None, "output.report": False}
    analysis = case["analysis"]
    if analysis.get("type", "dynamic") == "dynamic":
        steps = nb.load(path)._built({})[0].end_time / (_seconds(analysis["step"]) if "step" in analysis else 1e-2)
        if steps > SHORTENED:
            changed["analysis.end_time"] = nb.load(path)._built({})[0].end_time * SHORTENED / steps
            changed["output.every"] = changed["analysis.end_time"] / 10
    return changed


def _seconds(step):
    units = {"ms": 1e-3, "us": 1e-6, "s": 1}
    if not isinstance(step, str):
        return step
    number, unit = step.split()
    return float(number) * units[unit]


@pytest.mark.filterwarnings("ignore::nurbeam.CaseWarning")
@pytest.mark.parametrize("name", CASES)
def test_histories_are_those_of_the_command_line(name, command, tmp_path):
    path = ROOT / name
    changed = changes(path)
    settings = [word for key, value in changed.items() for word in ("--set", f"{key}={json.dumps(value)}")]
    try:
        results = nb.load(path, set=changed).run()
        expect = 0
    except nb.RunError as error:
        results, expect = error.results, 3
    command("run", path, "--out", tmp_path / "out", "--quiet", *settings, expect=expect)
    with open(tmp_path / "out" / "histories.csv", newline="") as stream:
        rows = list(csv.reader(stream))
    names = [heading.rsplit(" [", 1)[0] for heading in rows[0]]
    assert list(results.histories) == names
    assert len(results.histories[names[0]]) == len(rows) - 1 >= len(results) > 0  # a row can be between frames
    for i, column in enumerate(names):
        stored = np.array([float(row[i]) if row[i] else np.nan for row in rows[1:]])
        assert np.array_equal(results.histories[column], stored, equal_nan=True), column


def test_a_run_into_a_directory_is_that_of_the_command_line(command, root, tmp_path):
    changed = {"analysis.end_time": 0.05, "output.cad": None, "output.report": False}
    model = nb.load(root / "samples/zipline/zipline.json", set=changed)
    results = model.run(out=tmp_path / "python")
    settings = [word for key, value in changed.items() for word in ("--set", f"{key}={json.dumps(value)}")]
    command("run", root / "samples/zipline/zipline.json", "--out", tmp_path / "command", "--quiet", *settings)
    assert (tmp_path / "python/histories.csv").read_bytes() == (tmp_path / "command/histories.csv").read_bytes()
    in_memory = model.run()
    for name, values in in_memory.histories.items():
        assert np.array_equal(results.histories[name], values, equal_nan=True)
    # What either has begun the other goes on with.
    command("run", root / "samples/zipline/zipline.json", "--out", tmp_path / "python", "--resume", "--quiet", *settings)
    assert (tmp_path / "python/histories.csv").read_bytes() == (tmp_path / "command/histories.csv").read_bytes()
