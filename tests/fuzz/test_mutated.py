"""Working descriptions, broken at random: whatever comes out is only told of, in its place."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.fuzz.answers import assert_told_well

if TYPE_CHECKING:
    from collections.abc import Sequence

    from hypothesis.strategies import DrawFn

    from tests.fuzz.answers import Ask

_FOLDER = Path(__file__).with_name("seeds")
_SEEDS = {
    str(path.relative_to(_FOLDER)): path.read_text("utf-8")
    for path in sorted(_FOLDER.rglob("*.*"))
    if path.suffix in (".py", ".xml", ".yaml")
}
_TOKEN = re.compile(r"\w+|[ \t]+|\n|.", re.DOTALL)
_TOKENS = {name: _TOKEN.findall(text) for name, text in _SEEDS.items()}
_NASTY = (
    *("", " ", "\t", "\n", "\r", "\0", "\x1b[31m", "\x85", "\u2028", "\ufeff", "é", "😀", "\udcff"),
    *(
        "$(",
        "$(var",
        "$(var x)",
        "$(eval '1/0')",
        "$(eval",
        ")",
        "$",
        "\\",
        "'",
        '"',
        "`",
        "#",
        "<!--",
        "]]>",
    ),
    *("&a", "*a", "<<", "!!int", "!", "|", ">", "%", "@", "---", "...", "- ", ": ", "? ", "{", "}", "[", "]"),
    *("null", "~", "true", ".nan", "1e400", "0x", "9" * 30, "-1", "1.5", "/", "//", "~/x", "/**", "{x}"),
    *("<", ">", "</", "/>", "&", "&lt;", "&x;", "&#0;", "<![CDATA[", "<?xml", "<!DOCTYPE x [", 'a="'),
)


@st.composite
def _broken(draw: DrawFn, name: str) -> bytes:
    """A seed, changed in one to four places."""
    tokens = list(_TOKENS[name])
    for _ in range(draw(st.integers(1, 4))):
        tokens = draw(st.sampled_from(_CHANGES))(draw, tokens)
    text = "".join(tokens)
    if draw(st.integers(0, 19)) == 0:
        return text.encode("utf-16", "surrogatepass")
    return text.encode("utf-8", "surrogateescape")


def _span(draw: DrawFn, tokens: Sequence[str]) -> slice:
    begin = draw(st.integers(0, max(0, len(tokens) - 1)))
    return slice(begin, begin + draw(st.integers(1, 12)))


def _removed(draw: DrawFn, tokens: list[str]) -> list[str]:
    span = _span(draw, tokens)
    return tokens[: span.start] + tokens[span.stop :]


def _doubled(draw: DrawFn, tokens: list[str]) -> list[str]:
    span = _span(draw, tokens)
    return tokens[: span.stop] + tokens[span] * draw(st.sampled_from([1, 1, 1, 50])) + tokens[span.stop :]


def _moved(draw: DrawFn, tokens: list[str]) -> list[str]:
    span = _span(draw, tokens)
    rest = tokens[: span.start] + tokens[span.stop :]
    place = draw(st.integers(0, len(rest)))
    return rest[:place] + tokens[span] + rest[place:]


def _borrowed(draw: DrawFn, tokens: list[str]) -> list[str]:
    span, others = _span(draw, tokens), _TOKENS[draw(st.sampled_from(sorted(_TOKENS)))]
    return tokens[: span.start] + others[_span(draw, others)] + tokens[span.start + 1 :]


def _spoilt(draw: DrawFn, tokens: list[str]) -> list[str]:
    span = _span(draw, tokens)
    return [
        *tokens[: span.start],
        draw(st.sampled_from(_NASTY)),
        *tokens[span.start + draw(st.integers(0, 1)) :],
    ]


def _misspelt(draw: DrawFn, tokens: list[str]) -> list[str]:
    place = draw(st.integers(0, max(0, len(tokens) - 1)))
    word = tokens[place] if tokens else ""
    cut = draw(st.integers(0, len(word)))
    return [
        *tokens[:place],
        word[:cut] + draw(st.sampled_from("xX_1 ")) + word[cut + 1 :],
        *tokens[place + 1 :],
    ]


def _cut(draw: DrawFn, tokens: list[str]) -> list[str]:
    return tokens[: draw(st.integers(0, len(tokens)))]


_CHANGES = (_removed, _doubled, _moved, _borrowed, _spoilt, _misspelt, _misspelt, _cut)


def _check(check: Ask, broken: str, content: bytes) -> None:
    files = {name: text.encode() for name, text in _SEEDS.items()} | {broken: content}
    for main in dict.fromkeys(("all.launch.yaml" if "yaml" in broken else "all.launch.py", broken)):
        assert_told_well(check(files, main), files)


def test_the_seeds_are_sound(check: Ask) -> None:
    files = {name: text.encode() for name, text in _SEEDS.items()}
    for name in files:
        assert check(files, name).problems == []


@pytest.mark.parametrize("name", _SEEDS)
@settings(suppress_health_check=list(HealthCheck), deadline=None, max_examples=8)
@given(data=st.data())
def test_what_is_broken_is_told(check: Ask, name: str, data: st.DataObject) -> None:
    _check(check, name, data.draw(_broken(name)))


@pytest.mark.long
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("name", _SEEDS)
@settings(suppress_health_check=list(HealthCheck), deadline=None, max_examples=1_000)
@given(data=st.data())
def test_what_is_broken_in_many_ways_is_told(check: Ask, name: str, data: st.DataObject) -> None:
    _check(check, name, data.draw(_broken(name)))
