"""The configuration files of Fast DDS and Cyclone DDS: missing ones are passed over without a word, broken ones too."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.location import Span

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.location import Location
    from orchestra.resolve.inputs import Inputs

_FILES: Final = ("FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE")
_URI: Final = "CYCLONEDDS_URI"
_SCHEME: Final = "file://"


def check_files(name: str, value: str, location: Location | None, inputs: Inputs, problems: Problems) -> None:
    """Report a configuration file that is missing or no XML. One in a folder that is not here may be elsewhere."""
    for path in _paths(name, value):
        if "${" in str(path):
            continue
        if path.is_file():
            _check_content(path, name, problems)
        elif inputs.launching or path.parent.is_dir():
            problems.error(Code.VENDOR_FILE, f"{name}: there is no file {path}", location)


def _paths(name: str, value: str) -> list[Path]:
    if name in _FILES:
        return [Path(value)]
    if name == _URI:  # a list, in which XML may stand itself
        parts = [part.strip() for part in value.split(",")] if not value.lstrip().startswith("<") else []
        return [Path(part.removeprefix(_SCHEME)) for part in parts if part and not part.startswith("<")]
    return []


def _check_content(path: Path, name: str, problems: Problems) -> None:
    # Only now: few systems have such files.
    from xml.parsers import expat  # noqa: PLC0415

    parser = expat.ParserCreate()
    try:
        parser.Parse(path.read_bytes(), True)
    except expat.ExpatError as error:
        line, column = error.lineno, error.offset + 1
        told = f"{name} names a file that is no XML: {expat.ErrorString(error.code)}"
        problems.error(Code.VENDOR_FILE, told, Span(str(path), line, column, line, column + 1))
    except OSError as error:
        problems.error(Code.VENDOR_FILE, f"{name}: {path} cannot be read: {error.strerror}")
