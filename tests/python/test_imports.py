"""Modules of nurbeam import one another one way, for type checkers and inside functions too."""

from __future__ import annotations

import ast
from pathlib import Path

import nurbeam as nb


def imported(text: str) -> set[str]:
    """The modules of the package that a module's text names, wherever in it."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            found |= {node.module.split(".")[0]} if node.module else {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("nurbeam."):
            found.add(str(node.module).split(".")[1])
        elif isinstance(node, ast.Import):
            found |= {alias.name.split(".")[1] for alias in node.names if alias.name.startswith("nurbeam.")}
    return found


def circle(imports: dict[str, set[str]]) -> list[str]:
    """Modules of which each imports the next one, the last the first; none where there is no circle."""
    done: set[str] = set()

    def search(path: list[str]) -> list[str]:
        for name in sorted(imports.get(path[-1], set()) - done):
            if name in path:
                return [*path[path.index(name) :], name]
            if found := search([*path, name]):
                return found
        done.add(path[-1])
        return []

    return next((found for start in sorted(imports) if (found := search([start]))), [])


def test_no_module_imports_itself_by_way_of_others() -> None:
    files = Path(nb.__file__).parent.glob("*.py")
    imports = {file.stem: imported(file.read_text(encoding="utf-8")) for file in files}
    assert {"curves", "errors", "model", "results", "simulation"} <= imports.keys()
    assert circle(imports) == []


def test_circles_are_seen_wherever_they_are_hidden() -> None:
    checked = "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from .results import Results\n"
    inside = "def plot() -> None:\n    from . import plots\n"
    assert imported(checked) == {"results"}
    assert imported(inside) == {"plots"}
    assert imported("import nurbeam.curves\nfrom nurbeam.errors import Error\nimport numpy") == {"curves", "errors"}
    assert circle({"results": imported(inside), "plots": imported(checked), "curves": set()})[0] == "plots"
    assert circle({"results": imported(inside), "plots": {"curves"}, "model": {"results", "curves"}}) == []
