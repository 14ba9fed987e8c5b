"""Expressions of constants are worked out once, as Python works them out; all others take the way of any code."""

from __future__ import annotations

import warnings
from random import Random

import pytest

from orchestra.resolve.substitutions.constant_expressions import of_constants

_PIECES = (
    *("'a'", '"b"', "'a b'", "1", "0", "2.5", "-3", "True", "False", "None", "x", "''", "'", "\\", "007"),
    *(
        " == ",
        " != ",
        "<",
        ">=",
        " and ",
        " or ",
        " not ",
        "not ",
        " in ",
        " not in ",
        " is ",
        " if ",
        " else ",
    ),
    *(
        "+",
        "-",
        "*",
        "/",
        "//",
        "%",
        "**",
        "<<",
        "(",
        ")",
        "[",
        "]",
        ",",
        ".",
        " ",
        "f'{1}'",
        "()",
        "lambda: 1",
    ),
    *(
        "len('a')",
        "int('4')",
        "max(1, 2)",
        "str(",
        "'A'.lower()",
        ".strip()",
        ".replace('a', 'b')",
        "abs",
        "int",
    ),
)


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        ("'sim' == 'sim' and 'a' != 'none'", "True"),
        ("not ('a' == \"b\")", "True"),
        ("3 + 4 > 6.5", "True"),
        ("-2 // 3", "-1"),
        ("'a' + 'b'", "ab"),
        ("'a' not in 'bc'", "True"),
        ("len('sim') == 3 and int('4') > 3", "True"),
        ("'Sim'.lower() in ['sim', 'real']", "True"),
        ("'a' if 'sim'.startswith('s') else 'b'", "a"),
        ("'a' 'b'", "ab"),
        ("3 * (2.5 - 1) >= 4", "True"),
        ("'a*' == 'b' or '*' in 'a*'", "True"),
    ],
)
def test_constants_are_compared_and_counted(expression: str, text: str) -> None:
    assert of_constants(expression) == text


@pytest.mark.parametrize(
    "expression",
    [
        *(
            "x",
            "1 / 0",
            "'a' < 1",
            "9 ** 9",
            "1 << 9",
            "'a' * 9",
            "[1] * 9",
            "(1,) * 9",
            "2 ** 3 * 2",
            "str(1) * 2",
            "'a'('b')",
            "1if 1 else 2",
            "f'{1}'",
        ),
        *("'\\d'", "'a' is 'a'", "", "1 +", "(1", "__import__('os')", "'a'.join('b')", "1\n+ 1"),
        *(
            "'a'['b']",
            "[1](2)",
            "(1)(2)",
            "None[0]",
            "sqrt(4.0)",
            "1 >> 9",
            "'a'.__class__",
            "open('/')",
            "in5",
        ),
        f"'{'a' * 300}'",
    ],
)
def test_what_is_more_than_constants_or_fails_is_left_alone(expression: str) -> None:
    assert of_constants(expression) is None


def test_what_is_worked_out_is_what_python_gives_without_a_warning() -> None:
    rnd, known = Random(7), 0  # noqa: S311 - the same every time
    for _ in range(3_000):
        expression = "".join(rnd.choices(_PIECES, k=rnd.randrange(1, 7))).strip()
        text = of_constants(expression)
        if text is not None:
            known += 1
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                assert text == str(eval(expression, {})), expression  # noqa: S307 - of ours
    assert known > 100


@pytest.mark.parametrize("begun", ["(" * 190, "not " * 49, "1 + " * 49, "1" + " )" * 95, "'a' in " * 28])
def test_there_is_one_way_to_read_an_expression(begun: str) -> None:
    assert of_constants(f"{begun}x") is None
