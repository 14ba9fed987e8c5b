"""Texts of the front ends that come to the same whatever is set."""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.cli.glance.model import Places

_CALL = re.compile(r"\$\(\s*(?P<name>dirname|find-pkg-share|find-pkg-prefix)(\s+(?P<package>[\w.-]+))?\s*\)")


def constant_text(written: str, places: Places) -> str | None:
    """Return what a text comes to where only the place of the file and of packages count, else None."""
    parts, end = [], 0
    for call in _CALL.finditer(written):
        value = _value(call["name"], call["package"], places)
        if value is None:
            return None
        parts += [written[end : call.start()], value]
        end = call.end()
    text = "".join([*parts, written[end:]])
    return None if "$(" in text else text


def _value(name: str, package: str | None, places: Places) -> str | None:
    if name == "dirname":
        return os.path.dirname(places.path)  # noqa: PTH120 - a text is wanted, and pathlib would change it
    if package is None:
        return None
    return places.share(package) if name == "find-pkg-share" else places.prefix(package)
