"""`param list`, `param dump`, `param load`: all parameters of a node, or of every node."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from rcl_interfaces.msg import Parameter

from orchestra.errors import RunError
from orchestra.ros.tools.graph.asking import Deadline
from orchestra.ros.tools.graph.names import NO_NODE, absolute, nodes, services, unknown
from orchestra.ros.tools.graph.seeing import looking
from orchestra.ros.tools.parameter_values import json_value, plain_value, type_name, value_of
from orchestra.ros.tools.parameters import Asked, asked
from orchestra.ros.tools.telling import as_json, json_line, tell, warn

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.seeing import Graph

_VALUES: Final = "ros__parameters"
_EVERY_NODE: Final = "/**"
_LISTS: Final = "/list_parameters"


def list_parameters(options: Namespace) -> int:
    """Write the names of parameters, of one node or of all."""
    keep = _filter(options)
    with looking(options) as graph:
        wanted = _wanted(graph, options)
        silent = []
        found: dict[str, list[tuple[str, str]]] = {}
        for full in wanted:
            node = Asked(graph, full, Deadline(options.timeout))
            try:
                names = [name for name in node.names() if keep(name)]
                kinds = [type_name(one.type) for one in node.descriptors(names)] if options.param_type else []
            except RunError as error:
                if options.node is not None:
                    raise
                silent.append(str(error))
                continue
            found[full] = list(zip(names, kinds or [""] * len(names), strict=True))
    text = "".join(
        (f"{full}:\n" if options.node is None else "")
        + "".join(f"  {name}{f' (type: {kind})' if kind else ''}\n" for name, kind in rows)
        for full, rows in found.items()
    )
    data = {
        full: [{"name": name, "type": kind} if kind else {"name": name} for name, kind in rows]
        for full, rows in found.items()
    }
    tell(options, text, data)
    for reason in silent:
        warn(f"warning: {reason}")
    return 1 if silent else 0


def dump(options: Namespace) -> int:
    """Write all parameters of a node as a parameter file."""
    with asked(options) as node:
        names = node.names()
        values = node.values(names)
        if len(values) != len(names):  # rclcpp answers nothing at all where one has no value
            values = [next(iter(node.values([name])), value_of(None)) for name in names]
    kept = list(zip(names, values, strict=True))
    if as_json(options):
        sys.stdout.write(json_line({node.node: {name: json_value(value) for name, value in kept}}))
        return 0
    import yaml  # noqa: PLC0415 - JSON needs none

    tree: dict[str, Any] = {}
    for name, value in kept:
        _place(tree, name, plain_value(value))
    # As the ROS 2 tools write it: in ASCII, with an empty line at its end.
    sys.stdout.write(yaml.safe_dump({node.node: {_VALUES: tree}}, default_flow_style=False) + "\n")
    return 0


def load(options: Namespace) -> int:
    """Set the parameters of a node that stand in a file for it."""
    values = _in_file(options.file, absolute(options.node), wildcard=not options.no_use_wildcard)
    made = []
    for name, data in values.items():
        if data is None:
            continue  # as `dump` writes what has no value: to set it would be to undeclare it
        try:
            made.append(Parameter(name=name, value=value_of(data)))
        except RunError as error:
            raise RunError(f"{options.file}: {name}: {error}") from None
    with asked(options) as node:
        results = node.set(made)
    failed = 0
    for parameter, result in zip(made, results, strict=True):
        because = f": {result.reason}" if result.reason else ""
        if result.successful:
            if not as_json(options):
                sys.stdout.write(f"Set parameter {parameter.name} successful{because}\n")
        else:
            failed += 1
            warn(f"Set parameter {parameter.name} failed{because}")
    if as_json(options):
        told = [
            {"name": one.name, "successful": result.successful, "reason": result.reason}
            for one, result in zip(made, results, strict=True)
        ]
        sys.stdout.write(json_line(told))
    return 1 if failed else 0


def _wanted(graph: Graph, options: Namespace) -> list[str]:
    """Return the nodes to ask: the one that is named, or all that have parameters."""
    every = options.include_hidden_nodes

    def asking() -> list[str]:
        there = {name for name, _ in services(graph) if name.endswith(_LISTS)}
        return sorted({full for full in nodes(graph, every=every) if full + _LISTS in there})

    if options.node is None:
        return graph.whole(asking)
    full = absolute(options.node)
    if not graph.found(lambda: full in nodes(graph, every=True)):
        raise unknown(NO_NODE, full, nodes(graph))
    return [full]


def _filter(options: Namespace) -> Any:  # noqa: ANN401 - a function of a name
    try:
        expression = None if options.filter is None else re.compile(options.filter)
    except re.error as error:
        raise RunError(f"'{options.filter}' is no regular expression: {error}") from None
    prefixes = options.param_prefixes

    def keep(name: str) -> bool:
        if prefixes and not any(name == prefix or name.startswith(f"{prefix}.") for prefix in prefixes):
            return False
        return expression is None or expression.match(name) is not None

    return keep


def _place(tree: dict[str, Any], name: str, value: Any) -> None:  # noqa: ANN401 - of any of the types
    """Put a value into a tree by its dotted name; a name below one that has a value itself keeps its dots."""
    *path, last = name.split(".")
    here = tree
    for index, word in enumerate(path):
        below = here.setdefault(word, {})
        if not isinstance(below, dict):
            here[".".join([*path[index:], last])] = value
            return
        here = below
    if isinstance(here.get(last), dict):
        tree[name] = value
        return
    here[last] = value


def _in_file(path: str, full: str, *, wildcard: bool) -> dict[str, Any]:
    """Return the parameters in a file for a node, by dotted names. Raises `RunError`."""
    import yaml  # noqa: PLC0415 - only here

    try:
        document = yaml.safe_load(Path(path).read_text("utf-8"))
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = "" if mark is None else f":{mark.line + 1}:{mark.column + 1}"
        raise RunError(f"{path}{where}: {getattr(error, 'problem', None) or 'it is no YAML'}") from None
    if not isinstance(document, dict):
        raise RunError(f"{path} is no parameter file: it has no nodes")
    found: dict[str, Any] = {}
    named = [_EVERY_NODE] if wildcard else []
    # A node's own section counts for more, wherever it stands; its name may stand without the slash.
    for key in (*named, full.removeprefix("/"), full):
        section = document.get(key)
        if isinstance(section, dict) and isinstance(section.get(_VALUES), dict):
            _flatten(section[_VALUES], "", found)
    if not found:
        raise RunError(f"{path} has no parameters for {full}{'' if wildcard else ' by its name'}")
    return found


def _flatten(tree: dict[str, Any], prefix: str, found: dict[str, Any]) -> None:
    for name, value in tree.items():
        if isinstance(value, dict):
            _flatten(value, f"{prefix}{name}.", found)
        else:
            found[f"{prefix}{name}"] = value
