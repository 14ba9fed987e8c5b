"""Sizes, sets of cores and limits as people write them."""

from __future__ import annotations

import re
from typing import Final

from orchestra.description.source import shortened
from orchestra.nearest import nearest
from orchestra.patterns import pattern
from orchestra.resolve.amounts import UnfitError

UNLIMITED: Final = -1  # as RLIM_INFINITY of Python's resource
# Limits that are sizes in bytes; all others are plain numbers (getrlimit(2)).
SIZES: Final = frozenset({"as", "core", "data", "fsize", "memlock", "msgqueue", "rss", "stack"})

_LAST_CORE: Final = 8191  # Linux is built for 8192 at most
_MOST: Final = 2**63 - 1
_SIZE: Final = pattern(r"([0-9]{1,20})(?:\.([0-9]{1,20}))?\s*([KMGT]?)(?:i?B)?", re.IGNORECASE)
_SAID: Final = pattern(
    r"([0-9]+(?:\.[0-9]+)?)\s*([KMGT])i?(?:B|bytes?|ilo|ega|iga|era|egs?|igs?)\w*", re.IGNORECASE
)
_POWERS: Final = {"": 0, "K": 1, "M": 2, "G": 3, "T": 4}
_CORES: Final = pattern(r"\s*([0-9]{1,20})\s*(?:-\s*([0-9]{1,20})\s*)?")
_WORDS: Final = ("unlimited", "infinity", "infinite", "inf", "none", "max")


def size(text: str) -> int:
    """Return a number of bytes: `K`, `M`, `G` and `T` are powers of 1024. Raises `UnfitError`."""
    found = _SIZE.fullmatch(text.strip())
    if found is not None:
        decimals = found[2] or ""
        scaled = int(found[1] + decimals) << 10 * _POWERS[found[3].upper()]
        parts: int = 10 ** len(decimals)
        number, rest = divmod(scaled, parts)
        if not rest and number <= _MOST:
            return number
    said = _SAID.fullmatch(text.strip())
    meant = f"{said[1]}{said[2].upper()}" if said is not None else None
    raise UnfitError(f"expected a size as 512M or 2G, or a number of bytes, found '{shortened(text)}'", meant)


def cap(text: str) -> int:
    """Return a size that is not zero. Raises `UnfitError`."""
    found = size(text)
    if not found:
        raise UnfitError("a process needs memory: the cap cannot be 0")
    return found


def lock(text: str) -> int:
    """Return a size, or `UNLIMITED`. Raises `UnfitError`."""
    return _single(text, is_size=True)


def rlimit(text: str, *, is_size: bool) -> tuple[int, int]:
    """Return soft and hard limit of `SOFT:HARD`, or twice the one that is given. Raises `UnfitError`."""
    soft_text, colon, hard_text = text.partition(":")
    soft = _single(soft_text, is_size=is_size)
    hard = _single(hard_text, is_size=is_size) if colon else soft
    if hard != UNLIMITED and (soft == UNLIMITED or soft > hard):
        raise UnfitError(
            f"the soft limit {soft_text.strip()} is above the hard one {hard_text.strip()}",
            f"{hard_text.strip()}:{soft_text.strip()}",
        )
    return soft, hard


def cores(text: str) -> tuple[int, ...]:
    """Return the cores of numbers and ranges with commas between them. Raises `UnfitError`."""
    found: list[int] = []
    inside = text.strip()
    if inside[:1] == "[" and inside[-1:] == "]":
        inside = inside[1:-1]
    for part in inside.split(","):
        found += _range(part, text)
    return tuple(found)


def distinct(found: tuple[int, ...]) -> tuple[int, ...]:
    """Return cores in order. Raises `UnfitError` where one stands twice, and where there is none."""
    if not found:
        raise UnfitError("a process needs a core to run on: the list is empty")
    twice = next((core for core in found if found.count(core) > 1), None)
    if twice is not None:
        raise UnfitError(f"core {twice} stands twice")
    return tuple(sorted(found))


def _range(part: str, text: str) -> range:
    found = _CORES.fullmatch(part)
    if found is None:
        raise UnfitError(f"expected numbers of cores as 0-3,6, found '{shortened(text)}'")
    first, last = int(found[1]), int(found[2] or found[1])
    if last > _LAST_CORE or first > _LAST_CORE:
        raise UnfitError(f"there is no core {max(first, last)}: Linux counts from 0 to {_LAST_CORE} at most")
    if last < first:
        raise UnfitError(f"the range {part.strip()} is empty", f"{last}-{first}")
    return range(first, last + 1)


def _single(text: str, *, is_size: bool) -> int:
    text = text.strip()
    if text.lower() == _WORDS[0]:
        return UNLIMITED
    if text == str(UNLIMITED) or nearest(text, _WORDS) is not None or text.lower() in _WORDS:
        raise UnfitError(f"expected a number or unlimited, found '{shortened(text)}'", _WORDS[0])
    if is_size:
        return size(text)
    if not re.fullmatch("[0-9]{1,20}", text) or int(text) > _MOST:
        raise UnfitError(f"expected a whole number or unlimited, found '{shortened(text)}'")
    return int(text)
