"""Lets the n-th call of the operating system fail, for many n, or ends the process there, in a run, a resumed run, a
study, an export and a run from Python. Files under their final names must be whole, the exit code must be 4 with a
sentence where something is missing, and what goes on from there must come to the same answer.

sweep.py NURBEAM FAULT_LIBRARY DIRECTORY [--all] [--python PYTHONPATH] [--only SCENARIO]

Without --all some of the calls, drawn at random, in a minute or two.
"""
import argparse
import collections
import csv
import hashlib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("nurbeam", type=Path)
parser.add_argument("library", type=Path)
parser.add_argument("directory", type=Path)
parser.add_argument("--all", action="store_true")
parser.add_argument("--python")
parser.add_argument("--only")
arguments = parser.parse_args()
nurbeam, library, scratch = (path.resolve() for path in (arguments.nurbeam, arguments.library, arguments.directory))
chance = random.Random(11)

CASE = {
    "nurbeam": 1, "name": "faults", "gravity": [0, 0, -9.81],
    "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": 0.01},
               "material": {"density": 7200, "youngs_modulus": 2e7}, "elements": {"count": 4}}],
    "bodies": [{"name": "m", "mass": 0.5}],
    "supports": [{"beam": "b", "at": "start", "type": "clamped"}, {"beam": "b", "at": "end", "type": "pinned"}],
    "sliding_joints": [{"body": "m", "beam": "b", "at": {"fraction": 0.2}, "friction": {"coefficient": 0.1}, "speed": 0.8}],
    "analysis": {"end_time": 0.04, "step": 1e-3},
    "output": {"every": 0.01, "report": True, "paraview": True, "cad": {"formats": ["step"], "times": [0.02, 0.04]},
               "probes": [{"name": "p", "beam": "b", "at": {"fraction": 0.5}}]},
}
STUDY = {
    "nurbeam_study": 1, "case": "bare.json",
    "variables": [{"name": "r", "path": "beams[0].section.radius", "range": [0.008, 0.012]}],
    "quantities": [{"name": "q", "value": "min(p.z)"}], "plan": {"grid": [3]},
}
PYTHON = """
import sys, nurbeam as nb
model = nb.load(sys.argv[1])
try:
    model.run(out=sys.argv[2])
except nb.Error as problem:
    print("error:", problem, file=sys.stderr)
    sys.exit(4)
"""
WITH_TIMES = {"run.json", "report.html", "run.log", "study.rows", "study.json", "study.csv", "study.nc", "study.html"}


