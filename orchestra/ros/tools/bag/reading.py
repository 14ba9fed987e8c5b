"""Reads bags: folders with `metadata.yaml` and MCAP files, and single MCAP files. Times in nanoseconds.

A file that was not closed, since its recorder was killed or the disk was full, is read up to where it breaks off.
"""

from __future__ import annotations

import heapq
import struct
from contextlib import ExitStack
from itertools import count
from typing import TYPE_CHECKING, Final

from mcap.exceptions import McapError
from mcap.reader import make_reader
from mcap.records import Channel, Header, Message, Schema
from mcap.stream_reader import StreamReader
from zstandard import ZstdError

from orchestra.dataclass import dataclass
from orchestra.errors import RunError
from orchestra.fields import replace
from orchestra.ros.tools.bag import summary
from orchestra.ros.tools.bag.compressed import SUFFIX, is_compressed, opened, whole
from orchestra.ros.tools.bag.files import files_of, mcap_files
from orchestra.ros.tools.bag.summary import Part, Summary, Topic

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path
    from typing import BinaryIO, Self

    from mcap.summary import Summary as Index

# Messages of a broken file are put in order among so many: those that were heard at one time stand together in it.
_AMONG: Final = 10_000
_BROKEN: Final = (McapError, ValueError, struct.error)


@dataclass(frozen=True, slots=True)
class Recorded:
    """A message as it was recorded."""

    topic: str
    log_time: int
    publish_time: int
    data: bytes


class Bag:
    """An open bag. `broken` are the files that have no end."""

    def __init__(self, path: Path, *, anew: bool = False) -> None:
        """Open it; `anew` looks for its files whatever its metadata say. Raises `RunError` where it cannot be read."""
        self.path = path
        self.files, self._distribution = (mcap_files(path), summary.UNKNOWN) if anew else files_of(path)
        self.broken: list[Path] = []
        self._streams: list[BinaryIO] = []
        self._open = ExitStack()
        try:
            self._topics: dict[str, Topic] = {}
            self._parts: list[Part] = []
            for file in self.files:
                stream = self._open.enter_context(opened(file))
                self._streams.append(stream)
                self._learn(file, stream)
        except BaseException:
            self._open.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._open.close()

    @property
    def size(self) -> int:
        """How many bytes its files have."""
        return sum(file.stat().st_size for file in self.files)

    def summary(self) -> Summary:
        """Return what is in it."""
        topics = tuple(topic for _, topic in sorted(self._topics.items()))
        filled = [part for part in self._parts if part.count]
        start = min((part.start for part in filled), default=0)
        end = max((part.end for part in filled), default=0)
        return Summary(tuple(self._parts), topics, start, end, self._distribution)

    def mode(self) -> str:
        """Return how its messages are compressed, FILE, MESSAGE, or not at all."""
        if any(file.suffix == SUFFIX for file in self.files):
            return "FILE"
        firsts = (next(_raw(stream), None) for stream in self._streams)
        return "MESSAGE" if any(first is not None and is_compressed(first) for first in firsts) else ""

    def messages(
        self, wanted: Callable[[str], bool], since: int = 0, until: int | None = None
    ) -> Iterator[Recorded]:
        """Yield the messages of topics, from a time on, in the order of recording. Raises `RunError`."""
        for one in self._messages(wanted, since):
            if until is None or one.log_time <= until:
                yield one

    def _messages(self, wanted: Callable[[str], bool], since: int) -> Iterator[Recorded]:
        names = [name for name in self._topics if wanted(name)]
        for file, stream in zip(self.files, self._streams, strict=True):
            stream.seek(0)
            if file in self.broken:
                yield from (
                    one for one in _ordered(_scanned(stream)) if one.topic in names and one.log_time >= since
                )
                continue
            try:
                for _, channel, message in make_reader(stream).iter_messages(topics=names, starting_at=since):
                    yield _recorded(channel, message)
            except (*_BROKEN, RuntimeError, ZstdError) as error:  # the second is what lz4 raises
                raise RunError(f"{file} cannot be read: {error}") from None

    def _learn(self, file: Path, stream: BinaryIO) -> None:
        index = _index(file, stream)
        if index is None or index.statistics is None:
            self._learn_by_reading(file, stream)
            return
        statistics = index.statistics
        for number, channel in index.channels.items():
            schema = index.schemas.get(channel.schema_id)
            self._add(channel, schema, statistics.channel_message_counts.get(number, 0))
        span = (statistics.message_start_time, statistics.message_end_time)
        self._parts.append(Part(file.name, *span, statistics.message_count))

    def _learn_by_reading(self, file: Path, stream: BinaryIO) -> None:
        """Learn what is in a file that has no end."""
        self.broken.append(file)
        stream.seek(0)
        schemas: dict[int, Schema] = {}
        channels: dict[int, Channel] = {}
        counts: dict[int, int] = {}
        span: tuple[int, int] | None = None
        for record in _records(stream):
            if isinstance(record, Schema):
                schemas[record.id] = record
            elif isinstance(record, Channel):
                channels[record.id] = record
            elif isinstance(record, Message):
                counts[record.channel_id] = counts.get(record.channel_id, 0) + 1
                first, last = span or (record.log_time, record.log_time)
                span = (min(first, record.log_time), max(last, record.log_time))
        for number, channel in channels.items():
            self._add(channel, schemas.get(channel.schema_id), counts.get(number, 0))
        self._parts.append(Part(file.name, *(span or (0, 0)), sum(counts.values())))

    def _add(self, channel: Channel, schema: Schema | None, messages: int) -> None:
        known = self._topics.get(channel.topic)
        made = known or Topic(
            channel.topic,
            schema.name if schema else "",
            channel.metadata.get("topic_type_hash", ""),
            summary.read_profiles(channel.metadata.get("offered_qos_profiles", "")),
        )
        self._topics[channel.topic] = replace(made, count=made.count + messages)


