"""Versions of extension points, as extensions of nodes ask for them."""

from __future__ import annotations

import re


class PluginException(Exception):
    """An extension and its extension point do not fit together."""


def satisfies_version(version: str, caret_range: str) -> None:
    """Check that a version is in a range like `^0.1`. Raises `PluginException` where it is not."""
    least = _numbers(caret_range.removeprefix("^"))
    if _numbers(version) < least:
        raise PluginException(
            f"Extension point is too old ({version}), the extension requires {caret_range!r}"
        )
    if _numbers(version) >= get_upper_bound_caret_version(least):
        raise PluginException(
            f"Extension point is newer ({version}), than what the extension supports {caret_range!r}"
        )


def get_upper_bound_caret_version(version: tuple[int, ...]) -> tuple[int, ...]:
    """Return the first version that is not compatible any more."""
    major, minor = (*version, 0, 0)[:2]
    return (major + 1, 0) if major else (0, minor + 1)


def _numbers(version: str) -> tuple[int, ...]:
    return tuple(int(digits) for digits in re.findall(r"\d+", version))