def digest(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


def files_of(directory):
    return {str(file.relative_to(directory)): file for file in sorted(directory.rglob("*")) if file.is_file()}


def has_its_checksum(file):
    content = file.read_bytes()
    line = content[-(64 + 18):]
    return line.startswith(b"\nnurbeam SHA-256 ") and hashlib.sha256(content[:-len(line)]).hexdigest() == line[-65:-1].decode()


def answer(directory):
    """What the times of the wall do not change. Frames that came in several pieces lie in another order in results.nc."""
    found = {name: digest(file) for name, file in files_of(directory).items()
             if name not in WITH_TIMES and not name.endswith((".part", "restart.nc", "results.nc"))}
    if (directory / "results.nc").exists():
        shape = scratch / "shape.json"
        shape.unlink(missing_ok=True)
        subprocess.run([nurbeam, "export", directory, "--time", "0.04", "--to", shape], capture_output=True)
        found["results.nc"] = digest(shape) if shape.exists() else "cannot be read"
    table = directory / "study.csv"
    if table.exists():
        with table.open(newline="") as rows:
            found["study.csv"] = [row[:4] for row in csv.reader(rows)]
    return found


def half_files(directory, good, histories, before):
    """Files under their final names that are not whole. Those that are as a run before has left them are: the last frame of
    one that was stopped is of that moment, which the run that goes on from there does not have."""
    wrong = []
    for name, file in files_of(directory).items():
        if name.endswith(".part") or name in ("run.log", "study.rows") or digest(file) == before.get(name):
            continue
        if name.endswith(".nc") and not name.endswith("study.nc"):
            whole = has_its_checksum(file)
        elif name.endswith(".json"):
            try:
                whole = isinstance(json.loads(file.read_text()), dict)
            except ValueError:
                whole = False
        elif name.endswith(".html"):
            whole = file.read_text(errors="replace").rstrip().endswith("</html>")
        elif name == "histories.csv":  # of a run that has ended early
            whole = file.read_bytes().endswith(b"\n") and histories.startswith(file.read_bytes())
        elif name == "study.csv":
            whole = file.read_text().endswith("\n")
        elif name == "study.nc":
            whole = file.read_bytes().startswith(b"\x89HDF")
        elif name.endswith(".pvd"):
            whole = file.read_text().rstrip().endswith("</VTKFile>")
        else:
            whole = name in good and digest(file) == good[name]
        if not whole:
            wrong.append(name)
    return wrong


class Scenario:
    """A command that is disturbed, and one that goes on afterwards; {here} is the directory of the results."""

    def __init__(self, name, words, again=None, before=None, program="nurbeam"):
        self.name, self.words, self.again, self.before, self.program = name, words, again, before, program
        self.here = scratch / name / "here"
        self.left = {name: digest(file) for name, file in files_of(before).items()} if before else {}

    def fresh(self):
        shutil.rmtree(self.here.parent, ignore_errors=True)
        self.here.parent.mkdir(parents=True)
        if self.before:
            shutil.copytree(self.before, self.here)

    def play(self, words, faults=None):
        environment = dict(os.environ)
        if arguments.python:
            environment["PYTHONPATH"] = arguments.python
        if faults is not None:
            environment.update(LD_PRELOAD=str(library), FAULT_DIRECTORY=str(self.here), FAULT_PROGRAM=self.program,
                               **{f"FAULT_{key.upper()}": str(value) for key, value in faults.items()})
        words = [str(word).format(here=self.here) for word in words]
        try:
            done = subprocess.run(words, capture_output=True, text=True, timeout=120, env=environment)
        except subprocess.TimeoutExpired:
            return "hung", ""
        return done.returncode, done.stderr

    def reference(self):
        self.fresh()
        code, said = self.play(self.words)
        assert code == 0, (self.name, said)
        table = self.here / "histories.csv"
        self.histories = table.read_bytes() if table.exists() else b""
        return answer(self.here)

    def count(self, calls):
        self.fresh()
        log.unlink(missing_ok=True)
        code, said = self.play(self.words, {"calls": calls, "number": 0, "log": log})
        assert code == 0, (self.name, said)
        return [line.split()[1:] for line in log.read_text().splitlines()]


found = collections.Counter()
problems = []


def disturbed(scenario, good, kind, calls, number, sticky):
    scenario.fresh()
    log.unlink(missing_ok=True)
    code, said = scenario.play(scenario.words, {"calls": calls, "number": number, "kind": kind, "sticky": int(sticky), "log": log})
    lines = [line.split() for line in log.read_text().splitlines()] if log.exists() else []
    crashes_in = next((line[1].split(".")[0] for line in lines if line[0] == "crash" and line[1:]), None)
    asked_by = next((line[2].split(".")[0] for line in lines if line[1:2] == ["a"] and line[2:]), None)
    ends = kind in ("kill", "power")

    def wrong(what):
        problems.append((scenario.name, kind, calls, number, what, said[-200:]))
        found[scenario.name, kind, what.split(":")[0]] += 1

    found[scenario.name, kind, "tries"] += 1
    if code == "hung":
        return wrong("hung")
    if code == -signal.SIGKILL and ends:
        pass
    elif code not in (0, 4) and crashes_in:
        # netCDF itself crashes (4.9.0, in its list of open objects) where HDF5 cannot close a file; libcrypto without memory.
        found[scenario.name, kind, f"{crashes_in} crashes"] += 1
    elif code == 255 and asked_by:  # HDF5 calls exit(-1) in H5I_register
        found[scenario.name, kind, f"{asked_by} ends the process"] += 1
    elif code == 2 and asked_by and "NetCDF: HDF error" in said:
        # HDF5 does not tell netCDF that memory ran short: it is an error of the file to whoever asks.
        found[scenario.name, kind, f"{asked_by} keeps the reason"] += 1
    elif code not in (0, 4):
        wrong(f"crashed: exit {code}" if code < 0 else f"exit {code}")
    elif code == 4 and "error: " not in said:
        wrong("no sentence")
    is_told = "--resume" in said  # a study says which variants the machine ended
    if code == 0 and not is_told and answer(scenario.here) != good:
        wrong("silent: exit 0 without all results")
    if half := half_files(scenario.here, good, scenario.histories, scenario.left) if scenario.here.exists() else []:
        wrong(f"half files: {half}")
    if not scenario.again:
        return
    code, said = scenario.play(scenario.again)
    if code == 2 and "does not exist" in said:
        code, said = scenario.play(scenario.words)
    if code != 0:
        wrong(f"lost: exit {code} when it goes on: {said[-150:]}")
    elif answer(scenario.here) != good:
        now = answer(scenario.here)
        differ = [name for name in good.keys() | now.keys() if good.get(name) != now.get(name)]
        wrong(f"silent: another answer when it goes on: {differ}")


def sweep(scenario, most):
    good = scenario.reference()
    for kind, calls, sticky in (("EIO", "owfrucmt", False), ("ENOSPC", "owfrmt", True), ("short", "w", False),
                                ("kill", "owfrucmt", False), ("power", "owfru", False), ("EIO", "p", False),
                                ("ENOMEM", "a", False)):
        if kind == "ENOMEM" and scenario.program == "python3":
            continue  # most are the interpreter's own, which ends as it likes
        made = scenario.count(calls)
        numbers = list(range(1, len(made) + 1))
        if calls == "a" and arguments.all:
            numbers = sorted(chance.sample(numbers, min(len(numbers), 1000)))
        if not arguments.all:
            # The few that are no writes, and allocations of libraries, are as many as these.
            few = [n for n in numbers if made[n - 1][0] != "w" and (made[n - 1][0] != "a" or not made[n - 1][1:])]
            many = sorted(set(numbers) - set(few))
            numbers = sorted(chance.sample(few, min(len(few), most)) + chance.sample(many, min(len(many), most)))
        for number in numbers:
            disturbed(scenario, good, kind, calls, number, sticky)
        print(scenario.name, kind, calls, f"{len(numbers)} of {len(made)} calls", flush=True)


shutil.rmtree(scratch, ignore_errors=True)
scratch.mkdir(parents=True)
log = scratch / "calls"
case, bare, study = scratch / "case.json", scratch / "bare.json", scratch / "study.json"
case.write_text(json.dumps(CASE))
bare.write_text(json.dumps({**CASE, "output": {"every": 0.01, "report": False, "probes": CASE["output"]["probes"]}}))
study.write_text(json.dumps(STUDY))


def stopped(out):
    """A run that has been stopped in its middle, and its restart point."""
    long = scratch / "long.json"
    long.write_text(json.dumps({**CASE, "analysis": {**CASE["analysis"], "end_time": 0.5}}))
    for _ in range(20):  # on a busy machine it may be over before it is told to stop
        running = subprocess.Popen([nurbeam, "run", long, "--out", out, "--quiet"], stderr=subprocess.DEVNULL)
        part = out / "histories.csv.part"
        while not (part.exists() and part.read_bytes().count(b"\n") > 3) and running.poll() is None:
            time.sleep(0.001)
        running.send_signal(signal.SIGINT)
        if running.wait(60) == 130:
            break
        shutil.rmtree(out)
    else:
        raise SystemExit("the run has ended each time before it could be stopped")
    return long


scenarios = [Scenario("run", [nurbeam, "run", case, "--out", "{here}", "--quiet"],
                      [nurbeam, "run", case, "--out", "{here}", "--quiet", "--resume"])]
long = stopped(scratch / "stopped")
resume = [nurbeam, "run", long, "--out", "{here}", "--quiet", "--resume"]
scenarios.append(Scenario("resume", resume, resume, before=scratch / "stopped"))
studied = [nurbeam, "study", study, "--out", "{here}", "--quiet", "--jobs", "1"]
scenarios.append(Scenario("study", studied, [*studied, "--resume"], program="nurbeam-study"))
subprocess.run([nurbeam, "run", bare, "--out", scratch / "results", "--quiet"], check=True)
scenarios.append(Scenario("export", [nurbeam, "export", "{here}", "--time", "0.04", "--to", "{here}/shape.step"],
                          before=scratch / "results"))
scenarios.append(Scenario("report", [nurbeam, "report", "{here}"], before=scratch / "results"))
if arguments.python:
    scenarios.append(Scenario("python", [sys.executable, "-c", PYTHON, bare, "{here}"],
                              [nurbeam, "run", bare, "--out", "{here}", "--quiet"], program="python3"))
for scenario in scenarios:
    if arguments.only in (None, scenario.name):
        sweep(scenario, most=4)
for key, count in sorted(found.items()):
    print(*key, count)
for problem in problems[:60]:
    print("PROBLEM", *problem)
sys.exit(1 if problems else 0)
