"""`sys.argv` while launch files are loaded: code that looks at the words of the command line knows all arguments."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator


class Arguments(list[str]):
    """The words of `ros2 launch`; `seen` tells whether code has looked at them."""

    seen = False

    def __iter__(self) -> Iterator[str]:
        self.seen = True
        return super().__iter__()

    def __getitem__(self, index: Any) -> Any:
        self.seen = True
        return super().__getitem__(index)

    def __contains__(self, word: object) -> bool:
        self.seen = True
        return super().__contains__(word)

    def __add__(self, other: Any) -> Any:
        self.seen = True
        return super().__add__(other)

    def copy(self) -> list[str]:
        """Return the words as a list."""
        return list(self)


def look() -> None:
    """Note that code looks at the words in another way."""
    if isinstance(sys.argv, Arguments):
        sys.argv.seen = True


def seen() -> bool:
    """Return whether code of the launch files that are being loaded has looked at the words."""
    return isinstance(sys.argv, Arguments) and sys.argv.seen
