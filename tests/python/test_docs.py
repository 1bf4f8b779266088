"""The page is one session that runs, and the reference is that of the module."""

import os
import re
import shutil
import subprocess
import sys

from conftest import ROOT


def test_the_blocks_of_the_page_run_in_their_order(tmp_path):
    page = (ROOT / "docs/python.md").read_text()
    session = "\n".join(re.findall(r"```python\n(.*?)```", page, re.S))
    assert session.count("nb.") > 5 and session.count("```") == 0
    shutil.copytree(ROOT / "samples", tmp_path / "samples")
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", session], capture_output=True, text=True, cwd=tmp_path,
                          env={**os.environ, "MPLBACKEND": "Agg"})
    assert done.returncode == 0, done.stdout + done.stderr
    assert "beams[0].section.radius" in done.stdout and "supports[1].at" in done.stdout
    for picture in re.findall(r'savefig\("(.*?)"\)', session):
        assert "<svg" in (tmp_path / picture).read_text()


def test_the_ten_lines_of_the_overview_run(tmp_path):
    lines = "\n".join(re.findall(r"```python\n(.*?)```", (ROOT / "docs/api.md").read_text(), re.S))
    shutil.copytree(ROOT / "samples", tmp_path / "samples")
    subprocess.run([sys.executable, "-W", "ignore", "-c", lines], check=True, cwd=tmp_path)


def test_the_pictures_of_the_page_exist():
    page = (ROOT / "docs/python.md").read_text()
    for picture in re.findall(r"!\[.*?\]\((.*?)\)", page):
        assert (ROOT / "docs" / picture).exists(), picture


def test_the_reference_is_that_of_the_module():
    made = subprocess.run([sys.executable, ROOT / "docs/make_python_reference"], capture_output=True, text=True, check=True)
    assert made.stdout == (ROOT / "docs/python-reference.md").read_text(), (
        "docs/python-reference.md is not of this module: docs/make_python_reference > docs/python-reference.md"
    )
