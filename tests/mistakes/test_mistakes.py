"""Broken files of every kind: each mistake is told at exactly the wrong text, with what was meant, and nothing beside it."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

import pytest

from tests.mistakes.checked import Checker
from tests.mistakes.codes import PAGE, with_table
from tests.mistakes.corpus import cases

if TYPE_CHECKING:
    from tests.mistakes.corpus import Case

_MAIN: Final = {"yaml": "main.launch.yaml", "xml": "main.launch.xml", "parameters": "params.yaml"}
_FOUND: Final = [
    (kind, case)
    for kind, main in _MAIN.items()
    for path in sorted(Path(__file__).parent.glob(f"{kind}*.txt"))
    for case in cases(path, main)
]
_CASES: Final = [pytest.param(case, id=f"{kind}: {case.title}") for kind, case in _FOUND]
_PATHS: Final = [case for case in _CASES if re.search(r"\b(path|file)\b", str(case.id))]


@pytest.fixture(scope="module")
def checker(tmp_path_factory: pytest.TempPathFactory) -> Checker:
    """A folder with packages beside it."""
    return Checker(tmp_path_factory.mktemp("mistakes"))


@pytest.mark.parametrize("case", _CASES)
def test_a_mistake_is_told_once_at_its_place(
    case: Case, checker: Checker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(checker.folder)
    assert checker.differences(case) == ""


@pytest.mark.parametrize("case", _PATHS)
def test_a_mistake_in_a_path_is_told_where_folders_have_blanks_in_their_names(
    case: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "my own robot").mkdir()
    checker = Checker(tmp_path / "my own robot")
    monkeypatch.chdir(checker.folder)
    assert checker.differences(case) == ""


@pytest.mark.parametrize("case", _CASES[::6])
def test_a_byte_order_mark_and_the_line_ends_of_windows_move_nothing(
    case: Case, checker: Checker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(checker.folder)
    files = {name: "\ufeff" + text.replace("\n", "\r\n") for name, text in case.files.items()}
    assert checker.differences(replace(case, files=files)) == ""


def test_every_case_has_a_mistake_and_a_name_of_its_own() -> None:
    names = [param.id for param in _CASES]
    assert len(names) == len(set(names))
    assert all(case.mistakes for _, case in _FOUND)


def test_the_documentation_lists_all_codes() -> None:
    """Where it does not, `python -m tests.mistakes` writes the table."""
    text = PAGE.read_text("utf-8")
    assert text == with_table(text)
