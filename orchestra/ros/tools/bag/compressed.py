"""Bags that rosbag2 has compressed with zstd as whole files, or message by message."""

from __future__ import annotations

import io
import tempfile
from typing import TYPE_CHECKING, Final

import zstandard

from orchestra.errors import RunError

if TYPE_CHECKING:
    from pathlib import Path
    from typing import BinaryIO

SUFFIX: Final = ".zstd"
# Of each frame (RFC 8878, 3.1.1). No message in CDR begins so: its first byte is 0.
_MAGIC: Final = b"\x28\xb5\x2f\xfd"
_WHOLE: Final = 64 * 1024 * 1024  # what is longer is unpacked to the disk


def compress_file(path: Path) -> Path:
    """Put a file in the place of another that has all of it in less, and return where that is. Raises `OSError`."""
    made = path.with_name(path.name + SUFFIX)
    with path.open("rb") as source, made.open("wb") as sink:
        zstandard.ZstdCompressor().copy_stream(source, sink, size=path.stat().st_size)
    path.unlink()
    return made


def opened(path: Path) -> BinaryIO:
    """Open a storage file; one that is compressed is unpacked to where nobody else sees it.

    Raises `OSError`, and `RunError` for what is not compressed by zstd.
    """
    if path.suffix != SUFFIX:
        return path.open("rb")
    unpacked: BinaryIO = tempfile.SpooledTemporaryFile(_WHOLE)  # type: ignore[assignment]  # noqa: SIM115 - the caller closes it
    with path.open("rb") as source:
        try:
            zstandard.ZstdDecompressor().copy_stream(source, unpacked)
        except zstandard.ZstdError as error:
            unpacked.close()
            raise RunError(f"{path} cannot be unpacked: {error}") from None
    unpacked.seek(0)
    return unpacked


def compressed(data: bytes) -> bytes:
    """Return a message in less."""
    return zstandard.ZstdCompressor().compress(data)


def whole(data: bytes) -> bytes:
    """Return a message as the middleware carries it, whether it was compressed or not."""
    if not is_compressed(data):
        return data
    return zstandard.ZstdDecompressor().stream_reader(io.BytesIO(data)).read()


def is_compressed(data: bytes) -> bool:
    """Tell whether a message is compressed."""
    return data[:4] == _MAGIC
