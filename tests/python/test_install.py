"""What is installed works by itself, away from the build tree."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

import nurbeam as nb

# Programs of others hang at their end in libraries that the sanitizer was not made for.
pytestmark = pytest.mark.skipif("libasan" in os.environ.get("LD_PRELOAD", ""), reason="starts CMake and pip")

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

WHEEL_TRIED = """
from importlib.metadata import version
assert version("nurbeam") == nb.__version__
study = nb.study({"nurbeam_study": 1, "variables": [{"name": "x", "range": [0, 1]}], "plan": {"grid": [3]},
                  "quantities": [{"name": "y", "value": "2 * x"}]})
assert list(study["y"]) == [0, 1, 2]
"""


def cached(variable):
    """What the build was configured with."""
    return re.search(rf"^{variable}:\w+=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.M)[1]


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


@pytest.fixture(scope="module")
def build_backend(tmp_path_factory):
    """The directory of scikit-build-core."""
    directory = tmp_path_factory.mktemp("backend")
    fetched = subprocess.run([Path(__file__).with_name("fetch_build_backend"), directory], capture_output=True, text=True)
    if fetched.returncode == 77:
        pytest.skip("Debian 13's scikit-build-core is not to be had")
    assert fetched.returncode == 0, fetched.stderr
    return directory


EVERYWHERE = re.compile(r"(linux-vdso|ld-linux|lib(c|m|dl|rt|pthread|util|resolv|stdc\+\+|gcc_s)\.so)")


def libraries_outside(file, package):
    """What a file of a wheel would take from the system, besides the C library and the compiler's."""
    if file.parent.name == "lib":  # found by what loads it
        needed = re.findall(r"NEEDED +(\S+)", subprocess.run(["objdump", "-p", file], capture_output=True, text=True).stdout)
        return [name for name in needed if not EVERYWHERE.search(name) and not (package / "lib" / name).exists()]
    lines = subprocess.run(["ldd", file], capture_output=True, text=True, check=True).stdout.splitlines()
    return [line.strip() for line in lines if not EVERYWHERE.search(line) and str(package) not in line]


@pytest.mark.skipif(cached("CMAKE_BUILD_TYPE") != "Release", reason="a wheel is compiled as the preset release is")
def test_pip_makes_a_wheel_that_is_whole(tmp_path, build_backend):
    # Compiled beside the build and by its compiler: ccache has it all.
    environment = {k: v for k, v in os.environ.items() if k not in ("NURBEAM_CAD", "PYTHONPATH")}
    environment["CXX"] = cached("CMAKE_CXX_COMPILER")
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv"], check=True)  # for numpy
    python = tmp_path / "venv/bin/python"
    pip = [python, "-m", "pip", "--disable-pip-version-check", "install", "--no-index", "--no-deps", "--no-build-isolation",
           f"--config-settings=build-dir={BUILD.with_name(BUILD.name + '_wheel')}"]
    made = subprocess.run([*pip, ROOT], capture_output=True, text=True, env={**environment, "PYTHONPATH": str(build_backend)})
    assert made.returncode == 0, made.stdout + made.stderr
    package = next((tmp_path / "venv").glob("lib/python*/site-packages/nurbeam"))
    for file in [next(package.glob("_core*.so")), package / "nurbeam-cad", package / "nurbeam-study", *(package / "lib").iterdir()]:
        outside = libraries_outside(file, package)
        assert not outside, f"{file.name} needs what the wheel does not carry: {outside}"
    code = TRIED.format(prefix=str(tmp_path / "venv"), file=str(ROOT / "samples/zipline/cable.step"))
    code += WHEEL_TRIED
    done = subprocess.run([python, "-c", code], capture_output=True, text=True, env=environment, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_project_file_names_what_there_is():
    import tomllib

    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    assert project["project"]["name"] == "nurbeam"
    assert set(project["tool"]["scikit-build"]["build"]["targets"]) == {"nurbeam_python", "nurbeam-cad", "nurbeam-study"}
    assert (ROOT / project["project"]["readme"]).exists()
