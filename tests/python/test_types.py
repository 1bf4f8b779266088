"""The types that the module says are those that it has, and everything has its help."""

import inspect
import os
import subprocess
import sys
from pathlib import Path

import pytest

import nurbeam as nb

PACKAGE = Path(nb.__file__).resolve().parent


def mypy(*arguments, cwd, **environment):
    done = subprocess.run([sys.executable, "-m", *arguments], capture_output=True, text=True, cwd=cwd,
                          env={**os.environ, **environment})
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture(scope="module")
def checked(tmp_path_factory):
    """The words that check a program strictly; what numpy's types are is found once for all."""
    return ["mypy", "--strict", "--ignore-missing-imports", "--cache-dir", str(tmp_path_factory.mktemp("cache"))]


def test_the_package_is_typed(tmp_path, checked):
    mypy(*checked, "-p", "nurbeam", cwd=tmp_path, MYPYPATH=str(PACKAGE.parent))


def test_the_stubs_of_the_compiled_part_are_those_of_the_module(tmp_path):
    # Classes have pybind11's metaclass, and its __init__ where there is no other.
    (tmp_path / "allowed").write_text("nurbeam\\._core\\.[A-Za-z]+(\\.__init__)?\n")
    (tmp_path / "mypy.ini").write_text("[mypy]\nignore_missing_imports = True\n")
    mypy("mypy.stubtest", "nurbeam._core", "--ignore-positional-only", "--allowlist",
         str(tmp_path / "allowed"), "--mypy-config-file", str(tmp_path / "mypy.ini"),
         cwd=tmp_path, MYPYPATH=str(PACKAGE.parent))


def test_a_users_program_is_checked(tmp_path, checked):
    (tmp_path / "program.py").write_text(
        "import nurbeam as nb\n"
        "curve = nb.Curve.line([0, 0, 0], [1, 0, 0])\n"
        "reveal_type(curve.length)\n"
        "nb.Model().run(end_tme=1)\n"
    )
    done = subprocess.run([sys.executable, "-m", *checked, "program.py"], capture_output=True, text=True, cwd=tmp_path,
                          env={**os.environ, "MYPYPATH": str(PACKAGE.parent)})
    assert 'Revealed type is "builtins.float"' in done.stdout, done.stdout


def test_everything_has_its_help():
    missing = []
    for name in nb.__all__:
        thing = getattr(nb, name)
        if not inspect.getdoc(thing):
            missing.append(name)
        if not inspect.isclass(thing):
            continue
        for part, value in vars(thing).items():
            public = not part.startswith("_")
            if public and (callable(value) or isinstance(value, (property, staticmethod, classmethod))):
                if not inspect.getdoc(value):
                    missing.append(f"{name}.{part}")
    assert not missing
