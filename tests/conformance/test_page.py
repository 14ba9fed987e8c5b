from __future__ import annotations

import pytest

from tests.conformance.page import faults, render
from tests.conformance.rows import Difference, Language, Row, Section

_ROWS = (Row("a", "one"), Row("b c", "two", ("D1",)), Row("d", "three", absent="not needed"))
_LANGUAGE = Language((Section("1.1", "Things", _ROWS),), {"D1": Difference("that", "this | more", "so")})
_TESTS = {"1.1 a": ["x/test_y.py::test_it_is", "x/test_y.py::test_it_was"], "1.1 b c": ["test_z.py::test_z"]}


def test_a_page_tells_what_is_tested_where() -> None:
    lines = render(_LANGUAGE, _TESTS).splitlines()
    assert "| `a` | one | as upstream | [x/test_y.py](../tests/x/test_y.py): it is, it was |" in lines
    assert "| b c | two | differs: [D1](#d1) | [test_z.py](../tests/test_z.py): z |" in lines
    assert "| `d` | three | not provided: not needed |  |" in lines
    assert r'| <a id="d1"></a>D1 | that | this \| more | so |  |' in lines


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
