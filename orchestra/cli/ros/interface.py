"""`orchestra interface`: the types of messages, services and actions that are installed."""

from __future__ import annotations

import json
import os
import sys
from typing import TYPE_CHECKING, Final

from orchestra.cli.boundary import OK
from orchestra.cli.interfaces.expanded import Comments, expanded
from orchestra.cli.interfaces.index import KINDS, Interfaces
from orchestra.cli.ros.asking import answered
from orchestra.cli.ros.options import flag, word
from orchestra.cli.ros.verbs import Verb, VerbParser
from orchestra.errors import RunError, UsageError

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable

    from orchestra.cli.parser import CommandParser


def _kinds(parser: CommandParser) -> None:
    parser.add_argument("-m", "--only-msgs", action="store_true", help="only messages")
    parser.add_argument("-s", "--only-srvs", action="store_true", help="only services")
    parser.add_argument("-a", "--only-actions", action="store_true", help="only actions")


def _comments(parser: CommandParser) -> None:
    either = parser.add_mutually_exclusive_group()
    either.add_argument("--all-comments", action="store_true", help="those of the types that it uses too")
    either.add_argument("--no-comments", action="store_true", help="no comments")


def _paths(parser: CommandParser) -> None:
    tell = "folders of packages with definitions, or folders with such packages in them (default: this one)"
    parser.add_argument("paths", nargs="*", default=["."], metavar="PATH", help=tell)
    parser.add_argument("--only-check", action="store_true", help="build nothing: say what is wrong in them")


_TYPE: Final = word("type", "its full name, as std_msgs/msg/String")
_VERBS: Final = {
    "list": Verb("list the interfaces that are installed", "", (_kinds,)),
    "package": Verb("list the interfaces of a package", "", (word("package", "its name"), _kinds)),
    "packages": Verb("list the packages that have interfaces", "", (_kinds,)),
    "show": Verb(
        "show the definition of an interface", "", (word("type", "its full name; - reads it"), _comments)
    ),
    "proto": Verb(
        "show a message with its defaults, in YAML",
        "prototypes:proto",
        (_TYPE, flag("--no-quotes", tell="without quotes around it")),
    ),
    "build": Verb(
        "make packages of definitions ready to use",
        "building:build",
        (
            _paths,
            flag("--without-compiler", tell="as where there is no compiler: nothing to wait for, but slower"),
        ),
    ),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("interface", "Show and build types of messages, services and actions.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    if _VERBS[options.verb].tool:
        answered("interface", _VERBS[options.verb], options)
    answers: dict[str, Callable[[Interfaces, Namespace], tuple[str, object]]] = {
        "list": _list,
        "package": _package,
        "packages": _packages,
        "show": _show,
    }
    text, data = answers[options.verb](Interfaces(os.environ), options)
    sys.stdout.write(json.dumps(data) + "\n" if options.format == "json" else text)
    return OK


def _wanted(options: Namespace) -> tuple[str, ...]:
    given = {"msg": options.only_msgs, "srv": options.only_srvs, "action": options.only_actions}
    return tuple(kind for kind, wanted in given.items() if wanted) or tuple(KINDS)


def _list(interfaces: Interfaces, options: Namespace) -> tuple[str, object]:
    found = {kind: interfaces.all((kind,)) for kind in _wanted(options)}
    text = "".join(
        f"{KINDS[kind]}:\n" + "".join(f"    {name}\n" for name in names) for kind, names in found.items()
    )
    return text, found


def _package(interfaces: Interfaces, options: Namespace) -> tuple[str, object]:
    if not interfaces.of(options.package):
        raise RunError(interfaces.unknown_package(options.package))
    found = interfaces.of(options.package, _wanted(options))
    return "".join(f"{name}\n" for name in found), found


def _packages(interfaces: Interfaces, options: Namespace) -> tuple[str, object]:
    found = interfaces.packages(_wanted(options))
    return "".join(f"{name}\n" for name in found), found


def _show(interfaces: Interfaces, options: Namespace) -> tuple[str, object]:
    name = sys.stdin.readline().strip() if options.type == "-" else options.type
    if not name:
        raise UsageError("the name of an interface is missing on standard input")
    chosen = Comments.OUTER
    if options.all_comments or options.no_comments:
        chosen = Comments.ALL if options.all_comments else Comments.NONE
    text = expanded(name, interfaces.text, chosen)
    return text, {"name": name, "definition": text}
