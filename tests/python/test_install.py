"""What is installed works by itself, away from the build tree."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

import nurbeam as nb

BUILD = Path(nb.__file__).parents[2]
TRIED = """
import nurbeam as nb, sys
assert nb.__file__.startswith({prefix!r}), nb.__file__
assert len(nb.read({file!r})) == 1
model = nb.Model()
model.add_beam([[0, 0, 0], [1, 0, 0]], section=nb.Circle(0.01), material=nb.Material(7850, 2e11), elements=4, name="rod")
model.add_support("rod", at="start", type="clamped")
assert model.run(type="static")[-1].beams["rod"].nodes[-1, 2] < 0
"""


@pytest.mark.parametrize("components", [["python", "runtime"]])
def test_an_installation_is_whole(tmp_path, components):
    for component in components:
        subprocess.run(["cmake", "--install", BUILD, "--component", component, "--prefix", tmp_path], check=True,
                       capture_output=True)
    package = tmp_path / "lib/python3/dist-packages"
    assert (package / "nurbeam/py.typed").exists() and not (package / "nurbeam/model.py").is_symlink()
    environment = {k: v for k, v in os.environ.items() if k != "NURBEAM_CAD"}
    environment["PYTHONPATH"] = str(package)
    code = TRIED.format(prefix=str(package), file=str(ROOT / "samples/zipline/cable.step"))
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_project_file_names_what_there_is():
    import tomllib

    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    assert project["project"]["name"] == "nurbeam"
    assert set(project["tool"]["scikit-build"]["cmake"]["targets"]) == {"nurbeam_python", "nurbeam-cad", "nurbeam-study"}
    assert (ROOT / project["project"]["readme"]).exists()
