"""The words of a command line that follow the launch file, as inputs of a resolution."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import UsageError
from orchestra.location import Span
from orchestra.resolve.inputs import GivenArgument, GivenFile, GivenParameter, Inputs
from orchestra.wheels import as_called

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

COMMAND_LINE = "command line"
PARAMS_FILE = "--params-file"


def inputs_from(
    words: Sequence[str], *, environment: Mapping[str, str], params_files: Sequence[str] = ()
) -> Inputs:
    """Read `NAME:=VALUE` and `NODE:NAME:=VALUE`; the last of a repeated launch argument counts, as upstream.

    The environment is made the one in which the interpreter was called. Places are those on a line of the words and
    after them the parameter files, each behind its option.

    Raises `UsageError` for a word of another form.
    """
    arguments: dict[str, GivenArgument] = {}
    parameters: list[GivenParameter] = []
    column = 1
    for word in words:
        name, separator, value = word.partition(":=")
        if not separator or not name or name != name.strip():
            raise UsageError(f"'{word}' is none of NAME:=VALUE and NODE:NAME:=VALUE{_hint(word)}")
        span = Span(COMMAND_LINE, 1, column, 1, column + len(name))
        column += len(word) + 1
        node, colon, parameter = name.rpartition(":")
        if colon:
            parameters.append(GivenParameter(node, parameter, value, span))
        else:
            arguments[name] = GivenArgument(name, value, span)
    files = []
    for path in params_files:
        start = column + len(PARAMS_FILE) + 1
        column = start + len(path)
        files.append(GivenFile(path, Span(COMMAND_LINE, 1, start, 1, column)))
        column += 1
    return Inputs(as_called(environment), tuple(arguments.values()), tuple(parameters), tuple(files))


def _hint(word: str) -> str:
    """Return a question where one character is missing."""
    name, separator, value = word.partition("=")
    return f"; did you mean '{name}:={value}'?" if separator and name and name[-1] not in ": " else ""
