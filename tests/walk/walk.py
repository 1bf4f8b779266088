"""walk.py NURBEAM DIRECTORY [DRAWINGS...]: every drawing is read, runs for ten steps as beams along all of its
chains, and is written in four formats, which nurbeam reads back, and so do FreeCAD and ezdxf where they are installed.

Nothing may be told but what inspect tells of the file and what the rules below allow. Other folders of drawings than
the corpus may be named. A file that inspect refuses is listed; it must be refused with exit code 2 and its name.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
FORMATS = ("step", "igs", "dxf", "brep")
STEPS = 10
# What a run tells of a drawing as it is, besides what inspect tells.
ALLOWED = re.compile("is closed; the beam is open at its seam|curves? [-0-9, and]+ of .* meet at|"
                     "tangents that differed by up to 0.0001 rad were made one|the gap of .* was closed|"
                     "a curve of degree above 3 was approximated|declare no length unit")
TURNS_BACK = "turns right back on itself"  # a chain over which no section can be carried: then each curve is a beam


def messages(text):
    """The sentences of what was told, without the name of the file that they begin with."""
    lines = [re.sub(r"^(note|warning|error): \S+?: ", r"\1: ", line) for line in text.splitlines()]
    return [line for line in lines if line and not line.startswith("reading ")]


class Walk:
    def __init__(self, program, directory):
        self.program, self.directory = program, directory
        self.problems, self.refused, self.written = [], 0, {}

    def nurbeam(self, *arguments):
        return subprocess.run([str(self.program), *map(str, arguments)], capture_output=True, text=True, timeout=600,
                              cwd=self.directory)

    def wrong(self, file, what):
        self.problems.append(f"{file}: {what}")
        print("WRONG:", self.problems[-1], flush=True)

    def curves(self, file):
        """The curves of a file, or none, and what was told."""
        done = self.nurbeam("inspect", file, "--json")
        told = messages(done.stderr)
        return (json.loads(done.stdout)[0]["curves"] if done.returncode == 0 else None), told, done

    def walk(self, number, file):
        curves, told, done = self.curves(file)
        if curves is None:
            self.refused += 1
            print("refused:", done.stderr.strip()[:200], flush=True)
            if done.returncode != 2 or file.name not in done.stderr:
                self.wrong(file, f"exit code {done.returncode}: {done.stderr[:300]}")
            return
        shown = [curve for curve in curves if not curve["hidden"]] or curves
        lengths = [curve["length [m]"] for curve in shown]
        size = min(max(lengths), 20 * min(lengths))
        done, out = self.run(number, [{"file": str(file), "chains": "all"}], size)
        if TURNS_BACK in done.stderr:
            done, out = self.run(number, [{"file": str(file), "curve": c["index"]} for c in shown], size)
        if done.returncode != 0:
            self.wrong(file, f"exit code {done.returncode}: {done.stderr[-400:]}")
            return
        for line in messages(done.stderr):
            if line not in told and not ALLOWED.search(line):
                self.wrong(file, line)
        self.read_back(file, out)

    def run(self, number, axes, size):
        step = min(1e-3, size * 1e-3)
        beams = [{"name": f"beam {k}", "axis": axis, "corners": "hinge", "section": {"radius": size / 500},
                  "stress_free": "as-drawn-without-torsion",
                  "material": {"density": 7850, "youngs_modulus": "200 GPa", "poissons_ratio": 0.3}}
                 for k, axis in enumerate(axes)]
        case = {"nurbeam": 1, "beams": beams,
                "supports": [{"beam": beam["name"], "at": "start", "type": "clamped"} for beam in beams],
                "analysis": {"end_time": STEPS * step, "step": step},
                "output": {"report": False,
                           "cad": {"formats": ["step", "iges", "dxf", "brep"], "times": [STEPS * step]}}}
        path = self.directory / f"{number}.json"
        path.write_text(json.dumps(case))
        out = self.directory / f"out_{number}"
        shutil.rmtree(out, ignore_errors=True)
        return self.nurbeam("run", path, "--quiet", "--out", out), out

    def read_back(self, file, out):
        lengths = {}
        for ending in FORMATS:
            found = list(out.glob(f"*.{ending}"))
            if len(found) != 1:
                self.wrong(file, f"{len(found)} files of {ending}")
                continue
            curves, told, done = self.curves(found[0])
            if curves is None:
                self.wrong(file, f"its {ending} is not read back: {done.stderr[:300]}")
                continue
            for line in told:
                if not ALLOWED.search(line):
                    self.wrong(file, f"its {ending}: {line}")
            lengths[ending] = sorted(curve["length [m]"] for curve in curves)
            self.written[str(found[0])] = sum(lengths[ending])
        for ending, of in lengths.items():
            first = next(iter(lengths.values()))
            if len(of) != len(first) or any(abs(a - b) > 1e-9 * max(first) for a, b in zip(of, first)):
                self.wrong(file, f"its {ending} has other curves than its {next(iter(lengths))}")

    def compare(self, reader, totals):
        """Another program's lengths of the files in metres, or what it found wrong."""
        for file, total in totals.items():
            if isinstance(total, str):
                self.wrong(file, f"{reader}: {total}")
            elif abs(total - self.written[file]) > 1e-6 * self.written[file]:
                self.wrong(file, f"{reader}: {total} m in all, not {self.written[file]}")
        print(f"{reader} has read {len(totals)} files", flush=True)

    def ask_freecad(self):
        if not (shutil.which("freecad") and shutil.which("xvfb-run")):
            print("no freecad or xvfb-run")
            return
        # Debian's FreeCAD 0.20 crashes where it imports without a window; its browser does not start as root in a sandbox.
        environment = {**os.environ, "HOME": str(self.directory), "QTWEBENGINE_CHROMIUM_FLAGS": "--no-sandbox",
                       "QTWEBENGINE_DISABLE_SANDBOX": "1"}
        (self.directory / "to_read").write_text(
            "\n".join(file for file in self.written if not file.endswith(".dxf")))
        answer = self.directory / "lengths.json"
        answer.unlink(missing_ok=True)
        subprocess.run(["timeout", "1200", "xvfb-run", "--auto-servernum", "freecad", str(HERE / "read_edges.py")],
                       cwd=self.directory, env=environment, stdin=subprocess.DEVNULL, capture_output=True)
        if answer.exists():
            self.compare("FreeCAD", json.loads(answer.read_text()))
        else:
            self.wrong("FreeCAD", "it ended without an answer")

    def ask_ezdxf(self):
        done = subprocess.run(["/usr/bin/python3", HERE / "read_drawings.py",
                               *(file for file in self.written if file.endswith(".dxf"))], capture_output=True, text=True)
        if done.returncode == 77:
            print("no ezdxf (python3-ezdxf)")
        elif done.returncode == 0:
            self.compare("ezdxf", json.loads(done.stdout))
        else:
            self.wrong("ezdxf", done.stderr[-400:])


def drawings(folders):
    for folder in folders:
        for file in sorted(pathlib.Path(folder).resolve().iterdir()):
            if file.is_file() and not file.name.startswith(".") and file.suffix not in (".md", ".py"):
                yield file


def main(program, directory, *folders):
    walk = Walk(pathlib.Path(program).resolve(), pathlib.Path(directory).resolve())
    walk.directory.mkdir(parents=True, exist_ok=True)
    corpus = HERE.parent / "corpus"
    files = list(drawings(folders or (corpus, corpus / "kinds")))
    for number, file in enumerate(files):
        walk.walk(number, file)
    walk.ask_freecad()
    walk.ask_ezdxf()
    print(f"{len(files)} drawings, {walk.refused} refused, {len(walk.problems)} problems")
    return 1 if walk.problems or not files or (walk.refused and not folders) else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
