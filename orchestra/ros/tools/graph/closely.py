"""Looking at whose the ends in the graph are: on the wire where that can tell it, else with a whole node."""

from __future__ import annotations

import os
from contextlib import contextmanager
from typing import TYPE_CHECKING

from orchestra.ros.tools.graph.seeing import looking
from orchestra.ros.tools.graph.wire.speaking import domain_on_wire

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator

    from orchestra.ros.tools.graph.seeing import Graph


@contextmanager
def looking_closely(options: Namespace) -> Iterator[Graph]:
    """Look at the graph."""
    if domain_on_wire(os.environ) is not None:
        with looking(options) as graph:
            yield graph
        return
    from orchestra.ros.tools.graph.joining import joined  # noqa: PLC0415 - most of rclpy

    with joined(options) as graph:
        yield graph
