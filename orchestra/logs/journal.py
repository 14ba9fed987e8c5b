"""Where output goes: the file of its process, the merged file, and the screen."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from orchestra.logs import names, outputs
from orchestra.logs.files import LogFile
from orchestra.logs.page import Page
from orchestra.logs.terminal_text import coloured, for_screen, plain

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from orchestra.logs.outputs import Output
    from orchestra.logs.screen import Screen

OURSELVES = "orchestra"


class Sheet:
    """A screen, the page that is on it, and whether it shows colours."""

    def __init__(self, screen: Screen, *, colour: bool) -> None:
        self._screen = screen
        self._page = Page()
        self.colour = colour

    def write(self, source: object, prefix: str, text: str) -> None:
        """Show a piece of a source's output."""
        self._screen.write(self._page.compose(source, prefix, text))

    def end(self) -> None:
        """End an unfinished line."""
        self._screen.write(self._page.end())


class Sheets:
    """What the user sees: the output of processes, and our own messages. Both may be one and the same sheet."""

    def __init__(self, output: Sheet, messages: Sheet) -> None:
        self.output = output
        self.messages = messages


class Journal:
    """Writes what processes and we ourselves have to say.

    `wanted` maps each process, in plan order, to its `output`; `forced`, where given, counts for all of them. `failed`
    hears of a file that cannot be written, `told` of everything that we say.
    """

    def __init__(
        self,
        folder: Path,
        wanted: Mapping[str, Output],
        sheets: Sheets,
        failed: Callable[[Path, OSError], None],
        told: Callable[[str], None],
        wall: Callable[[], float] = time.time,
        *,
        forced: str | None = None,
    ) -> None:
        self._folder = folder
        self._sheets = sheets
        self._failed = failed
        self._told = told
        self._wall = wall
        self._forced = forced
        self._shown: dict[str, frozenset[str]] = {}
        self._prefixes: dict[str, str] = {}
        self._colours: dict[str, str] = {}
        self._files: dict[str, LogFile] = {}
        self._pages: dict[str, Page] = {}
        self._all = LogFile(folder / "all.log", failed)
        self._all_page = Page()
        self.add(wanted)

    def add(self, wanted: Mapping[str, Output]) -> None:
        """Take up more processes, after those that are known: names and files of these stay."""
        for process, output in wanted.items():
            self._shown[process] = outputs.on_screen(output if self._forced is None else self._forced)
            self._pages[process] = Page()
        self._prefixes = names.prefixes(self._shown)
        self._colours = self._colour_prefixes() if self._sheets.output.colour else self._prefixes
        stems = names.log_stems(self._shown)
        for process in wanted:
            self._files[process] = LogFile(self._folder / f"{stems[process]}.log", self._failed)

    def output(self, process: str, stream: str, text: str) -> None:
        """Write a piece of a process's output."""
        if not text:
            return
        self._files[process].write(self._pages[process].compose(stream, "", text))
        source = (process, stream)
        self._write_all(source, names.shown(process), text)
        if stream in self._shown[process]:
            self._sheets.output.write(source, self._colours[process], for_screen(text))

    def say(self, text: str) -> None:
        """Tell the user something, in whole lines."""
        self.note(text)
        sheet = self._sheets.messages
        prefix = f"[{OURSELVES}] "
        sheet.write(OURSELVES, f"\x1b[1m{prefix}\x1b[0m" if sheet.colour else prefix, f"{text}\n")

    def note(self, text: str) -> None:
        """Keep something for whoever reads the run afterwards, in whole lines."""
        self._told(text)
        self._write_all(OURSELVES, OURSELVES, f"{text}\n")

    def rest(self, process: str) -> None:
        """Close the file of a process that does not run; its next output opens it again."""
        self._files[process].close()

    def close(self) -> None:
        """End unfinished lines and close the files."""
        self._sheets.output.end()
        self._all.write(self._all_page.end())
        for file in (*self._files.values(), self._all):
            file.close()

    @property
    def lost(self) -> int:
        """The number of bytes that could not be written to files."""
        return sum(file.lost for file in (*self._files.values(), self._all))

    def _write_all(self, source: object, name: str, text: str) -> None:
        self._all.write(self._all_page.compose(source, f"{self._wall():.6f} [{name}] ", plain(text)))

    def _colour_prefixes(self) -> dict[str, str]:
        return {
            process: coloured(prefix.rstrip(), index) + prefix[len(prefix.rstrip()) :]
            for index, (process, prefix) in enumerate(self._prefixes.items())
        }
