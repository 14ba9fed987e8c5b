"""From an action that has been read to the form of its text.

Its tree tells where its values stand, its entity what they have become; both are gone through side by side. A value
whose key takes any text becomes a group that any harmless text matches; every other one has to stand there as it did,
for what its key accepts is decided by the key alone.
"""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING, Any, Final, get_args

from orchestra.dataclass import dataclass
from orchestra.description.entity import Action, Entity
from orchestra.description.fields import AnyValue, Argv, Literal, Text
from orchestra.description.marks import Plain
from orchestra.description.source import Keyed, Listed, Verbatim
from orchestra.description.text import Items, Template
from orchestra.errors import Problems
from orchestra.fields import field
from orchestra.load.alike.assembled import CLOSE, EXPRESSION, OPEN, TEXT, Part, assembled
from orchestra.load.alike.learned import Form, Manner, UnlikeError
from orchestra.load.alike.making import MAKING
from orchestra.load.keys import spelled
from orchestra.load.offsets import Source
from orchestra.load.reader import Reader
from orchestra.location import offsets_of

if TYPE_CHECKING:
    from orchestra.location import Span

# The file of code that is written here: who watches what code does knows by it that it is ours.
_MADE: Final = f"{__file__}: written"
# Each value takes as long to be learned as a hundred to be read: lists of very many are no forms.
_MOST_VALUES: Final = 150
# How the text of a key is read: with substitutions, without, or as the key has it.
_TEXT, _LITERAL, _OWN = "template", "literal", ""
_HARMLESS = "harmless"  # with substitutions, but nothing that escapes
# In the code that is written, a group by its offsets.
_GROUP: Final = re.compile(r"@([0-9]+):([0-9]+)@")


def learned(item: Any, action: Action, whole: Source, begin: int, end: int, manner: Manner) -> Form:  # noqa: ANN401 - a tree
    """Return the form of an action, which has been read from a tree and stands between two offsets.

    Raises `UnlikeError` where it has something that cannot be told by characters.
    """
    cast = _Cast(whole, begin, end, manner)
    code = cast.action(item, action)
    pattern = assembled(cast.expression())
    groups = {offsets: number + 1 for number, offsets in enumerate(cast.ordered())}

    def numbered(found: re.Match[str]) -> str:
        return str(groups[int(found[1]), int(found[2])])

    lines = ["def make(whole, match, reader):", "at = Matched(whole, match)"]
    lines += [*cast.lines, f"return {code}"]
    known = {**MAKING, **cast.known}
    exec(compile(_GROUP.sub(numbered, "\n ".join(lines)), _MADE, "exec"), known)  # noqa: S102 - names and numbers of ours
    form = Form(pattern, known["make"])
    match, reader = pattern.fullmatch(whole.text, begin, end), Reader(Problems())
    if match is None or form.make(whole, match, reader) != action or len(reader.problems):
        raise UnlikeError
    return form


