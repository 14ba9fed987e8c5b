"""`node list`."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.graph.names import nodes
from orchestra.ros.tools.graph.seeing import looking
from orchestra.ros.tools.telling import lines, tell, warn

if TYPE_CHECKING:
    from argparse import Namespace

_TWICE: Final = (
    "WARNING: Be aware that there are nodes in the graph that share an exact name, "
    "which can have unintended side effects"
)


def list_nodes(options: Namespace) -> int:
    """Write the names of the nodes."""
    with looking(options) as graph:
        found = graph.whole(lambda: nodes(graph, every=options.all))
    twice = [name for name, count in Counter(found).items() if count > 1]
    if twice:
        warn(f"{_TWICE}: {', '.join(twice)}")
    if options.count_nodes:
        tell(options, f"{len(found)}\n", len(found))
    else:
        tell(options, lines(found), found)
    return 0
