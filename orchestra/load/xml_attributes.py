"""Attributes that hold lists: with a separator in an attribute beside them, or as `[a, b]`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.source import Listed, Written
from orchestra.errors import Code
from orchestra.patterns import pattern
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    from orchestra.load.elements import Attribute
    from orchestra.load.offsets import Source
    from orchestra.load.reader import Reader

_WORDS: Final = "choices"
_WORD: Final = pattern(r"[\w./-]+")
_JOINT: Final = pattern(r"\s*[,;|]\s*|\s+")


def separated(attribute: Attribute, separator: Attribute, whole: Source, reader: Reader) -> Listed:
    """Return the pieces of a value between separators, blanks and all, as upstream."""
    items = Listed(whole.span(attribute.begin, attribute.end))
    written = attribute.written(whole)
    if not separator.value:
        message = f"the separator of '{attribute.name}' is empty"
        reader.error(Code.BAD_VALUE, message, separator.span(whole))
        items.append(written)
        return items
    at = 0
    for piece in written.text.split(separator.value):
        items.append(_part(written, at, at + len(piece), piece))
        at += len(piece) + len(separator.value)
    return items


def listed(attribute: Attribute, whole: Source, reader: Reader, *, alone: bool) -> Listed | Written:
    """Return the items of a value as `[a, b]`, by YAML's rules; any other value is itself or a list of it alone."""
    written = attribute.written(whole)
    node = _composed(written.text)
    items = Listed(written.span)
    if isinstance(node, yaml.SequenceNode) and all(isinstance(item, yaml.ScalarNode) for item in node.value):
        items.extend(_item(written, item) for item in node.value)
    elif alone:
        words = _JOINT.split(written.text.strip()) if attribute.name == _WORDS else []
        if len(words) > 1 and all(map(_WORD.fullmatch, words)):
            _refuse_words(attribute, words, whole, reader)
            items.extend(_part(written, 0, len(written.text), word) for word in words)
        else:
            items.append(written)
    else:
        return written
    return items


def _refuse_words(attribute: Attribute, words: list[str], whole: Source, reader: Reader) -> None:
    """Report the values of an argument in one text, which is one value of it."""
    first = f'<choice value="{words[0]}"/>'
    message = f"'{attribute.value}' is one value; each value is an element of its own: {first}"
    at = whole.span(attribute.at, attribute.end + 1)
    instead = f'{attribute.name}="[{", ".join(words)}]"'
    reader.error(Code.WRONG_TYPE, message, at, suggestion=instead)


def _composed(text: str) -> yaml.Node | None:
    try:
        parser = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
        return yaml.compose(text, Loader=parser) if text.lstrip().startswith("[") else None
    except yaml.YAMLError:
        return None


def _item(written: Written, node: yaml.ScalarNode) -> Written:
    begin, end = node.start_mark.index, node.end_mark.index
    inset = 1 if node.style else 0
    if written.text[begin + inset : end - inset] == node.value:
        return _part(written, begin + inset, end - inset, node.value, quoted=bool(node.style))
    span = written.spans(begin, end)
    return Written(node.value, span, lambda _first, _last: span, quoted=bool(node.style))


def _part(written: Written, begin: int, end: int, text: str, *, quoted: bool = False) -> Written:
    """Return a stretch of a value as a value of its own."""
    return Written(
        text,
        written.spans(begin, end),
        lambda first, last: written.spans(begin + first, begin + last),
        quoted=quoted,
    )
