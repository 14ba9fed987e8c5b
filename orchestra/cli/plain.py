"""Options of a plain command line, without argparse: with what it imports it takes 8 ms of a start.

Plain are words, flags, and options that take one word as it is or one of a few. All else is left to argparse, mistakes
too, which it tells of.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

_FLAG, _VALUE, _VALUES = "store_true", "store", "append"


def plain(words: Sequence[str], add_to: Callable[[Any], None]) -> SimpleNamespace | None:
    """Return what argparse would make of words for a parser that is filled so; None where it is to do it."""
    known = _Known()
    add_to(known)
    return known.options(words)


class _Option:
    """An option: where its value goes, how, and which it may be; `alone` is whether it goes with all others."""

    __slots__ = ("action", "alone", "choices", "name", "odd")

    def __init__(self, name: str, action: str, choices: Any, *, odd: bool, alone: bool) -> None:  # noqa: ANN401 - a container
        self.name = name
        self.action = action
        self.choices = choices
        self.odd = odd
        self.alone = alone


class _Known:
    """Takes what a parser is told, and knows what becomes of options."""

    def __init__(self) -> None:
        self._unasked: dict[str, Any] = {}
        self._options: dict[str, _Option] = {}
        self._alone = True

    def add_argument(
        self,
        *names: str,
        dest: str | None = None,
        action: str = _VALUE,
        default: object = None,
        choices: object = None,
        **others: object,
    ) -> None:
        """Know an option by its first long name, as argparse does; positional words are given in `options`."""
        long = next((name for name in names if name.startswith("--")), names[0])
        name = dest or long.lstrip("-").replace("-", "_")
        self._unasked[name] = False if action == _FLAG else default
        odd = "nargs" in others or "type" in others or action not in (_FLAG, _VALUE, _VALUES)
        option = _Option(name, action, choices, odd=odd, alone=self._alone)
        self._options.update((name, option) for name in names if name.startswith("-"))

    def add_mutually_exclusive_group(self) -> _Known:
        """Return what takes options of which there may be one."""
        group = _Known()
        group._unasked, group._options, group._alone = self._unasked, self._options, False
        return group

    def options(self, words: Sequence[str]) -> SimpleNamespace | None:
        """Return all options, with the words that are there; None where something is not plain."""
        found = {**self._unasked, "words": []}
        left = iter(words)
        for word in left:
            if not word.startswith("-"):
                found["words"].append(word)
            elif not self._take(word, left, found):
                return None
        return SimpleNamespace(**found)

    def _take(self, word: str, left: Iterator[str], found: dict[str, Any]) -> bool:
        name, equals, value = word.partition("=")
        option = self._options.get(name)
        if option is None or option.odd or not option.alone:
            return False
        if option.action == _FLAG:
            found[option.name] = True
            return not equals
        if not equals:
            value = next(left, "-")
            if value.startswith("-"):
                return False
        elif not name.startswith("--"):
            return False
        if option.choices is not None and value not in option.choices:
            return False
        found[option.name] = [*(found[option.name] or []), value] if option.action == _VALUES else value
        return True
