"""The parser of one command: argparse, but mistakes are raised, options stand anywhere and are never abbreviated."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from typing import TYPE_CHECKING, NoReturn

from orchestra.errors import UsageError

if TYPE_CHECKING:
    from argparse import Action
    from collections.abc import Sequence


class CommandParser(ArgumentParser):
    """Reads the words after `orchestra COMMAND`; `intermixed` tells whether options may follow other words."""

    def __init__(
        self, command: str, description: str, epilog: str | None = None, *, intermixed: bool = True
    ) -> None:
        super().__init__(
            prog=f"orchestra {command}",
            description=description,
            epilog=epilog,
            allow_abbrev=False,
            formatter_class=RawDescriptionHelpFormatter,
        )
        self.intermixed = intermixed

    @property
    def actions(self) -> tuple[Action, ...]:
        """The options and positional words that it reads."""
        return tuple(self._actions)

    def read(self, words: Sequence[str]) -> Namespace:
        """Return the options. Raises `UsageError`, or `SystemExit` after `--help`."""
        return self.parse_intermixed_args(words) if self.intermixed else self.parse_args(words)

    def error(self, message: str) -> NoReturn:
        """Raise instead of printing and leaving."""
        raise UsageError(message)
