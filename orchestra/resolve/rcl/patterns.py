"""The node patterns of parameter files: `/ns/n`, `/**`, `/**/n`, `/*/n`.

Source: `rcl_yaml_param_parser` (`_validate_name`) for what is allowed, rclpy and rclcpp for what matches; measured in
`tests/data/rcl-probes.jsonl`.
"""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING

from orchestra.patterns import pattern as pattern_of
from orchestra.resolve.names import Fault, mended, rmw_namespace_fault, rmw_node_name_fault

if TYPE_CHECKING:
    from collections.abc import Sequence

_WILDCARDS = frozenset({"*", "**"})
# As ReplaceString of nav2_common, Jinja and envsubst have it.
_REPLACED = pattern_of(r"\$\(|<[^<>/]+>|\{\{.+?\}\}|\$\{[^{}]+\}")


def matches(pattern: str, full_name: str) -> bool:
    """Return whether a pattern, with or without its first slash, matches a full node name."""
    if (
        "*" not in pattern
    ):  # as most are: an expression would take longer to compile than all else about a node
        return full_name == (pattern if pattern.startswith("/") else f"/{pattern}")
    return _expression(pattern).fullmatch(full_name) is not None


def pattern_fault(pattern: str, *, template: bool = False) -> Fault | None:
    """Return why rcl refuses a pattern, None where it takes it. Only whole parts can be wildcards.

    Of a `template` nothing is known where `$(...)` stands in it, or a word that is replaced: `<robot_namespace>`.
    """
    if template and _REPLACED.search(pattern):
        return None
    parts = pattern.split("/")
    offset = 0
    for index, part in enumerate(parts[:-1]):
        if not part and index:
            return Fault("it must not contain '//'", offset)
        if part and part not in _WILDCARDS and (fault := rmw_namespace_fault(f"/{part}")):
            return Fault(fault.reason, max(0, offset + fault.offset - 1))
        offset += len(part) + 1
    name = parts[-1]
    if name in _WILDCARDS:
        return None
    fault = rmw_node_name_fault(name)
    return fault and Fault(fault.reason, offset + fault.offset)


def instead(keys: Sequence[str]) -> str | None:
    """Return what to write for the last key of a section that is no pattern, None where that is not in it alone.

    A wildcard cannot be a part of a name: it stands for all nodes.
    """
    only, key = not any(keys[:-1]), keys[-1]
    if "*" in key:
        return _with_whole_wildcards(key) if only else None
    if not only and key.startswith("/"):
        bare = key.strip("/")
        return bare if pattern_fault(bare) is None else None
    return mended(key, pattern_fault)


def _with_whole_wildcards(key: str) -> str | None:
    """Return a pattern with a wildcard for each part that has one in it; for all nodes where no namespace is left.

    None where more than that is wrong.
    """
    parts = [("**" if "**" in part else "*") if "*" in part else part for part in key.split("/")]
    if not parts[-1] or (parts[-1] in _WILDCARDS and _WILDCARDS.issuperset(filter(None, parts))):
        return "/**"
    instead = "/".join(parts)
    return None if pattern_fault(instead) is not None else instead


@cache
def _expression(pattern: str) -> re.Pattern[str]:
    """Return the pattern as a regular expression: `/*` is one part of a name, `/**` any number of them."""
    absolute = pattern if pattern.startswith("/") else f"/{pattern}"
    parts = {"*": r"/\w+", "**": r"(?:/\w+)*"}
    return re.compile(
        "".join(parts.get(part, "/" + re.escape(part)) for part in absolute[1:].split("/")), re.ASCII
    )
