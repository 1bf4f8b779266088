"""`nurbeam run --progress json`: one JSON object a line, for programs that start runs."""

import json
import os
import signal
import subprocess
import time

CANTILEVER = {
    "nurbeam": 1,
    "beams": [{
        "name": "bar", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": "5 mm"}, "material": "steel",
        "elements": {"count": 10},
    }],
    "supports": [{"beam": "bar", "at": "start", "type": "clamped"}],
    "loads": [{"beam": "bar", "at": "end", "force": [0, 0, -10]}],
}  # fmt: skip


def written(folder, **keys):
    case = folder / "case.json"
    case.write_text(json.dumps({**CANTILEVER, **keys}))
    return case


def lines_of(case, *arguments, expect=0):
    done = subprocess.run([os.environ["NURBEAM"], "run", case, "--progress", "json", *arguments], capture_output=True, text=True,
                          cwd=case.parent)  # fmt: skip
    assert done.returncode == expect, done.stderr
    return [json.loads(line) for line in done.stderr.splitlines()]


def phases(lines):
    names = [line["phase"] for line in lines if "phase" in line]
    return [name for i, name in enumerate(names) if i == 0 or name != names[i - 1]]


def test_a_motion_tells_its_phases_and_how_far_it_is(tmp_path):
    case = written(tmp_path, analysis={"end_time": 1, "step": "0.02 ms", "initial": "equilibrium"})
    lines = lines_of(case)
    assert phases(lines) == ["model", "equilibrium", "motion", "results", "ended"]
    motion = [line for line in lines if line.get("phase") == "motion" and line["fraction"] is not None]
    assert motion, "a motion of 50000 steps takes more than 0.2 s"
    for line in motion:
        assert 0 <= line["fraction"] <= 1 and abs(line["time"] - line["fraction"]) < 1e-12
        assert line["seconds_to_go"] is None or line["seconds_to_go"] >= 0
    assert lines[-1] == {"phase": "ended", "code": 0, "out": "case_results"}
    assert any("displacement" in line.get("text", "") for line in lines)


def test_an_equilibrium_with_load_steps_tells_its_factor(tmp_path):
    lines = lines_of(written(tmp_path, analysis={"type": "static", "load_steps": 4}))
    assert phases(lines) == ["model", "equilibrium", "results", "ended"]
    assert lines[-1]["code"] == 0


def test_modes_have_a_phase_of_their_own(tmp_path):
    assert "modes" in phases(lines_of(written(tmp_path, analysis={"type": "modes", "modes": {"count": 2}})))


def test_findings_have_severity_place_and_message(tmp_path):
    case = written(tmp_path, analysis={"type": "static"}, supports=[{"beam": "rod", "at": "start", "type": "clamped"}])
    lines = lines_of(case, expect=2)
    errors = [line for line in lines if line.get("severity") == "error"]
    assert errors and errors[0]["where"].endswith("supports[0].beam") and "bar" in errors[0]["message"]
    assert lines[-1]["phase"] == "ended" and lines[-1]["code"] == 2


def test_an_interrupted_run_says_so(tmp_path):
    case = written(tmp_path, analysis={"end_time": 1000, "step": "0.1 ms"})
    process = subprocess.Popen([os.environ["NURBEAM"], "run", case, "--progress", "json"], stderr=subprocess.PIPE, text=True, cwd=tmp_path)
    begun = time.perf_counter()
    lines = []
    for text in process.stderr:
        lines.append(json.loads(text))
        if lines[-1].get("phase") == "motion" and lines[-1]["fraction"]:
            break
    process.send_signal(signal.SIGINT)
    lines += [json.loads(text) for text in process.stderr]
    assert process.wait() == 130
    assert lines[-1]["code"] == 130
    assert any("interrupted" in line.get("message", "") for line in lines)
    assert time.perf_counter() - begun < 30


def test_lines_come_five_times_a_second(tmp_path):
    case = written(tmp_path, analysis={"end_time": 1000, "step": "0.1 ms"})
    process = subprocess.Popen([os.environ["NURBEAM"], "run", case, "--progress", "json"], stderr=subprocess.PIPE, text=True, cwd=tmp_path)
    seconds = []
    for text in process.stderr:
        line = json.loads(text)
        if line.get("phase") == "motion":
            seconds.append(line["seconds"])
        if len(seconds) == 8:
            break
    process.kill()
    gaps = [b - a for a, b in zip(seconds, seconds[1:])]
    assert min(gaps) > 0.15 and sorted(gaps)[len(gaps) // 2] < 0.35


def test_an_unknown_form_is_refused(tmp_path):
    case = written(tmp_path, analysis={"type": "static"})
    done = subprocess.run([os.environ["NURBEAM"], "run", case, "--progress", "xml"], capture_output=True, text=True)
    assert done.returncode == 2 and '"text"' in done.stderr and '"json"' in done.stderr
