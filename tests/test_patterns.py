"""Expressions that are compiled late do what those compiled at once do, and all of ours can be compiled."""

from __future__ import annotations

import copy
import re
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

import orchestra
from orchestra import patterns
from orchestra.patterns import pattern

_ROOT = Path(orchestra.__file__).parent
_USERS = sorted(
    ".".join(("orchestra", *path.relative_to(_ROOT).with_suffix("").parts))
    for path in _ROOT.rglob("*.py")
    if "orchestra.patterns import pattern" in path.read_text()
)


def test_it_does_what_a_compiled_expression_does() -> None:
    late, compiled = (
        pattern(r"(?P<word>[a-z]+)(\d)?", re.IGNORECASE),
        re.compile(r"(?P<word>[a-z]+)(\d)?", re.IGNORECASE),
    )
    for text in ("Ab1 cd", "1", ""):
        for name in ("match", "fullmatch", "search"):
            ours, theirs = getattr(late, name)(text), getattr(compiled, name)(text)
            assert (ours and ours.groups()) == (theirs and theirs.groups())
        assert late.findall(text) == compiled.findall(text)
        assert [found.span() for found in late.finditer(text)] == [
            found.span() for found in compiled.finditer(text)
        ]
        assert late.split(text) == compiled.split(text)
        assert late.sub("x", text, count=1) == compiled.sub("x", text, count=1)
        assert late.subn("x", text) == compiled.subn("x", text)
    assert (late.pattern, late.flags, late.groupindex) == (
        compiled.pattern,
        compiled.flags,
        compiled.groupindex,
    )


def test_bytes_have_expressions_too() -> None:
    assert pattern(rb"\d+").findall(b"1 22") == [b"1", b"22"]


def test_nothing_is_compiled_before_it_is_used(monkeypatch: pytest.MonkeyPatch) -> None:
    compiled: list[str] = []
    real = re.compile

    def told(text: str, flags: int) -> re.Pattern[str]:
        compiled.append(text)
        return real(text, flags)

    monkeypatch.setattr(re, "compile", told)
    late = pattern("a+")
    assert repr(copy.copy(late)) == "pattern('a+', 0)"
    assert compiled == []
    assert [late.match("aa") is None, late.search("b") is None] == [False, True]
    assert compiled == ["a+"]


def test_modules_of_others_do_so_where_that_is_wanted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "of_others.py").write_text("import re\nEXPRESSION = re.compile('a+', re.IGNORECASE)\n")
    monkeypatch.syspath_prepend(tmp_path)
    compile_ = re.compile
    with patterns.late():
        found = import_module("of_others").EXPRESSION
    assert re.compile is compile_
    assert isinstance(found, patterns._Late)
    assert found.fullmatch("aA")


def test_a_wrong_expression_is_told_when_it_is_used() -> None:
    wrong = pattern("(")
    with pytest.raises(re.error):
        wrong.match("")


@pytest.mark.parametrize("module", _USERS)
def test_all_of_ours_can_be_compiled(module: str) -> None:
    found = [*_inside(vars(import_module(module)))]
    assert found
    for late in found:
        assert late.pattern


def _inside(value: Any) -> Any:
    """Yield the expressions in the tables of a module, however deep."""
    if isinstance(value, patterns._Late):
        yield value
    elif isinstance(value, dict):
        for name, item in value.items():
            if not str(name).startswith("__"):
                yield from _inside(item)
    elif isinstance(value, tuple | list):
        for item in value:
            yield from _inside(item)
