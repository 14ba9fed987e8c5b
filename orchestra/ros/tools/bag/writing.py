"""Writes a bag: a folder with one MCAP file and `metadata.yaml`.

A thread of its own writes, so that a slow disk stops nobody who hears messages. What is not written yet is bounded:
whoever adds more is told to wait (`behind`), and the middleware keeps it meanwhile.
"""

from __future__ import annotations

from contextlib import suppress
from functools import partial
from queue import SimpleQueue
from threading import Thread
from typing import TYPE_CHECKING, Final

from mcap.writer import CompressionType, Writer

from orchestra.fields import replace
from orchestra.ros.tools.bag import summary
from orchestra.ros.tools.bag.definitions import ENCODING
from orchestra.ros.tools.bag.summary import Summary, Topic

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path
    from typing import BinaryIO

    # Topic, log time, publish time, number of the message, its bytes.
    Message = tuple[str, int, int, int, bytes]

COMPRESSIONS: Final = {
    "none": CompressionType.NONE,
    "lz4": CompressionType.LZ4,
    "zstd": CompressionType.ZSTD,
}
_MOST_WAITING: Final = 256 * 2**20
# So much is lost of a recorder that is killed, and so much is read at once by whoever plays from the middle.
_CHUNK: Final = 768 * 1024
_METADATA: Final = "rosbag2"


class BagWriter:
    """A bag that is being written to a folder, which must not be there. Raises `OSError`, also for earlier writes."""

    def __init__(self, folder: Path, compression: str, library: str) -> None:
        folder.mkdir(parents=True)
        self.folder = folder
        self._path = folder / f"{folder.name}_0.mcap"
        self._stream: BinaryIO = self._path.open("wb")
        self._writer = Writer(self._stream, chunk_size=_CHUNK, compression=COMPRESSIONS[compression])
        self._writer.start(profile="ros2", library=library)
        self._channels: dict[str, int] = {}
        self._topics: dict[str, Topic] = {}
        self._counts: dict[str, int] = {}
        self._start = self._end = 0
        self._added = self._written = 0
        self._failure: OSError | None = None
        self._jobs: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self._thread = Thread(target=self._work, name="bag")
        self._thread.start()

    @property
    def behind(self) -> bool:
        """Tell whether as much waits to be written as may."""
        return self._added - self._written > _MOST_WAITING

    @property
    def count(self) -> int:
        """How many messages have been written."""
        return sum(self._counts.values())

    def declare(self, topic: Topic, definition: str) -> None:
        """Make a topic known, before its first message."""
        self._topics[topic.name] = topic
        self._jobs.put(partial(self._register, topic, definition.encode()))

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
        topics = tuple(
            replace(topic, count=self._counts.get(name, 0)) for name, topic in sorted(self._topics.items())
        )
        told = Summary((self._path.name,), topics, self._start, self._end)
        if self._failure is None:
            self._guarded(lambda: self._finish(told))
        if self._failure is not None:
            with suppress(OSError):  # of what could not be written before
                self._stream.close()
            raise self._failure
        made = self.folder / f".{summary.FILE}"
        made.write_text(summary.metadata_text(told), "utf-8")
        made.rename(self.folder / summary.FILE)
        return told

    def _work(self) -> None:
        """Do what is to be done until the end; after a failure, nothing more."""
        while (job := self._jobs.get()) is not None:
            if self._failure is None:
                self._guarded(job)

    def _guarded(self, job: Callable[[], None]) -> None:
        try:
            job()
            if not self._stream.closed:
                self._stream.flush()  # a recorder that is killed has written what it has heard but for a chunk
        except OSError as error:
            error.filename = str(self._path)
            self._failure = error

    def _register(self, topic: Topic, definition: bytes) -> None:
        schema = self._writer.register_schema(topic.type, ENCODING if definition else "", definition)
        about = {
            "offered_qos_profiles": summary.profiles_text(topic.profiles),
            "topic_type_hash": topic.type_hash,
        }
        self._channels[topic.name] = self._writer.register_channel(topic.name, "cdr", schema, about)

    def _write(self, messages: Sequence[Message]) -> None:
        for name, log_time, publish_time, number, data in messages:
            channel = self._channels[name]
            self._writer.add_message(channel, log_time, data, publish_time, number)
            self._counts[name] = self._counts.get(name, 0) + 1
            self._start = min(self._start or log_time, log_time)
            self._end = max(self._end, log_time)
        self._written += _size(messages)

    def _finish(self, told: Summary) -> None:
        self._writer.add_metadata(_METADATA, {"serialized_metadata": summary.stored_text(told)})
        self._writer.finish()  # type: ignore[no-untyped-call]  # it has no annotation
        self._stream.close()


def _size(messages: Sequence[Message]) -> int:
    return sum(len(message[-1]) for message in messages)
