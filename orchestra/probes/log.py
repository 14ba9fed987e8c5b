"""Ready when a line of output matches a regular expression."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from orchestra.logs.terminal_text import plain_text

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.probes.protocol import Site

# A program that never ends its line must not make us search ever more text.
_LONGEST_LINE = 65536


class LogProbe:
    """Searches each line of both streams, the unfinished one as far as it has come. Colours do not count."""

    looks_into_graph = False

    def __init__(self, pattern: str) -> None:
        self._pattern = re.compile(pattern)
        self._unfinished: dict[str, str] = {}

    @property
    def words(self) -> str:
        """What is awaited."""
        return f"a line of its output that matches {self._pattern.pattern!r}"

    def begin(self, site: Site, came: Callable[[], None]) -> None:
        """Read what the process writes."""

        def written(stream: str, text: str) -> None:
            if self.read(stream, text):
                came()

        site.on_output(written)

    def end(self) -> None:
        """Forget the unfinished lines."""
        self._unfinished.clear()

    def read(self, stream: str, text: str) -> bool:
        """Take a piece of output; tell whether a line matches."""
        written = self._unfinished.get(stream, "") + plain_text(text)
        *lines, rest = written.replace("\r\n", "\n").split("\n")
        self._unfinished[stream] = rest[-_LONGEST_LINE:]
        return any(map(self._pattern.search, lines)) or bool(self._pattern.search(rest.removesuffix("\r")))
