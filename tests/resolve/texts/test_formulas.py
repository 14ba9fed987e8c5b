"""What formulas know of texts that do nothing but calculate is what these come to part by part, and to all who ask."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.errors import Problems
from orchestra.load import files
from orchestra.load.alike.making import template
from orchestra.load.elements import Attribute
from orchestra.load.grammar import sound_template
from orchestra.load.nested import Nested
from orchestra.load.offsets import Source
from orchestra.load.reader import Reader
from orchestra.location import Places
from orchestra.pipeline import collect, inputs_from
from orchestra.plan import codec
from orchestra.resolve.formulas.formula import formula_of

if TYPE_CHECKING:
    from pathlib import Path

_HEAD = """\
launch:
- arg: {name: mode, default: sim}
- arg: {name: debug, default: 'false'}
- arg: {name: n, default: '5'}
- arg: {name: quote, default: it's}
- arg: {name: robot2, default: robot2}
- arg: {name: kind, default: arm, choices: [arm, base, '3']}
- include: {file: b.launch.yaml}
"""
_VARIABLES = ("mode", "debug", "n", "quote", "robot2", "kind", "leaked", "nobody")
_TEXTS = ("sim", "arm", "robot{0}", "{0}", "a ({0})", "", "true", "x y", "{0}.{1}")


def _variable(rnd: Random) -> str:
    return f"$(var {rnd.choice(_VARIABLES)}{rnd.choice(('', '', '', '', ' 1'))})"


def _value(rnd: Random) -> str:
    text = rnd.choice(_TEXTS).format(rnd.randrange(30), rnd.randrange(9))
    return rnd.choice(
        (f"'{text}'", f"'{_variable(rnd)}'", f"'{text}{_variable(rnd)}'", str(rnd.randrange(40)), "007")
    )


def _clause(rnd: Random) -> str:
    one, other = _value(rnd), _value(rnd)
    return rnd.choice((
        f"{one} == {other}",
        f"{one} != {other}",
        f"{one} in ({other}, {_value(rnd)})",
        f"{rnd.randrange(40)} >= {rnd.randrange(9)}.{rnd.randrange(9)}",
        f"len({one}) == {rnd.randrange(5)}",
        f"{one}.lower() == {other}",
        f"{_variable(rnd)} > {rnd.randrange(9)}",
        f"{one} < {other}",
        f"{one} {other}",
    ))  # fmt: skip


def _condition(rnd: Random, depth: int = 0) -> str:
    kind = rnd.randrange(8 if depth < 2 else 2)
    if kind == 0:
        clauses = [_clause(rnd) for _ in range(rnd.randrange(1, 3))]
        return f'$(eval "{rnd.choice((" and ", " or ")).join(clauses)}")' if depth == 0 else _variable(rnd)
    if kind == 1:
        return _variable(rnd)
    one, other = _condition(rnd, depth + 1), _condition(rnd, depth + 1)
    return rnd.choice((
        f"$(not {one})",
        f"$(and {one} {other})",
        f"$(equals {one} arm)",
        f"$(not-equals kind {other})",
        f"$(any {one} {other} true)",
        f"$(if {one} true {rnd.choice(('', 'false'))})",
        f"$(equals {one}{rnd.randrange(20)} robot{rnd.randrange(3)})",
    ))  # fmt: skip


def _plan(folder: Path, monkeypatch: pytest.MonkeyPatch, *, line_by_line: bool) -> tuple[Any, ...]:
    monkeypatch.setattr(files, "_pays", lambda _: line_by_line)
    problems = Problems()
    plan = collect(str(folder / "a.launch.yaml"), inputs_from([], environment={"PATH": "/bin"}), problems)
    return plan and codec.dumps(plan), problems.ordered


def _compare(folder: Path, monkeypatch: pytest.MonkeyPatch, rnd: Random) -> None:
    actions = [
        f"- node:\n    exec: /bin/true\n    name: n{number}\n    {rnd.choice(('if', 'unless'))}: {_condition(rnd)}\n"
        f"    param:\n    - name: p\n      value: {_condition(rnd)}\n    - name: q\n      value: x {_condition(rnd)}\n"
        for number in range(30)
    ]
    (folder / "a.launch.yaml").write_text(_HEAD + "".join(actions))
    (folder / "b.launch.yaml").write_text("launch:\n- let: {name: leaked, value: '3'}\n")
    assert _plan(folder, monkeypatch, line_by_line=True) == _plan(folder, monkeypatch, line_by_line=False)


def test_plans_are_those_of_texts_that_are_taken_apart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rnd = Random(1)  # noqa: S311 - the same every time
    for _ in range(8):
        _compare(tmp_path, monkeypatch, rnd)


@pytest.mark.long
@pytest.mark.timeout(900)
def test_hundreds_of_plans_are_those_of_texts_that_are_taken_apart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for seed in range(300):
        _compare(tmp_path, monkeypatch, Random(seed))  # noqa: S311 - as above


def _pieces(text: str) -> Any:
    read: Any = template(
        text, Places(Source(text, "a.launch.yaml"), [(0, len(text))]), 0, False, Reader(Problems())
    )
    return getattr(read, "pieces", None)


def test_texts_that_differ_by_numbers_share_a_formula() -> None:
    one, other = (_pieces(f"$(eval \"'$(var a{n})' == 'x{n}' and {n} >= 0\")") for n in (1, 25))
    assert formula_of(one) is formula_of(other)
    assert (one.names, other.names) == (("a1",), ("a25",))


@pytest.mark.parametrize(
    "text",
    [
        "$(not ${a})",
        "$(eval 'x')'",
        "\\$(var a) (b)",
        "$(not (var a))",
        "$(not dirname() $(var a))",
        "$(not a b)",
        "$(eval \"'$(var a)'",
        "$(nobody '1')",
        "$(not '\ue000')",
    ],
)
def test_of_what_there_may_be_something_to_tell_there_is_no_formula(text: str) -> None:
    assert not isinstance(_pieces(text), Nested)


@pytest.mark.parametrize(
    ("source", "text"),
    [
        ("$(eval &quot;'$(var a)' == 'b' and 12 > 3&quot;)", "$(eval \"'$(var a)' == 'b' and 12 > 3\")"),
        ("x&amp;$(not $(var a))", "x&$(not $(var a))"),
    ],
)
def test_places_of_texts_that_stand_otherwise_in_their_file_are_worked_out_later(
    source: str, text: str
) -> None:
    written = Attribute("if", text, 0, 0, len(source)).written(Source("a.launch.xml", source))
    read: Any = Reader(Problems()).template(written)
    assert isinstance(read.pieces, Nested)
    assert read == sound_template(text, written.spans)
    assert read.location(()).span.end_column == len(source) + 1
