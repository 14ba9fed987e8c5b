"""Descriptions that are built to break their reader: each is told of in bounded time and memory."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.fuzz.answers import assert_told_well

if TYPE_CHECKING:
    from tests.fuzz.answers import Ask

_DEEP = 100_000
_HUGE = 5_000_000


def _bomb() -> str:
    """Aliases that would come to ten to the power of nine."""
    lines = ["x0: &x0 [a, a, a, a, a, a, a, a, a, a]"]
    lines += [f"x{i}: &x{i} [{', '.join([f'*x{i - 1}'] * 10)}]" for i in range(1, 10)]
    return "\n".join(lines) + "\nlaunch: *x9\n"


def _bomb_of_actions() -> str:
    lines = ["launch:", "- group: &x0 [{log: {level: info, message: a}}]"]
    lines += [f"- group: &x{i} [{', '.join([f'{{group: *x{i - 1}}}'] * 10)}]" for i in range(1, 10)]
    return "\n".join(lines) + "\n"


def _bomb_of_parameters() -> str:
    lines = ["n:", "  ros__parameters:", "    x0: &x0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]"]
    lines += [f"    x{i}: &x{i} [{', '.join([f'*x{i - 1}'] * 10)}]" for i in range(1, 10)]
    return "\n".join(lines) + "\n"


def _bomb_of_entities() -> str:
    entities = ['<!ENTITY a0 "aaaaaaaaaa">']
    entities += [f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, 10)]
    return f"<!DOCTYPE launch [{''.join(entities)}]><launch><log message='&a9;'/></launch>"


def _quadratic_entity() -> str:
    return (
        f'<!DOCTYPE launch [<!ENTITY a "{"a" * 50_000}">]><launch><log message="{"&a;" * 50_000}"/></launch>'
    )


_NODE = "launch:\n- node: {exec: /bin/sh, name: n, param: [{name: p, value: %s}]}\n"
_MISTAKES: dict[str, tuple[str, str | bytes]] = {
    "aliases without bound": ("a.yaml", _bomb()),
    "aliases without bound, of actions": ("a.yaml", _bomb_of_actions()),
    "aliases without bound, in parameters": ("a.yaml", _bomb_of_parameters()),
    "an alias of itself": ("a.yaml", "launch: &a [{group: *a}]"),
    "entities without bound": ("a.launch.xml", _bomb_of_entities()),
    "one large entity many times": ("a.launch.xml", _quadratic_entity()),
    "an entity of a file": (
        "a.launch.xml",
        '<!DOCTYPE launch [<!ENTITY a SYSTEM "file:///etc/passwd">]><launch>&a;</launch>',
    ),
    "deep flow lists": ("a.yaml", "launch: " + "[" * _DEEP),
    "deep flow lists that end": ("a.yaml", "launch: " + "[" * _DEEP + "]" * _DEEP),
    "deep flow mappings": ("a.yaml", "launch: " + "{a: " * _DEEP),
    "deep block lists": ("a.yaml", "launch:\n" + "- " * _DEEP + "a\n"),
    "deep mappings": ("a.yaml", "".join(f"{' ' * i}a:\n" for i in range(2_000))),
    "deep groups": ("a.yaml", "launch: " + "[{group: " * 5_000 + "[]" + "}]" * 5_000),
    "deep elements": ("a.launch.xml", "<launch>" + "<group>" * _DEEP),
    "deep elements that end": (
        "a.launch.xml",
        f"<launch>{'<group>' * _DEEP}{'</group>' * _DEEP}</launch>",
    ),
    "deep substitutions": ("a.yaml", _NODE % ("'" + "$(var " * _DEEP + ")" * _DEEP + "'")),
    "deep substitutions without an end": ("a.yaml", _NODE % ("'" + "$(var " * _DEEP + "'")),
    "deep Python": ("a.launch.py", "x = " + "(" * 5_000 + ")" * 5_000),
    "deep Python operators": ("a.launch.py", "x = " + "-" * _DEEP + "1"),
    "a long key": ("a.yaml", f"launch:\n- {'k' * _HUGE}: {{}}\n"),
    "a long word": ("a.yaml", f"launch:\n- node: {{exec: e, nmae: {'k' * _HUGE}}}\n"),
    "a long integer": ("a.yaml", _NODE % ("9" * 200_000)),
    "a long hexadecimal": ("a.yaml", _NODE % ("0x" + "f" * _HUGE)),
    "a long sexagesimal": ("a.yaml", _NODE % ("1" + ":59" * 200_000)),
    "many keys": ("a.yaml", "launch:\n- node:\n" + "".join(f"    k{i}: 1\n" for i in range(4_000))),
    "many problems": ("a.yaml", "launch:\n" + "- nod: {exec: a}\n" * 1_500),
    "one key many times": ("a.yaml", "launch:\n- node:\n" + "    exec: a\n" * 5_000),
    "NUL": ("a.yaml", b"launch:\n- node: {exec: 'a\0b'}\n"),
    "NUL in XML": ("a.launch.xml", b"<launch><node exec='a\0b'/></launch>"),
    "NUL in Python": ("a.launch.py", b"def generate_launch_description():\n    return '\0'\n"),
    "NUL escaped": ("a.yaml", 'launch:\n- include: {file: "a\\0b.yaml"}\n'),
    "no text at all": ("a.yaml", bytes(range(256)) * 100),
    "no text in XML": ("a.launch.xml", bytes(range(256)) * 100),
    "no text in Python": ("a.launch.py", bytes(range(256)) * 100),
    "half a character": ("a.yaml", b"launch:\n- log: {level: info, message: '\xc3'}\n"),
    "a lone surrogate": ("a.yaml", b"launch:\n- node: {exec: '\xed\xa0\x80'}\n"),
    "a surrogate escaped": ("a.yaml", 'launch:\n- node: {exec: /bin/sh, name: "\\uD800"}\n'),
    "an encoding that Python does not know": ("a.launch.py", "# coding: klingon\n"),
    "UTF-16 that is cut": ("a.yaml", "launch: []\n".encode("utf-16")[:-1]),
    "a directive": ("a.yaml", "%YAML 9.9\n---\nlaunch: []\n"),
    "a tag that makes objects": ("a.yaml", "launch: !!python/object/apply:os.getcwd []\n"),
    "a long number with a point": ("a.yaml", _NODE % ("1" + ":59" * 300 + ".5")),
    **{
        f"the value {value}": ("a.launch.xml", f"<launch><set_parameter name='p' value='{value}'/></launch>")
        for value in ("!!int", "!!float", "!!bool x", "!!timestamp x", "!!binary é", "!!python/none x")
    },
    "an empty key at the top": ("a.yaml", "'': []\n"),
    "an empty key": ("a.yaml", "launch:\n- node: {'': a}\n- '': {}\n- {}\n"),
    "two documents": ("a.yaml", "launch: []\n---\nlaunch: []\n"),
    "a file that includes itself": ("a.yaml", "launch:\n- include: {file: a.yaml}\n"),
    "Python that never ends its recursion": (
        "a.launch.py",
        "def generate_launch_description():\n    return generate_launch_description()\n",
    ),
    "Python that leaves": ("a.launch.py", "import sys\nsys.exit(3)\n"),
    "a pattern that explodes": (
        "a.yaml",
        "launch:\n- node: {exec: /bin/sh, name: n, ready: {log: '(a+)+('}}\n",
    ),
}
"""Each has a mistake that is to be told as an error."""


_HARMLESS: dict[str, tuple[str, str | bytes]] = {
    "deep parameters": ("a.yaml", "n:\n  ros__parameters: " + "{a: " * 5_000 + "1" + "}" * 5_000),
    "an encoding that nobody knows": (
        "a.launch.xml",
        '<?xml version="1.0" encoding="klingon"?><launch/>',
    ),
    "UTF-32": ("a.launch.xml", "<launch/>".encode("utf-32")),
    "a small number of many digits": (
        "a.yaml",
        f"n:\n  ros__parameters: {{p: 0.{'0' * 310}{'1' * 5_000}, q: {'9' * _HUGE}}}\n",
    ),
    "many digits without commas": ("a.yaml", f"n:\n  ros__parameters: {{p: [{'1' * _DEEP}.x 2.0]}}\n"),
    "many blanks in a text of two lines": (
        "a.yaml",
        f"n:\n  ros__parameters:\n    p: a\n      - b{' ' * _DEEP}c\n",
    ),
}
"""Odd, but there is nothing wrong with them."""


@pytest.mark.parametrize("name", _MISTAKES)
def test_an_extreme_is_an_error_in_its_place(check: Ask, name: str) -> None:
    file, text = _MISTAKES[name]
    files = {file: text if isinstance(text, bytes) else text.encode()}
    answer = check(files)
    assert_told_well(answer, files)
    assert answer.errors


@pytest.mark.parametrize("name", _HARMLESS)
def test_what_is_only_odd_is_read(check: Ask, name: str) -> None:
    file, text = _HARMLESS[name]
    files = {file: text if isinstance(text, bytes) else text.encode()}
    answer = check(files)
    assert_told_well(answer, files)
    assert not answer.errors
