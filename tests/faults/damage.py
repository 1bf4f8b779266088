"""Flips bits of what nurbeam reads back, and looks at what it makes of it: refused with exit code 2 and the name of the
file, or the same answer; never a crash, never another answer. Then: equal runs write equal bytes.

damage.py NURBEAM DIRECTORY [TRIES]
"""
import collections
import hashlib
import json
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

nurbeam, scratch = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
tries = int(sys.argv[3]) if len(sys.argv) > 3 else 12
chance = random.Random(5)

CASE = {
    "nurbeam": 1, "name": "damage", "gravity": [0, 0, -9.81],
    "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": 0.01},
               "material": {"density": 7200, "youngs_modulus": 2e7}, "elements": {"count": 8}}],
    "bodies": [{"name": "m", "mass": 0.5}],
    "supports": [{"beam": "b", "at": "start", "type": "clamped"}, {"beam": "b", "at": "end", "type": "pinned"}],
    "sliding_joints": [{"body": "m", "beam": "b", "at": {"fraction": 0.2}, "friction": {"coefficient": 0.1}, "speed": 0.8}],
    "analysis": {"end_time": 0.4, "step": 1e-3},
    "output": {"every": 0.02, "report": False, "probes": [{"name": "p", "beam": "b", "at": {"fraction": 0.5}}]},
}
STUDY = {
    "nurbeam_study": 1, "case": "case.json",
    "variables": [{"name": "r", "path": "beams[0].section.radius", "range": [0.008, 0.012]}],
    "quantities": [{"name": "q", "value": "min(p.z)"}], "plan": {"grid": [5]},
}


def nurbeam_says(*words, **how):
    done = subprocess.run([nurbeam, *map(str, words)], capture_output=True, text=True, timeout=120, **how)
    return done.returncode, done.stdout + done.stderr


def must(*words):
    code, said = nurbeam_says(*words)
    assert code == 0, (words, code, said)
    return said


def digests(directory):
    return {str(file.relative_to(directory)): hashlib.sha256(file.read_bytes()).hexdigest()
            for file in sorted(directory.rglob("*")) if file.is_file()}


def equal_runs_write_equal_bytes():
    case = json.loads(json.dumps(CASE))
    case["output"].update(report=True, paraview=True,
                          cad={"formats": ["step", "iges", "dxf", "brep"], "times": [0.1, 0.4]})
    file = scratch / "equal.json"
    file.write_text(json.dumps(case))
    found = []
    for name in ("first", "second"):
        must("run", file, "--out", scratch / name, "--quiet")
        found.append(digests(scratch / name))
        time.sleep(1.1)  # clocks that are written have gone on
    differ = [name for name in found[0] if found[0][name] != found[1].get(name)]
    assert set(differ) <= {"run.json", "report.html", "run.log"}, differ
    assert len(found[0]) > 20 and found[0].keys() == found[1].keys()
    print("equal runs:", len(found[0]), "files, which differ:", differ)


def interrupted_run(case, out):
    """A run that has been stopped in its middle."""
    running = subprocess.Popen([nurbeam, "run", case, "--out", out, "--quiet", "--set", "analysis.end_time=400"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    part = out / "histories.csv.part"
    for _ in range(3000):
        if part.exists() and part.read_bytes().count(b"\n") > 5:
            break
        time.sleep(0.01)
    running.send_signal(signal.SIGINT)
    assert running.wait(60) == 130


def damaged(file):
    content = bytearray(file.read_bytes())
    kind = chance.randrange(8)
    if kind == 0:
        del content[chance.randrange(len(content)):]
    elif kind == 1:
        at = chance.randrange(len(content))
        content[at:at + 512] = bytes(len(content[at:at + 512]))
    else:
        content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
    file.write_bytes(content)


counts = collections.Counter()


def damage(whole, name, what, *words):
    """`what` makes an answer of a directory; that of the undamaged one must come out, or a refusal."""
    here = scratch / "damaged"

    def fresh():
        shutil.rmtree(here, ignore_errors=True)
        shutil.copytree(whole, here)

    fresh()
    must(*(str(word).format(here=here) for word in words))
    expected = what(here)
    for _ in range(tries):
        fresh()
        before = (here / name).read_bytes()
        damaged(here / name)
        if (here / name).read_bytes() == before:
            continue
        code, said = nurbeam_says(*(str(word).format(here=here) for word in words))
        if code == 2 and name in said:
            kind = "refused"
        elif code == 0:
            kind = "same" if what(here) == expected else "SILENT"
        else:
            kind = f"EXIT {code}"
        counts[f"{words[0]} with {name}", kind] += 1
        assert kind in ("refused", "same"), (name, words, kind, said)


def lines_without_times(file):
    return [line.split(",")[:3] for line in file.read_text().splitlines()]


shutil.rmtree(scratch, ignore_errors=True)
scratch.mkdir(parents=True)
case = scratch / "case.json"
case.write_text(json.dumps(CASE))
equal_runs_write_equal_bytes()

half, finished, study = scratch / "half", scratch / "finished", scratch / "study"
interrupted_run(case, half)
must("run", case, "--out", finished, "--quiet")


def histories(directory):
    return (directory / "histories.csv").read_bytes()


def page(directory):
    text = (directory / "report.html").read_text()
    return text[text.index('id="data"'):]


def curves(directory):
    return (directory / "shape.dxf").read_bytes()


# As long a run as has been resumed: a minute of simulated time, and interrupted again.
resume = ["run", case, "--out", "{here}", "--quiet", "--resume"]
damage(finished, "restart.nc", histories, *resume)
damage(finished, "results.nc", histories, *resume)
damage(finished, "results.nc", page, "report", "{here}")
damage(finished, "run.json", page, "report", "{here}")
damage(finished, "results.nc", curves, "export", "{here}", "--time", "0.2", "--to", "{here}/shape.dxf")
damage(finished, "run.json", curves, "export", "{here}", "--time", "0.2", "--to", "{here}/shape.dxf")
for name in ("restart.nc", "results.nc"):
    for _ in range(tries):
        here = scratch / "damaged"
        shutil.rmtree(here, ignore_errors=True)
        shutil.copytree(half, here)
        before = (here / name).read_bytes()
        damaged(here / name)
        if before == (here / name).read_bytes():
            continue
        code, said = nurbeam_says("run", case, "--out", here, "--quiet", "--resume", "--set", "analysis.end_time=400")
        counts[f"interrupted run with {name}", "refused" if code == 2 else f"EXIT {code}"] += 1
        assert code == 2 and name in said, (name, code, said)

(scratch / "study.json").write_text(json.dumps(STUDY))
must("study", scratch / "study.json", "--out", study, "--quiet")
damage(study, "study.rows", lambda here: lines_without_times(here / "study.csv"),
       "study", scratch / "study.json", "--out", "{here}", "--quiet", "--resume")
for (what, kind), count in sorted(counts.items()):
    print(f"{what}: {count} {kind}")
