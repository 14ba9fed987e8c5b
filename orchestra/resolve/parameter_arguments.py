"""Parameters and remapping rules among the arguments of a node: `--ros-args -p rate:=5 --params-file more.yaml`.

rcl reads them with all others, in the order of the command line, on which they stand before what the description gives
to the node.
"""

from __future__ import annotations

import os
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.location import Location, is_file, is_python
from orchestra.resolve.model import FileParameters, ResolvedRemap, new_remap
from orchestra.resolve.names import InvalidName
from orchestra.resolve.parameter_files import read_file
from orchestra.resolve.rcl.overrides import read_override
from orchestra.resolve.rcl.sections import Entry, Section
from orchestra.resolve.remaps import read_rule

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.resolve.context import Value
    from orchestra.resolve.resolution import Resolution

_SINGLE: Final = ("-p", "--param")
_FILE: Final = "--params-file"
_RULE: Final = ("-r", "--remap")
_OF_THE_NODE: Final = {"node", "namespace"}  # kinds of rules that say what the node itself is called
_ASSIGNED: Final = ":="


def settings_among(
    words: Sequence[Value], run: Resolution, *, for_ros: bool
) -> Iterator[FileParameters | ResolvedRemap]:
    """Yield what the words set, in order; `for_ros` tells that all of them are for rcl.

    What cannot be known here is a file without a path: the node may have more parameters.
    """
    reads = for_ros
    for word, following in pairwise(words):
        if word.text in ("--ros-args", "--"):
            reads = word.text == "--ros-args"
        elif reads and word.text in _SINGLE and _ASSIGNED in following.text:
            yield _single(following, run)
        elif reads and word.text == _FILE:
            yield _file(following, run)
        elif reads and word.text in _RULE and _ASSIGNED in following.text:
            yield from _rule(following, run)


def _rule(word: Value, run: Resolution) -> Iterator[ResolvedRemap]:
    source, _, target = word.text.partition(_ASSIGNED)
    try:
        rule = read_rule(source, target)
    except InvalidName as error:
        message = f"'{error.name}' cannot be a name: {error.fault.reason}"
        run.problems.error(Code.BAD_NAME, message, word.location)
        return
    if not set(rule.kinds) & _OF_THE_NODE:
        yield new_remap(replace(word, text=source), replace(word, text=target))


def _single(word: Value, run: Resolution) -> FileParameters:
    try:
        found = read_override(word.text)
    except ValueError as error:
        message = f"'{word.text}' sets no parameter: {error}"
        run.problems.error(Code.BAD_VALUE, message, word.location)
        return FileParameters("", (), word.location)
    key, value, is_apart = _places(word, found.name)
    entry = Entry(found.name, found.value, value, key, found.name, items=() if is_apart else (value,))
    return FileParameters(
        word.text, (Section(found.pattern, (entry,), key),), word.location, through=word.through
    )


def _places(word: Value, name: str) -> tuple[Location, Location, bool]:
    """Return the places of the name and of the value, and whether they are known: else both are that of the word."""
    at = word.location
    span = at.span
    is_written = span.line == span.end_line and span.end_column - span.column == len(word.text)
    if is_python(at) or not is_written:
        return at, at, False
    left = span.column + word.text.index(_ASSIGNED)
    key = replace(span, column=left - len(name), end_column=left)
    value = replace(span, column=left + len(_ASSIGNED))
    return replace(at, span=key), replace(at, span=value), True


def _file(word: Value, run: Resolution) -> FileParameters:
    """Return what a file sets. A relative path is one below the working directory of the process, mostly ours."""
    path = os.path.normpath(Path.cwd() / word.text)
    file = read_file(path, word.location, run) if is_file(path) else None
    return FileParameters("", (), word.location) if file is None else replace(file, through=word.through)
