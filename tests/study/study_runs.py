"""Runs studies as a user does: with one and with several processes, under MPI, killed and resumed, with bad files.

study_runs.py NURBEAM DIRECTORY
"""
import csv
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

nurbeam, scratch = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()

CASE = {
    "nurbeam": 1,
    "beams": [{"name": "beam", "axis": {"nurbs": {"degree": 2, "knots": [0, 0, 0, 1, 1, 1],
                                                  "control_points": [[0, 0, 0], [0.5, 0, 0.2], [1, 0, 0]]}},
               "section": {"radius": 0.01}, "material": {"density": 1000, "youngs_modulus": 1e8},
               "elements": {"count": 6}}],
    "supports": [{"name": "foot", "beam": "beam", "at": "start", "type": "clamped"}],
    "analysis": {"end_time": 0.05, "step": 1e-3},
    "output": {"probes": [{"name": "tip", "beam": "beam", "at": "end"}]},
}
STUDY = {
    "nurbeam_study": 1, "case": "case.json", "seed": 5,
    "variables": [
        {"name": "E", "path": "beams[0].material.youngs_modulus",
         "distribution": {"lognormal": {"mean": "100 MPa", "sd": "20 MPa"}}},
        {"name": "rise", "control_point": {"beam": "beam", "index": 1, "axis": "z"}, "range": ["-20 cm", "20 cm"]},
        {"name": "steps", "value": "1e-3 * (1 + (rise > 0.19))"}],
    "constraints": ["rise < 0.195"],
    "quantities": [{"name": "drop", "value": "min(tip.uz)", "unit": "m"},
                   {"name": "force", "value": "at(end, foot.fz)", "unit": "N"}],
    "plan": {"latin_hypercube": {"count": 60}},
}


def write(directory, study=STUDY, case=CASE):
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "case.json").write_text(json.dumps(case))
    (directory / "study.json").write_text(json.dumps(study))
    return directory / "study.json"


def run(*words, expected=0, prefix=()):
    done = subprocess.run([*prefix, nurbeam, "study", *words, "--quiet"], capture_output=True, text=True)
    assert done.returncode == expected, (words, done.returncode, done.stdout, done.stderr)
    return done


def table(out):
    """Rows without wall times."""
    with open(out / "study.csv", newline="") as file:
        rows = list(csv.reader(file))
    time_column = rows[0].index("wall time [s]")
    return [row[:time_column] + row[time_column + 1:] for row in rows]


def engines_agree():
    study = write(scratch / "engines")
    one, two = scratch / "engines/one", scratch / "engines/two"
    run(study, "--out", one, "--jobs", "1")
    run(study, "--out", two, "--jobs", "3")
    expected = table(one)
    assert len(expected) == 61
    statuses = [row[expected[0].index("status")] for row in expected[1:]]
    assert set(statuses) == {"done", "rejected"}, statuses
    assert table(two) == expected
    mpirun = shutil.which("mpirun")
    if mpirun:
        three = scratch / "engines/mpi"
        run(study, "--out", three, prefix=[mpirun, "--allow-run-as-root", "--oversubscribe", "-n", "4"])
        assert table(three) == expected
    return expected


def workers_of(process):
    """Processes that a study has started and that still run."""
    found = subprocess.run(["ps", "-o", "pid=,stat=", "--ppid", str(process.pid)], capture_output=True, text=True)
    return [int(line.split()[0]) for line in found.stdout.splitlines() if not line.split()[1].startswith("Z")]


def kill_a_worker(process):
    """Kills one that is there; one may end between being seen and being killed."""
    for worker in workers_of(process):
        try:
            os.kill(worker, signal.SIGKILL)
            return
        except ProcessLookupError:
            continue


def rows_of(out):
    return (out / "study.rows").read_bytes() if (out / "study.rows").exists() else b""


