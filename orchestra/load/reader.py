"""What the models ask of a loader: reading texts by the substitution grammar, and reporting what is wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass
from orchestra.description.entity import REPORTED
from orchestra.description.fields import STRAY_KEY
from orchestra.description.source import Keyed, Listed, Verbatim, Written, kind_of
from orchestra.description.text import Template, new_template, new_words
from orchestra.errors import Code, Problems
from orchestra.fields import field, replace
from orchestra.load.elements import beginning_of, noun, place_of
from orchestra.load.grammar import parse_template, sound_template, unescaped
from orchestra.load.halves import Halves
from orchestra.load.keys import known_keys
from orchestra.load.pairs import (
    NESTED,
    are_mappings,
    as_mappings,
    extent,
    nested_list,
    written_as_list,
    written_list,
    written_pair,
    written_so,
    written_two,
)
from orchestra.load.plain_calls import BARE
from orchestra.load.unquoted import ends_half_quoted
from orchestra.location import Location, Span

if TYPE_CHECKING:
    import re
    from collections.abc import Iterable, Sequence

    from pydantic_core import ErrorDetails

    from orchestra.description.conflict import Conflict


_WANTED = {
    "model_type": "a mapping",
    "dict_type": "a mapping",
    "list_type": "a list",
    "tuple_type": "a list",
}
_QUOTES = ("'", '"')
_SIGNS = "%@&#"  # that other languages have in place of the '$'
_LISTS = ("list_type", "tuple_type")


@dataclass(slots=True)
class Reader:
    """Reads one file, which is `text`; everything it reports carries the includes on the way to that file."""

    problems: Problems
    included_from: tuple[Span, ...] = ()
    text: str = ""
    halves: Halves = field(init=False)

    def __post_init__(self) -> None:
        self.halves = Halves(self.problems)

    def error(
        self,
        code: Code,
        message: str,
        span: Span,
        *,
        suggestion: str | None = None,
        notes: Iterable[str] = (),
    ) -> None:
        """Report an error in this file."""
        self.problems.error(
            code, message, Location(span, self.included_from), suggestion=suggestion, notes=notes
        )

    def warning(self, code: Code, message: str, span: Span, *, suggestion: str | None = None) -> None:
        """Report a warning in this file."""
        self.problems.warning(code, message, Location(span, self.included_from), suggestion=suggestion)

    def template(self, written: Written) -> Template:
        """Read a text with substitutions."""
        text = written.text
        if text[-1:] in _QUOTES and not written.quoted and ends_half_quoted(written):
            told = f"the {text[-1]} at the end of '{text}' is part of the text: nothing opens it"
            self.warning(Code.SURPRISING_SCALAR, told, written.inside, suggestion=text[-1] + text)
        if "(" in text and (bare := BARE.search(text)) is not None and self._is_lost(bare, written):
            return Template((), text, written.inside, written.quoted, faulty=True)
        if text and "$" not in text and "\\" not in text:
            span = written.inside if written.quoted or type(written) is not Verbatim else written.span
            return new_template((new_words(text, span),), text, span, written.quoted)
        braces = "${" in text or "$[" in text
        sound = None if braces else _sound(written)
        if sound is not None:
            return sound
        found = Problems()
        lost = False
        if braces:
            from orchestra.load.braces import report_braces  # noqa: PLC0415 - hardly any text has them

            lost = report_braces(text, written.spans, found)
        template = parse_template(text, written.spans, found, quoted=written.quoted)
        for problem in found:
            self.problems.report(replace(problem, included_from=self.included_from))
        return replace(template, faulty=True) if lost else template

    def _is_lost(self, bare: re.Match[str], written: Written) -> bool:
        """Report a substitution without its '$', or before its bracket; return whether nothing else is meant."""
        if bare[2] is not None:
            told = f"{bare[0]} is no substitution: the name stands behind the bracket"
            instead = f"$({f'{bare[2]} {bare[3]}'.strip()})"
            at = written.spans(*bare.span())
            self.warning(Code.SUBSTITUTION_SYNTAX, told, at, suggestion=instead)
            return False
        sign = bare[0][0] if bare[0][0] in _SIGNS else ""
        certain = bare[1] != "var" or sign != ""
        report = self.error if certain else self.warning
        lacks = f"in place of the '{sign}'" if sign else "before it"
        told = f"{bare[0]} is no substitution: a '$' is missing {lacks}"
        instead = f"${bare[0].lstrip(_SIGNS + '$ ')}"
        report(Code.SUBSTITUTION_SYNTAX, told, written.spans(*bare.span()), suggestion=instead)
        return certain

    def literal(self, written: Written) -> str:
        """Read a text without substitutions."""
        return unescaped(written.text)

    def keys(self, known: frozenset[str], mapping: Keyed, required: frozenset[str] = frozenset()) -> Keyed:
        """Return the mapping with no key but those that are known; others are reported.

        `required` are those of them that cannot be missing.
        """
        return known_keys(known, mapping, self.error, required)

    def faults(self, mapping: Keyed, errors: Sequence[ErrorDetails]) -> set[str]:
        """Report what is wrong with the values of a mapping, return the keys that are concerned.

        A key that is missing because it is probably misspelt stays silent, for that has been reported.
        """
        if self.halves.joined(mapping):
            return set(mapping)
        places = [error["loc"] for error in errors]
        for error in errors:
            place = error["loc"]
            misspelt = error["type"] == "missing" and place[-1] in mapping.meant
            fewer = error["type"] == "too_short" and any(
                other[: len(place)] == place and other != place for other in places
            )
            if error["type"] == REPORTED or misspelt or fewer:
                continue
            plain = _among_texts(mapping, error)
            if place[:1] == ("choices",) and are_mappings(mapping.get("choices")):
                message = (
                    "'choices' is a list of values; where each is a mapping with 'value', the key is 'choice'"
                )
                at = mapping.keys_at["choices"]
                self.error(Code.WRONG_TYPE, message, at, suggestion="choice")
            elif plain == "choice":
                span, instead = as_mappings(mapping[plain], self.text)
                message = "each value of 'choice' is a mapping with 'value'; a list of values is 'choices'"
                self.error(Code.WRONG_TYPE, message, span, suggestion=instead)
            elif plain != "":
                self._fault(mapping, error)
        self.halves.told(mapping)
        return {str(error["loc"][0]) for error in errors if error["loc"]}

    def conflict(self, mapping: Keyed, conflict: Conflict) -> None:
        """Report keys that cannot stand together, at the last that is too many."""
        if self.halves.joined(mapping):
            return
        too_many = sorted((at, key) for key, at in mapping.keys_at.items() if key in conflict.keys)
        at = too_many[-1][0] if too_many else mapping.head
        notes = [f"`{key}` is at {place}" for place, key in too_many[:-1]]
        self.error(Code.CONFLICTING_KEYS, conflict.reason, at, notes=notes)
        self.halves.told(mapping)

    def _fault(self, mapping: Keyed, error: ErrorDetails) -> None:
        kind = error["type"]
        place = error["loc"]
        if kind == "missing":
            missing = noun(mapping, str(place[-1]))
            self.error(Code.MISSING_KEY, f"the {missing} is missing", _way(mapping, place[:-1])[0])
            return
        if kind in _WANTED:
            message = f"expected {_WANTED[kind]}, found {kind_of(error['input'])}"
        elif kind == "too_short":
            message = "expected at least one item, found none"
        else:
            message = error["msg"]
        key = str(place[-1])
        suggestion = error.get("ctx", {}).get("suggestion") or written_as_list(key, error["input"])
        if (
            suggestion is None
            and kind == "wrong_type"
            and key != "type"
            and isinstance(error["input"], Written)
        ):
            # Here, because only mistakes need it.
            from orchestra.load.expressions import as_substitutions  # noqa: PLC0415

            suggestion = as_substitutions(error["input"].text, self.text)
        head, value = _way(mapping, place)
        if isinstance(value, Written) and value.null and suggestion is None:
            # Here, because only mistakes need it.
            from orchestra.load.eaten import EATEN, eaten  # noqa: PLC0415

            suggestion = eaten(head, self.text.split("\n"))
            message += EATEN if suggestion is not None else ""
        if kind == STRAY_KEY:
            self.error(Code.UNKNOWN_KEY, message, head, suggestion=suggestion)
            return
        if isinstance(error["input"], Listed) and (nested := nested_list(mapping, place)) is not None:
            self.error(Code.WRONG_TYPE, NESTED, nested[0], suggestion=nested[1])
            return
        at, notes = place_of(value, head), list[str]()
        if suggestion is None and type(mapping) is Keyed:
            at, suggestion = self._instead(place, value, at)
        if (
            kind in _LISTS
            and suggestion is None
            and (instead := written_list(key, error["input"])) is not None
        ):
            notes.append(f"it is written {instead}")
        self.error(Code.WRONG_TYPE, message, at, suggestion=suggestion, notes=notes)

    def _instead(
        self,
        place: tuple[int | str, ...],
        value: Any,  # noqa: ANN401 - a tree
        at: Span,
    ) -> tuple[Span, str | None]:
        """Return what to point at for a value that is no list or no item of one, and how it is written; of XML nothing.

        A block that begins below its key is written anew with it.
        """
        if isinstance(place[-1], str):
            instead = written_so(place[-1], value)
        elif isinstance(value, Written) and len(place) > 1:
            instead = written_pair(str(place[-2]), value)
        elif isinstance(value, Listed) and len(place) > 1:
            instead = written_two(str(place[-2]), value)
        else:
            instead = None
        whole = None if instead is None else extent(value)
        if whole is None:
            return at, None
        if at.end_line >= whole.line:
            return whole, instead
        key = self.text.split("\n")[at.line - 1][at.column - 1 : at.end_column - 1]
        return replace(at, end_line=whole.end_line, end_column=whole.end_column), f"{key}: {instead}"


def _sound(written: Written) -> Template | None:
    """Return a text of which there is nothing to tell; else None."""
    late = None
    if type(written) is Written:
        from orchestra.load.nested import spread  # noqa: PLC0415 - most texts stand in their file as they read

        late = spread(written)
    return late or sound_template(written.text, written.spans, quoted=written.quoted)


def _among_texts(mapping: Keyed, error: ErrorDetails) -> str | None:
    """Return the key of a list of nothing but texts where mappings are wanted, of which the first is wrong.

    Empty for those behind the first, which are one mistake with it; None for any other fault.
    """
    key, *rest = error["loc"] or ("",)
    items = mapping.get(str(key))
    if error["type"] != "model_type" or len(rest) != 1 or not isinstance(items, Listed):
        return None
    if not all(isinstance(item, Written) for item in items):
        return None
    return str(key) if rest[0] == 0 else ""


def _way(mapping: Keyed, place: tuple[int | str, ...]) -> tuple[Span, Any]:
    """Return what is at the end of a way into a mapping: the place of its key or of its item, and the value."""
    value: Any = mapping
    span = mapping.head
    for step in place:
        if isinstance(value, Keyed) and step in value:
            span = value.keys_at[str(step)]
            value = value[str(step)]
        elif isinstance(value, Listed) and isinstance(step, int) and step < len(value):
            value = value[step]
            span = beginning_of(value, span)
        else:
            break
    return span, value
