"""The environment of this process while code of a launch file runs in it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Mapping


def put_environment(environment: Mapping[str, str]) -> None:
    """Make the environment of this process that of a scope."""
    with observer().aside():
        if os.environ == environment:
            return
        for name in os.environ.keys() - environment.keys():
            del os.environ[name]
        for name, value in environment.items():
            if os.environ.get(name) != value:
                os.environ[name] = value
