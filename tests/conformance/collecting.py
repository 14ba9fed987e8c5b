"""Which tests hold to which rows, as pytest's own collection has it; no test is run."""

from __future__ import annotations

import contextlib
import io
from collections import defaultdict
from typing import TYPE_CHECKING

import pytest

from tests.conformance.rows import ROOT

if TYPE_CHECKING:
    from pathlib import Path

_TESTS = ROOT / "tests"


class _Marked:
    """A plug-in that keeps what the marks of all collected tests say."""

    def __init__(self) -> None:
        self.tests: dict[str, set[str]] = defaultdict(set)

    @pytest.hookimpl(tryfirst=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        for item in items:
            for mark in item.iter_markers("conforms"):
                for row in mark.args:
                    self.tests[row].add(_called(item))


def marked_tests() -> dict[str, list[str]]:
    """Return the tests of every row that has any, as `room/test_file.py::test_name`, sorted.

    Only files that speak of rows are imported. Raises `RuntimeError` where pytest cannot collect them.
    """
    files = [str(path) for path in sorted(_TESTS.rglob("test_*.py")) if _speaks(path)]
    marked, said = _Marked(), io.StringIO()
    with contextlib.redirect_stdout(said):
        status = pytest.main(["--collect-only", "-qqq", "-p", "no:cacheprovider", *files], plugins=[marked])
    if status != pytest.ExitCode.OK:
        raise RuntimeError(said.getvalue())
    return {row: sorted(tests) for row, tests in marked.tests.items()}


def _speaks(path: Path) -> bool:
    text = path.read_text("utf-8")
    return "mark.conforms" in text or "tests.conformance.marks" in text


def _called(item: pytest.Item) -> str:
    name = getattr(item, "originalname", None) or item.name
    return f"{item.path.relative_to(_TESTS).as_posix()}::{name}"
