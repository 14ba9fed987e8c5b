"""Which names the parts of a description mention that have not been visited.

An argument that only such a part declares or reads is no mistake.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import nullcontext
from typing import TYPE_CHECKING, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.description.actions.arg import Arg
from orchestra.description.actions.include import Include
from orchestra.description.actions.opaque import OpaqueAction
from orchestra.description.entity import Entity
from orchestra.description.text import Call, MatchedTemplate, Opaque, PlainCall, PlainPath, Template, Words
from orchestra.errors import Problems
from orchestra.fields import replace
from orchestra.resolve.context import CommandResult, Context, Value, Variable
from orchestra.resolve.evaluate import evaluate
from orchestra.resolve.ledger import Hidden
from orchestra.resolve.paths import beside

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from contextlib import AbstractContextManager

    from orchestra.description.entity import Action, Conditional
    from orchestra.description.launch import Description
    from orchestra.location import Location
    from orchestra.resolve.context import Evaluated, Packages, Read, ReadKind

    Open: TypeAlias = Callable[[str], Description | None]


def is_fixed(template: Template) -> bool:
    """Return whether a text comes to the same whatever is set."""
    pieces = (
        template.pieces.pieces if type(template) is MatchedTemplate and template.pieces is not None else ()
    )
    if PlainPath in map(type, pieces):  # a call that joins its components, whatever these are
        return False
    if pieces and _OF_WORDS.issuperset(map(type, pieces)):  # the same, without the places of its parts
        return all(type(piece) is str or piece.name in _FIXED for piece in pieces)  # type: ignore[union-attr] # as it says
    return all(isinstance(part, Call) and part.name in _FIXED for part in performed_in(template))


def glimpse(template: Template, context: Context, variables: Mapping[str, Variable]) -> Value | None:
    """Return what a text comes to, without a word and without running anything; None where that cannot be told."""
    if any(isinstance(part, Opaque) or part.name == "command" for part in performed_in(template)):
        return None
    if not isinstance(context.variables, _Glance):
        context = replace(context, problems=Problems(), variables=_Glance(variables))
    value = evaluate(template, context)
    return value if isinstance(value, Value) else None


def hidden(action: Conditional, context: Context, variables: Mapping[str, Variable]) -> Hidden:
    """Return an action that is not visited; `variables` are those that are set around it."""
    return Hidden(action, _files((action,), context, variables))


def files_named(
    description: Description, environment: Mapping[str, str], packages: Packages, absent: str
) -> set[str]:
    """Return the files that includes name, whatever their conditions say, as far as no variable is needed for that.

    They are there, but for those below the folder `absent`.
    """
    context = Context(Problems(), _Glance({}), environment, packages, _run_nothing, description.path)
    paths = _paths(description.actions, context, {})
    found = (path if path.startswith(absent) else beside(context.file, path) for path in paths if path)
    return {path for path in found if path is not None}


def names_in(actions: Iterable[Conditional]) -> set[str]:
    """Return the arguments that actions declare and the variables that they read, whatever their conditions say."""
    found = set()
    for entity in entities_in(tuple(actions)):
        if isinstance(entity, Arg) and entity.name.constant is not None:
            found.add(entity.name.constant)
        for template in templates_of(entity):
            found.update(_variables(template))
    return found


def variables_in(template: Template) -> set[str] | None:
    """Return the variables that a text reads; None where one has no fixed name, or code may read others."""
    parts = performed_in(template)
    if any(isinstance(part, Opaque) or part.name == "command" for part in parts):
        return None
    names = [part.arguments[0].constant for part in parts if isinstance(part, Call) and part.name == "var"]
    found = {name for name in names if name is not None}
    return found if len(found) == len(set(names)) else None


def is_of_the_moment(actions: Iterable[Action]) -> bool:
    """Return whether actions say something that only an event knows which is being handled."""
    return any(
        isinstance(part, Opaque) and getattr(part.target, "_of_the_moment", False)
        for entity in entities_in(tuple(actions))
        for template in templates_of(entity)
        for part in performed_in(template)
    )


def words_in(action: Conditional) -> set[str]:
    """Return every constant text of an action and the actions in it."""
    texts = (template.constant for entity in entities_in(action) for template in templates_of(entity))
    return {text for text in texts if text is not None}


def names_behind(
    parts: Iterable[Hidden], context: Context, open_file: Open, files: Iterable[str] = ()
) -> tuple[set[str], bool]:
    """Return the names that hidden parts, files, and what they include mention, and whether there may be more."""
    names: set[str] = set()
    waiting: list[str | None] = [*files]
    for part in parts:
        names |= names_in((part.action,))
        waiting += part.files
    seen: set[str] = set()
    more = False
    while waiting:
        path = waiting.pop()
        if path in seen:
            continue
        description = open_file(path) if path is not None else None
        if path is None or description is None:
            more = True
            continue
        seen.add(path)
        names |= names_in(description.actions) | description.lost
        waiting += _files(description.actions, replace(context, file=path), {})
    return names, more


# Most of what is in an entity, and never one itself.
_PLAIN = frozenset({Template, MatchedTemplate, str, bool, type(None)})
_NAMING = (Include, OpaqueAction)
_OF_WORDS = frozenset({str, PlainCall})
_FIXED = frozenset({"dirname", "filename", "find-pkg-prefix", "find-pkg-share"})


@dataclass(frozen=True, slots=True)
class _Glance:
    """Variables that may be looked at without a word."""

    variables: Mapping[str, Variable]

    def get(self, name: str, reader: Location) -> Evaluated | None:
        """Return the value, None where it is unset."""
        del reader
        variable = self.variables.get(name)
        return None if variable is None else variable.value

    def known(self, names: Sequence[str]) -> None:
        """Return nothing: each is looked at by itself."""

    def names(self) -> tuple[str, ...]:
        """Return the names that are set."""
        return tuple(self.variables)

    def note(self, kind: ReadKind, name: str, value: str) -> None:
        """Note nothing: what only a glance reads makes no value."""

    def removes(self, name: str) -> bool:
        """Return false: nothing is told of what only a glance reads."""
        del name
        return False

    def tracing(self) -> AbstractContextManager[list[Read]]:
        """Collect nothing."""
        return nullcontext([])


def _run_nothing(command: tuple[str, ...], environment: Mapping[str, str]) -> CommandResult:
    del command, environment
    return CommandResult(0, "", "", "nothing is run here")


# Code of a launch file may name any file: it counts as one that is not known.
def _files(
    actions: tuple[Conditional, ...], context: Context, variables: Mapping[str, Variable]
) -> tuple[str | None, ...]:
    paths = _paths(actions, context, variables)
    return tuple(None if path is None else beside(context.file, path) for path in paths)


def _paths(
    actions: tuple[Conditional, ...], context: Context, variables: Mapping[str, Variable]
) -> list[str | None]:
    """Return what includes name, None for what cannot be told."""
    found = [entity for entity in entities_in(actions) if isinstance(entity, _NAMING)]
    values = [
        glimpse(entity.file, context, variables) if isinstance(entity, Include) else None for entity in found
    ]
    return [None if value is None else value.text for value in values]


def entities_in(value: object) -> list[Entity]:
    """Return an entity, or several, and all that stand in them."""
    found: list[Entity] = []
    _collect(value, found)
    return found


def _collect(value: object, found: list[Entity]) -> None:
    if isinstance(value, tuple):
        for item in value:
            if type(item) not in _PLAIN:
                _collect(item, found)
    elif isinstance(value, Entity):
        found.append(value)
        for inner in vars(value).values():
            if type(inner) not in _PLAIN:
                _collect(inner, found)


def templates_of(entity: Entity) -> list[Template]:
    """Return the texts of an entity, those of the entities in it left out."""
    found: list[Template] = []
    for value in vars(entity).values():
        if value is None:
            continue
        if isinstance(value, Template):
            found.append(value)
        elif type(value) is tuple:
            found += [text for text in value if isinstance(text, Template)]
        elif type(value) not in _PLAIN:
            for item in value.values() if isinstance(value, dict) else (value,):
                found += (
                    text
                    for text in (item if isinstance(item, tuple) else (item,))
                    if isinstance(text, Template)
                )
    return found


def performed_in(template: Template) -> list[Call | Opaque]:
    """Return every substitution of a text, those in the arguments of others included."""
    found: list[Call | Opaque] = []
    for part in template.parts:
        if not isinstance(part, Words):
            found.append(part)
            for inner in part.arguments if isinstance(part, Call) else part.inside:
                found += performed_in(inner)
    return found


def _variables(template: Template) -> Iterator[str]:
    for part in performed_in(template):
        if isinstance(part, Call) and part.name == "var" and part.arguments:
            name = part.arguments[0].constant
            if name is not None:
                yield name
