"""A graph that is drawn: what the formats share, whatever it shows.

Namespaces are groups; what is in them has a shape, and arrows lie between.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field

Shape: TypeAlias = Literal["process", "node", "container", "component", "trigger", "topic"]


@dataclass(frozen=True, slots=True)
class Node:
    """A node of the graph; `key` is unique and made of letters and digits, `lines` are its text."""

    key: str
    shape: Shape
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Edge:
    """An arrow between two keys; `dashed` where it says what a trigger does or what a container holds."""

    source: str
    target: str
    label: str
    dashed: bool = False


@dataclass(slots=True)
class Group:
    """A namespace: its nodes, and the namespaces below it by the last part of their names."""

    title: str
    nodes: list[Node] = field(default_factory=list)
    below: dict[str, Group] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Graph:
    """All of it: the nodes outside all namespaces, the namespaces, the edges."""

    title: str
    outside: tuple[Node, ...]
    root: Group
    edges: tuple[Edge, ...]


def at(root: Group, namespace: str) -> Group:
    """Return the group of a namespace, made where it is not there."""
    here = root
    for token in filter(None, namespace.split("/")):
        here = here.below.setdefault(token, Group(f"{here.title.rstrip('/')}/{token}"))
    return here
