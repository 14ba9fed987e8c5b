"""Writes a bag: a folder with MCAP files, one unless it is split, and `metadata.yaml`.

A thread of its own writes, so that a slow disk stops nobody who hears messages. What is not written yet is bounded:
whoever adds more is told to wait (`behind`), and the middleware keeps it meanwhile.
"""

from __future__ import annotations

from contextlib import suppress
from functools import partial
from queue import SimpleQueue
from threading import Thread
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.fields import replace
from orchestra.ros.tools.bag import summary
from orchestra.ros.tools.bag.compressed import compressed
from orchestra.ros.tools.bag.settings import Settings
from orchestra.ros.tools.bag.storing import StorageFile
from orchestra.ros.tools.bag.summary import Part, Summary, Topic

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from orchestra.ros.tools.bag.storing import Message


@dataclass(frozen=True, slots=True)
class Layout:
    """How a bag is written.

    Another file begins after so many bytes or nanoseconds, 0 for never; `mode` tells whether whole files or messages
    are compressed by zstd, "none" for neither; `custom` is what the bag says besides; `most_waiting` is in bytes.
    """

    settings: Settings = Settings()
    most_bytes: int = 0
    most_time: int = 0
    mode: str = "none"
    custom: tuple[tuple[str, str], ...] = ()
    most_waiting: int = 256 * 2**20


class BagWriter:
    """A bag that is being written to a folder, which must not be there. Raises `OSError`, also for earlier writes."""

    def __init__(self, folder: Path, layout: Layout, library: str) -> None:
        folder.mkdir(parents=True)
        self.folder = folder
        self._layout = layout
        self._library = library
        self._parts: list[Part] = []
        self._topics: dict[str, Topic] = {}
        self._definitions: dict[str, str] = {}
        self._counts: dict[str, int] = {}
        self._added = self._written = 0
        self._failure: OSError | None = None
        self._file = self._begun()
        self._jobs: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self._thread = Thread(target=self._work, name="bag")
        self._thread.start()

    @property
    def behind(self) -> bool:
        """Tell whether as much waits to be written as may."""
        return self._added - self._written > self._layout.most_waiting

    @property
    def count(self) -> int:
        """How many messages have been written."""
        return sum(self._counts.values())

    def declare(self, topic: Topic, definition: str) -> None:
        """Make a topic known, before its first message."""
        self._topics[topic.name] = topic
        self._jobs.put(partial(self._register, topic, definition))

    def learn(self, topic: Topic) -> None:
        """Take what has become known of a topic since."""
        self._topics[topic.name] = topic

    def add(self, messages: Sequence[Message]) -> None:
        """Have messages written, in this order. Raises what writing of earlier ones failed with."""
        if self._failure is not None:
            raise self._failure
        self._added += _size(messages)
        self._jobs.put(partial(self._write, messages))

    def close(self) -> Summary:
        """Write the rest, and return what is in the bag. Raises `OSError`; what was written can be read then too."""
        self._jobs.put(None)
        self._thread.join()
        if self._failure is None:
            self._guarded(self._end_file)
        if self._failure is not None:
            with suppress(OSError):  # of what could not be written before
                self._file.close()
            raise self._failure
        told = self._told()
        made = self.folder / f".{summary.FILE}"
        made.write_text(summary.metadata_text(told), "utf-8")
        made.rename(self.folder / summary.FILE)
        return told

    def _begun(self) -> StorageFile:
        """Return the next file, in which all topics are known. Raises `OSError`."""
        path = self.folder / f"{self.folder.name}_{len(self._parts)}.mcap"
        settings = self._layout.settings
        chunk = min(settings.chunk, self._layout.most_bytes or settings.chunk)
        made = StorageFile(path, replace(settings, chunk=chunk), self._library)
        for name, definition in self._definitions.items():
            made.register(self._topics[name], definition)
        return made

    def _told(self) -> Summary:
        """Return what is in the bag by now."""
        parts = (*self._parts, self._file.part)
        topics = tuple(
            replace(topic, count=self._counts.get(name, 0)) for name, topic in sorted(self._topics.items())
        )
        filled = [part for part in parts if part.count]
        start = min((part.start for part in filled), default=0)
        mode = "" if self._layout.mode == "none" else self._layout.mode.upper()
        return Summary(
            parts,
            topics,
            start,
            max((part.end for part in filled), default=0),
            mode=mode,
            custom=self._layout.custom,
        )

    def _work(self) -> None:
        """Do what is to be done until the end; after a failure, nothing more."""
        while (job := self._jobs.get()) is not None:
            if self._failure is None:
                self._guarded(job)

    def _guarded(self, job: Callable[[], None]) -> None:
        try:
            job()
            self._file.flush()
        except OSError as error:
            error.filename = str(self.folder / self._file.part.path)
            self._failure = error

    def _register(self, topic: Topic, definition: str) -> None:
        self._definitions[topic.name] = definition
        self._file.register(topic, definition)

    def _write(self, messages: Sequence[Message]) -> None:
        for message in messages:
            name, log_time, *_ = message
            if self._is_full(log_time):
                self._end_file()
                self._parts.append(self._file.part)
                self._file = self._begun()
            if self._layout.mode == "message":
                message = (*message[:-1], compressed(message[-1]))  # noqa: PLW2901 - the same in less
            self._file.write(message)
            self._counts[name] = self._counts.get(name, 0) + 1
        self._written += _size(messages)

    def _end_file(self) -> None:
        self._file.finish(self._told())
        if self._layout.mode == "file":
            self._file.compress()

    def _is_full(self, log_time: int) -> bool:
        """Tell whether a message of this time begins another file."""
        most_bytes, most_time = self._layout.most_bytes, self._layout.most_time
        if not (most_bytes or most_time) or not (part := self._file.part).count:
            return False
        return bool(
            (most_bytes and self._file.size >= most_bytes)
            or (most_time and log_time - part.start >= most_time)
        )


def _size(messages: Sequence[Message]) -> int:
    return sum(len(message[-1]) for message in messages)
