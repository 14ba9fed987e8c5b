"""The definition of a message with those of all types that it uses, as an MCAP has them.

Source: mcap.dev/spec/registry, ros2msg.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.cli.interfaces.expanded import type_in, without_comment
from orchestra.errors import RunError

if TYPE_CHECKING:
    from collections.abc import Callable

ENCODING: Final = "ros2msg"
_LINE: Final = "=" * 80
_PARTS: Final = ("Request", "Response")
_SEPARATOR: Final = re.compile(r"^---.*\n?", re.MULTILINE)
# REP 2012: what a client or a server that has introspection on says of itself.
_EVENT: Final = """\
service_msgs/ServiceEventInfo info
{request}[<=1] request
{response}[<=1] response
"""


def definition(name: str, text_of: Callable[[str], str]) -> str:
    """Return the text for a type by its full name; nothing where a definition is not installed, or is in IDL."""
    try:
        texts = _texts(name, text_of)
    except RunError:
        return ""
    if any(line.startswith("module ") for text in texts.values() for line in text.splitlines()):
        return ""
    own, *others = texts.items()
    return own[1] + "".join(f"\n{_LINE}\nMSG: {_short(other)}\n{text}" for other, text in others)


def _texts(name: str, text_of: Callable[[str], str]) -> dict[str, str]:
    """Return the texts of a type and of all that it uses, each once, the outer ones first."""
    found: dict[str, str] = {}
    waiting = [name]
    while waiting:
        here = waiting.pop(0)
        if here in found:
            continue
        found[here] = _text(here, text_of)
        package = here.partition("/")[0]
        used = (type_in(without_comment(line), package) for line in found[here].splitlines())
        waiting += [nested for nested in used if nested is not None]
    return found


def _text(name: str, text_of: Callable[[str], str]) -> str:
    """Return the definition of a message; also of the event of a service, and of what is asked and answered in it."""
    package, kind, local = name.split("/")
    service, _, part = local.rpartition("_")
    if kind == "srv" and part == "Event":
        return _EVENT.format(request=f"{package}/{service}_Request", response=f"{package}/{service}_Response")
    try:
        return text_of(name)
    except RunError:
        if part not in _PARTS:
            raise
        return _SEPARATOR.split(text_of(f"{package}/srv/{service}"), maxsplit=1)[_PARTS.index(part)]


def _short(name: str) -> str:
    package, _, local = name.split("/")
    return f"{package}/{local}"
