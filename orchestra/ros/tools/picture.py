"""`graph`: which nodes talk on which topics, as text, JSON, Mermaid, DOT or SVG."""

from __future__ import annotations

import sys
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING, Any, Final

from orchestra.plan.render import dot, mermaid, svg
from orchestra.plan.render.drawing import Edge, Graph, Group, Node, at
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.graph.system import COMMON, mismatch, system
from orchestra.ros.tools.telling import json_line

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable, Iterable, Sequence

    from orchestra.ros.tools.graph.system import End, System

_NAME: Final = "ros"


def show(options: Namespace) -> int:
    """Write the graph."""
    with joined(options) as graph:
        seen = graph.whole(lambda: system(graph))
    chosen = _chosen(seen if options.all else _plain(seen), options.node)
    sys.stdout.write(_FORMATS[options.format](chosen))
    return 0


def unfed(seen: System) -> set[str]:
    """Return the keys of the subscriptions that none of the publishers of their topic fits."""
    fits: dict[str, bool] = {}
    for publisher, subscription in seen.pairs():
        fits[subscription.key] = fits.get(subscription.key, False) or not mismatch(publisher, subscription)
    return {key for key, fit in fits.items() if not fit}


def drawn(seen: System) -> Graph:
    """Return the picture: nodes and topics in their namespaces, an arrow for each end."""
    names = sorted({*seen.nodes, *(end.node for end in (*seen.publishers, *seen.subscriptions))})
    types: dict[str, set[str]] = {}
    for end in (*seen.publishers, *seen.subscriptions):
        types.setdefault(end.topic, set()).add(end.type)
    nodes = {name: Node(f"n{number}", "node", (name,)) for number, name in enumerate(names, 1)}
    topics = {
        name: Node(f"t{number}", "topic", (name, *sorted(types[name])))
        for number, name in enumerate(sorted(types), 1)
    }
    root = Group("/")
    for found in (nodes, topics):
        for name, node in found.items():
            at(root, name.rpartition("/")[0]).nodes.append(node)
    deaf = unfed(seen)
    edges = {Edge(nodes[end.node].key, topics[end.topic].key, ""): None for end in seen.publishers} | {
        Edge(topics[end.topic].key, nodes[end.node].key, "", dashed=end.key in deaf): None
        for end in seen.subscriptions
    }
    return Graph("nodes and topics", (), root, tuple(edges))


def text(seen: System) -> str:
    """Return the nodes, each with the topics that it publishes and hears, and with whom."""
    blocks = []
    for node in sorted(set(seen.nodes)):
        rows = [
            *_rows(node, "publishes", "to", seen.publishers, seen.subscriptions),
            *_rows(node, "hears", "from", seen.subscriptions, seen.publishers),
        ]
        blocks.append("".join(f"{row}\n" for row in (node, *rows)))
    return "\n".join(blocks)


def data(seen: System) -> dict[str, Any]:
    """Return it as plain data."""
    deaf = unfed(seen)
    topics = sorted({end.topic for end in (*seen.publishers, *seen.subscriptions)})
    return {
        "nodes": sorted(seen.nodes),
        "topics": [
            {
                "name": topic,
                "types": sorted({end.type for end in (*publishers, *subscriptions)}),
                "publishers": [end.node for end in publishers],
                "subscriptions": [
                    {"node": end.node, "fed": bool(publishers) and end.key not in deaf}
                    for end in subscriptions
                ],
            }
            for topic in topics
            for publishers, subscriptions in [
                (_of(topic, seen.publishers), _of(topic, seen.subscriptions)),
            ]
        ],
    }


def _rows(node: str, word: str, way: str, own: Sequence[End], others: Sequence[End]) -> Iterable[str]:
    for topic, type_ in sorted({(end.topic, end.type) for end in own if end.node == node}):
        ends = sorted({end.node for end in _of(topic, others)})
        yield f"  {word} {topic} [{type_}] {way} {', '.join(ends) or 'nobody'}"


def _of(topic: str, ends: Iterable[End]) -> list[End]:
    return [end for end in ends if end.topic == topic]


def _plain(seen: System) -> System:
    """Return it without what is hidden, and without the topics that every node has."""
    return seen.without_hidden().only(lambda _: True, lambda end: end.topic not in COMMON)


def _chosen(seen: System, globs: Sequence[str]) -> System:
    """Return the nodes that a pattern fits, with all ends of their topics; everything where there is no pattern."""
    if not globs:
        return seen

    def fits(node: str) -> bool:
        return any(fnmatchcase(node, glob) for glob in globs)

    theirs = {end.topic for end in (*seen.publishers, *seen.subscriptions) if fits(end.node)}
    return seen.only(fits, lambda end: end.topic in theirs)


_FORMATS: Final[dict[str, Callable[[System], str]]] = {
    "text": text,
    "json": lambda seen: json_line(data(seen)),
    "mermaid": lambda seen: mermaid.text(drawn(seen)),
    "dot": lambda seen: dot.text(drawn(seen), _NAME),
    "svg": lambda seen: svg.image(dot.text(drawn(seen), _NAME)),
}
