"""A graph, as that of a plan, in the DOT language of Graphviz (graphviz.org/doc/info/lang.html)."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.plan.render.graph import graph
from orchestra.plan.render.setting import Setting

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Plan
    from orchestra.plan.render.drawing import Edge, Graph, Group, Node, Shape

# In labels `&amp;` is an entity, as in HTML, and a backslash begins an escape.
_ESCAPES = {"&": "&amp;", "\\": "\\\\", '"': '\\"'}
_SHAPES: Final[dict[Shape, str]] = {
    "process": "box",
    "node": "ellipse",
    "container": "box3d",
    "component": "component",
    "trigger": "hexagon",
    "topic": "box",
}


def render(plan: Plan, setting: Setting = Setting(), /) -> str:  # noqa: B008 - it is frozen
    """Return the text of the graph of a plan."""
    del setting
    return text(graph(plan), "plan")


def text(drawn: Graph, name: str) -> str:
    """Return the text of a graph."""
    lines = [
        f"digraph {name} {{",
        f"  label={quoted((drawn.title,))}; labelloc=t; rankdir=LR; compound=true;",
        '  node [fontname="sans-serif"]; edge [fontname="sans-serif"];',
        *(f"  {_node(node)}" for node in drawn.outside),
        *(f"  {line}" for line in _members(drawn.root)),
        *(f"  {_edge(edge)}" for edge in drawn.edges),
        "}",
    ]
    return "\n".join(lines) + "\n"


def quoted(lines: tuple[str, ...]) -> str:
    """Return a text in quotes that says exactly these lines."""
    text = "\\n".join("".join(map(_escaped, line)) for line in lines)
    return f'"{text}"'


def _escaped(character: str) -> str:
    return _ESCAPES.get(character) or (character if character.isprintable() else "\ufffd")


def _members(group: Group) -> Iterator[str]:
    yield from (_node(node) for node in group.nodes)
    for below in group.below.values():
        yield f"subgraph {_key(below.title)} {{"
        yield f"  label={quoted((below.title,))};"
        yield from (f"  {line}" for line in _members(below))
        yield "}"


def _key(title: str) -> str:
    """Return the name of a group, which is drawn where it begins with `cluster`; other titles give other names."""
    return "cluster" + re.sub(r"[^A-Za-z0-9]", lambda found: f"_{ord(found[0]):x}_", title)


def _node(node: Node) -> str:
    return f"{node.key} [shape={_SHAPES[node.shape]}, label={quoted(node.lines)}];"


def _edge(edge: Edge) -> str:
    style = ", style=dashed" if edge.dashed else ""
    return f"{edge.source} -> {edge.target} [label={quoted((edge.label,))}{style}];"
