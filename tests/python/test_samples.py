"""Every sample runs, as it stands, and draws its picture."""

import os
import subprocess
import sys

import pytest
from conftest import ROOT

SAMPLES = sorted((ROOT / "samples/python").glob("*.py"))


def test_there_are_ten():
    assert len(SAMPLES) == 10
    assert all(f"`{sample.name}`" in (ROOT / "samples/python/README.md").read_text() for sample in SAMPLES)


@pytest.mark.parametrize("sample", SAMPLES, ids=lambda path: path.stem)
def test_samples_run(sample, tmp_path):
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    done = subprocess.run([sys.executable, sample, tmp_path / "picture.svg"], capture_output=True, text=True,
                          env=environment, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "<svg" in (tmp_path / "picture.svg").read_text()
