"""Nodes that are there and do not answer: their program hangs, or is too busy."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.ros.tools.doctor.observed import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.ros.tools.doctor.observed import Observed


def check(seen: Observed) -> Iterator[Finding]:
    """Yield each node of which a parameter was asked in vain."""
    for node in seen.silent:
        yield Finding(
            "answers", f"{node} does not answer what is asked of its parameters", (node,), {"node": node}
        )
