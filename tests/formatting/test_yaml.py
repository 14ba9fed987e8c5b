"""YAML files in their one form."""

from __future__ import annotations

import pytest

from orchestra.errors import Problems
from orchestra.formatting.formatted import WIDTH, formatted
from orchestra.formatting.refusal import NotFormatted
from orchestra.formatting.yaml_layout import yaml_formatted

_CASES: dict[str, tuple[str, str | None]] = {
    "indentation, and lists below their key": (
        "launch:\n- arg:\n        name: a\n        default: b\n- group:\n  - log: {message: x}\n  scoped: false\n",
        "launch:\n  - arg:\n      name: a\n      default: b\n  - group:\n      - log: {message: x}\n    scoped: false\n",
    ),
    "lists in lists": ("-   - 1\n    -   - 2\n        - 3\n", "- - 1\n  - - 2\n    - 3\n"),
    "spaces": (
        "a:   1   \nb :  { c: 1,d:  2 , e: [ 1,2 ] }\nf: {}\ng: [ ]\n",
        "a: 1\nb: {c: 1, d: 2, e: [1, 2]}\nf: {}\ng: []\n",
    ),
    "empty lines": ("\n\n\na:\n\n  b: 1\n\n\n  c: 2\n\n\n", "a:\n  b: 1\n\n  c: 2\n"),
    "a value below its key": ("a:\n  text\nb:\n  [1, 2]\n", "a: text\nb: [1, 2]\n"),
    "no line break at the end": ("a: 1", "a: 1\n"),
    "the spelling of scalars": (
        "a: 0x1F\nb: 1e-6\nc: y\nd: '1'\ne: \"x\"\nf: ~\ng:\nh: 1_000\ni: !!str 5\n",
        None,
    ),
    "keys that stand twice": ("/**:\n  ros__parameters: {a: 1}\n/**:\n  ros__parameters: {a: 2}\n", None),
    "anchors and aliases": ("a: &x\n    b: 1\nc: *x\nd: &y  [1]\n", "a: &x\n  b: 1\nc: *x\nd: &y [1]\n"),
    "documents": ("%YAML 1.2\n---\na: 1\n...\n---\nb: 2\n", None),
    "a literal text": ("a:\n    b: |\n        x\n          y\n\n        z  \n", "a:\n  b: |\n    x\n      y\n\n    z  \n"),
    "a literal text with its indentation": ("a:\n    b: |2\n        x\n      y\n", "a:\n  b: |2\n      x\n    y\n"),
    "a literal text that keeps its end": ("a:\n    b: |+\n      x\n\n\n    c: 1\n", "a:\n  b: |+\n    x\n\n\n  c: 1\n"),
    "a literal text that ends in blanks": ("a: |\n      x\n         \n    \nb: 1\n", "a: |\n  x\n     \nb: 1\n"),
    "a folded text without its end": ("a: >-\n      x\n      y\n\n\nb: 1\n", "a: >-\n  x\n  y\n\nb: 1\n"),
    "a text in quotes over lines": ('a: "x\n\n      y \\\n      z"\n', 'a: "x\n\n  y \\\n  z"\n'),
    "a plain text over lines": ("a: x\n        y\n          z\n", "a: x\n  y\n    z\n"),
    "text on the line of the document": ("--- a\n", "---\na\n"),
}  # fmt: skip

_COMMENTS: dict[str, tuple[str, str | None]] = {
    "before, behind and after": (
        "# top\n\nlaunch:   # list\n# first\n- log: {message: a}   # a\n\n# last\n",
        "# top\n\nlaunch:   # list\n  # first\n  - log: {message: a}   # a\n\n  # last\n",
    ),
    "at the level that they are indented for": (
        "a:\n    b:\n        c: 1\n        # of c\n    # of b\n# of a\nd: 1\n",
        "a:\n  b:\n    c: 1\n    # of c\n  # of b\n# of a\nd: 1\n",
    ),
    "below a key without a value": ("a:\n     # - b\nc: 1\n", "a:\n  # - b\nc: 1\n"),
    "between a dash and its item": ("-    # x\n  # y\n  a: 1\n", "-    # x\n  # y\n  a: 1\n"),
    "between a key and its value": ("a:  # x\n      # y\n      1\n", "a:  # x\n  # y\n  1\n"),
    "too near": ("a: 1 # x\n", "a: 1  # x\n"),
    "in one column": (
        "a:\n    b: 1       # x\n    cc: 2\n    ddd: 3     # y\n               # and more\n",
        "a:\n  b: 1       # x\n  cc: 2\n  ddd: 3     # y\n             # and more\n",
    ),
    "of different columns": ("a: 1    # x\nb: 1  # y\n", "a: 1    # x\nb: 1  # y\n"),
    "in the first line of a literal text": ("a:\n    b: |  # x\n        c\n", "a:\n  b: |  # x\n    c\n"),
    "alone": ("   # x\n\n\n  # y\n", "# x\n\n# y\n"),
}

