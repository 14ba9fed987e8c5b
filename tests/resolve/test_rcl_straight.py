"""Parameter files that are read line by line hold what the reader that follows rcl finds in them, and it tells nothing."""

from __future__ import annotations

import random

import pytest

from orchestra.errors import Problems
from orchestra.resolve.rcl.files import read_kept
from orchestra.resolve.rcl.straight import sections_of

_NODES = ("/**", "n0", "/n1", "/**/n2", "/x/n3", "x", "y", "n4", "/*", "x_y")
_NAMES = (
    *("a", "b", "a.b", "g", "h", "rate", "frame_id", "yes", "on", "null", "long-name", "a.c", "id", "serial"),
    *("c", "d", "e", "k", "m"),
)
_VALUES = (
    *(
        "1",
        "-2",
        "0",
        "1.5",
        "20.0",
        "1e-9",
        "true",
        "True",
        "false",
        "word",
        "base_link",
        "/tf",
        "topic",
        "front",
    ),
    *(
        "192.168.0.1",
        "a-b",
        "a.b",
        "'q'",
        '"q r"',
        '"x.y/z"',
        "[1, 2]",
        "[1.0, 2.0]",
        "[a, b]",
        "[a]",
        "[ 1 , 2 ]",
    ),
    *("{x: 1}", "{x: 1, y: -2.5, z: 'a b'}", "9223372036854775807", "[true, false]", "[1,2]", "v1", "''"),
    *(
        "[\"a\", 'b']",
        "text  # c",
        "5 # five",
        '"x" #c',
        "[1] # c",
        "x#y",
        "0.0",
        "F1",
        "1.10",
        "0.50",
        "3.00",
        "[0.10, 2.0]",
        "{id: 1.10, z: -0.20}",
        "{version: 2.0, x: 2.50}",
        "\n%- 1\n%- 2",
        "\n%- 'q r'",
    ),
    *("[1,\n% 2,\n%3]", "[1 ,\n%\n% 2 ]"),
)
_ODD = (
    *(
        "007",
        "1.50",
        "-0.0",
        "1e3",
        "yes",
        "off",
        "y",
        "null",
        "~",
        "ture",
        "inf",
        ".nan",
        "1_000",
        "0x10",
        "0o7",
    ),
    *(
        "'it''s'",
        '"a\\nb"',
        '"5 m"',
        "5m",
        "[1, 2.5]",
        "[]",
        "['0.5 0.3']",
        "[a, [b]]",
        "{}",
        "{a.b: 1}",
        "{x: [1]}",
    ),
    *(
        "",
        "9223372036854775808",
        "[yes]",
        "a, b",
        "a b",
        "a:b",
        "a: b",
        "+5",
        "-",
        "-x",
        "f",
        "tru",
        "1,5",
        "2.",
    ),
    *(
        '""',
        "é",
        "!!str 5",
        "&a 1",
        "*a",
        "|",
        "> x",
        "it's",
        "a]",
        "[x,]",
        "[1\n2]",
        "\n%- [1]",
        "\n%- a: 1",
        "1\n%2",
    ),
)
_BETWEEN = ("", "   ", "# c", "      # c", "  #", "---", "\t")


def _lines(chance: random.Random, indent: int, depth: int, odd: float) -> list[str]:
    found = []
    for drawn in chance.sample(_NAMES, chance.randrange(1, 5)):
        name = chance.choice((*_NODES, "ros__parameters", "'q'", drawn)) if chance.random() < odd else drawn
        deeper = indent + chance.choice((2, 2, 4, 1, 0 if chance.random() < odd else 2))
        if chance.random() < 0.2 and depth < 3:
            found += [
                f"{' ' * indent}{name}:{chance.choice(('', ' # c'))}",
                *_lines(chance, deeper, depth + 1, odd),
            ]
        else:
            value = chance.choice(_ODD if chance.random() < odd else _VALUES).replace("%", " " * deeper)
            found.append(f"{' ' * indent}{name}: {value}")
        if chance.random() < 0.05:
            found.append(chance.choice(_BETWEEN[: 7 if odd else 5]))
    return found


def _nodes(chance: random.Random, indent: int, odd: float) -> list[str]:
    found = []
    for name in chance.sample(_NODES, chance.randrange(1, 4)):
        found.append(f"{' ' * indent}{name}:")
        if indent < 6 and chance.random() < 0.25:
            found += _nodes(chance, indent + 2, odd)
            continue
        deeper = indent + chance.choice((2, 2, 4, 1))
        found += [f"{' ' * deeper}ros__parameters:", *_lines(chance, deeper + 2, 0, odd)]
        found += _lines(chance, deeper, 0, odd) if chance.random() < odd else []
    return found


@pytest.mark.parametrize("odd", [0.0, 0.1])
def test_what_is_plain_to_see_is_what_the_reader_of_events_finds(odd: float) -> None:
    chance, plain = random.Random(5), 0  # noqa: S311 - the same each time
    for _ in range(250):
        text = "\n".join(_nodes(chance, 0, odd)) + chance.choice(("\n", "\n", "", "\n\n# end\n", "\n  # end"))
        straight = sections_of(text, "f.yaml")
        if straight is None:
            continue
        plain += 1
        problems = Problems()
        read = read_kept(text, "f.yaml", problems)
        assert (repr(read), [*problems]) == (repr((straight, True)), []), text
    assert plain > (15 if odd else 60)


@pytest.mark.parametrize("value", _ODD)
def test_what_may_have_something_to_tell_takes_the_other_reader(value: str) -> None:
    text = "n:\n  ros__parameters:\n    id: {}\n".format(value.replace("%", "      "))
    straight = sections_of(text, "f.yaml")
    problems = Problems()
    assert straight is None or (straight, True) == read_kept(text, "f.yaml", problems)
    assert straight is None or not problems


def test_keys_that_rcl_would_not_take_for_what_they_are_take_the_other_reader() -> None:
    for text in (
        "n:\n  ros__parameters:\n    a: 1\n  m:\n    ros__parameters:\n      a: 1\n",  # beside the section
        "n:\n  ros__parameters:\n    a: 1\nn:\n  ros__parameters:\n    a: 1\n",
        "n:\n  ros__parameters:\n    a.b: 1\n    a:\n      b: 1\n",
        "n:\n  ros__params:\n    a: 1\n",
        "/n/:\n  ros__parameters:\n    a: 1\n",
        "n:\n  ros__parameters:\n    a: 1\n    a: 2\n",
        "n:\n  ros__parameters:\n    a:\n      b: 1\n     c: 1\n",
        "ros__parameters:\n  a: 1\n",
        "n:\n  ros__parameters: 1\n",
        "n:\n  ros__parameters:\n",
        "- n\n",
        "",
    ):
        assert sections_of(text, "f.yaml") is None
