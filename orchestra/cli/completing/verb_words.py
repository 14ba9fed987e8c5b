"""Words of the ROS command line: names of what runs and of what is installed.

Names in the graph are those that the commands themselves list; a process with rclpy looks for them.
"""

from __future__ import annotations

import json
import os
import signal
import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final, NoReturn

from orchestra.cli.commands import COMMANDS
from orchestra.cli.completing.candidates import Candidate
from orchestra.cli.completing.paths import paths
from orchestra.cli.interfaces.index import Interfaces
from orchestra.resolve.packages import InstalledPackages
from orchestra.resolve.packages.components import registered

if TYPE_CHECKING:
    from argparse import Action
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from orchestra.cli.parser import CommandParser

# Whoever waits at a prompt and does not want to any more presses Ctrl-C.
_PATIENCE: Final = 60
# What lists the words that a word of this name can be, and the key of a name in what it lists.
_LISTED: Final = {
    "TOPIC": (("topic", "list"), "name"),
    "NODE": (("node", "list"), None),
    "SERVICE": (("service", "list"), "name"),
    "ACTION": (("action", "list"), "name"),
    "CONTAINER": (("component", "list", "--containers-only"), None),
}
_OF_NODE: Final = {"NAME": (("param", "list"), "name"), "TRANSITION": (("lifecycle", "list"), "label")}
_LIFECYCLE: Final = ("lifecycle", "nodes")
_FILLED: Final = ("VALUES", "GOAL")
_KIND: Final = {"topic": "msg", "service": "srv", "action": "action"}


def words_of(command: str, parser: CommandParser) -> Callable[[Sequence[str], str], Iterable[Candidate]]:
    """Return what knows the words of a verb, given those before the cursor and the one that is begun."""

    def words(before: Sequence[str], begun: str) -> Iterable[Candidate]:
        word = _at(parser, len(before))
        return () if word is None else _words(command, str(word.metavar), before, begun)

    return words


def _at(parser: CommandParser, place: int) -> Action | None:
    """Return the word that stands at a place; the last may be one of several."""
    positional = [action for action in parser.actions if not action.option_strings]
    if place < len(positional):
        return positional[place]
    return positional[-1] if positional and positional[-1].nargs == "+" else None


def _words(command: str, metavar: str, before: Sequence[str], begun: str) -> Iterable[Candidate]:
    if metavar in _LISTED:
        words, key = _LISTED[metavar]
        return _names(_LIFECYCLE if command == "lifecycle" and metavar == "NODE" else words, key)
    if metavar in _OF_NODE and before:
        words, key = _OF_NODE[metavar]
        return _names((*words, before[0]), key)
    if metavar == "TYPE":
        return map(Candidate, _types(command, before, begun))
    if metavar in _FILLED:
        return () if begun else _prototype(before[-1])
    if metavar == "PACKAGE":
        return map(Candidate, InstalledPackages(os.environ).names())
    if metavar == "PLUGIN":
        return map(Candidate, registered(os.environ).get(before[-1], ()))
    return paths(begun) if metavar in ("FILE", "BAG") else ()


def _types(command: str, before: Sequence[str], begun: str) -> list[str]:
    """Return the types that a name has in the graph; where it has none, or one is begun, all that are installed."""
    if before and not begun and command in _KIND and (found := _asked((command, "type", before[0]))):
        return list(found)
    return Interfaces(os.environ).all((_KIND[command],) if command in _KIND else ("msg", "srv", "action"))


def _prototype(kind: str) -> Iterator[Candidate]:
    """Yield a message of a type, the request of a service or the goal of an action, with its defaults."""
    made = _asked(("interface", "proto", kind))
    if made is not None:
        yield Candidate(_in_one_line(made))


def _in_one_line(data: Any) -> str:  # noqa: ANN401 - JSON data
    """Return data as YAML in one line, without double quotes: in those it stands on a command line."""
    if isinstance(data, dict):
        return f"{{{', '.join(f'{key}: {_in_one_line(value)}' for key, value in data.items())}}}"
    if isinstance(data, list):
        return f"[{', '.join(map(_in_one_line, data))}]"
    if isinstance(data, str):
        doubled = data.replace("'", "''")
        return f"'{doubled}'"
    return ".nan" if data is None else json.dumps(data)


def _names(words: Sequence[str], key: str | None) -> Iterator[Candidate]:
    """Yield the names that a command lists; none where it cannot."""
    found = _asked(words)
    items = [item for below in found.values() for item in below] if isinstance(found, dict) else found
    for item in items or ():
        yield Candidate(item if key is None else item[key])


def _asked(words: Sequence[str]) -> Any:  # noqa: ANN401 - JSON data
    """Return what a command answers in JSON, None where it cannot."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        _list(words, writing)
    os.close(writing)
    with os.fdopen(reading, "rb") as stream:
        told = stream.read()
    return None if os.waitpid(child, 0)[1] else json.loads(told)


def _list(words: Sequence[str], writing: int) -> NoReturn:
    """Become the command in this forked process: a new one would first import what is here already."""
    try:
        nowhere = os.open(os.devnull, os.O_RDWR)
        for stream, instead in enumerate((nowhere, writing, nowhere)):
            os.dup2(instead, stream)
        sys.stdout = os.fdopen(1, "w")
        signal.alarm(_PATIENCE)
        name, *rest = words
        module = import_module(COMMANDS[name].module)
        module.run(module.parser().read([*rest, "--format", "json"]))
    finally:
        os._exit(1)  # it ends by itself where it can list anything
