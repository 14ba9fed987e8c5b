"""The arbiter's parameters: inputs and locks by name, as twist_mux has them (`topics.NAME.*`, `locks.NAME.*`)."""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

NAME = re.compile(r"[A-Za-z]\w*")
MOST_PRIORITY = 255
# A time-out longer than a day is a mistake in the unit.
LONGEST = 86400.0


@dataclass(frozen=True, slots=True)
class Source:
    """A topic that counts for `timeout` s after each message; of several the one with the greatest priority holds.

    As an input its time-out is more than 0. As a lock of time-out 0 it holds what it last said for ever, with a
    longer one it locks as well when it has fallen silent.
    """

    name: str
    topic: str
    priority: int
    timeout: float


@dataclass(frozen=True, slots=True)
class Settings:
    """All inputs and all locks."""

    inputs: tuple[Source, ...]
    locks: tuple[Source, ...]


@dataclass(frozen=True, slots=True)
class Entry:
    """One parameter of a source: its type, its range, its meaning, and whether it can be changed while it runs."""

    name: str
    kind: type[Any]
    minimum: float | None
    maximum: float | None
    description: str
    read_only: bool


ENTRIES = (
    Entry("topic", str, None, None, "Topic of {what}", read_only=True),
    Entry("priority", int, 0, MOST_PRIORITY, "Priority of {what}: the greatest one holds", read_only=False),
    Entry("timeout", float, 0.0, LONGEST, "Seconds of ROS time for which {what} counts", read_only=False),
)
GROUPS = {"topics": "the input {name}", "locks": "the lock {name}"}


class SettingsError(ValueError):
    """Parameters that cannot be meant; the message says why."""


def unknown(names: list[str]) -> dict[str, str]:
    """The parameters among these that no source has, each with the nearest that one could have, or nothing."""
    known = {each.name for each in ENTRIES}
    found = {}
    for name in names:
        group, _, rest = name.partition(".")
        source, _, entry = rest.partition(".")
        if group in GROUPS and entry in known and NAME.fullmatch(source):
            continue
        near = difflib.get_close_matches(group, GROUPS, n=1), difflib.get_close_matches(entry, known, n=1)
        found[name] = f"{near[0][0]}.{source}.{near[1][0]}" if near[0] and near[1] and source else ""
    return found


def settings(values: Mapping[str, Any]) -> Settings:
    """What the parameters say together, by their full names.

    Raises SettingsError: a source without topic or with an unusable value, two of one topic or one priority, no input.
    """
    inputs, locks = (_sources(group, values) for group in GROUPS)
    if not inputs:
        raise SettingsError("no input: give topics.NAME.topic, topics.NAME.priority and topics.NAME.timeout")
    for source in inputs:
        if source.timeout <= 0.0:
            raise SettingsError(f"topics.{source.name}.timeout is {source.timeout:g}, must be more than 0")
    for what in ("topic", "priority"):
        _require_different(inputs, what)
    _require_different(locks, "topic")
    return Settings(inputs, locks)


def names(group: str, values: Mapping[str, Any]) -> list[str]:
    """The sources of a group, in order of their names."""
    return sorted(
        {name.split(".")[1] for name in values if name.startswith(f"{group}.") and name.count(".") > 1}
    )


def _sources(group: str, values: Mapping[str, Any]) -> tuple[Source, ...]:
    return tuple(_source(group, name, values) for name in names(group, values))


def _source(group: str, name: str, values: Mapping[str, Any]) -> Source:
    given: list[Any] = [values.get(f"{group}.{name}.{entry.name}") for entry in ENTRIES]
    for entry, value in zip(ENTRIES, given, strict=True):
        _check(f"{group}.{name}.{entry.name}", entry, value)
    return Source(name, *given)


def _check(name: str, entry: Entry, value: Any) -> None:  # noqa: ANN401 - a parameter's value
    if value is None or value == "":
        raise SettingsError(f"{name} is missing")
    if entry.kind is not type(value):  # a bool is an int as well
        raise SettingsError(f"{name} is {value!r}, must be of type {entry.kind.__name__}")
    if entry.minimum is None or entry.maximum is None:
        return
    if not entry.minimum <= value <= entry.maximum:
        raise SettingsError(f"{name} is {value}, must lie in {entry.minimum} .. {entry.maximum}")


def _require_different(sources: tuple[Source, ...], what: str) -> None:
    seen: dict[Any, str] = {}
    for source in sources:
        value = getattr(source, what)
        if value in seen:
            raise SettingsError(f"{seen[value]} and {source.name} have the same {what}: {value}")
        seen[value] = source.name
