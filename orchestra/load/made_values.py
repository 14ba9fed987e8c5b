"""Keys that are not known where they stand: what they are with what stands beside them.

Parameters whose value another program gives, as in ROS 1, have $(command); a file of a package $(find-pkg-share). A key
that stands beside the list whose last item lacks it belongs into that item.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.source import Keyed, Listed, Written
from orchestra.fields import replace
from orchestra.load.elements import Tagged

if TYPE_CHECKING:
    from orchestra.location import Span

_PACKAGES: Final = ("pkg", "package")
_PAIRS: Final = {
    "remap": ("from", "to"),
    **dict.fromkeys(("arg", "env", "let", "param", "extra_arg"), ("name", "value")),
}
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


def packaged(key: str, mapping: Keyed) -> tuple[Span, str, Written] | None:
    """Return what `made_value` does for a package beside a file, and that file in it; None where that is not clear.

    The place ends with the file where that stands behind its package on the same line.
    """
    package, file = mapping.get(key), mapping.get("file")
    if key not in _PACKAGES or not isinstance(package, Written) or not isinstance(file, Written):
        return None
    if not package.text or package.null or not file.text or file.text[0] in "$/~":
        return None
    text, span = f"$(find-pkg-share {package.text})/{file.text}", file.span
    at, end, names = mapping.keys_at[key], file.span, list(mapping)
    if at.line == end.end_line and names[names.index(key) + 1 :][:1] == ["file"]:
        behind = 1 if isinstance(mapping, Tagged) else 0
        at = replace(at, end_line=end.end_line, end_column=end.end_column + behind)
    instead = f'file="{text}"' if isinstance(mapping, Tagged) else f"file: {text}"
    return at, instead, Written(text, span, lambda _first, _last: span)


def of_item_above(key: str, mapping: Keyed) -> str | None:
    """Return the list above a key whose last item lacks that key, which it is given then; None without such."""
    names = list(mapping)
    above = names[: names.index(key)][-1:]
    items = mapping[above[0]] if above else None
    pair = _PAIRS.get(above[0], ()) if above else ()
    if key not in pair or not isinstance(items, Listed) or not items or isinstance(mapping, Tagged):
        return None
    last = items[-1]
    if not isinstance(last, Keyed) or key in last or not last.keys() <= {*pair}:
        return None
    last.put(key, mapping[key], mapping.keys_at[key])
    return above[0]