def survives_kills():
    longer = json.loads(json.dumps(CASE))
    longer["analysis"]["end_time"] = 1
    count = 1000  # several times what runs between the kills, also where these come late
    study = write(scratch / "kills", {**STUDY, "plan": {"latin_hypercube": {"count": count}}}, longer)
    start = time.monotonic()
    run(study, "--out", scratch / "kills/whole", "--jobs", "2")
    pace = (time.monotonic() - start) / count  # seconds a variant, so that kills fall where they should on any machine
    expected = table(scratch / "kills/whole")
    out = scratch / "kills/out"
    generator = random.Random(3)
    known, kills = b"", 20
    for attempt in range(kills):
        words = [nurbeam, "study", study, "--out", out, "--jobs", "2", "--quiet"] + (["--resume"] if (out / "study.rows").exists() else [])
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        if attempt % 5 < 4:  # while variants run
            wanted = known.count(b"\n") + generator.randint(1, 12)
            while rows_of(out).count(b"\n") < wanted and process.poll() is None:
                time.sleep(pace / 4)
        time.sleep(generator.uniform(0, 2 * pace))
        if attempt % 3 == 2:  # a worker, then the coordinator, or it alone, or all at once
            kill_a_worker(process)
            time.sleep(3 * pace)
        if process.poll() is not None:  # on a busy machine kills come late, and the study may be over before the last ones
            assert process.returncode == 0 and attempt >= kills / 2, (attempt, process.returncode)
            break
        if attempt % 3 == 1:
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
        process.wait()
        rows = rows_of(out)
        finished = rows[:rows.rfind(b"\n") + 1]
        assert finished.startswith(known), (attempt, "a row that was finished is lost")
        known = finished
    assert known.count(b"\n") > 20, "the kills come while variants run"
    run(study, "--out", out, "--jobs", "2", "--resume")
    status = expected[0].index("status")
    rows = table(out)
    crashed = sum(row[status] == "crashed" for row in rows)
    print(f"{kills} kills, {known.count(chr(10).encode()) - 1} variants finished between them, {crashed} crashed")
    assert crashed <= kills // 3
    assert all(row == other or row[status] == "crashed" for row, other in zip(rows, expected, strict=True))


def a_killed_worker_costs_its_variant():
    slow = json.loads(json.dumps(CASE))
    slow["analysis"].update(end_time=30, step=1e-4)
    study = write(scratch / "worker", {**STUDY, "plan": {"list": [["100 MPa", 0.1], ["100 MPa", 0.0]]}}, slow)
    out = scratch / "worker/out"
    process = subprocess.Popen([nurbeam, "study", study, "--out", out, "--jobs", "2", "--quiet"], stderr=subprocess.PIPE, text=True)
    deadline = time.time() + 60
    while len(workers_of(process)) < 2 and time.time() < deadline:
        time.sleep(0.05)
    time.sleep(0.5)
    kill_a_worker(process)
    assert process.wait() == 0
    assert "1 of 2 variants crashed" in process.stderr.read()
    rows = table(out)
    status = rows[0].index("status")
    assert sorted(row[status] for row in rows[1:]) == ["crashed", "done"], rows
    assert any("Killed" in row[-1] for row in rows)
    # The machine ended it, not the variant: it runs again.
    process = subprocess.run([nurbeam, "study", study, "--out", out, "--quiet", "--resume"], capture_output=True, text=True)
    assert process.returncode == 0 and "crashed" not in process.stderr, process.stderr
    assert [row[status] for row in table(out)[1:]] == ["done", "done"]


def time_limits_end_variants():
    slow = json.loads(json.dumps(CASE))
    slow["analysis"].update(end_time=500, step=1e-4)
    study = write(scratch / "limit", {**STUDY, "plan": {"list": [["100 MPa", 0.1]]}, "time_limit": "300 ms"}, slow)
    told = run(study, "--out", scratch / "limit/out", expected=3).stderr
    assert "none of 1 variants is done: 1 timed out (took longer than 0.3 s)" in told, told
    rows = table(scratch / "limit/out")
    assert rows[1][rows[0].index("status")] == "timed out", rows


