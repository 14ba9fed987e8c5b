"""The environment of this process while code of a launch file runs in it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Mapping


# The table as it was when it was last read, and what was read: seldom is it another one the next time.
_LAST: list[dict[Any, Any]] = []


def put_environment(environment: Mapping[str, str]) -> None:
    """Make the environment of this process that of a scope."""
    now = environment_now()
    with observer().aside():
        # Not `==`, which an environment that tells who reads it answers slowly.
        if dict.__eq__(now, environment) is True:
            return
        for name in now.keys() - environment.keys():
            del os.environ[name]
        for name, value in environment.items():
            if now.get(name) != value:
                os.environ[name] = value


def environment_now() -> dict[str, str]:
    """Return the environment of this process, which nobody counts as reading it."""
    data = getattr(os.environ, "_data", None)
    if isinstance(data, dict):  # the table itself: to go through `os.environ` takes ten times as long
        if not _LAST or not dict.__eq__(data, _LAST[0]):
            decoded = {os.fsdecode(name): os.fsdecode(value) for name, value in dict.items(data)}
            _LAST[:] = [dict(dict.items(data)), decoded]
        return dict(_LAST[1])
    with observer().aside():
        return dict(os.environ)
