"""What `import orchestra` offers, and what it costs."""

from __future__ import annotations

import ast
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import orchestra
import orchestra.testing

_NAMES = {
    *(
        "Code",
        "DescriptionError",
        "Event",
        "Inputs",
        "Location",
        "OrchestraError",
        "Plan",
        "Problem",
        "Process",
    ),
    *("RunError", "Severity", "Span", "UsageError", "check", "inputs_from", "make_plan"),
}
_TESTING_NAMES = {"Run", "free_domain", "launched", "planned"}


def test_the_public_names_are_these() -> None:
    assert set(orchestra.__all__) == _NAMES
    assert set(orchestra.testing.__all__) == _TESTING_NAMES


@pytest.mark.parametrize("module", ["orchestra", "orchestra.testing"])
def test_every_public_name_is_what_it_says(module: str) -> None:
    package = import_module(module)
    for name in package.__all__:
        value = getattr(package, name)
        assert value.__name__ == name
        assert value.__doc__
        assert name in dir(package)


@pytest.mark.parametrize("module", ["orchestra", "orchestra.testing"])
def test_what_checkers_of_types_see_is_what_is_there(module: str) -> None:
    """The lazy table and the imports under TYPE_CHECKING name the same homes."""
    package = import_module(module)
    assert package.__file__
    tree = ast.parse(Path(package.__file__).read_text("utf-8"))
    seen = {
        alias.name: node.module
        for block in tree.body
        if isinstance(block, ast.If)
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert set(seen) == set(package.__all__)
    for name, home in seen.items():
        assert home is not None
        assert getattr(import_module(home), name) is getattr(package, name)


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        orchestra.nothing  # type: ignore[attr-defined]  # noqa: B018


def test_importing_it_imports_nothing_else() -> None:
    count = (
        "import sys; before = set(sys.modules); import orchestra; print(*sorted(set(sys.modules) - before))"
    )
    found = subprocess.run(
        [sys.executable, "-c", count], capture_output=True, text=True, check=True, timeout=60
    )
    assert [name for name in found.stdout.split() if not name.startswith("importlib")] == ["orchestra"]
