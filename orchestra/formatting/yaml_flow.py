"""Lists and mappings in brackets: on one line where they fit, as a table where somebody has laid one out."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from orchestra.formatting.lines import indentation, shifted
from orchestra.formatting.yaml_nodes import Mapping, Node, Scalar, Sequence
from orchestra.formatting.yaml_scalars import STEP

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.formatting.yaml_nodes import File

# Numbers and booleans, which read well in rows.
_SHORT = re.compile(r"[-+.0-9][-+.0-9a-fA-FxXeE]*|[Tt]rue|[Ff]alse|[-+]?\.(?:nan|inf)", re.IGNORECASE)


def one_line(node: Node, text: str) -> str | None:
    """Return the node on one line, None where a scalar in it takes several."""
    if isinstance(node, Scalar):
        written = text[node.start : node.end]
        return None if "\n" in written else written
    inner = _items(node, text) if isinstance(node, Sequence) else _pairs(node, text)
    if inner is None:
        return None
    if isinstance(node, Mapping) and not node.braces:
        return inner
    brackets = "[]" if isinstance(node, Sequence) else "{}"
    return f"{_before(node.properties)}{brackets[0]}{inner}{brackets[1]}"


def _items(node: Sequence, text: str) -> str | None:
    items = [one_line(item, text) for item in node.items]
    return None if None in items else ", ".join(item for item in items if item is not None)


def _pairs(node: Mapping, text: str) -> str | None:
    pairs = [one_pair(key, value, text) for key, value in node.pairs]
    return None if None in pairs else ", ".join(pair for pair in pairs if pair is not None)


def one_pair(key: Scalar, value: Node, text: str) -> str | None:
    """Return a pair of a mapping in braces; a key alone stays alone."""
    if isinstance(value, Scalar) and value.empty:
        colon = ":" in text[key.end : value.start]
        return f"{key_text(key, text)}: " if colon else text[key.start : key.end]
    written = one_line(value, text)
    return None if written is None else f"{key_text(key, text)}: {written}"


def key_text(key: Scalar, text: str) -> str:
    """Return a key; between an alias and the colon stands a blank, for the colon could be part of its name."""
    written = text[key.start : key.end]
    return f"{written} " if written.startswith(("*", "&", "!")) and key.style is None else written


def is_table(node: Node, file: File) -> bool:
    """Tell whether somebody has laid out a list in rows: it has several lines, and scalars alone or comments in it.

    What cannot stand on one line otherwise is left as it is laid out, too.
    """
    if isinstance(node, Scalar) or "\n" not in file.text[node.start : node.end]:
        return False
    if file.comment_in(node.start, node.end) is not None:
        return True
    return one_line(node, file.text) is None or (isinstance(node, Sequence) and _is_plain(node))


def _is_plain(node: Sequence) -> bool:
    return bool(node.items) and all(
        _is_plain(item) if isinstance(item, Sequence) else isinstance(item, Scalar) for item in node.items
    )


def table(node: Node, text: str, indent: int, column: int) -> list[str]:
    """Return the rows of a table that belongs to what is indented so far and whose bracket comes to stand in a column.

    The first row is without indentation. Where items stand behind the bracket the rows stay below them, else they are
    indented by one step, and a bracket alone on the last row by none.
    """
    first, *rest = text[node.start : node.end].split("\n")
    opening = first.partition("#")[0].rstrip()
    closing = rest[-1].lstrip()[0] in "]}"
    if opening.endswith(("[", "{")):
        body = [row for row in (rest[:-1] if closing else rest) if row.strip()]
        rows = list(shifted(rest, indent + STEP - min(map(indentation, body), default=0), indent + 1))
        if closing:
            rows[-1] = " " * indent + rest[-1].lstrip()
    else:
        rows = list(shifted(rest, column - _column(text, node.start), indent + 1))
    return [row if row.rstrip().endswith("\\") else row.rstrip() for row in (first, *rows)]


def _column(text: str, offset: int) -> int:
    return len(text[text.rfind("\n", 0, offset) + 1 : offset].expandtabs())


def filled(node: Node, text: str, column: int, width: int) -> list[str] | None:
    """Return a long list of numbers in rows below its bracket, None for any other node."""
    if not isinstance(node, Sequence) or not node.items or node.properties:
        return None
    words = [text[item.start : item.end] for item in node.items if isinstance(item, Scalar)]
    if len(words) < len(node.items) or not all(_SHORT.fullmatch(word) for word in words):
        return None
    return list(_rows([f"{word}," for word in words[:-1]] + [f"{words[-1]}]"], column + 1, width))


def _rows(words: list[str], column: int, width: int) -> Iterator[str]:
    row = "["
    margin = " " * column
    length = column
    for word in words:
        if length > column and length + 1 + len(word) > width:
            yield row
            row, length = margin, column
        blank = " " if length > column else ""
        row += blank + word
        length += len(blank) + len(word)
    yield row


def _before(properties: str) -> str:
    return f"{properties} " if properties else ""