_TABLES: dict[str, tuple[str, str | None]] = {
    "rows below their bracket": (
        "a:\n    b: [1,   2.0,   # x\n        3,     4]   # y\n",
        "a:\n  b: [1,   2.0,   # x\n      3,     4]   # y\n",
    ),
    "rows below their key": (
        "a:\n    b: [\n        1, 2,\n        3\n    ]\n",
        "a:\n  b: [\n    1, 2,\n    3\n  ]\n",
    ),
    "rows of an item": ("a:\n- [1,\n   2]\n", "a:\n  - [1,\n     2]\n"),
    "a mapping that fits": ("a: {b: 1,\n    c: [1,\n    2]}\n", "a: {b: 1, c: [1, 2]}\n"),
    "rows on the line below their key": (
        "a:\n - b:\n    [1,\n      2]\n",
        "a:\n  - b:\n      [1,\n        2]\n",
    ),
    "a mapping with comments": (
        "a:\n    b: {c: 1,  # x\n        d: 2}\n",
        "a:\n  b: {c: 1,  # x\n      d: 2}\n",
    ),
}
_ALL = _CASES | _COMMENTS | _TABLES


@pytest.mark.parametrize(("written", "wanted"), _ALL.values(), ids=_ALL)
def test_a_text_has_one_form(written: str, wanted: str | None) -> None:
    wanted = written if wanted is None else wanted
    assert yaml_formatted(written, WIDTH) == wanted
    assert yaml_formatted(wanted, WIDTH) == wanted


def test_what_does_not_fit_in_brackets_loses_them() -> None:
    written = "launch:\n  - node: {pkg: demo, exec: talker, param: [{name: rate, value: 10}]}  # why\n"
    assert yaml_formatted(written, 80) == written
    assert yaml_formatted(written, 60) == (
        "launch:\n  - node:  # why\n      pkg: demo\n      exec: talker\n      param: [{name: rate, value: 10}]\n"
    )
    assert yaml_formatted(written, 30).endswith("      param:\n        - name: rate\n          value: 10\n")


def test_many_numbers_stand_in_rows() -> None:
    written = f"a:\n  numbers: [{', '.join(['1.25'] * 12)}]\n"
    assert yaml_formatted(written, 40) == (
        "a:\n"
        "  numbers: [1.25, 1.25, 1.25, 1.25,\n"
        "            1.25, 1.25, 1.25, 1.25,\n"
        "            1.25, 1.25, 1.25, 1.25]\n"
    )  # fmt: skip


def test_texts_are_never_broken() -> None:
    written = f"a: {'word ' * 40}end\nb:\n  {'word ' * 40}end\n"
    assert yaml_formatted(written, 40) == written


@pytest.mark.parametrize(
    "text", ["? a\n: b\n", "? [a]\n: b\n", "{a: 1}: b\n", "%TAG ! x:\n---\na: 1\n", "[" * 150 + "]" * 150]
)
def test_what_has_no_form_is_left(text: str) -> None:
    with pytest.raises(NotFormatted):
        yaml_formatted(text, WIDTH)


@pytest.mark.parametrize(
    ("text", "kind", "line"),
    [
        ("launch:\n  - node: {\n", "launch", 2),
        ("/**:\n  ros__parameters:\n\ta: 1\n", "parameters", 3),
        ("/**: 'x\n", "parameters", 1),
    ],
)
def test_a_syntax_error_is_reported_in_its_place(text: str, kind: str, line: int) -> None:
    problems = Problems()
    assert formatted(text.encode(), "a.yaml", lambda _text: kind, problems) is None
    (problem,) = problems.errors
    assert problem.span is not None
    assert (problem.span.file, problem.span.line) == ("a.yaml", line)


def test_mistakes_in_what_is_said_do_not_hinder() -> None:
    text = b"launch:\n- nod:   {}\n- node: {exce: a, exce: b}\n"
    problems = Problems()
    assert formatted(text, "a.yaml", lambda _text: "launch", problems) == (
        b"launch:\n  - nod: {}\n  - node: {exce: a, exce: b}\n"
    )
    assert not problems.errors
