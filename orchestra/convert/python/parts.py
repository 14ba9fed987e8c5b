"""What several actions share in Python: parameters, remappings, pairs, conditions and Orchestra's own keywords."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.convert.argv import words_of
from orchestra.convert.comments.kept import Comments
from orchestra.convert.kinds import Kind, key_of, kind_of, short_key
from orchestra.convert.python.code import Atom, Bracket, Code, Element, a_list, call, flat_text, string
from orchestra.convert.python.texts import Texts
from orchestra.convert.python.values import number, value
from orchestra.convert.remarks import UnsayableError
from orchestra.convert.words import ordered
from orchestra.dataclass import dataclass
from orchestra.description.entity import Conditional, Entity
from orchestra.description.fields import TRUE_WORDS
from orchestra.description.parts import Override, Pair, Param, Remap
from orchestra.description.text import Constant, Template

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

# Keys of Orchestra's own that hold a text or a list of texts.
_SEVERAL: Final = frozenset({"cores"})


@dataclass(frozen=True, slots=True)
class Parts:
    """Writes the parts of actions of one file."""

    texts: Texts
    comments: Comments

    def flag(self, template: Template) -> Code:
        """Return True or False, or what comes to it."""
        constant = template.constant
        return (
            self.texts.of(template) if constant is None else Atom(str(constant.strip().lower() in TRUE_WORDS))
        )

    def fixed(self, template: Template) -> Atom:
        """Return True or False where Python takes nothing else. Raises `UnsayableError`."""
        code = self.flag(template)
        if not isinstance(code, Atom):
            raise UnsayableError("in Python this is True or False, no substitution", template.span)
        return code

    def plain(self, template: Template) -> Code:
        """Return a number or a truth value as such, any other text as a text."""
        constant = template.constant
        literal = None if constant is None else number(constant)
        return self.texts.of(template) if literal is None else literal

    def condition(self, entity: Conditional) -> Iterator[Element]:
        """Yield the condition of an action."""
        for field, name in (("if_", "IfCondition"), ("unless", "UnlessCondition")):
            template = getattr(entity, field)
            if template is not None:
                code = call(self.texts.name(name), [Element(self.texts.of(template))])
                yield Element(code, "condition=", self.comments.of(entity, field))

    def pairs(self, pairs: Iterable[Pair]) -> Bracket:
        """Return names and values as a dictionary: of those with one name the last counts."""
        elements: dict[str, Element] = {}
        for pair in pairs:
            key = self._key(pair.name)
            elements[key] = Element(self.texts.of(pair.value), f"{key}: ", self.comments.within(pair))
        return Bracket("{", tuple(elements.values()), "}")

    def paired(self, pairs: Iterable[Pair]) -> Bracket:
        """Return names and values as a list of pairs, in which a name may stand twice."""
        items = (
            Element(self._tuple(pair.name, pair.value), "", self.comments.within(pair)) for pair in pairs
        )
        return Bracket("[", tuple(items), "]")

    def rules(self, rules: Iterable[Remap]) -> Bracket:
        """Return remapping rules."""
        return Bracket(
            "[",
            tuple(
                Element(self._tuple(rule.from_, rule.to), "", self.comments.within(rule)) for rule in rules
            ),
            "]",
        )

    def parameters(self, params: Iterable[Param], *, quotes: bool = True) -> Bracket:
        """Return parameters: neighbours in one dictionary, files between them."""
        found: list[Element] = []
        for param in params:
            if param.from_ is not None:
                found.append(Element(self._file(param), "", self.comments.within(param)))
            elif isinstance(param, Override):
                found.append(Element(self._override(param), "", self.comments.within(param)))
            else:
                for entry in self.nested(param, quotes=quotes):
                    _put(found, entry)
        return Bracket("[", tuple(found), "]")

    def nested(self, param: Param, *, quotes: bool) -> Iterator[Element]:
        """Yield the entries of dictionaries that say a parameter: several where one dictionary cannot hold them."""
        assert param.name is not None  # noqa: S101 - the caller has asked
        lead, notes = f"{self._key(param.name)}: ", self.comments.within(param)
        if param.param is None:
            assert param.value is not None  # noqa: S101 - the caller has asked
            yield Element(value(param.value, param.type, self.texts, quotes=quotes), lead, notes)
            return
        for inner in self.dictionaries(param.param, quotes=quotes):
            yield Element(inner, lead, notes)
            notes = type(notes)()

    def dictionaries(self, params: Iterable[Param], *, quotes: bool) -> list[Bracket]:
        """Return parameters as dictionaries, as few as can hold them."""
        found: list[Element] = []
        for param in params:
            for entry in self.nested(param, quotes=quotes):
                _put(found, entry)
        return [element.item for element in found if isinstance(element.item, Bracket)] or [
            Bracket("{", (), "}")
        ]

    def words(self, argv: Template | tuple[Template, ...]) -> Bracket:
        """Return the words of a command, each a text."""
        return a_list(self.texts.of(word) for word in words_of(argv))

    def extension(self, value: Any, kind: Kind) -> Code:  # noqa: ANN401 - a part of a description, whatever it is
        """Return the value of one of Orchestra's own keywords: plain values, lists and dictionaries of them."""
        if isinstance(value, Entity):
            return self.keyed(value)
        if isinstance(value, Constant):
            return string(str(value.value)) if kind is not Kind.VALUE else _typed(value, self.texts)
        if isinstance(value, tuple):
            return a_list(self.extension(item, kind) for item in value)
        if isinstance(value, dict):
            items = (
                Element(self._several(item, kind), f"{string(key).text}: ") for key, item in value.items()
            )
            return Bracket("{", tuple(items), "}")
        return self.flag(value) if kind is Kind.FLAG else self.plain(value)

    def keyed(self, entity: Entity, short: str | None = None) -> Code:
        """Return a part as a dictionary, or as the one value that is short for it."""
        model = type(entity)
        elements = []
        for field in ordered(entity):
            inner = getattr(entity, field)
            if inner is None or inner == ():
                continue
            code = self._inner(entity, field, inner)
            notes = self.comments.of(entity, field)
            elements.append(Element(code, f"{string(key_of(model, field)).text}: ", notes))
            if field == short and sum(getattr(entity, name) is not None for name in model.model_fields) == 1:
                return code
        return Bracket("{", tuple(elements), "}")

    def _inner(self, entity: Entity, field: str, inner: Any) -> Code:  # noqa: ANN401 - a part of a description, whatever it is
        kind = kind_of(type(entity), field)
        if kind is Kind.VALUE:
            return value(inner, None, self.texts, quotes=True)
        if kind is Kind.ARGV:
            return self.words(inner)
        if isinstance(inner, Entity):
            return self.keyed(inner, short_key(type(entity), field))
        return self._several(inner, kind) if field in _SEVERAL else self.extension(inner, kind)

    def _several(self, value: Any, kind: Kind) -> Code:  # noqa: ANN401 - a part of a description, whatever it is
        """Return a text, or a list of several, where a list is no text in parts."""
        return self.texts.whole(value) if isinstance(value, Template) else self.extension(value, kind)

    def _key(self, template: Template) -> str:
        code = self.texts.key(template)
        if isinstance(code, Atom):
            return code.text
        items = [element.item for element in code.elements]
        flat = ", ".join(_flat(item) for item in items)
        return f"{code.start}{flat}{code.end}"

    def _tuple(self, *templates: Template) -> Bracket:
        return Bracket("(", tuple(Element(self.texts.of(template)) for template in templates), ")")

    def _file(self, param: Param) -> Code:
        assert param.from_ is not None  # noqa: S101 - the caller has asked
        code = self.texts.of(param.from_)
        is_list = isinstance(code, Bracket) and code.start == "["
        if param.allow_substs is None and not is_list:
            return code
        elements = [Element(code)]
        if param.allow_substs is not None:
            elements.append(Element(self.fixed(param.allow_substs), "allow_substs="))
        return call(self.texts.name("ParameterFile"), elements)

    def _override(self, param: Override) -> Code:
        raise UnsayableError("a parameter for all nodes of a process", param.span)


def _put(found: list[Element], entry: Element) -> None:
    """Add an entry to the dictionary that stands last, unless that has such a key."""
    last = found[-1].item if found else None
    if (
        isinstance(last, Bracket)
        and last.start == "{"
        and entry.lead not in [item.lead for item in last.elements]
    ):
        found[-1] = Element(Bracket("{", (*last.elements, entry), "}"), "", found[-1].notes)
    else:
        found.append(Element(Bracket("{", (entry,), "}")))


def _typed(constant: Constant, texts: Texts) -> Code:
    return value(constant, None, texts, quotes=True)


def _flat(item: Code | None) -> str:
    return (flat_text(item) if item is not None else None) or ""
