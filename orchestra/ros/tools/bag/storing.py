"""One MCAP file of a bag, as rosbag2 lays it out. Times in nanoseconds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from mcap.writer import CompressionType, Writer

from orchestra.ros.tools.bag import summary
from orchestra.ros.tools.bag.compressed import compress_file
from orchestra.ros.tools.bag.definitions import ENCODING
from orchestra.ros.tools.bag.summary import Part

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.ros.tools.bag.settings import Settings
    from orchestra.ros.tools.bag.summary import Summary, Topic

    # Topic, log time, publish time, number of the message, its bytes.
    Message = tuple[str, int, int, int, bytes]

_COMPRESSIONS: Final = {
    "none": CompressionType.NONE,
    "lz4": CompressionType.LZ4,
    "zstd": CompressionType.ZSTD,
}
_METADATA: Final = "rosbag2"


class StorageFile:
    """A file that is being written. Its methods raise `OSError`."""

    def __init__(self, path: Path, settings: Settings, library: str) -> None:
        self._path = path
        self._stream = path.open("wb")
        self._writer = Writer(
            self._stream,
            chunk_size=settings.chunk,
            compression=_COMPRESSIONS[settings.compression],
            use_chunking=settings.chunked,
            enable_crcs=settings.checked,
        )
        self._writer.start(profile="ros2", library=library)
        self._channels: dict[str, int] = {}
        self._start = self._end = self._count = 0

    @property
    def part(self) -> Part:
        """What is in it by now."""
        return Part(self._path.name, self._start, self._end, self._count)

    @property
    def size(self) -> int:
        """How many bytes have been written, whole chunks of them."""
        return 0 if self._stream.closed else self._stream.tell()

    def register(self, topic: Topic, definition: str) -> None:
        """Make a topic known, before its first message."""
        schema = self._writer.register_schema(topic.type, ENCODING if definition else "", definition.encode())
        about = {
            "offered_qos_profiles": summary.profiles_text(topic.profiles),
            "topic_type_hash": topic.type_hash,
        }
        self._channels[topic.name] = self._writer.register_channel(topic.name, "cdr", schema, about)

    def write(self, message: Message) -> None:
        """Write a message of a topic that is known."""
        name, log_time, publish_time, number, data = message
        self._writer.add_message(self._channels[name], log_time, data, publish_time, number)
        self._count += 1
        self._start = min(self._start or log_time, log_time)
        self._end = max(self._end, log_time)

    def flush(self) -> None:
        """Hand over what is written: of a recorder that is killed, a chunk is lost at most."""
        if not self._stream.closed:
            self._stream.flush()

    def finish(self, told: Summary) -> None:
        """Write its index, and what the bag says of itself, and close it."""
        self._writer.add_metadata(_METADATA, {"serialized_metadata": summary.stored_text(told)})
        self._writer.finish()  # type: ignore[no-untyped-call]  # it has no annotation
        self._stream.close()

    def compress(self) -> None:
        """Make less of a file that is finished."""
        self._path = compress_file(self._path)

    def close(self) -> None:
        """Close it as it is."""
        self._stream.close()