def bad_files_are_refused():
    study = write(scratch / "bad", {**STUDY, "quantities": [{"name": "q", "value": "max(tipp.x)"}]})
    done = run(study, "--out", scratch / "bad/out", expected=2)
    assert "no column \"tipp.x\"; did you mean \"tip.x\"?" in done.stderr, done.stderr
    study = write(scratch / "bad", {**STUDY, "quantities": [{"name": "q", "value": "tip.x"}]})
    done = run(study, "--out", scratch / "bad/out", expected=2)
    assert "quantities[0].value: \"tip.x\": the expression is a history" in done.stderr, done.stderr
    broken = {**STUDY, "variables": [{"name": "i", "control_point": {"beam": "baem", "index": 1, "axis": "z"},
                                      "range": [0, 1]}], "constraints": [], "plan": {"grid": 2}}
    done = run(write(scratch / "bad", broken), "--out", scratch / "bad/out", expected=2)
    assert "variables[0]: the case has no beam \"baem\"; did you mean \"beam\"?" in done.stderr, done.stderr
    wrong = {**STUDY, "constraints": ["ryse < 1"], "variables": broken["variables"], "plan": {"grid": [2, 2]},
             "quantities": [{"name": "q", "value": "max(tipp.x)"}]}
    done = run(write(scratch / "bad", wrong), "--out", scratch / "bad/out", expected=2)
    for place in ("constraints[0]: there is no variable \"ryse\"", "plan.grid: has 2 numbers",
                  "variables[0]: the case has no beam", "quantities[0].value: a run of this case has no column"):
        assert place in done.stderr, (place, done.stderr)
    wrong = {**STUDY, "set": ["analysis.stp=1", "analysis.step=-1"], "quantities": [{"name": "q", "value": "max(tipp.x)"}]}
    done = run(write(scratch / "bad", wrong), "--out", scratch / "bad/out", expected=2)
    for place in ("study.json: set[0]: \"analysis.stp=1\": there is no \"stp\"",
                  "study.json: set[1]: \"analysis.step=-1\": analysis.step: ",
                  "quantities[0].value: a run of this case has no column"):
        assert place in done.stderr, (place, done.stderr)
    wrong = {**STUDY, "variables": [{"name": "r", "path": "beams[0].section.radius", "range": [-0.02, 0.01]}],
             "constraints": [], "quantities": [{"name": "q", "value": "max(tipp.x)"}]}
    done = run(write(scratch / "bad", wrong), "--out", scratch / "bad/out", expected=2)
    for text in ("warning: ", "variables: the nominal variant cannot be built: ", "no column \"tipp.x\""):
        assert text in done.stderr, (text, done.stderr)
    resting = {**CASE, "analysis": {"type": "static"}}
    wrong = {**STUDY, "quantities": [{"name": "q", "value": "at(1, tip.x)"}]}
    done = run(write(scratch / "bad", wrong, resting), "--out", scratch / "bad/out", expected=2)
    assert "quantities[0].value: the load steps of the case go from 0 s to 0 s, and 1 s is not between" in done.stderr, done.stderr
    assert not (scratch / "bad/out").exists(), "of a study that cannot run nothing is left behind"
    run(scratch / "bad/nothing.json", expected=2)
    done = run(write(scratch / "bad"), "--out", scratch / "bad/none", "--resume", expected=2)
    assert "there is no study to resume" in done.stderr, done.stderr
    assert not (scratch / "bad/none").exists()
    for place in (CASE, STUDY):
        here = scratch / "bad/place"
        case, study = (here / name for name in (("best.json", "s.json") if place is CASE else ("c.json", "study.json")))
        here.mkdir(exist_ok=True)
        case.write_text(json.dumps(CASE))
        study.write_text(json.dumps({**STUDY, "case": case.name}))
        taken = case if place is CASE else study
        kept = taken.read_text()
        done = run(study, "--out", here, expected=2)
        assert f"{taken}: is an input of this study, and a name of its results" in done.stderr, done.stderr
        assert taken.read_text() == kept and not (here / "study.rows").exists()
    changed = write(scratch / "bad", {**STUDY, "plan": {"sobol": {"count": 2}}})
    run(changed, "--out", scratch / "bad/changed")
    changed = write(scratch / "bad", {**STUDY, "plan": {"sobol": {"count": 3}}})
    rows = rows_of(scratch / "bad/changed")
    done = run(changed, "--out", scratch / "bad/changed", "--resume", expected=2)
    assert "another study: changed since: \"plan\" of the study; run without --resume" in done.stderr, done.stderr
    assert rows_of(scratch / "bad/changed") == rows, "they are kept"
    # A table that the case reads, changed between a study and its resumption.
    here = scratch / "table"
    here.mkdir(parents=True, exist_ok=True)
    (here / "load.csv").write_text("t,f\n0,-10\n1,-10\n")
    (here / "case.json").write_text(json.dumps({
        "nurbeam": 1, "gravity": [0, 0, 0],
        "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": 0.01}, "material": "steel"}],
        "supports": [{"beam": "b", "at": "start", "type": "clamped"}],
        "loads": [{"beam": "b", "at": "end", "force": [0, 0, 1], "time": {"file": "load.csv"}}],
        "analysis": {"type": "static"}, "output": {"probes": [{"name": "tip", "beam": "b", "at": "end"}]}}))
    (here / "study.json").write_text(json.dumps({
        "nurbeam_study": 1, "case": "case.json", "variables": [{"name": "r", "path": "beams[0].section.radius", "range": [0.009, 0.011]}],
        "quantities": [{"name": "z", "value": "at(end, tip.z)"}], "plan": {"grid": 2}}))
    run(here / "study.json", "--out", here / "out")
    (here / "load.csv").write_text("t,f\n0,-20\n1,-20\n")
    done = run(here / "study.json", "--out", here / "out", "--resume", expected=2)
    assert f"another study: changed since: {here / 'load.csv'}; run" in done.stderr, done.stderr


