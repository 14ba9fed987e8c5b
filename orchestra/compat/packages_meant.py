"""Packages that code looks for by a slip of their names: it goes on with the one that was meant."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from orchestra.compat.literals import argument_span
from orchestra.compat.place import Place, is_own
from orchestra.compat.refusing import collector
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.seam import connection
from orchestra.compat.syntax_trees import Tree, is_dealt_with
from orchestra.compat.wrong import WrongNumber
from orchestra.errors import Code, Problem
from orchestra.nearest import is_slip

if TYPE_CHECKING:
    from types import FrameType


def package_meant(package: str) -> str | None:
    """Report a slip, and return the package that was meant; None where there is none, or the code sees to it itself."""
    collecting, frame = collector(), _users_frame()
    severity, told, meant = connection().missing_package(package)
    if collecting is None or frame is None or meant is None or not is_slip(package, meant):
        return None
    if is_dealt_with(frame, Tree.tries):
        return None
    place = Place(frame.f_code, frame.f_lasti)
    span = argument_span(place, package)
    problems, chain = collecting
    found = Problem(Code.MISSING_PACKAGE, severity, told, span or place.span, chain, meant)
    problems.report(found)
    return meant


def no_name(package: str) -> ValueError:
    """Return what is raised for a text that is no name: that of a package and a path behind it may be meant."""
    message, frame = f"{package!r} cannot be the name of a package", _users_frame()
    if frame is None:
        return ValueError(message)
    first, _, behind = package.partition("/")
    names = (first, package.strip(), package.strip().replace(" ", "_"))
    meant = next((name for name in names if name and connection().package_share(name) is not None), None)
    message += ": what is behind it is joined to its folder" if meant == first and behind else ""
    span = argument_span(Place(frame.f_code, frame.f_lasti), package)
    instead = None if meant is None or span is None else Rewritten(meant)
    return WrongNumber(message, code=Code.BAD_NAME, at=span, suggestion=instead)


def _users_frame() -> FrameType | None:
    frame: FrameType | None = sys._getframe(1)
    while frame is not None and is_own(frame.f_code.co_filename):
        frame = frame.f_back
    return frame
