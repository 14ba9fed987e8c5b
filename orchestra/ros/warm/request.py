"""What the fork server is asked for."""

from __future__ import annotations

from typing import Any, NamedTuple


class Request(NamedTuple):
    """What is to be started, and its descriptors: to be told to go, its output, its errors, perhaps its input."""

    facts: dict[str, Any]
    descriptors: list[int]
