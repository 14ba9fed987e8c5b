"""Mappings and texts where a list that has a mapping for each name is wanted: how that is written."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.description.source import Keyed, Listed, Written, shortened
from orchestra.load.elements import Tagged
from orchestra.location import Span
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Sequence
    from collections.abc import Set as AbstractSet

NESTED: Final = "a parameter cannot be a list of lists"
_LONGEST: Final = 100
# The keys of a pair, and the lists that are made of such pairs.
_NAMED: Final = ("name", "value")
_RULE: Final = ("from", "to")
_DECLARED: Final = ("name", "default")
_PROGRAM: Final = ("pkg", "exec")
_CHOICE: Final = ("value",)
_LISTS: Final[dict[str, tuple[str, ...]]] = {
    **dict.fromkeys(("arg", "env", "env_only", "extra_arg", "keep", "let", "param"), _NAMED),
    "remap": _RULE,
    "choice": _CHOICE,
}
# Other keys that one item of a list may have.
_ALONE: Final = {
    "param": (("from",), ("from", "allow_substs"), ("name", "param"), ("name", "value", "type")),
    "arg": (("name", "default"),),
}
# What joins a name and a value: on a command line, in a shell, in words.
_JOINTS: Final = {
    _NAMED: pattern(r"([^\s:=]+)\s*:?=\s*(\S.*)"),
    _RULE: pattern(r"(\S+?)\s*(?::=|=|->|:)\s*(\S+)"),
}
_PATH: Final = pattern(r"(?:\$\([^()]*\)|[\w./~-])+\.ya?ml")
_SPECIAL: Final = pattern(r"[,{}\[\]#]|: |:$|^[ &*!|>%@`'\"?-]|^$| $")
_OF_TEXTS: Final = ("choices", "success_exit_codes")
_COMMA: Final = pattern(r"\s*,\s*")
_ITEM: Final = pattern(r"[\w./-]+")


def written_list(key: str, content: Any) -> str | None:  # noqa: ANN401 - a tree
    """Return how what stands behind a key is written as a list; None where it is no mapping to make one of."""
    if key not in _LISTS or not isinstance(content, Keyed) or not content:
        return None
    pair = _LISTS[key]
    names = next((names for names in (pair, *_ALONE.get(key, ())) if content.keys() == set(names)), None)
    if names is not None:  # one item, without its dash
        return shortened(
            f"{key}: [{{{', '.join(f'{name}: {_value(content[name])}' for name in names)}}}]", _LONGEST
        )
    return None if pair == _CHOICE else shortened(f"{key}: [{_items(content, pair)}]", _LONGEST)


def written_so(key: str, content: Any) -> str | None:  # noqa: ANN401 - a tree
    """Return the list that stands for a mapping or for a text behind a key; None where that is not clear."""
    if key not in _LISTS:
        return None
    if isinstance(content, Written):
        item = None if content.null else written_pair(key, content)
        return f"[{item}]" if item is not None else None
    written = written_list(key, content)
    return None if written is None or "..." in written or "…" in written else written.removeprefix(f"{key}: ")


def written_pair(key: str, text: Written) -> str | None:
    """Return the item of a list that a text was meant to be, as `a:=b` is a name and its value, else None."""
    pair = _LISTS.get(key)
    if key == "param" and _PATH.fullmatch(text.text):
        return f"{{from: {_plain(text.text)}}}"
    if pair == _CHOICE:
        return ", ".join(f"{{value: {_plain(value)}}}" for value in _COMMA.split(text.text.strip()))
    return None if pair is None else _parted(text.text, pair)


def written_two(key: str, items: Any) -> str | None:  # noqa: ANN401 - a tree
    """Return the item of a list that a list of two texts was meant to be: what it is called, and what it is."""
    pair = _LISTS.get(key, ())
    if (
        type(items) is not Listed
        or len(items) != len(pair)
        or not all(isinstance(item, Written) for item in items)
    ):
        return None
    return f"{{{', '.join(f'{name}: {_value(item)}' for name, item in zip(pair, items, strict=True))}}}"


def written_mapping(known: AbstractSet[str], required: AbstractSet[str], text: Written) -> str | None:
    """Return the mapping with such keys that a text was meant to be, None where that is not clear."""
    for pair in (_NAMED, _RULE, _DECLARED):
        if required <= set(pair) <= known and (written := _parted(text.text, pair)) is not None:
            return written
    words = text.text.split()
    if known >= set(_PROGRAM):
        return f"{{pkg: {words[0]}, exec: {words[1]}}}" if len(words) == len(_PROGRAM) else None
    if len(required) != 1 or "\n" in text.text:
        return None
    (key,) = required
    return f"{{{key}: {_value(text)}}}"


def _parted(text: str, pair: tuple[str, ...]) -> str | None:
    is_short = "\n" not in text and len(text) <= _LONGEST
    found = _JOINTS[_RULE if pair == _RULE else _NAMED].fullmatch(text.strip()) if is_short else None
    return None if found is None else f"{{{pair[0]}: {_plain(found[1])}, {pair[1]}: {_plain(found[2])}}}"


def extent(content: Any) -> Span | None:  # noqa: ANN401 - a tree
    """Return the place of a value of a YAML file from its first character to its last."""
    span: Span = content.span
    if isinstance(content, Written) or span.line == span.end_line:
        return span
    if type(content) is not Keyed or not content:
        return None
    ends = [extent(value) for value in content.values()]
    last = ends[-1]
    first = min(content.keys_at.values())
    in_braces = span < first
    if last is None or in_braces:
        return span if in_braces else None
    return Span(first.file, first.line, first.column, last.end_line, last.end_column)


def written_as_list(key: str, content: Any) -> str | None:  # noqa: ANN401 - a tree
    """Return the list that a flow mapping of nothing but keys was meant to be, as `{a, b}`; None for anything else.

    Behind a key that wants a list of texts it may be one text with commas too.
    """
    if isinstance(content, Written):
        text = content.text.strip("[]{}() ")
        texts = [item.strip() for item in text.split(",")] if "," in text else text.split()
        sound = key in _OF_TEXTS and texts and all(map(_ITEM.fullmatch, texts))
        return f"[{', '.join(texts)}]" if sound else None
    if not isinstance(content, Keyed) or not content or min(content.keys_at.values()) <= content.span:
        return None
    if not all(isinstance(value, Written) and value.null for value in content.values()):
        return None
    span = content.span
    keys = [_value(Written(key, at, lambda _first, _last: span)) for key, at in content.keys_at.items()]
    return f"[{', '.join(keys)}]"


def written_item(known: AbstractSet[str], content: Keyed) -> tuple[tuple[str, str], str] | None:
    """Return the keys that an item lacks which has a name as its only key, and how it is written.

    `known` are the keys that it may have. None where it is something else.
    """
    if len(content) != 1:
        return None
    pair = next((pair for pair in (_NAMED, _RULE, _DECLARED) if known >= set(pair)), None)
    if pair is None:
        return None
    ((key, value),) = content.items()
    if isinstance(content, Tagged) and isinstance(value, Written):
        text = value.text.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
        return pair, f'{pair[0]}="{key}" {pair[1]}="{text}"'
    return pair, shortened(_items(content, pair), _LONGEST)


def whole_item(content: Keyed) -> Span | None:
    """Return the place of all of such an item, None where it is on several lines; in XML that of its attribute."""
    ((key, value),) = content.items()
    at = content.keys_at[key]
    if not isinstance(value, Written) or value.null:
        return None
    if isinstance(content, Tagged):
        end = value.span
        quote = end.end_column + 1
        return Span(at.file, at.line, at.column, end.end_line, quote) if at.line == end.end_line else None
    if type(content) is not Keyed:
        return None
    end = content.span if content.span < at else value.span  # in flow form it has braces
    begin = min(content.span, at)
    if begin.line != end.end_line:
        return None
    return Span(begin.file, begin.line, begin.column, end.end_line, end.end_column)


def nested_list(mapping: Keyed, place: tuple[int | str, ...]) -> tuple[Span, str | None] | None:
    """Return the place of a value that is a list of lists, and the text that nodes read instead; None for any other."""
    *above, last = place
    value: Any = mapping
    for step in above:
        value = value[step]
    if not above or above[-1] != "value" or not isinstance(last, int) or type(value) is not Listed:
        return None
    span = value.span
    if span.line != span.end_line:
        return value[last].span, None
    written = _value(value)
    return span, None if '"' in written or "..." in written else f'"{written}"'


def are_mappings(items: Any) -> bool:  # noqa: ANN401 - a tree
    """Tell whether a list has nothing but mappings."""
    return isinstance(items, Listed) and bool(items) and all(isinstance(item, Keyed) for item in items)


def as_mappings(items: Listed, source: str) -> tuple[Span, str | None]:
    """Return the place of all of a list's texts, and how each is written as a mapping with `value`, in its form.

    Between them everything stays as it is. `source` is the file, of which lists in XML have no items in that form.
    """
    first, last = items[0].span, items[-1].span
    lines = source.split("\n")
    if not (items.span < first and last.end_line <= len(lines)):
        return first, None
    left, right = ("{", "}") if lines[items.span.line - 1][items.span.column - 1] == "[" else ("", "")
    written, at = "", (first.line, first.column)
    for span in (item.span for item in items):
        between = _stretch(lines, at, (span.line, span.column))
        text = _stretch(lines, (span.line, span.column), (span.end_line, span.end_column))
        written += f"{between}{left}value: {text}{right}"
        at = (span.end_line, span.end_column)
    return Span(first.file, first.line, first.column, last.end_line, last.end_column), written


def _stretch(lines: Sequence[str], begin: tuple[int, int], end: tuple[int, int]) -> str:
    """Return the text from one line and column to another."""
    kept = [*lines[begin[0] - 1 : end[0] - 1], lines[end[0] - 1][: end[1] - 1]]
    return "\n".join([kept[0][begin[1] - 1 :], *kept[1:]])


def _items(content: Keyed, pair: tuple[str, ...]) -> str:
    return ", ".join(_item(name, value, pair) for name, value in content.items())


def _item(name: str, value: Any, pair: tuple[str, ...]) -> str:  # noqa: ANN401 - a tree
    if isinstance(value, Keyed) and pair == _NAMED:
        return f"{{name: {name}, param: [{_items(value, pair)}]}}"
    return f"{{{pair[0]}: {name}, {pair[1]}: {_value(value)}}}"


def _value(value: Any) -> str:  # noqa: ANN401 - a tree
    if isinstance(value, Listed):
        return f"[{', '.join(map(_value, value))}]"
    if not isinstance(value, Written):
        return "..."
    return _quoted(value.text) if value.quoted else _plain(value.text)


def _plain(text: str) -> str:
    """Return a text as it is written in a flow mapping, in quotes where it needs them."""
    return _quoted(text) if _SPECIAL.search(text) else text


def _quoted(text: str) -> str:
    if '"' in text or "\\" in text:
        return "'" + text.replace("'", "''") + "'"
    return f'"{text}"'
