"""Interface declarations in YAML and JSON: the form that is captured, and NoDL 2, whose words it uses.

A mapping with lists of endpoints by kind (`publishers`, …), each with `name`, `type` and, for topics, `qos`. Policies
may be in small or capital letters; durations are in seconds, or in nanoseconds where the key ends in `_ns`, 0 for
endless. What NoDL 2 has beside that is for others.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

from orchestra.declared.interfaces.model import KINDS, Endpoint, EndpointKind, Interface, Qos
from orchestra.declared.interfaces.words import full_type, policy
from orchestra.errors import Code
from orchestra.nearest import is_slip, nearest

if TYPE_CHECKING:
    from orchestra.declared.documents import Document, Way
    from orchestra.errors import Problems

_OF_ENDPOINT: Final = ("name", "type", "qos", "description")
_OF_QOS: Final = (
    *("reliability", "durability", "liveliness", "history", "depth"),
    *("deadline", "lifespan", "lease_duration", "liveliness_lease_duration"),
    *("deadline_ns", "lifespan_ns", "liveliness_lease_duration_ns"),
)
_NANOSECONDS: Final = 1e9


def read_interface(document: Document, problems: Problems) -> Interface | None:
    """Return what a file declares, None where it is no declaration; what is wrong with it is reported."""
    if not isinstance(document.data, dict):
        told = "an interface declaration is a mapping with publishers, subscriptions, …"
        problems.error(Code.BROKEN_DECLARATION, told, document.at())
        return None
    file = _File(document, problems)
    file.slips(document.data, (*KINDS, "parameters", "description", "nodl_version", "base", "fragments"), ())
    endpoints = [
        endpoint
        for kind in KINDS
        for index, item in enumerate(file.items(document.data, kind))
        if (endpoint := file.endpoint(item, kind, (kind, index))) is not None
    ]
    return Interface(tuple(endpoints))


class _File:
    """A file that is being read."""

    def __init__(self, document: Document, problems: Problems) -> None:
        self._document = document
        self._problems = problems

    def items(self, data: dict[Any, Any], kind: EndpointKind) -> list[Any]:
        """Return the endpoints of a kind as they are written."""
        listed = data.get(kind) or []
        if isinstance(listed, list):
            return listed
        self.refuse(f"'{kind}' is a list", (kind,))
        return []

    def endpoint(self, item: Any, kind: EndpointKind, way: Way) -> Endpoint | None:  # noqa: ANN401 - whatever is there
        """Return one endpoint."""
        if not isinstance(item, dict):
            self.refuse("an endpoint is a mapping with `name` and `type`", way)
            return None
        meant = self.slips(item, _OF_ENDPOINT, way)
        name, word = item.get("name"), item.get("type")
        for key, value in (("name", name), ("type", word)):
            if key in meant:
                return None
            if not isinstance(value, str) or not value:
                self.refuse(f"an endpoint needs a `{key}`", way)
                return None
        kind_of_type = full_type(str(word), kind)
        if kind_of_type is None:
            self.refuse(f"'{word}' is no type of an interface, as std_msgs/msg/String", (*way, "type"))
            return None
        return Endpoint(kind, str(name), kind_of_type, self.qos(item.get("qos"), (*way, "qos")))

    def qos(self, item: Any, way: Way) -> Qos:  # noqa: ANN401 - as above
        """Return a quality of service; durations that are not given are endless."""
        if item is None:
            return Qos()
        if not isinstance(item, dict):
            self.refuse("`qos` is a mapping of policies", way)
            return Qos()
        self.slips(item, _OF_QOS, way)
        words = {
            key: self.policy(key, item.get(key), way) for key in ("reliability", "durability", "liveliness")
        }
        return Qos(
            **words,
            deadline=self.duration(item, ("deadline",), way),
            lease_duration=self.duration(item, ("lease_duration", "liveliness_lease_duration"), way),
        )

    def policy(self, key: str, word: Any, way: Way) -> str | None:  # noqa: ANN401 - as above
        """Return a policy, None where what it comes to is not known."""
        if word is None:
            return None
        try:
            return policy(key, str(word))
        except ValueError as error:
            (meant,) = error.args[1:]
            self.refuse(str(error.args[0]), (*way, key), meant=meant)
            return None

    def duration(self, item: dict[Any, Any], keys: tuple[str, ...], way: Way) -> float:
        """Return a duration in seconds."""
        for key in keys:
            for name, unit in ((key, 1.0), (f"{key}_ns", _NANOSECONDS)):
                value = item.get(name)
                if value is None:
                    continue
                if isinstance(value, bool) or not isinstance(value, int | float) or not value >= 0:
                    self.refuse(f"`{name}` is a duration, not {value!r}", (*way, name))
                    continue
                return value / unit or math.inf
        return math.inf

    def slips(self, data: dict[Any, Any], known: tuple[str, ...], way: Way) -> set[str]:
        """Report keys that are slips for known ones, and return these; others are for somebody else."""
        meant: set[str] = set()
        for key in data:
            near = nearest(str(key), known)
            if key not in known and near is not None and near not in data and is_slip(str(key), near):
                self.refuse(f"there is no key '{key}' here", (*way, key), meant=near, key=True)
                meant.add(near)
        return meant

    def refuse(self, told: str, way: Way, *, meant: str | None = None, key: bool = False) -> None:
        """Report what is wrong with the file."""
        at = self._document.at(way, key=key)
        self._problems.error(Code.BROKEN_DECLARATION, told, at, suggestion=meant)
