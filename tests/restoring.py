"""What a test changes in its own process is put back."""

from __future__ import annotations

import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

# Of pytest: what it is at.
_CURRENT = b"PYTEST_CURRENT_TEST"


@contextmanager
def environment_restored() -> Iterator[None]:
    """Put the environment back: plans that are made in this process may leave another one."""
    before = _environment()
    try:
        yield
    finally:
        if before != (now := _environment()):
            for name in now.keys() - before.keys():
                del os.environ[os.fsdecode(name)]
            for name, value in before.items():
                if now.get(name) != value:
                    os.environ[os.fsdecode(name)] = os.fsdecode(value)


def _environment() -> dict[bytes, bytes]:
    """Return the environment in a tenth of the time that decoding takes; who watches it (`witness`) need not know."""
    variables: Any = os.environ
    found = dict.copy(variables._data)
    found.pop(_CURRENT, None)
    return found