def a_full_disk_costs_nothing(expected):
    study = write(scratch / "full")
    out = scratch / "full/out"
    limited = ["bash", "-c", 'ulimit -f 4; exec "$@"', "bash"]
    done = run(study, "--out", out, expected=4, prefix=limited)
    assert "go on with --resume" in done.stderr, done.stderr
    kept = (out / "study.rows").read_bytes()
    assert kept.endswith(b"\n") and kept.count(b"\n") > 2
    run(study, "--out", out, "--resume")
    assert (out / "study.rows").read_bytes().startswith(kept)
    assert table(out) == expected


def a_variant_that_cannot_be_built_says_why():
    study = {**STUDY, "variables": [{"name": "r", "path": "beams[0].section.radius", "range": [-0.01, 0.01]}],
             "constraints": [], "plan": {"list": [[-0.01], [0.01]]}}
    run(write(scratch / "refused", study), "--out", scratch / "refused/out")
    rows = table(scratch / "refused/out")
    status = rows[0].index("status")
    assert [row[status] for row in rows[1:]] == ["refused", "done"], rows
    assert rows[1][-1].startswith("with r = -0.01: ") and "beams[0].section.radius" in rows[1][-1], rows[1]
    # The curve turns back on itself at its end: of three variables one is to blame.
    study = {**STUDY, "variables": [
        STUDY["variables"][0],
        {"name": "x", "control_point": {"beam": "beam", "index": 1, "axis": "x"}, "range": [0, 1]},
        {"name": "end", "control_point": {"beam": "beam", "index": 2, "axis": "x"}, "range": [0, 2]}],
        "constraints": [], "plan": {"list": [["90 MPa", 0.4, 0.9], ["90 MPa", 0.4, 0]]}}
    case = json.loads(json.dumps(CASE))
    case["beams"][0]["axis"]["nurbs"]["control_points"][1][2] = 0
    run(write(scratch / "refused", study, case), "--out", scratch / "refused/turned")
    rows = table(scratch / "refused/turned")
    status = rows[0].index("status")
    assert [row[status] for row in rows[1:]] == ["done", "refused"], rows
    assert rows[2][-1].startswith("with end = 0: "), rows[2]
    page = (scratch / "refused/turned/study.html").read_text()
    data = json.loads(page.split('<script type="application/json" id="data">')[1].split("</script>")[0])
    assert sorted(data["curves"][0]["variants"]) == ["0", "1"], "its curve is there to see"