def _index(file: Path, stream: BinaryIO) -> Index | None:
    """Return the index of a file, None where its end is missing. Raises `RunError` for what is no MCAP at all."""
    try:
        next(iter(StreamReader(stream).records))
    except (*_BROKEN, StopIteration):
        raise RunError(f"{file} is no MCAP file") from None
    stream.seek(0)
    try:
        return make_reader(stream).get_summary()
    except _BROKEN:
        return None


def _records(stream: BinaryIO) -> Iterator[Header | Schema | Channel | Message]:
    """Yield the records of a file up to where it breaks off."""
    try:
        for record in StreamReader(stream).records:
            if isinstance(record, Schema | Channel | Message):
                yield record
    except _BROKEN:
        return


def _raw(stream: BinaryIO) -> Iterator[bytes]:
    """Yield the messages of a file as they stand there."""
    stream.seek(0)
    yield from (record.data for record in _records(stream) if isinstance(record, Message))


def _scanned(stream: BinaryIO) -> Iterator[Recorded]:
    channels: dict[int, Channel] = {}
    for record in _records(stream):
        if isinstance(record, Channel):
            channels[record.id] = record
        elif isinstance(record, Message) and record.channel_id in channels:
            yield _recorded(channels[record.channel_id], record)


def _ordered(messages: Iterator[Recorded]) -> Iterator[Recorded]:
    """Yield messages by the time at which they were recorded, where not more than `_AMONG` are between them."""
    waiting: list[tuple[int, int, Recorded]] = []
    numbers = count()
    for message in messages:
        heapq.heappush(waiting, (message.log_time, next(numbers), message))
        if len(waiting) > _AMONG:
            yield heapq.heappop(waiting)[-1]
    while waiting:
        yield heapq.heappop(waiting)[-1]


def _recorded(channel: Channel, message: Message) -> Recorded:
    return Recorded(channel.topic, message.log_time, message.publish_time, whole(message.data))
