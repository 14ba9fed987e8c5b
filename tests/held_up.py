"""Ends a process of tests in which code of another language never comes back.

The time limit of a test is a signal, and its handler is Python: where an extension keeps the interpreter to itself, as a
participant of Fast DDS that is given back can (eProsima/Fast-DDS#6513), neither that nor a thread gets a turn. The
thread of `faulthandler` needs none. pytest-xdist tells which test it was, and goes on in another process.
"""

from __future__ import annotations

import faulthandler
import os
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Generator

# Seconds beyond the time limit of a test, in which its own end comes about where it can.
_LATER = float(os.environ.get("ORCHESTRA_TEST_HELD_UP", "60"))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
    marker = item.get_closest_marker("timeout")
    said = [] if marker is None else [*marker.args, *marker.kwargs.values()]
    limit = said[0] if said else item.config.getini("timeout")
    faulthandler.dump_traceback_later(float(limit or 0) + _LATER, exit=True, file=2)
    try:
        return (yield)
    finally:
        faulthandler.cancel_dump_traceback_later()
