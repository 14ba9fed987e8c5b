"""A node that was copied and whose name was left as it was: the rest of it says in which word the two differ."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.patterns import pattern
from orchestra.resolve.model import InlineParameter

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.resolve.model import ResolvedComponent, ResolvedProcess

_WORD: Final = pattern(r"[A-Za-z]+|[0-9]+|[^A-Za-z0-9]+")


def name_meant(
    one: ResolvedProcess | ResolvedComponent, copy: ResolvedProcess | ResolvedComponent
) -> str | None:
    """Return the name with the one word replaced that parameters and remaps of the copy have another word for.

    `right_camera` for a second `left_camera` whose frame is `right_optical` where that of the first is `left_optical`.
    """
    if copy.name is None or not copy.name.verbatim:
        return None
    changes: dict[str, set[str]] = {}
    for first, second in _values(one, copy):
        words, others = _WORD.findall(first), _WORD.findall(second)
        changed = [pair for pair in zip(words, others, strict=False) if pair[0] != pair[1]]
        if len(words) == len(others) and len(changed) == 1:
            changes.setdefault(changed[0][0], set()).add(changed[0][1])
    parts = _WORD.findall(copy.name.text)
    known = [index for index, word in enumerate(parts) if len(changes.get(word, ())) == 1]
    if len(known) != 1:
        return None
    (instead,) = changes[parts[known[0]]]
    return "".join([*parts[: known[0]], instead, *parts[known[0] + 1 :]])


def _values(
    one: ResolvedProcess | ResolvedComponent, copy: ResolvedProcess | ResolvedComponent
) -> Iterator[tuple[str, str]]:
    """Yield the texts that both have under the same name: of parameters, and of topics where remaps lead."""
    for first, second in ((_parameters(one), _parameters(copy)), (_remaps(one), _remaps(copy))):
        for name in first.keys() & second.keys():
            yield first[name], second[name]


def _parameters(node: ResolvedProcess | ResolvedComponent) -> dict[str, str]:
    return {
        item.name: item.value
        for item in node.parameters
        if isinstance(item, InlineParameter) and isinstance(item.value, str) and not item.everywhere
    }


def _remaps(node: ResolvedProcess | ResolvedComponent) -> dict[str, str]:
    return {item.source.text: item.target.text for item in node.remaps}
