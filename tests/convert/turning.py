"""Launch files that are converted there and back, and the plans of all that they come through."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from orchestra.convert.converting import ENDINGS, convert
from orchestra.convert.original import LANGUAGES, language_of
from orchestra.errors import Code, Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import encode

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

_PLACES = {"location", "provenance", "line", "column", "end_line", "end_column", "problems"}
_SPELLED = {"default", "expression"}


@dataclass(frozen=True)
class Seen:
    """What a launch file comes to, without places and names of languages; and the kinds of its errors."""

    content: Any
    errors: frozenset[Code]


def seen(path: Path, environment: Mapping[str, str], words: Sequence[str] = ()) -> Seen:
    """Return what a launch file comes to."""
    problems = Problems()
    plan = collect(str(path), inputs_from(words, environment=environment), problems)
    content = None if plan is None else _plain(encode(plan), path.name)
    codes = frozenset(problem.code for problem in problems.errors)
    return Seen(content, codes - {Code.DUPLICATE_NODE})  # which is none in Python


def turned(path: Path, language: str, environment: Mapping[str, str], name: str = "turned") -> Path:
    """Convert a launch file; return the result, which stands beside it. It fails where something is lost."""
    found = convert(str(path), language, environment)
    assert not found.lossy, found.remarks
    assert found.mistake is None, f"{found.mistake}\n{found.text}"
    assert found.text is not None
    other = path.with_name(name + ENDINGS[language])
    other.write_text(found.text, "utf-8")
    return other


def others(path: Path) -> list[str]:
    """Return the languages that a launch file is not in."""
    return [language for language in LANGUAGES if language != language_of(str(path))]


def same_everywhere(path: Path, environment: Mapping[str, str], words: Sequence[str] = ()) -> None:
    """Convert a launch file to both other languages, and each of these to both others again: the plan is the same."""
    plan = seen(path, environment, words)
    for language in others(path):
        there = turned(path, language, environment)
        assert seen(there, environment, words) == plan, there.read_text("utf-8")
        for next_language in others(there):
            back = turned(there, next_language, environment, "back")
            assert seen(back, environment, words) == plan, back.read_text("utf-8")


def _plain(value: Any, name: str) -> Any:
    """Return data without places, names of the file, and what says how something is spelled: what it comes to stays."""
    if isinstance(value, dict):
        return {key: _plain(item, name) for key, item in value.items() if key not in _PLACES | _SPELLED}
    if isinstance(value, list | tuple):
        return [_plain(item, name) for item in value]
    return value.replace(name, "FILE") if isinstance(value, str) else value


def round_trip(
    path: Path, environment: Mapping[str, str], words: Sequence[str] = (), *, rounds: int = 1
) -> None:
    """Convert a launch file to each other language in turn and back: the plan stays, and after one round the text."""
    plan = seen(path, environment, words)
    for index in range(rounds):
        there = path
        for language in (*others(path), language_of(str(path)) or ""):
            there = turned(there, language, environment, f"{path.name.split('.')[0]}_{index}")
            assert seen(there, environment, words) == plan, there.read_text("utf-8")
        if index:
            assert there.read_text("utf-8") == path.read_text("utf-8")
        path = there
