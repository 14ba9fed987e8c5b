"""Actions in XML as nearly all are: tags with attributes, of texts that mean the same to every reader of XML.

What an element means is told by the model that it belongs to, as in `xml_file`. Anything that is not plain to see takes
a parser.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.actions import model_of
from orchestra.load.alike.learned import UnlikeError
from orchestra.load.alike.straight import Keys, Plainly, Series
from orchestra.load.elements import Attribute
from orchestra.load.forms import Kind, forms_of
from orchestra.load.keys import spelled
from orchestra.location import Places

if TYPE_CHECKING:
    from orchestra.description.entity import Entity
    from orchestra.load.forms import Forms
    from orchestra.load.offsets import Source

_DEEPEST: Final = 20
_BLANK: Final = r"[ \t\r\n]"
# With what stands for characters that would mean something else, as expressions have it.
_NAMED: Final = r"&(?:quot|apos|lt|gt|amp);"
_VALUE: Final = rf"""(?:"((?:[ !#-%'-;=-~]++|{_NAMED})*+)"|'((?:[ -%(-;=-~]++|{_NAMED})*+)')"""
_PAIR: Final = rf"{_BLANK}++([A-Za-z_][A-Za-z0-9_.-]*+){_BLANK}*+={_BLANK}*+{_VALUE}"
_COMMENT: Final = r"<!--(?:(?!--)[\t\r\n -~\xa0-\xff])*+-->"
_TAG: Final = re.compile(
    rf"<(/?)([A-Za-z][A-Za-z0-9_-]*+)((?:{_PAIR})*+){_BLANK}*+(/?)>(?:{_BLANK}++|{_COMMENT})*+|([^<]|<)"
)
_ATTRIBUTE: Final = re.compile(_PAIR)
_ENTITY: Final = re.compile("&([a-z]+);")
_CHARACTERS: Final = {"quot": '"', "apos": "'", "lt": "<", "gt": ">", "amp": "&"}
_CLOSING, _NAME, _PAIRS, _EMPTY, _ODD = 1, 2, 3, 7, 8


def scanned(whole: Source, begin: int, end: int) -> Plainly | None:
    """Return the action that is the one element between two offsets; None where it takes a parser."""
    tags = list(_TAG.finditer(whole.text, begin, end))
    if any(tag.lastindex == _ODD for tag in tags):
        return None
    scan = _Scan(whole, tags)
    try:
        action = scan.action(0)
    except (UnlikeError, IndexError):  # the end where something has to follow
        return None
    return Plainly(action, scan.places, tuple(scan.words)) if scan.tag == len(tags) else None


class _Scan:
    """Goes through tags; `tag` is the number of the next one. `words` are the names, which show the form."""

    __slots__ = ("places", "tag", "tags", "text", "whole", "words")

    def __init__(self, whole: Source, tags: list[re.Match[str]]) -> None:
        self.whole = whole
        self.text = whole.text
        self.tags = tags
        self.tag = 0
        self.places = Places(whole)
        self.words: list[str] = []

    def action(self, depth: int) -> Keys:
        """Return the action that begins with the next tag: a mapping with its name as the only key."""
        name = self.tags[self.tag][_NAME]
        model = model_of(spelled(name))
        if model is None or depth > _DEEPEST:
            raise UnlikeError
        content = self.content(model, depth)
        return Keys({name: content}, content.head)

    def content(self, model: type[Entity], depth: int) -> Keys:
        """Return what the element says that begins with the next tag, and its model knows."""
        tag, forms, words = self.tags[self.tag], forms_of(model), self.words
        if tag[_CLOSING]:
            raise UnlikeError
        self.tag += 1
        name, places = tag[_NAME], self.places.offsets
        words.append(name)
        keys = Keys({}, len(places))
        places.append(tag.span(_NAME))
        values, texts = keys.values, forms.texts
        for pair in _ATTRIBUTE.finditer(self.text, *tag.span(_PAIRS)):
            key, double, single = pair.groups()
            if key not in texts or key in values:
                raise UnlikeError
            words.append(key)
            text, group = (double, 2) if single is None else (single, 3)
            if "&" in text:
                value = _ENTITY.sub(lambda found: _CHARACTERS[found[1]], text)
                attribute = Attribute(key, value, pair.start(1), *pair.span(group))
                values[key] = attribute.written(self.whole)
                continue
            values[key] = (text, len(places), False)
            places.append(pair.span(group))
        if not tag[_EMPTY]:
            self.children(name, forms, values, depth)
        elif forms.holds_actions:
            raise UnlikeError
        return keys

    def children(self, name: str, forms: Forms, values: dict[str, Any], depth: int) -> None:
        """Add what stands in an element, up to the tag that closes it."""
        actions: list[Any] = []
        while not (tag := self.tags[self.tag])[_CLOSING]:
            key = tag[_NAME]
            form = forms.by_key.get(key)
            if form is None and forms.holds_actions:
                actions.append(self.action(depth + 1))
                continue
            if form is None or form.model is None or form.or_variables or depth > _DEEPEST:
                raise UnlikeError
            content = self.content(form.model, depth + 1)
            if form.kind is Kind.PART and key not in values:
                values[key] = content
            elif form.kind is Kind.PARTS:
                parts = values.setdefault(key, Series([], content.head, content.head))
                if type(parts) is not Series:
                    raise UnlikeError
                parts.items.append(content)
            else:
                raise UnlikeError
        if tag[_NAME] != name or tag[_PAIRS] or tag[_EMPTY] or (forms.holds_actions and not actions):
            raise UnlikeError
        self.tag += 1
        if forms.holds_actions:
            values["children"] = Series(actions, 0, 0)
