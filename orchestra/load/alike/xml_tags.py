"""Actions in XML as nearly all are: tags with attributes, of texts that mean the same to every reader of XML.

What an element means is told by the model that it belongs to, as in `xml_file`. Anything that is not plain to see takes
a parser.
"""

from __future__ import annotations

import re
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Final

from orchestra.load.alike.learned import UnlikeError
from orchestra.load.alike.making import template
from orchestra.load.alike.straight import action_model, how
from orchestra.load.elements import Attribute
from orchestra.load.forms import Kind, forms_of
from orchestra.location import GROUPS, Places

if TYPE_CHECKING:
    from orchestra.description.entity import Action
    from orchestra.description.source import Written
    from orchestra.load.alike.straight import Model, Scalar
    from orchestra.load.forms import Forms
    from orchestra.load.offsets import Source
    from orchestra.load.reader import Reader

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
_last_group: Final = attrgetter("lastindex")
_CHILDREN: Final = "children"
_IN_DOUBLE, _IN_SINGLE = 2, 3  # groups of an attribute
_CLOSING, _NAME, _PAIRS, _EMPTY, _ODD = 1, 2, 3, 7, 8


def read(whole: Source, begin: int, end: int, reader: Reader) -> tuple[Action, tuple[str, ...]] | None:
    """Return the action that is the one element between two offsets, and what tells its form.

    None where it takes a parser, or a closer look.
    """
    tags = list(_TAG.finditer(whole.text, begin, end))
    if _ODD in map(_last_group, tags):
        return None
    scan = _Scan(whole, tags, reader)
    try:
        action = scan.action(0)
    except (UnlikeError, IndexError):  # the end where something has to follow
        return None
    return (action, tuple(scan.words)) if scan.tag == len(tags) else None


class _Scan:
    """Goes through tags; `tag` is the number of the next one. `words` are the names, which show the form."""

    __slots__ = ("places", "reader", "tag", "tags", "text", "whole", "words")

    def __init__(self, whole: Source, tags: list[re.Match[str]], reader: Reader) -> None:
        self.whole = whole
        self.reader = reader
        self.text = whole.text
        self.tags = tags
        self.tag = 0
        self.places = Places(whole, [*tags])
        self.words: list[str] = []

    def action(self, depth: int) -> Action:
        """Return the action that begins with the next tag."""
        if depth > _DEEPEST:
            raise UnlikeError
        action: Action = self.entity(action_model(self.tags[self.tag][_NAME]), depth)
        return action

    def entity(self, model: Model, depth: int) -> Any:  # noqa: ANN401 - an entity
        """Return what the element says that begins with the next tag, and its model knows."""
        number = self.tag
        tag, forms, words, places = self.tags[number], forms_of(model.model), self.words, self.places
        if tag[_CLOSING]:
            raise UnlikeError
        self.tag = number + 1
        name = tag[_NAME]
        words.append(name)
        values: dict[str, Any] = {}
        told = places.told
        for pair in _ATTRIBUTE.finditer(self.text, *tag.span(_PAIRS)):
            key, double, single = pair.groups()
            if key not in forms.texts:
                raise UnlikeError
            words.append(key)
            text, group = (double, _IN_DOUBLE) if single is None else (single, _IN_SINGLE)
            field = model.texts.get(key)
            if field is not None and field not in values and "&" not in text:
                told.append(pair)
                values[field] = template(text, places, len(told) - 1 << GROUPS | group, False, self.reader)
                continue
            way = model.way(key, values)
            values[way.name] = way.read(self.attribute(pair, key, text, group), places, self.reader)
        if not tag[_EMPTY]:
            self.children(name, model, forms, values, depth)
        elif forms.holds_actions:
            raise UnlikeError
        return model.made(values, places, number << GROUPS | _NAME)

    def attribute(self, pair: re.Match[str], key: str, text: str, group: int) -> Scalar | Written:
        """Return the value of an attribute."""
        if "&" not in text:
            return text, self.places.add(pair) | group, False
        value = _ENTITY.sub(lambda found: _CHARACTERS[found[1]], text)
        return Attribute(key, value, pair.start(1), *pair.span(group)).written(self.whole)

    def children(self, name: str, model: Model, forms: Forms, values: dict[str, Any], depth: int) -> None:
        """Add what stands in an element, up to the tag that closes it."""
        actions: list[Action] = []
        lists: dict[str, list[Any]] = {}
        while not (tag := self.tags[self.tag])[_CLOSING]:
            key = tag[_NAME]
            form = forms.by_key.get(key)
            if form is None and forms.holds_actions:
                actions.append(self.action(depth + 1))
                continue
            if form is None or form.or_variables or depth > _DEEPEST:
                raise UnlikeError
            way = model.way(key, values)
            if way.model is None or way.model is not form.model:
                raise UnlikeError
            part = self.entity(how(way.model), depth + 1)
            if form.kind is Kind.PARTS:
                lists.setdefault(way.name, []).append(part)
            else:
                values[way.name] = part
        if tag[_NAME] != name or tag[_PAIRS] or tag[_EMPTY] or (forms.holds_actions and not actions):
            raise UnlikeError
        self.tag += 1
        for field, parts in lists.items():
            values[field] = tuple(parts)
        if forms.holds_actions:
            values[model.way(_CHILDREN, values).name] = tuple(actions)
