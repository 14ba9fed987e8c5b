"""Reads a text with substitutions: `literal $(name argument "quoted $(nested)") literal`.

The rules are those of the ROS 2 Jazzy front ends, with spaces at the edges and in runs allowed. Two of them surprise:
only U+0020 separates arguments (a tab or a line break is an ordinary character), and inside a quoted argument the
arguments of a nested substitution cannot be quoted again: the other quote is an ordinary character there.

A fault is reported and reading goes on behind it, so that one pass finds them all. What can still be evaluated in a
faulty template stays among its parts, because evaluating it finds further faults and marks variables as read.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.description.substitutions import SIGNATURES
from orchestra.description.text import Call, Template
from orchestra.errors import Code, Problems
from orchestra.load.exposed import exposed_part
from orchestra.load.parts import Parts
from orchestra.load.repeated import known_template, placed
from orchestra.load.signatures import excess, lack, one_default, usage
from orchestra.load.unquoted import BRACKETS, in_quotes, kept_quotes, phrase_meant
from orchestra.location import Span
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.description.text import Part

# How deep substitutions may nest: far more than anybody writes, far from the interpreter's recursion limit.
DEEPEST: Final = 50

_MOST_LINES: Final = 50  # of a file, with a fault each, that are read anew

_NAME = pattern(r"[A-Za-z][A-Za-z0-9_-]*")
_ESCAPE = pattern(r"\\(.)")
_QUOTES = ("'", '"')
# Characters without a meaning anywhere, and those without one outside an argument or in a quoted one.
_PLAIN = pattern(r"""[^$\\'" ()]+""")
_QUOTED_PLAIN = pattern(r"""[^$\\'"]+""")


def parse_template(
    text: str, spans: Callable[[int, int], Span], problems: Problems, *, quoted: bool = False
) -> Template:
    """Read a text as written; `spans` maps code point offsets of the text to places in the file.

    Faults go to `problems` and make the template faulty; nothing is raised.
    """
    sound = sound_template(text, spans, quoted=quoted)
    if sound is not None:
        return sound
    reader = _Reader(text, spans, problems)
    return Template(reader.parts("", "", 0), text, spans(0, len(text)), quoted, reader.faults > 0)


def sound_template(text: str, spans: Callable[[int, int], Span], *, quoted: bool = False) -> Template | None:
    """Read a short text of which there is nothing to tell; None where there is, or may be."""
    known = known_template(text, by_itself)
    return None if known is None else placed(known, spans, quoted)


def by_itself(text: str, spans: Callable[[int, int], Span], problems: Problems) -> Template:
    """Return the template that a text is to who knows no names but those of the language."""
    return Template(_Reader(text, spans, problems, others=False).parts("", "", 0), text, spans(0, len(text)))


def unescaped(text: str) -> str:
    """Return the text of a value that takes no substitutions: a backslash before a character goes away."""
    return _ESCAPE.sub(r"\1", text) if "\\" in text else text


@dataclass(slots=True)
class _Reader:
    """A place in the text; every method reads on from there."""

    text: str
    spans: Callable[[int, int], Span]
    problems: Problems
    at: int = 0
    faults: int = 0
    crowded: int | None = None  # where the last one with too many arguments begins
    lost: bool = False  # an unterminated quote or too deep a nesting took the rest of the text
    others: bool = True  # who has added substitutions to the language is asked

    def parts(self, stop: str, within: str, depth: int) -> tuple[Part, ...]:
        """Read literal text and substitutions up to the stop character, which stays unread, or to the end."""
        found = Parts(self)
        while self.at < len(self.text) and self.here != stop:
            if self.opens:
                found.substitution(within, depth)
            else:
                found.text(_QUOTED_PLAIN)
        return found.finished()

    def call(self, within: str, depth: int) -> tuple[Part, ...]:
        """Read a substitution; `within` is the quote of the argument around it, if any.

        A faulty one gives the substitutions among its arguments instead of itself.
        """
        start, before, told = self.at, self.faults, len(self.problems)
        if depth >= DEEPEST:
            self.fault(start, start + 2, f"substitutions are nested more than {DEEPEST} deep")
            self.at, self.lost = len(self.text), True
            return ()
        self.at += 2
        name, name_span = self.name(start, within)
        arguments: list[Template] = []
        first = last = self.at
        while self.separated(within):
            first = first if arguments else self.at
            arguments.append(self.argument(within, depth + 1))
            last = self.at
        if self.faults > before and not (within or self.lost):
            self.unquoted(name, first, last, told)
        if self.here == ")":
            self.at += 1
        else:
            self.not_closed(start, told, depth)
        call = Call(name, tuple(arguments), self.spans(start, self.at))
        known = len(self.problems)
        if name not in SIGNATURES:
            made = exposed_part(call, self.problems) if self.faults == before and self.others else None
            if made is not None:
                self.faults += len(self.problems) > known
                return made
        if name_span and self.known(call, name_span, last) and self.faults == before:
            self.count(call, start, first, last)
        if self.faults == before:
            return (call,)
        return tuple(part for argument in arguments for part in argument.parts if isinstance(part, Call))

    def unquoted(self, name: str, first: int, last: int, known: int) -> None:
        """Tell once of brackets in arguments without quotes, behind so many problems."""
        file = self.spans(first, last).file
        instead = phrase_meant(name, self.text[first:last], file, self.problems, known)
        if instead is not None:
            self.fault(first, last, BRACKETS, suggestion=instead)

    def not_closed(self, start: int, first: int, depth: int) -> None:
        """Report a substitution without an end, behind so many problems.

        What else seems wrong within it follows from that: one with too many arguments has the end of this one.
        """
        if not self.lost:
            from orchestra.load.unclosed import with_end  # noqa: PLC0415 - only mistakes need it

            self.problems.forget(Code.SUBSTITUTION_SYNTAX, first)
            begin = self.crowded if self.crowded is not None and self.crowded > start else start
            end, instead = with_end(self.text, begin) or (begin + 2, None)
            told = "this substitution is not closed: a ')' is missing"
            self.fault(begin, end, told, suggestion=instead)
        line = self.text.find("\n", start)
        # A file is read as one text: its other lines stay what they are.
        if not depth and line >= 0 and self.faults < _MOST_LINES:
            self.at, self.lost = line, False

    def name(self, start: int, within: str) -> tuple[str, Span | None]:
        """Read the name of a substitution; the span is None where it is malformed."""
        self.skip_spaces()
        match = _NAME.match(self.text, begin := self.at)
        if match and self.text[match.end() : match.end() + 1] in ("", " ", ")", within):
            self.at = match.end()
            return match[0], self.spans(begin, self.at)
        brackets = 0
        while self.here and self.here != within and (brackets or self.here not in " )"):
            brackets += (self.here == "(") - (self.here == ")")
            self.at += 1
        if self.at == begin:
            self.fault(start, min(begin + 1, len(self.text)), "a substitution begins with its name")
        else:
            from orchestra.load.unknown_calls import misnamed  # noqa: PLC0415 - only mistakes need it

            told, instead = misnamed(self.text[begin : self.at])
            self.fault(begin, self.at, told, suggestion=instead)
        return "", None

    def separated(self, within: str) -> bool:
        """Skip spaces and tell whether an argument begins here."""
        before = self.at
        self.skip_spaces()
        if self.here in ("", ")"):
            return False
        return self.at > before or self.here != within

    def argument(self, within: str, depth: int) -> Template:
        """Read one argument, quoted as a whole or made of adjoining pieces."""
        start, before = self.at, self.faults
        parts: tuple[Part, ...] = ()
        glued = False
        if self.here == within or (self.here in _QUOTES and not within):
            inner = self.quoted(depth)
            if self.here in ("", " ", ")"):
                if within and not self.lost:
                    self.fault(
                        start, self.at, f"inside an argument in {within} no other one can be in {within}"
                    )
                return inner if not within else self.template(inner.parts, start, self.at, before)
            parts, glued = inner.parts, True
        elif within and self.here in _QUOTES:
            self.warn_about_kept_quotes(start)
        parts += self.pieces(start, within, depth, glued=glued)
        return self.template(parts, start, self.at, before)

    def quoted(self, depth: int) -> Template:
        """Read an argument in quotes; its span leaves the quotes out."""
        quote, start, before = self.here, self.at, self.faults
        self.at += 1
        parts = self.parts(quote, quote, depth)
        end = self.at
        if self.here == quote:
            self.at += 1
        elif not self.lost:
            self.fault(start, start + 1, f"this {quote} is not closed")
            self.lost = True
        return self.template(parts, start + 1, end, before, quoted=True)

    def pieces(self, start: int, within: str, depth: int, *, glued: bool) -> tuple[Part, ...]:
        """Read the adjoining pieces of an unquoted argument that began at `start`."""
        wrong = "an argument is quoted as a whole or not at all" if glued else ""
        found = Parts(self)
        brackets = 0
        while self.here and self.here != within and (brackets or self.here not in " )"):
            if self.opens:
                found.substitution(within, depth)
                continue
            if self.here in "()":
                brackets += 1 if self.here == "(" else -1
                wrong = wrong or BRACKETS
            elif self.here in _QUOTES and not within:
                wrong = wrong or "an argument is quoted as a whole or not at all"
            elif self.text.startswith("\\ ", self.at):
                wrong = wrong or "a backslash does not join words: quote the argument"
            found.text(_PLAIN)
        if wrong and self.here and not self.lost:  # at the end, the substitution itself is not closed
            self.fault(
                start, self.at, wrong, suggestion=None if within or glued else self.in_quotes(start, self.at)
            )
        return found.finished()

    def template(
        self, parts: tuple[Part, ...], start: int, end: int, before: int, *, quoted: bool = False
    ) -> Template:
        """Return the template of a stretch of text; `before` is the number of faults found ahead of it."""
        return Template(parts, self.text[start:end], self.spans(start, end), quoted, self.faults > before)

    def known(self, call: Call, span: Span, last: int) -> bool:
        """Tell whether there is such a substitution, whose arguments end there; report its name where there is none."""
        if call.name in SIGNATURES:
            return True
        from orchestra.load.unknown_calls import tell_unknown  # noqa: PLC0415 - only mistakes need it

        self.faults += 1
        tell_unknown(call, span, self.spans(last, last), self.problems)
        return False

    def count(self, call: Call, start: int, first: int, last: int) -> None:
        """Report too few or too many arguments of the call that began at `start`; they are from `first` to `last`."""
        name, number = call.name, len(call.arguments)
        notes = (f"it is written {usage(name)}",)
        if told := lack(name, number):
            self.fault(start, self.at, told, notes=notes)
        elif told := excess(name, number):
            self.crowded, phrase = start, SIGNATURES[name].phrase
            instead = self.in_quotes(first, last) if phrase else one_default(name, call.arguments)
            whole = f"{self.text[start:first]}{instead}{self.text[last : self.at]}" if instead else None
            self.fault(start, self.at, told, suggestion=whole, notes=notes)

    def in_quotes(self, start: int, end: int) -> str | None:
        return in_quotes(self.text[start:end], self.spans(start, end).file)

    def warn_about_kept_quotes(self, start: int) -> None:
        """Say that quotes do not quote here; with backslashes the text says so itself."""
        end, suggestion = kept_quotes(self.text, start)
        told = "inside a quoted argument these quotes do not quote: they are part of the text"
        self.problems.warning(Code.SUBSTITUTION_SYNTAX, told, self.spans(start, end), suggestion=suggestion)

    def fault(
        self, start: int, end: int, told: str, *, suggestion: str | None = None, notes: Iterable[str] = ()
    ) -> None:
        """Report what keeps a stretch of the text from being read."""
        self.faults += 1
        at = self.spans(start, end)
        self.problems.error(Code.SUBSTITUTION_SYNTAX, told, at, suggestion=suggestion, notes=notes)

    def skip_spaces(self) -> None:
        while self.here == " ":
            self.at += 1

    @property
    def here(self) -> str:
        """The character to be read next, empty at the end."""
        return self.text[self.at : self.at + 1]

    @property
    def opens(self) -> bool:
        return self.text.startswith("$(", self.at)
