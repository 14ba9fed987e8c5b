"""What the user sees: pages on one screen or two."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.logs.page import Page
from orchestra.logs.terminal_text import for_screen, overwrites

if TYPE_CHECKING:
    from orchestra.logs.screen import Screen


class Sheet:
    """A screen, the page that is on it, and whether it shows colours."""

    def __init__(self, screen: Screen, *, colour: bool) -> None:
        self._screen = screen
        self._page = Page()
        self._returned = False
        self.colour = colour

    def write(self, source: object, prefix: bytes, data: bytes, *, clean: bool) -> None:
        """Show a piece of a source's output; what is overwritten with carriage returns is so here.

        `clean` says that it is harmless but for colours.
        """
        shown = for_screen(data, clean=clean)
        again = self._page.continues(source) and (self._returned or overwrites(data))
        self._returned = data.endswith(b"\r")
        if shown:
            again = again and not shown.startswith(b"\n")
            self._screen.write(self._page.compose(source, prefix, shown, again=again))

    def let_through(self, source: object, data: bytes) -> None:
        """Show output as it is: the program knows that it has a terminal and does with it what it wants."""
        self._returned = False
        self._screen.write(self._page.let_through(source, data))

    def end(self) -> None:
        """End an unfinished line."""
        self._screen.write(self._page.end())


class Sheets:
    """The output of processes, and our own messages. Both may be one and the same sheet."""

    def __init__(self, output: Sheet, messages: Sheet) -> None:
        self.output = output
        self.messages = messages
