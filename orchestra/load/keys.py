"""The keys of a mapping as its entity knows them: `-` and `_` are alike, other spellings are reported.

What is clearly a slip of the keys is read as what was meant, so that a value behind it is checked too and nothing that
depends on it is reported missing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from orchestra.description.actions import ACTIONS
from orchestra.errors import Code
from orchestra.load.elements import emptied, noun
from orchestra.load.pairs import written_item
from orchestra.load.words import ELSEWHERE
from orchestra.nearest import is_slip, nearest

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.description.source import Keyed
    from orchestra.location import Span

# Words of the Python launch files and of ROS 1, and how they are spelled here.
_ELSEWHERE = {
    "additional_env": "env",
    "arguments": "args",
    "command": "cmd",
    "default_value": "default",
    "doc": "description",
    "environment": "env",
    "executable": "exec",
    "launch_arguments": "arg",
    "node_name": "name",
    "node_namespace": "namespace",
    "ns": "namespace",
    "package": "pkg",
    "parameters": "param",
    "prefix": "launch_prefix",
    "remappings": "remap",
    "ros_arguments": "ros_args",
    "type": "exec",
}


class Report(Protocol):
    """Takes an error in the file that is being read."""

    def __call__(
        self,
        code: Code,
        message: str,
        span: Span,
        *,
        suggestion: str | None = ...,
        notes: Iterable[str] = ...,
    ) -> None:
        """Report it."""


def spelled(key: str) -> str:
    """Return how a word of the launch language is spelled in the models."""
    return key.replace("-", "_")


def meant(word: str, known: Iterable[str], elsewhere: Mapping[str, str]) -> tuple[str | None, bool]:
    """Return the known word that another one probably means, and whether it is only a slip."""
    known = frozenset(known)
    if (other := elsewhere.get(spelled(word))) in known:
        return other, False
    near = nearest(word, known)
    return near, near is not None and is_slip(word, near)


def key_meant(word: str, known: Iterable[str]) -> tuple[str | None, bool]:
    """Return the known key that another word probably means, and whether it is only a slip."""
    return meant(word, known, _ELSEWHERE)


def action_meant(word: str) -> tuple[str | None, bool]:
    """Return the action that an unknown one probably means, and whether it is only a slip."""
    return meant(word, ACTIONS, ELSEWHERE)


def known_keys(known: frozenset[str], mapping: Keyed, report: Report) -> Keyed:
    """Return the mapping with no keys but known ones; every other key is reported, and so is one that stands twice."""
    if mapping.keys() <= known:
        return mapping
    read = emptied(mapping)
    read.lossy, read.meant = mapping.lossy, set(mapping.meant)
    free = known - {spelled(key) for key in mapping}
    pair = written_item(known, mapping)
    for key, value in mapping.items():
        at, name = mapping.keys_at[key], spelled(key)
        if name not in known:
            near, slip = key_meant(key, free)
            notes = (f"it is written {pair[1]}",) if pair is not None and near is None else ()
            report(Code.UNKNOWN_KEY, f"unknown {noun(mapping, key)}", at, suggestion=near, notes=notes)
            if near is None or not slip:
                read.lossy = True
                read.meant |= {near} if near is not None else set(pair[0]) if pair is not None else set()
                continue
            name, free = near, free - {near}
        if name in read:
            first = f"first at {read.keys_at[name]}"
            report(Code.DUPLICATE_KEY, f"the {noun(mapping, key)} stands twice", at, notes=(first,))
        else:
            read.put(name, value, at)
    return read
