"""What code of a launch file has asked for and is not here, kept in its module for when it fails for want of it."""

from __future__ import annotations

import sys
from types import FunctionType, ModuleType
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from orchestra.compat.place import Place, is_own
from orchestra.witness.origins import INSTALLED, PYTHON

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

_KEPT: Final = "__asked_in_vain__"  # the name in a module
_NOT_USERS: Final = ("<", *PYTHON, *INSTALLED)


class Asked(NamedTuple):
    """What was not found, as the exception that tells it, and where it was asked for."""

    error: Exception
    place: Place


def keep_module(name: str) -> None:
    """Keep that there is no such module, where code of users imports it or looks for it."""
    frame: FrameType | None = sys._getframe(2)
    while frame is not None and "importlib" in str(frame.f_globals.get("__name__")):
        frame = frame.f_back
    if frame is not None and not is_own(frame.f_code.co_filename):
        _keep(ModuleNotFoundError(f"No module named {name!r}", name=name), frame)


def keep_package(error: KeyError) -> None:
    """Keep that there is no such package, where code of users has asked for it."""
    frame: FrameType | None = sys._getframe(1)
    while frame is not None and is_own(frame.f_code.co_filename):
        frame = frame.f_back
    if frame is not None:
        _keep(error, frame)


def kept(known: dict[str, Any]) -> Iterator[Asked]:
    """Yield what a module with these names has asked for, and those have of which it has functions or all names."""
    yield from known.get(_KEPT, ())
    for value in list(known.values()):
        others = value.__globals__ if isinstance(value, FunctionType) else {}
        others = vars(value) if isinstance(value, ModuleType) else others
        if others is not known:
            yield from others.get(_KEPT, ())


def _keep(error: Exception, frame: FrameType) -> None:
    if not frame.f_code.co_filename.startswith(_NOT_USERS):
        asked = Asked(error, Place(frame.f_code, frame.f_lasti))
        frame.f_globals.setdefault(_KEPT, []).append(asked)
