from __future__ import annotations

from graphlib import CycleError, TopologicalSorter
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from orchestra.plan.circles import circles

_GRAPHS = st.dictionaries(
    st.sampled_from("abcdef"), st.lists(st.sampled_from("abcdef"), max_size=3, unique=True), max_size=6
)


def _first(graph: dict[str, list[str]]) -> list[str] | None:
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        found: list[str] = error.args[1]
        return found
    return None


@given(_GRAPHS)
def test_all_circles_are_found_and_nothing_else(graph: dict[str, list[str]]) -> None:
    found = list(circles(graph))
    assert next(iter(found), None) == _first(graph)
    for circle in found:
        assert circle[0] == circle[-1]
        assert all(one in graph[other] for one, other in pairwise(circle))
    nodes = [node for circle in found for node in circle[1:]]
    assert len(nodes) == len(set(nodes))
    left = {node: awaited for node, awaited in graph.items() if node not in nodes}
    assert (
        _first({node: [other for other in awaited if other in left] for node, awaited in left.items()})
        is None
    )


def test_a_long_way_round_is_walked() -> None:
    graph = {str(number): [str(number - 1)] for number in range(1, 5000)} | {"0": ["4999"]}
    (circle,) = circles(graph)
    assert len(circle) == 5001
