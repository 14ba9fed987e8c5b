"""A text that is a list of quoted texts without its brackets."""

from __future__ import annotations

import ast


def quoted(text: str) -> list[str] | None:
    """Return the items of a text such as `"'a', 'b'"`, if it is one."""
    try:
        items = ast.literal_eval(f"[{text}]")
    except (SyntaxError, ValueError, MemoryError, RecursionError):
        return None
    return items if items and all(isinstance(item, str) for item in items) else None
