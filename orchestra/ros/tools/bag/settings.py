"""How an MCAP file is written, under the names that rosbag2's storage plug-in for MCAP gives to it."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import yaml

from orchestra.dataclass import dataclass
from orchestra.errors import UsageError
from orchestra.fields import replace
from orchestra.nearest import nearest

COMPRESSIONS: Final = ("none", "lz4", "zstd")
# So much is lost of a recorder that is killed, and so much is read at once by whoever plays from the middle.
_CHUNK: Final = 768 * 1024
# What a file of settings may have besides, which the library does not distinguish.
_ALIKE: Final = (
    *("noAttachmentCRC", "noSummaryCRC", "compressionLevel", "forceCompression", "noRepeatedSchemas"),
    *("noRepeatedChannels", "noAttachmentIndex", "noMetadataIndex", "noChunkIndex", "noStatistics"),
    *("noSummaryOffsets", "noMessageIndex", "noSummary"),
)


@dataclass(frozen=True, slots=True)
class Settings:
    """`chunk` is in bytes; without `chunked` messages stand in the file one by one, and nothing is compressed."""

    compression: str = "none"
    chunk: int = _CHUNK
    chunked: bool = True
    checked: bool = True


# As rosbag2_storage_mcap has them; how hard zstd tries cannot be chosen.
PRESETS: Final = {
    "none": Settings(),
    "fastwrite": Settings(chunked=False),
    "zstd_fast": Settings("zstd", checked=False),
    "zstd_small": Settings("zstd", chunk=4 * 1024 * 1024),
}


def settings(preset: str, file: str | None, compression: str | None) -> Settings:
    """Return what a preset says, then a file of settings, then a compression that is asked for. Raises `UsageError`."""
    made = PRESETS[preset]
    if file is not None:
        made = _in_file(file, made)
    return made if compression is None else replace(made, compression=compression)


def _in_file(file: str, made: Settings) -> Settings:
    try:
        found = yaml.safe_load(Path(file).read_text("utf-8"))
    except yaml.YAMLError as error:
        raise UsageError(f"{file} is no YAML: {error}") from None
    if not isinstance(found, dict):
        raise UsageError(f"{file} has no settings, as 'compression: Zstd'")
    for name, value in found.items():
        made = _set(made, file, str(name), value)
    return made


def _set(made: Settings, file: str, name: str, value: Any) -> Settings:  # noqa: ANN401 - whatever YAML gives
    match name, value:
        case "compression", str() if value.lower() in COMPRESSIONS:
            return replace(made, compression=value.lower())
        case "chunkSize", int() if value > 0 and not isinstance(value, bool):
            return replace(made, chunk=value)
        case "noChunking", bool():
            return replace(made, chunked=not value)
        case "noChunkCRC", bool():
            return replace(made, checked=not value)
        case "enableDataCRC", bool():
            return made
    if name in _ALIKE:
        return made
    known = ("compression", "chunkSize", "noChunking", "noChunkCRC", "enableDataCRC", *_ALIKE)
    if name in known:
        raise UsageError(f"{file}: {name} cannot be {value!r}")
    near = nearest(name, known)
    raise UsageError(f"{file}: there is no setting {name}" + (f"; did you mean {near}?" if near else ""))
