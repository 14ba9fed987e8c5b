"""A bracket that is missing is looked for by reading the file with one: of a long file that is done seldom."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.compat import missing_brackets

if TYPE_CHECKING:
    import pytest

_LINES: Final = "".join(f"    make('{number}', [1, 2]),\n" for number in range(100))


def _tries(source: str, monkeypatch: pytest.MonkeyPatch) -> int:
    """Return how often a file is read that no bracket mends."""
    tries = 0

    def reads(_source: str) -> bool:
        nonlocal tries
        tries += 1
        return False

    monkeypatch.setattr(missing_brackets, "_reads", reads)
    assert missing_brackets.bracket_missing(source) is None
    return tries


def test_a_long_file_is_read_a_few_times(monkeypatch: pytest.MonkeyPatch) -> None:
    source = f"found = [\n{_LINES}other = = 1\n"
    assert _tries(source, monkeypatch) > 20
    monkeypatch.setattr(missing_brackets, "_MOST_READ", 6 * len(source))
    assert 6 <= _tries(source, monkeypatch) <= 12


def test_the_bracket_is_found_in_a_long_file(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(missing_brackets, "_MOST_READ", 0)
    source = f"found = [\n{_LINES}    make('a', [1, 2),\n]\n"
    found = missing_brackets.bracket_missing(source)
    assert found is not None
    assert found[2] == "[1, 2]"