def no_more_processes_than_are_of_use():
    slow = json.loads(json.dumps(CASE))
    slow["analysis"].update(end_time=30, step=1e-4)
    study = write(scratch / "jobs", {**STUDY, "plan": {"list": [["100 MPa", 0.1]]}}, slow)
    process = subprocess.Popen([nurbeam, "study", study, "--out", scratch / "jobs/out", "--jobs", "1000", "--quiet"],
                               stderr=subprocess.PIPE, text=True)
    deadline = time.time() + 60
    while not workers_of(process) and time.time() < deadline:
        time.sleep(0.05)
    time.sleep(0.3)
    assert len(workers_of(process)) == 1, "one for each variant"
    process.terminate()
    told = process.communicate()[1]
    assert "--jobs 1000: no more than" in told, told


def answers_that_there_are_not_say_why():
    def told(study):
        return run(write(scratch / "why", {"nurbeam_study": 1, "variables": [{"name": "a", "range": [0, 1]}],
                                           "quantities": [{"name": "q", "value": "log(a - 0.4)"}], **study}),
                   "--out", scratch / "why/out", expected=3).stderr
    search = {"optimise": {"minimise": "q", "evaluations": 20}}
    text = told({"constraints": ["a > 5"], **search})
    assert "study.json: none of " in text and "rejected (the first: \"a > 5\" does not hold with a = 0.5)" in text, text
    assert "subject_to" not in text, text
    text = told({"quantities": [{"name": "q", "value": "log(-1 - a)"}], **search})
    assert "failed (the first: the quantity \"q\" is no number" in text and "subject_to" not in text, text
    text = told({"optimise": {"minimise": "q", "subject_to": ["q < 9", "q <= a - 30"], "evaluations": 20}})
    assert "that are done holds \"subject_to\": \"q <= a - 30\" is missed by" in text, text
    assert "q < 9" not in text, text
    status = json.loads((scratch / "why/out/study.json").read_text())["status"]
    assert "is missed by" in status, status
    text = told({"quantities": [{"name": "q", "value": "log(a - 0.6)"}], "optimise": {"minimise": "q", "method": "gradient"}})
    assert "none of 1 variants is done" in text and "search begins at the \"nominal\" values" in text, text
    text = told({"constraints": ["a > 5"], "optimise": {"minimise": "q", "method": "genetic"}})
    assert "nominal" not in text, text


def answers_say_what_is_not_done():
    study = {"nurbeam_study": 1, "variables": [{"name": "a", "range": [0, 1]}],
             "quantities": [{"name": "q", "value": "a + 0 * log(a - 0.4)"}], "optimise": {"minimise": "q"}}
    told = run(write(scratch / "undone", study), "--out", scratch / "undone/out").stdout
    rows = table(scratch / "undone/out")
    failed = sum(row[-2] == "failed" for row in rows)
    assert f"  variants that are not done, of {len(rows) - 1}: {failed} failed (the first: the quantity \"q\" is" in told, told
    study["quantities"][0]["value"] = "a"
    told = run(write(scratch / "undone", study), "--out", scratch / "undone/out").stdout
    assert "not done" not in told, told


def the_best_variant_runs():
    study = {**STUDY, "variables": [STUDY["variables"][1]], "constraints": [],
             "quantities": [{"name": "height", "value": "max(tip.z)"}],
             "optimise": {"maximise": "height", "evaluations": 12}}
    del study["plan"]
    out = scratch / "best/out"
    run(write(scratch / "best", study), "--out", out)
    assert (out / "best.step").exists()
    done = subprocess.run([nurbeam, "run", out / "best.json", "--out", scratch / "best/results", "--quiet"])
    assert done.returncode == 0
    del study["optimise"]
    run(write(scratch / "best", {**study, "plan": {"list": [[0.1]]}}), "--out", out)
    assert not (out / "best.json").exists() and not (out / "best.step").exists(), "of the study before"
    page = (out / "study.html").read_text()
    assert "http" not in page.replace("http://www.w3.org", ""), "the page needs no network"


shutil.rmtree(scratch, ignore_errors=True)
rows = engines_agree()
survives_kills()
a_full_disk_costs_nothing(rows)
a_killed_worker_costs_its_variant()
time_limits_end_variants()
bad_files_are_refused()
a_variant_that_cannot_be_built_says_why()
no_more_processes_than_are_of_use()
answers_that_there_are_not_say_why()
answers_say_what_is_not_done()
the_best_variant_runs()
print("all studies ran as they should")
