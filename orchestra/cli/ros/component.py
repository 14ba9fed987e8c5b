"""`orchestra component`: nodes that containers have in their processes."""

from __future__ import annotations

import json
import os
import sys
from typing import TYPE_CHECKING, Final

from orchestra.cli.boundary import OK
from orchestra.cli.ros.asking import answered
from orchestra.cli.ros.options import flag, graph, natural, timeout, word
from orchestra.cli.ros.verbs import Verb, VerbParser
from orchestra.errors import RunError
from orchestra.nearest import nearest
from orchestra.resolve.packages.components import registered

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser


def _numbers(parser: CommandParser) -> None:
    parser.add_argument(
        "numbers", nargs="+", type=natural, metavar="UID", help="as `component list` has them"
    )


def _node(parser: CommandParser) -> None:
    """Add what a component is given."""
    parser.add_argument("-n", "--node-name", default="", metavar="NAME", help="name of its node")
    parser.add_argument("--node-namespace", default="", metavar="NAMESPACE", help="namespace of its node")
    levels = ("debug", "info", "warn", "error", "fatal")
    parser.add_argument("--log-level", type=str.lower, choices=levels, help="level of its logger")
    lists = {
        ("-r", "--remap-rule"): ("FROM:=TO", "remaps a name; may be given several times"),
        ("-p", "--parameter"): ("NAME:=VALUE", "sets a parameter, in YAML; may be given several times"),
        ("-e", "--extra-argument"): (
            "NAME:=VALUE",
            "tells the container more, as use_intra_process_comms:=true",
        ),
    }
    for names, (metavar, tell) in lists.items():
        parser.add_argument(*names, action="append", default=[], metavar=metavar, help=tell)


def _own_container(parser: CommandParser) -> None:
    parser.add_argument(
        "-c",
        "--container-node-name",
        metavar="NAME",
        help="name of the container's node (default: standalone_container_ and a random number)",
    )


_CONTAINER: Final = word("container", "its full name")
_QUIET: Final = flag("-q", "--quiet", tell="write only the number and the name")
_TIME: Final = timeout(10.0, "wait so long for the container to answer")
_PLUGIN: Final = (
    word("package", "its package"),
    word("plugin", "as `component types` has it, or MODULE:CLASS"),
)
_VERBS: Final = {
    "types": Verb(
        "list the components that are installed",
        "",
        (word("package", "only those of this package", optional=True),),
    ),
    "list": Verb(
        "list the containers and what they have loaded",
        "components:list_components",
        (
            graph,
            word("container", "only this one", optional=True),
            flag("--containers-only", tell="only their names"),
            _TIME,
        ),
    ),
    "load": Verb(
        "load a component into a container",
        "components:load",
        (graph, _CONTAINER, *_PLUGIN, _node, _QUIET, _TIME),
    ),
    "unload": Verb(
        "unload components from a container",
        "components:unload",
        (graph, _CONTAINER, _numbers, _QUIET, _TIME),
    ),
    "standalone": Verb(
        "run a component in a container of its own",
        "standalone:run",
        (graph, *_PLUGIN, _node, _own_container, _TIME),
    ),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("component", "Show, load and unload components.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    if options.verb != "types":
        answered("component", _VERBS[options.verb], options)
    return _types(options)


def _types(options: Namespace) -> int:
    found = registered(os.environ)
    if options.package is None:
        text = "".join(
            f"{package}\n" + "".join(f"  {name}\n" for name in names) for package, names in found.items()
        )
        data: object = found
    else:
        if options.package not in found:
            near = nearest(options.package, found)
            hint = f"; did you mean {near}?" if near else ""
            raise RunError(f"no package {options.package} has components{hint}")
        data = found[options.package]
        text = "".join(f"{name}\n" for name in found[options.package])
    sys.stdout.write(json.dumps(data) + "\n" if options.format == "json" else text)
    return OK
