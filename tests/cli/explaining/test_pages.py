"""Every code has a page, and the examples of every page do what it says."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.cli.checking import problems_in
from orchestra.cli.explaining.page import has_page, page_of
from orchestra.cli.targets import targets
from orchestra.errors import Code
from orchestra.resolve.command_line import inputs_from

if TYPE_CHECKING:
    from orchestra.cli.explaining.page import Example

_PAGES = Path(__file__).parents[3] / "orchestra/cli/explaining/pages"


@pytest.fixture
def prefix(tmp_path: Path) -> Path:
    """Return the prefix of the package `demo`, which examples use."""
    made = tmp_path / "install"
    for folder in ("share/ament_index/resource_index/packages", "lib/demo", "share/demo"):
        (made / folder).mkdir(parents=True)
    (made / "share/ament_index/resource_index/packages/demo").touch()
    for program in ("talker", "listener"):
        (made / "lib/demo" / program).write_text("#!/bin/sh\n", "utf-8")
        (made / "lib/demo" / program).chmod(0o755)
    return made


def test_every_code_has_a_page() -> None:
    assert [code.value for code in Code if not has_page(code)] == []


def test_every_page_has_a_code() -> None:
    assert {path.stem for path in _PAGES.iterdir()} <= {code.value for code in Code}


@pytest.mark.parametrize("code", [code for code in Code if has_page(code)])
def test_the_wrong_example_gives_the_code_and_nothing_else(
    tmp_path: Path, prefix: Path, monkeypatch: pytest.MonkeyPatch, code: Code
) -> None:
    assert _codes(page_of(code).wrong, tmp_path / "work", prefix, monkeypatch) == {code.value}


@pytest.mark.parametrize("code", [code for code in Code if has_page(code)])
def test_the_right_example_gives_nothing(
    tmp_path: Path, prefix: Path, monkeypatch: pytest.MonkeyPatch, code: Code
) -> None:
    assert _codes(page_of(code).right, tmp_path / "work", prefix, monkeypatch) == set()


def _codes(
    examples: tuple[Example, ...], work: Path, prefix: Path, monkeypatch: pytest.MonkeyPatch
) -> set[str]:
    """Return the codes of what is wrong with the files of an example, checked together, or launched if it says so."""
    for example in examples:
        if example.file is not None:
            (work / example.file).parent.mkdir(parents=True, exist_ok=True)
            (work / example.file).write_text(example.text, "utf-8")
    monkeypatch.chdir(work)
    monkeypatch.syspath_prepend(work)
    environment = {
        "PATH": os.environ["PATH"],
        "HOME": str(work),
        "AMENT_PREFIX_PATH": str(prefix),
        "PYTHONPATH": str(work),
    }
    typed = [example.text for example in examples if example.language == "console"]
    if typed:
        return _launched(typed[0], work, environment)
    found = problems_in(targets(["."]), inputs_from([], environment=environment))
    return {problem.code.value for problem in found}


def _launched(typed: str, work: Path, environment: dict[str, str]) -> set[str]:
    """Return the codes of the problems that a command line tells: in JSON, as a list."""
    words = typed.strip().removeprefix("$ orchestra ").split()
    command = [sys.executable, "-m", "orchestra", *words, "--format", "github"]
    done = subprocess.run(
        command, cwd=work, env=environment, capture_output=True, text=True, check=False, timeout=60
    )
    said = f"{done.stdout}{done.stderr}"
    return {code.value for code in Code if code.value in said}
