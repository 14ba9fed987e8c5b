"""From the models of a description to what is written in YAML and XML: key by key, whatever the action.

An action that the language has no word for is told and left out; with `partial` a comment stands in its place.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.convert.argv import joined, words_of
from orchestra.convert.comments.kept import Comments
from orchestra.convert.kinds import Kind, key_of, kind_of, short_key
from orchestra.convert.plain import is_plain, looks_like_text
from orchestra.convert.refused import why
from orchestra.convert.remarks import Remarks, UnsayableError
from orchestra.convert.texts import written
from orchestra.convert.tree import Entry, Item, Mapping, Notes, Scalar, Sequence, Style
from orchestra.convert.typed import type_word
from orchestra.convert.words import name_of, ordered
from orchestra.dataclass import dataclass
from orchestra.description.actions.set_parameter import SetParameter
from orchestra.description.conditions import Alive, ParameterFact, Ready
from orchestra.description.entity import Action, Entity
from orchestra.description.limits import Limits, Rlimits
from orchestra.description.parts import Param, Stop
from orchestra.description.text import Constant, Template
from orchestra.load.forms import Kind as Form
from orchestra.load.forms import forms_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.convert.tree import Node

Values: TypeAlias = Callable[..., "Node"]

# What upstream does not know: numbers need no quotes where a text is wanted.
_LENIENT = (Alive, Limits, Ready, Rlimits, Stop, ParameterFact)
# Lists of parameters in which quotes of YAML make no text.
_EVEN_EMPTY = frozenset({"children", "value"})
_WITHOUT_QUOTES = frozenset({"extra_arg"})


@dataclass(frozen=True, slots=True)
class Builder:
    """Builds the nodes of one file; `values` writes those of parameters."""

    values: Values
    comments: Comments
    remarks: Remarks
    partial: bool = False

    def actions(self, actions: Iterable[Action]) -> Sequence:
        """Return a list of actions."""
        items: list[Item] = []
        waiting: tuple[str, ...] = ()
        for action in actions:
            notes = self.comments.of(action)
            try:
                node = self._action(action)
            except UnsayableError as error:
                self.remarks.lose(error.message, error.span)
                told = (f"not converted: {error.message}",) if self.partial else ()
                waiting = (*waiting, *notes.before, *told, *([notes.beside] if notes.beside else []))
                continue
            items.append(Item(node, Notes((*waiting, *notes.before), notes.beside)))
            waiting = ()
        if waiting:
            items.append(Item(Mapping(()), Notes(waiting)))
        return Sequence(tuple(items))

    def _action(self, action: Action) -> Mapping:
        name = name_of(action)
        if name is None:
            raise UnsayableError(why(action), action.span)
        return Mapping((Entry(name, self._entity(action)),))

    def _entity(self, entity: Entity, *, quotes: bool = True) -> Mapping:
        found = tuple(self._entries(entity, quotes=quotes))
        return Mapping(found)

    def _entries(self, entity: Entity, *, quotes: bool) -> Iterator[Entry]:
        model = type(entity)
        quotes = quotes and not isinstance(entity, SetParameter)
        for field in ordered(entity):
            value = getattr(entity, field)
            if value is None or (value == () and field not in _EVEN_EMPTY):
                continue
            node = self._node(entity, field, value, quotes=quotes)
            yield Entry(key_of(model, field), node, self.comments.of(entity, field))

    def _node(self, entity: Entity, field: str, value: Any, *, quotes: bool) -> Node:  # noqa: ANN401, PLR0911
        model = type(entity)
        if field == "children":
            return self.actions(value)
        if field == "for_each":
            return Mapping(
                tuple(Entry(name, self._repeated(item)) for name, item in value.items()), variables=True
            )
        kind = kind_of(model, field)
        if kind is Kind.VALUE:
            word = type_word(entity.type) if isinstance(entity, Param | SetParameter) else None
            return self.values(value, word, quotes=quotes)
        if kind is Kind.ARGV:
            return self._command(value)
        if isinstance(value, Entity):
            return self._part(value, short_key(model, field))
        if isinstance(value, dict):
            return Mapping(tuple(Entry(name, self._list(items, Kind.WORD)) for name, items in value.items()))
        if isinstance(value, tuple) and value and isinstance(value[0], Entity):
            inner = quotes and field not in _WITHOUT_QUOTES
            return Sequence(
                tuple(Item(self._entity(item, quotes=inner), self.comments.of(item)) for item in value)
            )
        kind = Kind.WORD if issubclass(model, _LENIENT) else kind
        if not isinstance(value, tuple):
            return self._text(value, kind)
        form = forms_of(model).by_key[key_of(model, field).replace("-", "_")]
        return self._list(value, kind, free=form.kind is Form.LIST)

    def _part(self, part: Entity, short: str | None) -> Node:
        entity = self._entity(part)
        if short is not None and len(entity.entries) == 1 and entity.entries[0].key == short:
            return entity.entries[0].node
        return entity

    def _command(self, value: Template | tuple[Template, ...]) -> Node:
        """Return a command as one text, as upstream wants it."""
        if isinstance(value, Template):
            return self._text(value, Kind.TEXT)
        if not value:
            return Sequence(())
        text = joined(words_of(value), value[0])
        return Scalar(written(text), Style.TEXT, text.span)

    def _list(self, items: tuple[Template, ...], kind: Kind, *, free: bool = True) -> Sequence:
        return Sequence(tuple(Item(self._text(item, kind)) for item in items), free=free)

    def _repeated(self, value: Any) -> Node:  # noqa: ANN401 - a part of a description, whatever it is
        if isinstance(value, tuple):
            return Sequence(tuple(Item(self._repeated(item)) for item in value), free=True)
        if isinstance(value, Constant):
            return Sequence(tuple(Item(self._repeated(item)) for item in _templates(value)))
        text = written(value)
        return Scalar(text, Style.PLAIN if is_plain(text) else Style.TEXT, value.span)

    def _text(self, template: Template, kind: Kind) -> Scalar:
        if kind is Kind.LITERAL:
            constant = template.constant or ""
            text = constant.replace("\\", "\\\\")
        else:
            text = written(template)
        native = kind in (Kind.FLAG, Kind.WORD) and is_plain(text)
        free = not looks_like_text(text) and not native
        style = Style.QUOTED if free else (Style.PLAIN if native else Style.TEXT)
        return Scalar(text, style, template.span)


def _templates(constant: Constant) -> tuple[Template, ...]:
    raise UnsayableError("a repetition goes over texts", constant.span)
