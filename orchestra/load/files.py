"""Launch files by path: one loader per format behind one table; no format is ever tried for another."""

from __future__ import annotations

import os
import sys
from importlib import import_module
from typing import TYPE_CHECKING, cast

from orchestra.description.launch import Description
from orchestra.errors import Code, Problems
from orchestra.fields import replace
from orchestra.load.encodings import UndecodableError, decoded
from orchestra.load.entities import describe
from orchestra.load.offsets import source
from orchestra.load.reader import Reader
from orchestra.location import Location, Span, displayed, point
from orchestra.patterns import pattern
from orchestra.witness.observing import observer
from orchestra.witness.once import real

if TYPE_CHECKING:
    import io

    from orchestra.description.entity import Action
    from orchestra.load.alike.one_by_one import Format

PYTHON = ".py"
FORMATS: dict[str, str] = {
    ".launch": "launch_file",
    ".xml": "xml_file",
    ".yaml": "yaml_file",
    ".yml": "yaml_file",
}

# The formats of which long files are read action by action, with what was learned of others.
ONE_BY_ONE: dict[str, str] = {"xml_file": "xml_items", "yaml_file": "yaml_items"}

_LARGEST = 64 * 1024 * 1024
_PIECE = 64 * 1024  # of a file that does not say how long it is
_LONG = 1_000  # characters
_READER = "orchestra.load.alike.one_by_one"
_OF_SHELLS = pattern(r"\$[A-Za-z_{]")


def load(
    path: str, problems: Problems, included_from: tuple[Span, ...] = (), ending: str | None = None
) -> Description | None:
    """Read a launch file. What is wrong in it is reported; None where there is nothing to go on with.

    `ending` tells the format where it is not that of the path.
    """
    ending = ending or _ending(path)
    if ending == PYTHON:
        # Here, because it brings in what Python launch files import.
        from orchestra.load import python_file  # noqa: PLC0415

        return python_file.read(path, problems, included_from)
    file = displayed(path, real)
    reader = Reader(problems, included_from)
    at = included_from[0] if included_from else point(file)
    location = Location(at, included_from[1:])
    module = FORMATS.get(ending)
    if module is None:
        problems.error(Code.UNKNOWN_FORMAT, unknown_format(file), location)
        return None
    text = _text(path, file, problems, location)
    if text is None:
        return None
    foreign = _may_be_foreign(text)
    actions = _one_by_one(text, file, module, reader) if _pays(text) else None
    if actions is not None:
        return Description(path, file, actions, foreign=foreign)
    tree = import_module(f"orchestra.load.{module}").read(text, file, reader)
    if tree is None:
        # Here, because only what cannot be read needs it.
        from orchestra.load.carrying_on import description_behind  # noqa: PLC0415

        description = description_behind(text, path, file, module, reader)
    else:
        description = describe(tree, path, file, reader)
    return description if description is None or not foreign else replace(description, foreign=True)


_OF_PYTHON = ("LaunchConfiguration(", "EnvironmentVariable(", "FindPackageShare(")


def _may_be_foreign(text: str) -> bool:
    """Return whether there may be a variable in a text as other languages write them; counting is the fastest way."""
    dollars = text.count("$") > text.count("$(") and _OF_SHELLS.search(text) is not None
    return dollars or "{{" in text or any(map(text.__contains__, _OF_PYTHON))


def _pays(text: str) -> bool:
    """Return whether to read a file action by action: a long one, and any other once what does so is imported."""
    return len(text) >= _LONG or _READER in sys.modules


def _one_by_one(text: str, file: str, module: str, reader: Reader) -> tuple[Action, ...] | None:
    """Return the actions of a long file in which nothing is wrong; None where it takes the ordinary way to read it."""
    items = ONE_BY_ONE.get(module)
    if items is None:
        return None
    from orchestra.load.alike.one_by_one import actions  # noqa: PLC0415 - what is short needs none of it

    written = cast("Format", import_module(f"orchestra.load.alike.{items}"))
    return actions(written, source(file, text), reader)


def _text(path: str, file: str, problems: Problems, location: Location) -> str | None:
    try:
        with open(path, "rb", buffering=0) as stream:  # noqa: PTH123 - pathlib is slow
            content = _content(stream)
    except OSError as error:
        problems.error(Code.UNREADABLE_FILE, f"cannot read {file}: {error.strerror}", location)
        return None
    observer().read(path, content)
    if len(content) > _LARGEST:
        problems.error(Code.UNREADABLE_FILE, f"{file} is larger than 64 MiB", location)
        return None
    try:
        return decoded(content)
    except UndecodableError as error:
        at = Location(point(file, error.line, error.column), location.included_from)
        problems.error(Code.SYNTAX, str(error), at)
        return None


def _content(stream: io.FileIO) -> bytes:
    """Return what is in a file, at most one byte more than it may have; room for that takes long to get."""
    pieces: list[bytes] = []
    left = _LARGEST + 1
    size = os.fstat(stream.fileno()).st_size
    while left and (piece := stream.read(min(max(size + 1, _PIECE), left))):
        pieces.append(piece)
        left -= len(piece)
    return b"".join(pieces)


def has_format(path: str) -> bool:
    """Return whether the ending of a path tells how the file is read."""
    ending = _ending(path)
    return ending == PYTHON or ending in FORMATS


def _ending(path: str) -> str:
    return os.path.splitext(path)[1].lower()  # noqa: PTH122 - pathlib is slow


def unknown_format(file: str) -> str:
    """Return what is said of a file whose ending tells nothing."""
    return f"cannot tell the format of {file}: launch files end in " + ", ".join(sorted({PYTHON, *FORMATS}))
