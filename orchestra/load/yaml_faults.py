"""Why a text is no YAML, in the words of who wrote it: the parser's own point behind the cause, often lines behind.

What the parser has told apart before it gave up (its tokens) is looked at again: a quote that ends on another line
than it begins, a key without its colon, a bracket that is open still.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import yaml

from orchestra.description.source import shortened
from orchestra.load.faults import Fault
from orchestra.load.offsets import Source
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Callable


_PARSER: type[Any] = getattr(yaml, "CBaseLoader", yaml.BaseLoader)

_WORD = re.compile(r"[^\s:,\[\]{}#]+")
_PLAIN = re.compile(r"[^\s,\]}#](?:[^\n,\]}#]*[^\s,\]}#])?")
_ANCHOR = re.compile(r"&([^\s,\[\]{}]+)")
_ALIAS = re.compile(r"\*([^\s,\[\]{}]*)")
_CONTROL = re.compile("[^\t\n\r -~\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_QUOTES: Final = ("'", '"')
_OPENS: Final = " \t\n[{(,:"
_FOLLOWS: Final = " \t\r\n,]}:#"
_CLOSERS: Final = {"[": "]", "{": "}"}


def explained(error: yaml.YAMLError, whole: Source) -> Fault:
    """Return the fault behind an error of PyYAML."""
    if not isinstance(error, yaml.MarkedYAMLError):
        return _no_character(error, whole)
    mark = error.problem_mark or error.context_mark
    at = _offset(mark, whole) if mark is not None else 0
    context = _offset(error.context_mark, whole) if error.context_mark is not None else at
    failure = _Failure(whole, at, context, error.problem or "", error.context or "")
    return failure.of_quotes() or _explanation(failure)(failure) or failure.plainly()


@dataclass(frozen=True, slots=True)
class _Piece:
    """A scalar that the parser has read: where it is, and whether it is in quotes."""

    begin: int
    end: int
    quoted: bool


@dataclass(frozen=True, slots=True)
class _Failure:
    """Where the parser gave up (`at`), what it was busy with from where on (`context`), and its own words."""

    whole: Source
    at: int
    context: int
    problem: str
    doing: str

    @property
    def text(self) -> str:
        return self.whole.text

    @property
    def here(self) -> str:
        """The character at which the parser gave up."""
        return self.text[self.at : self.at + 1]

    def fault(self, message: str, begin: int, end: int, suggestion: str | None = None) -> Fault:
        """Return a fault of a stretch of the text."""
        return Fault(f"this is not YAML: {message}", self.whole.span(begin, end), suggestion=suggestion)

    def plainly(self) -> Fault:
        """Return what the parser says, at the word where it says so."""
        message = ", ".join(part for part in (self.doing, self.problem) if part)
        return self.fault(message, self.at, self.end_of_word(self.at))

    def end_of_word(self, begin: int) -> int:
        """Return where a word ends, a character at least; the end of the text has none."""
        found = _WORD.match(self.text, begin)
        return found.end() if found else min(begin + 1, len(self.text))

    def line_of(self, offset: int) -> int:
        """Return the number of the line."""
        return self.whole.place(offset)[0]

    def line_end(self, begin: int) -> int:
        """Return where the text of a line that stands from here on ends, comments left out."""
        line = re.split(r"[\r\n]|\s#", self.text[begin:], maxsplit=1)[0]
        return begin + len(line.rstrip())

    def pieces(self) -> list[_Piece]:
        """Return the scalars that come before the failure."""
        found: list[_Piece] = []
        try:
            for token in yaml.scan(self.text, Loader=_PARSER):
                if token.start_mark.index >= self.at:
                    break
                if isinstance(token, yaml.ScalarToken):
                    begin, end = token.start_mark.index, token.end_mark.index
                    found.append(_Piece(begin, end, token.style in _QUOTES))
        except yaml.YAMLError:
            pass  # the failure itself
        return found

    def of_quotes(self) -> Fault | None:
        """Return the fault of a quote that is missing or stands in a quoted text, None where it is none of that."""
        pieces = self.pieces()
        for piece in pieces:
            if piece.quoted and self.line_of(piece.begin) < self.line_of(piece.end) and self.is_next(piece):
                return self.unclosed(piece.begin)
        last = pieces[-1] if pieces else None
        if last is None or not last.quoted or last.end != self.at or self.here in _FOLLOWS:
            return None
        quote = self.text[last.begin]
        escaped = "''" if quote == "'" else '\\"'
        message = f"this {quote} ends the text: inside {quote} it is written {escaped}"
        return self.fault(message, last.end - 1, last.end, escaped)

    def is_next(self, piece: _Piece) -> bool:
        """Return whether the quote that ends a text of several lines is rather the beginning of another one."""
        before, behind = self.text[piece.end - 2], self.text[piece.end : piece.end + 1]
        return before in _OPENS and behind not in _FOLLOWS and behind != ""

    def unclosed(self, begin: int) -> Fault:
        """Return the fault of a quote without its other half."""
        return self.fault(f"this {self.text[begin]} is not closed", begin, begin + 1)


def _explanation(failure: _Failure) -> Callable[[_Failure], Fault | None]:
    return next(
        (explain for said, explain in _EXPLANATIONS.items() if said in failure.problem),
        lambda _failure: None,
    )


def _stray(failure: _Failure) -> Fault | None:
    """Explain a character that begins nothing."""
    if failure.here == "\t":
        return _tab(failure)
    found = _PLAIN.match(failure.text, failure.at)
    if found is None:
        return None
    message = f"a text cannot begin with {failure.here} unless it is in quotes"
    return failure.fault(message, *found.span(), _in_quotes(found[0]))


def _tab(failure: _Failure) -> Fault:
    begin = failure.whole.lines[failure.line_of(failure.at) - 1]
    first = failure.text.find("\t", begin, failure.at + 1)
    at = first if first >= 0 else failure.at
    return failure.fault("a tab cannot indent", at, at + 1)


def _ended(failure: _Failure) -> Fault | None:
    return failure.unclosed(failure.context) if "quoted scalar" in failure.doing else None


def _open(failure: _Failure) -> Fault:
    """Explain a list or mapping in brackets in which something else stands than a comma or the end."""
    opening = failure.text[failure.context]
    closer = _CLOSERS.get(opening, "]")
    last = next((piece for piece in reversed(failure.pieces()) if piece.begin > failure.context), None)
    around = last.end if last is not None and last.end <= failure.at else failure.at
    begun = last.begin if last is not None else failure.context
    begun_earlier = failure.line_of(begun) < failure.line_of(failure.at) and not failure.here.isalnum()
    if failure.here in ("", *"]}") or begun_earlier or "\n" in failure.text[around : failure.at]:
        message = f"this {opening} is not closed: a {closer} is missing"
        return failure.fault(message, failure.context, failure.context + 1)
    begin = failure.at
    if failure.here == ":" and last is not None and last.end == failure.at and not last.quoted:
        begin = last.begin + len(re.split(r"\S+$", failure.text[last.begin : last.end])[0])
    end = failure.end_of_word(begin)
    message = f"a ',' or '{closer}' is missing before '{shortened(failure.text[begin:end])}'"
    return failure.fault(message, begin, end)


def _second_value(failure: _Failure) -> Fault | None:
    """Explain a colon behind what can be no key: a value, or a key over several lines."""
    last = next((piece for piece in reversed(failure.pieces()) if piece.end <= failure.at), None)
    colon = failure.fault("a text with ': ' in it needs quotes", failure.at, failure.at + 1)
    if last is None or last.quoted or failure.line_of(last.begin) == failure.line_of(failure.at):
        return colon
    line = failure.whole.lines[failure.line_of(last.begin) - 1]
    if re.search(r":\s+$", failure.text[line : last.begin]):
        begin = last.begin + failure.text[last.begin : last.end].rfind("\n") + 1
        begin += len(failure.text[begin : last.end]) - len(failure.text[begin : last.end].lstrip())
        word = shortened(failure.text[begin : last.end])
        return failure.fault(f"'{word}' is indented too far: the line above has a value", begin, last.end)
    return _without_colon(failure, last.begin)


def _without_colon(failure: _Failure, begin: int) -> Fault:
    """Explain a key whose colon, or the blank behind it, is missing."""
    end = failure.line_end(begin)
    written = failure.text[begin:end]
    if ":" in written:
        name, _, value = written.partition(":")
        return failure.fault(f"a blank is missing behind '{name}:'", begin, end, f"{name}: {value}")
    name, blank, value = written.partition(" ")
    value = re.sub(r"^=\s*", "", value.lstrip())
    meant = f"{name}: {value}" if blank and " " not in value else f"{name}:" if not blank else None
    return failure.fault(f"a ':' is missing behind '{shortened(name)}'", begin, end, meant)


def _no_key(failure: _Failure) -> Fault | None:
    """Explain what stands where a key of a mapping is expected."""
    if failure.here in ("]", "}"):
        return failure.fault(f"'{failure.here}' closes nothing", failure.at, failure.at + 1)
    begin = failure.whole.lines[failure.line_of(failure.at) - 1]
    if failure.text[begin : failure.at].strip():
        return failure.fault("the value has ended before this", failure.at, failure.end_of_word(failure.at))
    message = "this is indented as nothing above it is"
    return failure.fault(message, failure.at, failure.end_of_word(failure.at))


def _no_item(failure: _Failure) -> Fault | None:
    begin, end = failure.at, failure.end_of_word(failure.at)
    word = failure.text[begin:end]
    column = failure.whole.place(begin)[1]
    if column != failure.whole.place(failure.context)[1]:
        return failure.fault("this is indented as nothing above it is", begin, end)
    return failure.fault("an item of the list begins with '- '", begin, end, f"- {word}")


def _key_without_colon(failure: _Failure) -> Fault:
    return _without_colon(failure, failure.context)


def _item_in_line(failure: _Failure) -> Fault:
    return failure.fault(
        "a list begins on a line of its own, or is written [a, b]", failure.at, failure.at + 1
    )


def _undefined_alias(failure: _Failure) -> Fault:
    found = _ALIAS.match(failure.text, failure.at)
    name = found[1] if found else ""
    near = nearest(name, _ANCHOR.findall(failure.text, 0, failure.at))
    message = f"no anchor &{name} stands before this alias"
    end = found.end() if found else failure.at + 1
    return failure.fault(message, failure.at, end, f"*{near}" if near else None)


def _no_anchor(failure: _Failure) -> Fault:
    """Explain a text that begins like an alias, an anchor or a block."""
    found = _PLAIN.match(failure.text, failure.context)
    end = found.end() if found else failure.context + 1
    first = failure.text[failure.context]
    written = failure.text[failure.context : end]
    message = f"a text cannot begin with {first} unless it is in quotes"
    return failure.fault(message, failure.context, end, _in_quotes(written))


def _escape(failure: _Failure) -> Fault:
    at = failure.text.rfind("\\", 0, failure.at + 1)
    written = failure.text[at : at + 2]
    message = f"{written} means nothing in double quotes: a backslash is written \\\\ there"
    return failure.fault(message, at, at + 2, f"\\{written}")


def _no_character(error: yaml.YAMLError, whole: Source) -> Fault:
    found = _CONTROL.search(whole.text)
    if found is None:
        return Fault(f"this is not YAML: {shortened(str(error), 200)}", whole.span(0, 0))
    message = f"this is not YAML: a file cannot hold the character U+{ord(found[0]):04X}"
    return Fault(message, whole.span(*found.span()))


def _offset(mark: Any, whole: Source) -> int:  # noqa: ANN401 - a mark of either parser
    return min(mark.index, len(whole.text))


def _in_quotes(text: str) -> str | None:
    return next(
        (f"{quote}{text}{quote}" for quote in _QUOTES if quote not in text and "\\" not in text), None
    )


_EXPLANATIONS: Final[dict[str, Callable[[_Failure], Fault | None]]] = {
    "found character that cannot start any token": _stray,
    "found a tab character": _tab,
    "found unexpected end of stream": _ended,
    "did not find expected ',' or": _open,
    "mapping values are not allowed": _second_value,
    "could not find expected ':'": _key_without_colon,
    "did not find expected key": _no_key,
    "did not find expected '-' indicator": _no_item,
    "block sequence entries are not allowed": _item_in_line,
    "found undefined alias": _undefined_alias,
    "did not find expected alphabetic or numeric character": _no_anchor,
    "did not find expected comment or line break": _no_anchor,
    "found unknown escape character": _escape,
}
