"""What the tests of the Python module share. NURBEAM names the program to compare with."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
os.environ.setdefault("MPLBACKEND", "Agg")


@pytest.fixture
def root():
    return ROOT


@pytest.fixture
def command():
    """Runs the command line; returns what it has said."""

    def run(*arguments, expect=0):
        done = subprocess.run([os.environ["NURBEAM"], *map(str, arguments)], capture_output=True, text=True)
        assert done.returncode == expect, done.stdout + done.stderr
        return done.stdout + done.stderr

    return run
