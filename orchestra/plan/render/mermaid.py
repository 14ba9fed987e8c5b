"""A graph, as that of a plan, as a Mermaid flowchart (mermaid.js.org), which many web pages and editors draw."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.plan.render.graph import graph
from orchestra.plan.render.setting import Setting

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Plan
    from orchestra.plan.render.drawing import Edge, Graph, Group, Node, Shape

# Everything else of ASCII is written as a number: quotes, brackets, `#`, `%%` and colons have meanings of their own,
# some of them even between quotes.
_UNSAFE = re.compile(r"[^\w /.,=+-]", re.ASCII)
_BOXES: Final[dict[Shape, tuple[str, str]]] = {
    "process": ("[", "]"),
    "node": ("(", ")"),
    "container": ("[[", "]]"),
    "component": ("([", "])"),
    "trigger": ("{{", "}}"),
    "topic": ("[", "]"),
}


def render(plan: Plan, setting: Setting = Setting(), /) -> str:  # noqa: B008 - it is frozen
    """Return the text of the flowchart of a plan."""
    del setting
    return text(graph(plan))


def text(drawn: Graph) -> str:
    """Return the text of the flowchart of a graph."""
    lines = ["flowchart LR", *(_node(node) for node in drawn.outside)]
    lines += _members(drawn.root)
    lines += [_edge(edge) for edge in drawn.edges]
    return "\n  ".join(lines) + "\n"


def label(lines: tuple[str, ...]) -> str:
    """Return a text in quotes that says exactly these lines."""
    return f'"{"<br/>".join(_UNSAFE.sub(_number, line) for line in lines)}"'


def _number(found: re.Match[str]) -> str:
    character = found[0]
    if not character.isascii() and character.isprintable():
        return character
    code = ord(character)
    return f"#{code};" if character.isascii() and character.isprintable() else "#65533;"  # U+FFFD


def _members(group: Group) -> Iterator[str]:
    yield from (_node(node) for node in group.nodes)
    for below in group.below.values():
        yield f"subgraph g{_key(below.title)} [{label((below.title,))}]"
        yield from (f"  {line}" for line in _members(below))
        yield "end"


def _key(title: str) -> str:
    """Return a name of a group: other titles give other names."""
    return re.sub(r"[^A-Za-z0-9]", lambda found: f"_{ord(found[0]):x}_", title)


def _node(node: Node) -> str:
    before, after = _BOXES[node.shape]
    return f"{node.key}{before}{label(node.lines)}{after}"


def _edge(edge: Edge) -> str:
    arrow = "-.->" if edge.dashed else "-->"
    return f"{edge.source} {arrow}{f'|{label((edge.label,))}|' if edge.label else ''} {edge.target}"
