"""Circles in a graph: one walk finds them all, each node in one at the most."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping


def circles(graph: Mapping[str, Iterable[str]]) -> Iterator[list[str]]:
    """Yield circles of nodes, given those that each waits for: each waits for the one before, the first stands twice.

    What is in a circle counts as gone then. `graphlib` finds the first one too, but knows no way to go on from there.
    """
    waiting: dict[str, list[str]] = {}
    for node, awaited in graph.items():
        waiting.setdefault(node, [])
        for other in awaited:
            waiting.setdefault(other, []).append(node)
    seen: set[str] = set()
    for root in waiting:
        if root not in seen:
            yield from _from(root, waiting, seen)


def _from(root: str, waiting: Mapping[str, list[str]], seen: set[str]) -> Iterator[list[str]]:
    """Walk on from a node. What is `seen` and not on the way leads to no circle, or has gone with one."""
    way: dict[str, Iterator[str]] = {}
    there: str | None = root
    while there is not None or way:
        if there is not None:
            seen.add(there)
            way[there] = iter(waiting[there])
        last = next(reversed(way))
        there = next((node for node in way[last] if node in way or node not in seen), None)
        if there is None:
            del way[last]
        elif there in way:
            yield [*reversed(_back_to(there, way)), there]
            there = None


def _back_to(node: str, way: dict[str, Iterator[str]]) -> list[str]:
    """Go back the way until a node has been taken off it; return what has been, the node itself at the end."""
    circle = []
    while node in way:
        circle.append(way.popitem()[0])
    return circle
