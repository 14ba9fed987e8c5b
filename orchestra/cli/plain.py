"""Options of a command line that has none, without argparse: with what it imports it takes 8 ms of a start."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence


def are_plain(words: Sequence[str]) -> bool:
    """Tell whether words are no options, and no mark that ends them."""
    return not any(word.startswith("-") for word in words)


class Unasked:
    """Takes what a parser is told, and knows what becomes of options that nobody gives."""

    def __init__(self) -> None:
        self._options: dict[str, Any] = {}

    def add_argument(
        self,
        *names: str,
        dest: str | None = None,
        action: str = "store",
        default: object = None,
        **_others: object,
    ) -> None:
        """Know an option by its first long name, as argparse does; positional words are given in `options`."""
        long = next((name for name in names if name.startswith("--")), names[0])
        known = dest or long.lstrip("-").replace("-", "_")
        self._options[known] = False if action == "store_true" else default

    def add_mutually_exclusive_group(self) -> Unasked:
        """Return what takes options of which there may be one."""
        return self

    def options(self, words: Sequence[str]) -> SimpleNamespace:
        """Return all options, with the words that are there."""
        return SimpleNamespace(**{**self._options, "words": list(words)})
