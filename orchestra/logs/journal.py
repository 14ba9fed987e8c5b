"""Where output goes: the file of its process, the merged files, and the screen."""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING

from orchestra.logs import forms, names, outputs
from orchestra.logs.narration import Narration
from orchestra.logs.page import Page
from orchestra.logs.records import OURS, Record, dumps
from orchestra.logs.rotation import Rotation
from orchestra.logs.terminal_text import coloured, harmless, plain

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from orchestra.logs.outputs import Output
    from orchestra.logs.sheets import Sheets
    from orchestra.logs.writer import LogFile, Writer

OURSELVES = "orchestra"

# At the end of a run a disk must take something every so many seconds, and all within the second time.
_PATIENCE, _LONGEST = 0.5, 1.5


class Journal:
    """Writes what processes and we ourselves have to say.

    `wanted` maps each process, in plan order, to its `output`; `forced`, where given, counts for all of them. `told`
    hears everything that we say. The file of a process has its bytes and nothing else; of what could not be written
    there, a line in its place tells.
    """

    def __init__(
        self,
        folder: Path,
        wanted: Mapping[str, Output],
        sheets: Sheets,
        writer: Writer,
        told: Callable[[str], None],
        wall: Callable[[], float] = time.time,
        *,
        rotation: Rotation | None = None,
        forced: str | None = None,
    ) -> None:
        self._folder = folder
        self._sheets = sheets
        self._writer = writer
        self._told = told
        self._wall = wall
        self._rotation = rotation or Rotation()
        self._forced = forced
        self._shown: dict[str, frozenset[str]] = {}
        self._prefixes: dict[str, bytes] = {}
        self._files: dict[str, LogFile] = {}
        self._narrations: dict[str, Narration] = {}
        self._all = writer.file(folder / "all.log", self._rotation, forms.OUTPUT)
        self._all_page = Page()
        self._records = writer.file(folder / "all.jsonl", self._rotation, forms.RECORDS)
        self.add(wanted)

    def add(self, wanted: Mapping[str, Output]) -> None:
        """Take up more processes, after those that are known: names and files of these stay."""
        for process, output in wanted.items():
            self._shown[process] = outputs.on_screen(output if self._forced is None else self._forced)
            self._narrations[process] = Narration(process)
        prefixes = names.prefixes(self._shown)
        shown = self._colour(prefixes) if self._sheets.output.colour else prefixes
        self._prefixes = {process: prefix.encode("utf-8", "replace") for process, prefix in shown.items()}
        stems = names.log_stems(self._shown)
        for process in wanted:
            path = self._folder / f"{stems[process]}.log"
            self._files[process] = self._writer.file(path, self._rotation, forms.OUTPUT)

    def begin(self, process: str, pid: int, environment: Mapping[str, str]) -> None:
        """Another run of a process begins: what it writes from now on is of this pid."""
        self._narrations[process].begin(pid, environment)

    def output(self, process: str, stream: str, data: bytes, *, shown: bool = True) -> None:
        """Write a piece of a process's output; without `shown`, to the files alone."""
        if not data:
            return
        now, source, bare = self._wall(), (process, stream), plain(data)
        clean = harmless(bare)
        told = self._narrations[process].add(stream, bare, now, clean=clean)
        with self._writer.together():
            self._files[process].write(data)
            self._write_all(source, names.shown(process), bare, now)
            self._records.write(told)
        if shown and stream in self._shown[process]:
            self._sheets.output.write(source, self._prefixes[process], data, clean=clean)

    def let_through(self, process: str, data: bytes) -> None:
        """Show raw output of a process that has the user's terminal for itself."""
        if self._shown[process]:
            self._sheets.output.let_through(process, data)

    def say(self, text: str) -> None:
        """Tell the user something, in whole lines."""
        self.note(text)
        sheet, data = self._sheets.messages, _bytes(f"{text}\n")
        prefix = f"[{OURSELVES}] "
        shown = f"\x1b[1m{prefix}\x1b[0m" if sheet.colour else prefix
        sheet.write(OURSELVES, shown.encode(), data, clean=harmless(plain(data)))

    def note(self, text: str) -> None:
        """Keep something for whoever reads the run afterwards, in whole lines."""
        self._told(text)
        now = self._wall()
        self._write_all(OURSELVES, OURSELVES, plain(_bytes(f"{text}\n")), now)
        for line in text.split("\n"):
            record = Record(now, None, os.getpid(), OURS, None, None, line)
            self._records.write(dumps(record).encode() + b"\n")

    def rest(self, process: str) -> None:
        """Close the file of a process that does not run; its next output opens it again."""
        self._records.write(self._narrations[process].end(self._wall()))
        self._files[process].close()

    def settle(self) -> None:
        """Wait until the disk has what was written so far, unless it hangs."""
        self._writer.finish(_PATIENCE, _LONGEST)

    def close(self) -> None:
        """End unfinished lines and close the files."""
        self._sheets.output.end()
        self._all.write(self._all_page.end())
        for process in self._files:
            self.rest(process)
        self._all.close()
        self._records.close()

    @property
    def lost(self) -> int:
        """The number of bytes that could not be written to files, or have not been."""
        return self._writer.lost

    def _write_all(self, source: object, name: str, bare: bytes, now: float) -> None:
        self._all.write(self._all_page.compose(source, _bytes(f"{now:.6f} [{name}] "), bare))

    @staticmethod
    def _colour(prefixes: Mapping[str, str]) -> dict[str, str]:
        return {
            process: coloured(prefix.rstrip(), index) + prefix[len(prefix.rstrip()) :]
            for index, (process, prefix) in enumerate(prefixes.items())
        }


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", "surrogateescape")
