"""Nodes with one name: what is asked of one is answered by any of them."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from orchestra.ros.tools.doctor.observed import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.ros.tools.doctor.observed import Observed


def check(seen: Observed) -> Iterator[Finding]:
    """Yield each name that several nodes have."""
    for name, count in sorted(Counter(seen.system.nodes).items()):
        if count > 1:
            yield Finding(
                "names", f"{count} nodes have the name {name}", (name,), {"node": name, "count": count}
            )
