"""Entities from the lines of a YAML file, in one pass.

The model of an entity tells what stands behind its keys: texts become those of the entity as their lines are reached,
and what is of another model is gone on with. What is left, as lists of texts, is read into trees first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.description.text import matched_words
from orchestra.load.alike.learned import UnlikeError
from orchestra.load.alike.making import template
from orchestra.load.alike.straight import Kind, action_model, how, read_action
from orchestra.load.alike.yaml_lines import (
    BARE,
    BRACKETS,
    DASH,
    DEEPEST,
    DOUBLE_IN_PAIR,
    FIRST,
    FIRST_KEY,
    FIRST_WORD,
    IN_DOUBLE,
    IN_SINGLE,
    INDENT,
    KEY_IN_PAIR,
    NAME,
    OPEN,
    PAIR,
    PLAIN,
    PLAIN_IN_PAIR,
    SECOND,
    SECOND_KEY,
    SECOND_QUOTED,
    SINGLE_IN_PAIR,
    TWO,
    WORD,
    Scan,
    lines_of,
)
from orchestra.location import GROUPS

if TYPE_CHECKING:
    import re

    from orchestra.description.entity import Action
    from orchestra.load.alike.straight import Model, Way
    from orchestra.load.offsets import Source
    from orchestra.load.reader import Reader

_CHILDREN: Final = "children"
_QUOTED: Final = frozenset({IN_DOUBLE, IN_SINGLE})
# What a line may end with that names an action: nothing behind the key, or brackets.
_OPENING: Final = frozenset({NAME, *BRACKETS})


def read(whole: Source, begin: int, end: int, reader: Reader) -> tuple[Action, tuple[str, ...]] | None:
    """Return the action that is the one item of a list between two offsets, and what tells its form.

    None where it takes a parser, or a closer look.
    """
    lines = lines_of(whole, begin, end)
    if lines is None:
        return None
    scan = _Entities(whole, lines, end, reader)
    try:
        actions = scan.listed(lines[0].end(INDENT) - begin, None, 0)
    except (UnlikeError, IndexError):  # the end where something has to follow
        return None
    return (actions[0], tuple(scan.words)) if scan.line == scan.count and len(actions) == 1 else None


class _Entities(Scan):
    """Goes through lines, and makes entities of them."""

    __slots__ = ("reader",)

    def __init__(self, whole: Source, lines: list[re.Match[str]], end: int, reader: Reader) -> None:
        super().__init__(whole, lines, end)
        self.reader = reader

    def listed(self, column: int, model: Model | None, depth: int) -> tuple[Any, ...]:
        """Return the list whose dashes stand in a column, from the next line on: of entities, else of actions."""
        found: list[Any] = []
        lines, words = self.lines, self.words
        number = self.line
        while number < self.count:
            line = lines[number]
            indent, dash, key = line.group(INDENT, DASH, NAME)
            if dash is None or len(indent) < column:
                break
            last = line.lastindex
            if len(indent) > column or last == DASH or depth > DEEPEST:
                raise UnlikeError
            words.append("-")
            if key is None:
                self.line = number + 1
                found.append(self.item(line, number << GROUPS | OPEN, model))
            elif model is None:
                found.append(self.action(column + len(dash), depth + 1))
            else:
                found.append(self.entity(column + len(dash), None, depth + 1, model))
            number = self.line
        return tuple(found)

    def item(self, line: re.Match[str], head: int, model: Model | None) -> Any:  # noqa: ANN401 - an entity
        """Return what stands in brackets behind a dash: an entity, else an action."""
        if model is not None:
            return self.in_braces(line, head, model)
        if line.lastindex not in BRACKETS:
            raise UnlikeError
        return read_action(self.opened(line, None), self.places, self.reader)

    def action(self, column: int, depth: int) -> Action:
        """Return the action whose name begins in a column of the next line, and is the only key there."""
        number = self.line
        line = self.lines[number]
        self.line = number + 1
        key, opening = line.group(NAME, OPEN)
        if key is None or line.lastindex not in _OPENING:
            raise UnlikeError
        self.words.append(key)
        model, head = action_model(key), number << GROUPS | NAME
        if opening == "{":
            found = self.in_braces(line, head, model)
        elif opening is not None:
            way = model.way(_CHILDREN, ())
            items = way.read(self.opened(line, head), self.places, self.reader)
            found = model.made({way.name: items}, self.places, head)
        elif self.lines[self.line][DASH] is not None:
            way = model.way(_CHILDREN, ())
            found = model.made({way.name: self.below_key(way, head, column, depth)}, self.places, head)
        else:
            found = self.entity(self.deeper(column, depth), head, depth + 2, model)
        if self.line < self.count and len(self.lines[self.line][INDENT]) >= column:
            raise UnlikeError
        action: Action = found
        return action

    def entity(self, column: int, head: int | None, depth: int, model: Model) -> Any:  # noqa: ANN401 - an entity
        """Return the entity whose keys begin in a column, from the next line on, behind the dash that may be there."""
        values: dict[str, Any] = {}
        lines, count, number, places, reader = self.lines, self.count, self.line, self.places, self.reader
        texts, words = model.texts, self.words
        if head is None:
            head = number << GROUPS | NAME
        line = lines[number]
        key = line[NAME]
        while True:
            if key is None:
                raise UnlikeError
            words.append(key)
            name, last = texts.get(key), line.lastindex
            if last in PLAIN and name is not None and name not in values:
                group = number << GROUPS | last
                if last == WORD:
                    values[name] = matched_words(line[WORD], False, places, group)
                else:
                    values[name] = template(line[BARE], places, group, False, reader)
                number += 1
            else:
                way = model.way(key, values)
                self.line = number + 1
                values[way.name] = self.behind_key(line, way, column, depth)
                number = self.line
            if number == count:
                break
            line = lines[number]
            indent, dash, key = line.group(INDENT, DASH, NAME)
            if dash is None and len(indent) == column:
                continue
            if len(indent) >= column:
                raise UnlikeError
            break
        self.line = number
        return model.made(values, places, head)

    def behind_key(self, line: re.Match[str], way: Way, column: int, depth: int) -> Any:  # noqa: ANN401 - of any field
        """Return what stands behind the key of the last line, or below it."""
        number, last = self.line - 1 << GROUPS, line.lastindex
        if last in PLAIN:
            return way.read((line[last], number | last, False), self.places, self.reader)
        if last in _QUOTED:
            return way.read(self.quoted(line, number, last), self.places, self.reader)
        if last in BRACKETS:
            return self.in_brackets(line, way, number | NAME)
        return self.below_key(way, number | NAME, column, depth)

    def deeper(self, column: int, depth: int) -> int:
        """Return the column of the mapping below a key."""
        indent = len(self.lines[self.line][INDENT])
        if indent <= column or depth > DEEPEST:
            raise UnlikeError
        return indent

    def below_key(self, way: Way, head: int, column: int, depth: int) -> Any:  # noqa: ANN401 - the value of any field
        """Return what stands below a key that has nothing behind it."""
        following = self.lines[self.line]
        if way.kind is Kind.OTHER:
            return way.read(self.below(head, column, depth), self.places, self.reader)
        if following[DASH] is None:
            if way.kind is not Kind.PART or way.model is None:
                raise UnlikeError
            return self.entity(self.deeper(column, depth), head, depth + 1, how(way.model))
        indent = len(following[INDENT])
        if indent < column or way.kind is Kind.PART:
            raise UnlikeError
        return self.listed(indent, None if way.model is None else how(way.model), depth + 1)

    def in_brackets(self, line: re.Match[str], way: Way, head: int) -> Any:  # noqa: ANN401 - the value of any field
        """Return what stands in brackets behind a key, up to the end of the line."""
        if way.kind is Kind.PART and way.model is not None and line[OPEN] == "{":
            return self.in_braces(line, head, how(way.model))
        return way.read(self.opened(line, head), self.places, self.reader)

    def in_braces(self, line: re.Match[str], head: int, model: Model) -> Any:  # noqa: ANN401 - an entity
        """Return the entity that stands in braces behind a key, or behind a dash, up to the end of the line."""
        last = line.lastindex
        if last in TWO:
            key, word, text, other, also = line.group(FIRST_KEY, FIRST_WORD, FIRST, SECOND_KEY, last)
            first, second = model.texts.get(key), model.texts.get(other)
            if first is not None and second is not None and first != second:
                self.words += ("{", key, other)
                places, reader, number = self.places, self.reader, self.line - 1 << GROUPS
                made: dict[str, Any] = {}
                if word is None:
                    made[first] = template(text, places, number | FIRST, False, reader)
                else:
                    made[first] = matched_words(word, False, places, number | FIRST_WORD)
                if last == SECOND:
                    made[second] = template(also, places, number | SECOND, False, reader)
                else:
                    made[second] = matched_words(also, last == SECOND_QUOTED, places, number | last)
                return model.made(made, places, head)
        elif last != OPEN:
            raise UnlikeError
        begin = line.start(OPEN)
        if self.text[begin] != "{":
            raise UnlikeError
        self.words.append("{")
        values, at = self.values(begin + 1, model)
        self.end_line(line, at)
        return model.made(values, self.places, head)

    def values(self, at: int, model: Model) -> tuple[dict[str, Any], int]:
        """Return the values of the fields that stand in braces, and the offset behind it."""
        values: dict[str, Any] = {}
        text, end, places, reader, words = self.text, self.end, self.places, self.reader, self.words
        told = places.told
        while True:
            found = PAIR.match(text, at, end)
            if found is None:
                raise UnlikeError
            key, opening, _, single, plain, following = found.groups()
            words.append(key)
            told.append(found)
            at, number = found.end(), len(told) - 1 << GROUPS
            name = model.texts.get(key)
            if plain is not None and name is not None and name not in values:
                values[name] = template(plain, places, number | PLAIN_IN_PAIR, False, reader)
            else:
                way = model.way(key, values)
                if plain is not None:
                    value: Any = (plain, number | PLAIN_IN_PAIR, False)
                elif opening is None:
                    value = self.quoted(found, number, DOUBLE_IN_PAIR if single is None else SINGLE_IN_PAIR)
                else:
                    value, at = self.flow(at - 1, opening, number | KEY_IN_PAIR, 1)
                    following, at = self.following(at)
                values[way.name] = way.read(value, places, reader)
            if following != ",":
                break
        if following != "}":
            raise UnlikeError
        return values, at
