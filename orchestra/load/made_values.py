"""Parameters whose value another program gives, as ROS 1 writes them: how they are written with $(command)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.source import Written
from orchestra.fields import replace
from orchestra.load.elements import Tagged

if TYPE_CHECKING:
    from orchestra.description.source import Keyed
    from orchestra.location import Span

_COMMANDS: Final = {"command": "{}", "textfile": "cat {}"}


def made_value(key: str, mapping: Keyed) -> tuple[Span, str] | None:
    """Return the place of a key with what stands behind it, and how both are written; None where that is not clear."""
    content = mapping.get(key)
    if key not in _COMMANDS or not {"name"} <= mapping.keys() or not isinstance(content, Written):
        return None
    text, at, end = content.text.strip(), mapping.keys_at[key], content.span
    whole = text.startswith("$(command ")
    if not text or ("'" in text and not whole) or '"' in text or at.line != end.end_line:
        return None
    made = text if whole else f"$(command '{_COMMANDS[key].format(text)}')"
    if isinstance(mapping, Tagged):
        return replace(at, end_line=end.end_line, end_column=end.end_column + 1), f'value="{made}"'
    return replace(at, end_line=end.end_line, end_column=end.end_column), f"value: {made}"
