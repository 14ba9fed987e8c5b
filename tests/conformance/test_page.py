from __future__ import annotations

import subprocess
import sys

import pytest

from tests.conformance.page import faults, render
from tests.conformance.rows import ROOT, Difference, Language, Row, Section

_ROWS = (Row("a", "one"), Row("b c", "two", ("D1",)), Row("d_e", "three", absent="not needed, D1"))
_LANGUAGE = Language((Section("1.1", "Things", _ROWS),), {"D1": Difference("that", "this | more", "so")})
_TESTS = {"1.1 a": ["x/test_y.py::test_it_is", "x/test_y.py::test_it_was"], "1.1 b c": ["test_z.py::test_z"]}


def test_every_row_is_tested_and_the_page_says_so() -> None:
    """In a process of its own, because pytest collects there."""
    command = [sys.executable, "-m", "tests.conformance", "--check"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, timeout=100)
    assert (done.returncode, done.stdout) == (0, ""), done.stderr


def test_a_page_tells_what_is_tested_where() -> None:
    lines = render(_LANGUAGE, _TESTS).splitlines()
    assert "| a | one | as upstream | [x/y]: it is, it was |" in lines
    assert "| b c | two | differs: [D1](#d1) | [z]: z |" in lines
    assert "| `d_e` | three | not provided: not needed, [D1](#d1) |  |" in lines
    assert r'| <a id="d1"></a>D1 | that | this \| more | so |  |' in lines
    assert lines[-2:] == ["[z]: ../tests/test_z.py", "[x/y]: ../tests/x/test_y.py"]


@pytest.mark.parametrize(
    ("tests", "told"),
    [
        ({**_TESTS, "D1": ["t"]}, []),
        (_TESTS, ["no test of 'D1'"]),
        ({"1.1 a": ["t"], "D1": ["t"]}, ["no test of '1.1 b c'"]),
        ({**_TESTS, "D1": ["t"], "9.9 x": ["t::u"]}, ["no row '9.9 x': t::u"]),
    ],
)
def test_what_is_wrong_is_told(tests: dict[str, list[str]], told: list[str]) -> None:
    assert faults(_LANGUAGE, tests) == told


def test_a_difference_that_there_is_not_is_told() -> None:
    language = Language((Section("1.1", "Things", (Row("a", "one", ("D9",)),)),), {})
    assert faults(language, {"1.1 a": ["t"]}) == ["no difference 'D9'"]