@dataclass(slots=True)
class _Cast:
    """Gathers the groups of an expression by their offsets, and the code that makes an entity of them.

    What is `inside` of a group is an expression for a value, or the value; None where other groups and what stands
    there are.
    """

    whole: Source
    begin: int
    end: int
    manner: Manner
    known: dict[str, Any] = field(default_factory=dict)
    inside: dict[tuple[int, int], Part | None] = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)

    def action(self, item: Any, action: Action) -> str:  # noqa: ANN401 - a tree
        """Return the code for an action, which is a mapping with its name as the only key."""
        if not isinstance(item, Keyed) or len(item) != 1:
            raise UnlikeError
        ((name, content),) = item.items()
        if isinstance(content, Listed):
            children, content = content, Keyed(content.span, item.keys_at[name])
            content.put("children", children, content.head)
        return self.entity(content, action)

    def entity(self, mapping: Any, entity: Any) -> str:  # noqa: ANN401 - a tree, any value
        """Return the code for an entity."""
        if not isinstance(mapping, Keyed) or not isinstance(entity, Entity) or mapping.lossy:
            raise UnlikeError
        span = entity.span
        if set(entity.__pydantic_private__ or ()) != {"span"}:
            raise UnlikeError
        names = _names(type(entity))
        values = [(names[spelled(key)], value) for key, value in mapping.items()]
        words = [f"{name!r}: {self.value(entity, name, value)}" for name, value in values]
        kept = self.keep({**entity.__dict__, **dict.fromkeys(name for name, _ in values)})
        return f"entity({self.keep(type(entity))}, {{**{', '.join([kept, *words])}}}, {self.place(span)})"

    def value(self, entity: Entity, name: str, written: Any) -> str:  # noqa: ANN401 - a tree
        """Return the code for the value of a field."""
        made = entity.__dict__[name]
        if isinstance(written, Listed):
            return self.items(written, made, _way(type(entity), name))
        return self.text(written, made, _way(type(entity), name)) or self.entity(written, made)

    def items(self, written: Listed, made: Any, way: str) -> str:  # noqa: ANN401 - any value
        """Return the code for a list: of actions, of parts, of texts."""
        if not isinstance(made, tuple) or len(made) != len(written):
            raise UnlikeError
        words = [
            self.action(item, value)
            if isinstance(value, Action)
            else self.text(item, value, way) or self.entity(item, value)
            for item, value in zip(written, made, strict=True)
        ]
        listed = f"({''.join(f'{word}, ' for word in words)})"
        return f"items({listed}, {self.place(made.span)})" if isinstance(made, Items) else listed

    def text(self, written: Any, made: Any, way: str) -> str | None:  # noqa: ANN401 - a tree, any value
        """Return the code for a text, None for what is none."""
        if not isinstance(made, Template):
            return None
        group, free = self.stands(written, way)
        name, read = f"text{len(self.lines)}", _HARMLESS if free and way == _TEXT else way or _TEXT
        self.lines.append(f"{name} = {read}(match[{group}], at, {group}, {written.quoted}, reader)")
        return name

    def stands(self, written: Any, way: str) -> tuple[str, bool]:  # noqa: ANN401 - a tree
        """Return the group in which a text stands, and whether any that is harmless may stand there."""
        if type(written) is not Verbatim or len(self.inside) >= _MOST_VALUES:
            raise UnlikeError
        first, last = _offsets(written.span)
        first, last = first + written.quoted, last - written.quoted
        if self.whole.text[first:last] != written.text:
            raise UnlikeError
        free = "" if way == _OWN else self.manner.harmless(self.whole.text, self.begin, first, last)
        any_text = bool(free) and re.fullmatch(free, written.text) is not None
        return self.group((first, last), (EXPRESSION, free) if any_text else (TEXT, written.text)), any_text

    def place(self, span: Span) -> str:
        """Return the code for the place of something."""
        return f"at, {self.group(_offsets(span), None)}"

    def keep(self, value: Any) -> str:  # noqa: ANN401 - any value
        """Return the name of something in the code."""
        name = f"known{len(self.known)}"
        self.known[name] = value
        return name

    def group(self, offsets: tuple[int, int], inside: Part | None) -> str:
        """Add a group between two offsets; return what stands for its number."""
        within = self.begin <= offsets[0] <= offsets[1] <= self.end
        if not within or self.inside.setdefault(offsets, inside) != inside:
            raise UnlikeError
        return f"@{offsets[0]}:{offsets[1]}@"

    def ordered(self) -> list[tuple[int, int]]:
        """Return the groups in the order in which they open."""
        return sorted(self.inside, key=lambda group: (group[0], -group[1]))

    def expression(self) -> list[Part]:
        """Return the expression for all texts of the form, in its parts."""
        found: list[Part] = []
        opened: list[int] = []
        at = self.begin

        def take(until: int) -> None:
            nonlocal at
            if until < at:
                raise UnlikeError
            found.append((TEXT, self.whole.text[at:until]))
            at = until

        for first, last in self.ordered():
            while opened and opened[-1] <= first:
                take(opened.pop())
                found.append((CLOSE, ""))
            take(first)
            inside = self.inside[first, last]
            found.append((OPEN, ""))
            if inside is None:
                opened.append(last)
            else:
                found += inside, (CLOSE, "")
                at = last
        while opened and opened[-1] < self.end:
            take(opened.pop())
            found.append((CLOSE, ""))
        # Lists in block form end where the next thing begins: behind all that may stand there.
        text, behind = self.manner.ending(self.whole.text[at : self.end])
        return [*found, (TEXT, text), (EXPRESSION, behind), *[(CLOSE, "")] * len(opened)]


def _offsets(span: Span) -> tuple[int, int]:
    offsets = offsets_of(span)
    if offsets is None:
        raise UnlikeError
    return offsets


@cache
def _names(model: type[Entity]) -> dict[str, str]:
    """Return the names of fields by their keys."""
    return {entry.alias or name: name for name, entry in model.model_fields.items()}


@cache
def _way(model: type[Entity], name: str) -> str:
    """Return how the text of a field, or of an item of it, is read."""
    reads = set(_reads(model.model_fields[name].annotation))
    if reads and reads <= {*_reads(Text), *_reads(Argv), *_reads(AnyValue)}:
        return _TEXT
    return _LITERAL if reads == set(_reads(Literal)) else _OWN


def _reads(annotation: Any) -> list[Any]:  # noqa: ANN401 - a type
    """Return the functions that read values of a type."""
    if isinstance(annotation, Plain):
        return [annotation.read]
    return [read for item in get_args(annotation) for read in _reads(item)]
