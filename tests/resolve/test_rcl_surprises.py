"""Plain scalars that rcl reads as something else than they say."""

from __future__ import annotations

import pytest

from orchestra.errors import Code, Problems
from orchestra.resolve.rcl.files import read_parameter_file


def _told(value: str) -> list[tuple[int, int, str | None]]:
    problems = Problems()
    read_parameter_file(f"/n:\n  ros__parameters:\n    x: {value}\n", "p.yaml", problems)
    assert all(problem.code is Code.SURPRISING_SCALAR for problem in problems)
    spans = [(problem.span, problem.suggestion) for problem in problems if problem.span is not None]
    return [(span.column, span.end_column, suggestion) for span, suggestion in spans]


@pytest.mark.parametrize(
    ("value", "instead"),
    [
        ("y", '"y"'),
        ("N", '"N"'),
        ("on", "true"),
        ("Off", "false"),
        ("yes", "true"),
        ("NO", "false"),
        ("0452", "452"),
        ("-010", "-10"),
        ("08", "8"),
        ("NaN", ".nan"),
        ("nan", ".nan"),
        ("inf", ".inf"),
        ("-Infinity", "-.inf"),
        ("1_000", "1000"),
        ("0o17", "15"),
        ("0b11", "3"),
        ("null", '"null"'),
        ("~", '"~"'),
        ("99999999999999999999", '"99999999999999999999"'),
    ],
)
def test_a_value_that_is_read_otherwise_is_told_with_what_to_write(value: str, instead: str) -> None:
    assert _told(value) == [(8, 8 + len(value), instead)]


@pytest.mark.parametrize(
    "value",
    [
        *(
            "true",
            "False",
            "TRUE",
            "'y'",
            '"on"',
            "!!str y",
            "1",
            "-7",
            "0",
            "00",
            "007",
            "0x10",
            "1.5",
            ".5",
            "5.",
        ),
        *(
            "1e-6",
            "1E5",
            "123E5",
            ".nan",
            "-.inf",
            ".Inf",
            "12:30",
            "2024-01-01",
            "1.2.3",
            "map",
            "nano",
            "infra",
        ),
        *("only", "[1, 2]", "[a, b]", "[true, false]", "['y', 'n']", "|\n      y"),
    ],
)
def test_a_value_that_is_read_as_it_says_is_fine(value: str) -> None:
    assert _told(value) == []


def test_of_a_list_the_first_is_told() -> None:
    assert _told("[y, n]") == [(9, 10, '"y"')]
