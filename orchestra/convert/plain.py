"""Which texts may stand in YAML without quotes."""

from __future__ import annotations

import io
from functools import lru_cache
from typing import TYPE_CHECKING

import yaml

if TYPE_CHECKING:
    from collections.abc import Callable

_resolve: Callable[..., str] = yaml.resolver.Resolver().resolve
_NULL = frozenset({"", "~", "null", "Null", "NULL"})


@lru_cache(maxsize=4096)
def is_plain(text: str, *, flow: bool = False) -> bool:
    """Return whether a text is read as itself without quotes, in a list in brackets (`flow`) or elsewhere."""
    if text in _NULL or text.startswith("<<"):
        return False
    found = _emitter().analyze_scalar(text)
    return bool(found.allow_flow_plain if flow else found.allow_block_plain) and not found.multiline


@lru_cache(maxsize=4096)
def looks_like_text(text: str) -> bool:
    """Return whether YAML 1.1, by which ROS 2 reads launch files, takes a text without quotes for a text."""
    return _resolve(yaml.ScalarNode, text, (True, False)) == "tag:yaml.org,2002:str"


def _emitter() -> yaml.emitter.Emitter:
    made = yaml.emitter.Emitter(io.StringIO())
    made.allow_unicode = True
    return made
