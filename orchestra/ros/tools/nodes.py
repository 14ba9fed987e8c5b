"""`node list`."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.graph.names import nodes
from orchestra.ros.tools.telling import lines, tell, warn

if TYPE_CHECKING:
    from argparse import Namespace


def list_nodes(options: Namespace) -> int:
    """Write the names of the nodes."""
    with joined(options) as graph:
        found = graph.whole(lambda: nodes(graph, every=options.all))
    twice = [name for name, count in Counter(found).items() if count > 1]
    if twice:
        warn(f"warning: several nodes have one name, which can have unintended effects: {', '.join(twice)}")
    if options.count_nodes:
        tell(options, f"{len(found)}\n", len(found))
    else:
        tell(options, lines(found), found)
    return 0
