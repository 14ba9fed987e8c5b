"""Topics that nobody feeds or nobody reads beside one of nearly the same name.

Names are compared token by token, so that `/left/image` is no slip of `/right/image`; where the token is a namespace,
it is none where both namespaces are of nodes that publish. A topic of which only the namespace differs is meant where
neither side has anybody else.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.nearest import is_slip
from orchestra.ros.tools.doctor.observed import Finding

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.ros.tools.doctor.observed import Observed
    from orchestra.ros.tools.graph.system import End


def check(seen: Observed) -> Iterator[Finding]:
    """Yield each topic once, subscriptions that are not fed first."""
    published = _by_topic(seen.system.publishers)
    read = _by_topic(seen.system.subscriptions)
    told: set[str] = set()
    for topic, ends in read.items():
        if topic not in published and (near := _meant(topic, ends, published, read)):
            told.add(near)
            yield _finding(topic, near, ends, f"nobody publishes {topic}, which {_nodes(ends)} subscribes to")
    for topic, ends in published.items():
        if topic not in read and topic not in told and (near := _meant(topic, ends, read, published)):
            yield _finding(topic, near, ends, f"nobody reads {topic}, which {_nodes(ends)} publishes")


def _finding(topic: str, near: str, ends: Iterable[End], message: str) -> Finding:
    nodes = sorted({end.node for end in ends})
    return Finding(
        "unmatched",
        f"{message}; did you mean {near}?",
        (topic, near),
        {"topic": topic, "near": near, "nodes": nodes},
    )


def _meant(
    topic: str, ends: list[End], others: dict[str, list[End]], own: dict[str, list[End]]
) -> str | None:
    """Return the topic of the other side that is probably meant: a slip, or the same name in another namespace."""
    types = {end.type for end in ends}
    alike = [
        name
        for name, found in others.items()
        if name not in (topic, "") and types & {end.type for end in found}
    ]
    slips = [name for name in alike if _slip(topic, name, {*others, *own} - {topic})]
    lonely = [name for name in alike if name not in own and _moved(topic, name)]
    found = sorted(slips, key=lambda name: (name in own, name)) or (lonely if len(lonely) == 1 else [])
    return found[0] if found else None


def _slip(topic: str, other: str, known: set[str]) -> bool:
    """Tell whether one token of a name is mistyped; a namespace that others are in is none."""
    tokens, theirs = topic.split("/"), other.split("/")
    if len(tokens) != len(theirs):
        return topic.replace("/", "").lower() == other.replace("/", "").lower()
    differing = [place for place, pair in enumerate(zip(tokens, theirs, strict=True)) if pair[0] != pair[1]]
    if len(differing) != 1:
        return False
    token, its = tokens[differing[0]], theirs[differing[0]]
    if _siblings(token, its) or not is_slip(token, its):
        return False
    namespace = "/".join(tokens[: differing[0] + 1]) + "/"
    return differing[0] == len(tokens) - 1 or not any(name.startswith(namespace) for name in known)


def _siblings(token: str, other: str) -> bool:
    """Tell whether names are of several of a kind, as `robot_a` and `robot_b` are."""
    (head, mark, tail), (its_head, _, its_tail) = token.rpartition("_"), other.rpartition("_")
    return bool(mark) and head == its_head and len(tail) == len(its_tail) == 1


def _moved(topic: str, other: str) -> bool:
    """Tell whether one of the names is the other in a namespace."""
    return topic.endswith(other) or other.endswith(topic)


def _by_topic(ends: Iterable[End]) -> dict[str, list[End]]:
    found: dict[str, list[End]] = {}
    for end in ends:
        found.setdefault(end.topic, []).append(end)
    return found


def _nodes(ends: Iterable[End]) -> str:
    return ", ".join(sorted({end.node for end in ends}))
