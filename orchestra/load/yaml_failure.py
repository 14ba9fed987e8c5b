"""Where a parser of YAML gave up, and what it had read before: the ground on which its failure is explained."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass
from orchestra.load.conflicts import TOLD, conflict_in
from orchestra.load.faults import Fault
from orchestra.load.offsets import Source
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    from collections.abc import Iterator

_PARSER: type[Any] = getattr(yaml, "CBaseLoader", yaml.BaseLoader)

_WORD = re.compile(r"[^\s:,\[\]{}#]+")
_INNER = re.compile(r"\[[^][{}]*\]|\{[^][{}]*\}")
_QUOTES: Final = ("'", '"')
_OPENS: Final = " \t\n[{(,:"
_FOLLOWS: Final = " \t\r\n,]}:#"


@dataclass(frozen=True, slots=True)
class Piece:
    """A scalar that the parser has read: where it is, and whether it is in quotes."""

    begin: int
    end: int
    quoted: bool


@dataclass(frozen=True, slots=True)
class Failure:
    """Where the parser gave up (`at`), what it was busy with from where on (`context`), and its own words."""

    whole: Source
    at: int
    context: int
    problem: str
    doing: str

    @property
    def text(self) -> str:
        """The whole text."""
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
        return self.place(offset)[0]

    def place(self, offset: int) -> tuple[int, int]:
        """Return line and column in the text as the parser sees it, which may be a mended one."""
        return Source.place(self.whole, offset)

    def indentation(self, offset: int) -> int:
        """Return how far the line is indented; the dashes of items count as blanks."""
        line = self.text[self.whole.lines[self.line_of(offset) - 1] :]
        return len(line) - len(line.lstrip(" -"))

    def line_end(self, begin: int) -> int:
        """Return where the text of a line that stands from here on ends, comments left out."""
        line = re.split(r"[\r\n]|\s#", self.text[begin:], maxsplit=1)[0]
        return begin + len(line.rstrip())

    def pieces(self) -> list[Piece]:
        """Return the scalars that come before the failure."""
        return [
            Piece(token.start_mark.index, token.end_mark.index, token.style in _QUOTES)
            for token in self._tokens()
            if isinstance(token, yaml.ScalarToken)
        ]

    def opening(self) -> int | None:
        """Return where the innermost bracket stands that is open at the failure."""
        found: list[int] = []
        for token in self._tokens():
            if isinstance(token, yaml.FlowSequenceStartToken | yaml.FlowMappingStartToken):
                found.append(token.start_mark.index)
            elif isinstance(token, yaml.FlowSequenceEndToken | yaml.FlowMappingEndToken) and found:
                found.pop()
        return found[-1] if found else None

    def _tokens(self) -> Iterator[Any]:
        """Yield the tokens that begin before the failure."""
        try:
            for token in yaml.scan(self.text, Loader=_PARSER):
                if token.start_mark.index >= self.at:
                    return
                yield token
        except yaml.YAMLError:
            pass  # the failure itself

    def of_conflict(self) -> Fault | None:
        """Return the fault of a merge whose conflict is left in the text, None where it is none of that."""
        found = conflict_in(self.text)
        return None if found is None else self.fault(TOLD, *found)

    def of_quotes(self) -> Fault | None:
        """Return the fault of a quote that is missing or stands in a quoted text, None where it is none of that."""
        pieces = self.pieces()
        for piece in pieces:
            if piece.quoted and self.is_next(piece):
                return self.unclosed(piece.begin)
        last = pieces[-1] if pieces else None
        if last is None or not last.quoted or last.end != self.at or self.here in _FOLLOWS:
            return None
        quote = self.text[last.begin]
        escaped = "''" if quote == "'" else '\\"'
        message = f"this {quote} ends the text: inside {quote} it is written {escaped}"
        return self.fault(message, last.end - 1, last.end, escaped)

    def is_next(self, piece: Piece) -> bool:
        """Return whether the quote that ends a text is rather the beginning of another one."""
        before, behind = self.text[piece.end - 2], self.text[piece.end : piece.end + 1]
        if self.line_of(piece.begin) == self.line_of(piece.end):
            before = "," if self.text[piece.begin : piece.end - 1].rstrip()[-1:] == "," else "."
        return before in _OPENS and behind not in _FOLLOWS and behind != ""

    def unclosed(self, begin: int) -> Fault:
        """Return the fault of a quote without its other half."""
        return self.fault(f"this {self.text[begin]} is not closed", begin, begin + 1)

    def is_open(self, closer: str, own: str) -> bool:
        """Return whether a bracket is open that this one closes; `own`, which closes the innermost one, may follow."""
        opener = "[" if closer == "]" else "{"
        before, behind = self.text[: self.context], self.text[self.at : self.line_end(self.at)]
        return before.count(opener) > before.count(closer) or own in behind

    @property
    def holds_pairs(self) -> bool:
        """Whether there are names with values in the brackets that are read, others in it left out."""
        return ": " in _INNER.sub("", self.text[self.context + 1 : self.at])

    @property
    def is_doubled(self) -> bool:
        """Whether the list that does not go on was begun by the second of two dashes, as in `- - name: a`."""
        begin = self.whole.lines[self.line_of(self.context) - 1]
        before = self.text[begin : self.context].strip()
        return before == "-" and self.text.startswith("- ", self.context) and "'-'" in self.problem
