"""Comments that silence problems: `orchestra: ignore`, for some codes `orchestra: ignore[ORC013, ORC026]`.

A comment counts for its line; one that stands on a line of its own for the next line that has something on it. In
Python a comment on the first line of a statement counts for the whole statement, in XML one beside a tag for all the
lines of that tag, since none can stand inside. Only comments count: each language's own tokens tell what is one.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.location import Span
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

MARK: Final = "orchestra:"
_ASKED: Final = pattern(r"(?:#+|<!--)\s*orchestra:\s*ignore\b(?:\s*\[([^\]\n]*)\])?")
_BREAK: Final = pattern("\r\n|[\n\r]")
_YAML_BREAK: Final = pattern("\r\n|[\n\r\x85\u2028\u2029]")
_EITHER: Final = ".launch"  # XML or YAML
_CODE: Final = pattern(r"[^\s,]+")
_XML: Final = pattern(
    r"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<\?.*?\?>|</?[A-Za-z_](?:[^\"'<>]++|\"[^\"]*+\"|'[^']*+')*+>", re.DOTALL
)

# Offsets of comments, and ranges of offsets whose lines belong together.
_Found: TypeAlias = tuple[list[int], list[tuple[int, int]]]


@dataclass(frozen=True, slots=True)
class Ignore:
    """A comment that silences problems which begin or end on `lines`; all of them where it names no `codes`."""

    span: Span
    lines: frozenset[int]
    codes: tuple[tuple[str, Span], ...] | None

    def means(self, code: str, line: int) -> bool:
        """Tell whether a problem of this code on a line is silenced."""
        named = self.codes is None or any(code == name for name, _ in self.codes)
        return line in self.lines and named


def ignores(text: str, file: str) -> tuple[Ignore, ...]:
    """Return the comments of a file, which is in YAML, XML or Python by its name; others have none."""
    find = next((found for ending, found in _FINDERS.items() if file.endswith(ending)), None)
    if find is None or MARK not in text:
        return ()
    if file.endswith(_EITHER) and not text.lstrip().startswith("<"):
        find = _yaml
    lines = _Lines(text, _YAML_BREAK if find is _yaml else _BREAK)
    offsets, together = find(text, lines)
    spans = [(lines.number(begin), lines.number(end)) for begin, end in together]
    return tuple(made for offset in offsets if (made := _ignore(offset, lines, spans, file)) is not None)


class _Lines:
    """The lines of a text and where they begin."""

    def __init__(self, text: str, ending: re.Pattern[str]) -> None:
        self.text = text
        self.begins = [0, *(found.end() for found in ending.finditer(text))]

    def number(self, offset: int) -> int:
        """Return the line, from 1, in which an offset lies."""
        # Here, because hardly any file has such comments.
        from bisect import bisect_right  # noqa: PLC0415

        return bisect_right(self.begins, offset)

    def of(self, number: int) -> str:
        """Return the text of a line."""
        end = self.begins[number] if number < len(self.begins) else len(self.text)
        return self.text[self.begins[number - 1] : end]

    def span(self, begin: int, end: int, file: str) -> Span:
        """Return the span between two offsets."""
        first, last = self.number(begin), self.number(end)
        return Span(file, first, begin - self.begins[first - 1] + 1, last, end - self.begins[last - 1] + 1)


def _ignore(offset: int, lines: _Lines, together: list[tuple[int, int]], file: str) -> Ignore | None:
    found = _ASKED.match(lines.text, offset)
    if found is None:
        return None
    line = lines.number(offset)
    if not lines.of(line)[: offset - lines.begins[line - 1]].strip():
        line = _next(line, lines)
    meant = {line}
    for first, last in together:
        if line in (first, last):
            meant.update(range(first, last + 1))
    codes = None
    if found[1] is not None:
        codes = tuple(
            (code.group(), lines.span(found.start(1) + code.start(), found.start(1) + code.end(), file))
            for code in _CODE.finditer(found[1])
        )
    return Ignore(lines.span(offset, found.end(), file), frozenset(meant), codes)


def _next(line: int, lines: _Lines) -> int:
    """Return the next line with something other than a comment on it, the last line where there is none."""
    for number in range(line + 1, len(lines.begins) + 1):
        text = re.sub(r"<!--.*?-->", "", lines.of(number)).strip()
        if text and not text.startswith("#"):
            return number
    return len(lines.begins)


def _yaml(text: str, lines: _Lines) -> _Found:
    """Find the comments of YAML: what stands behind a `#` that is in no scalar."""
    # Here, because hardly any file has such comments.
    import yaml  # noqa: PLC0415

    scalars: list[tuple[int, int]] = []
    try:
        for token in yaml.scan(text, Loader=getattr(yaml, "CBaseLoader", yaml.BaseLoader)):
            if isinstance(token, yaml.ScalarToken):
                begin, end = token.start_mark.index, token.end_mark.index
                if token.style in ("|", ">"):  # a comment may stand behind the sign
                    number = lines.number(begin)
                    begin = lines.begins[number] if number < len(lines.begins) else end
                scalars.append((begin, end))
    except yaml.YAMLError:
        pass  # what is behind the fault silences nothing
    offsets = [found.start() for found in re.finditer(r"(?<![^\s])#", text)]
    return [at for at in offsets if not _is_within(at, scalars)], []


def _is_within(at: int, ranges: Sequence[tuple[int, int]]) -> bool:
    """Return whether an offset is in one of some ranges, which stand one after the other."""
    # Here, because hardly any file has such comments.
    from bisect import bisect_right  # noqa: PLC0415

    index = bisect_right(ranges, at, key=lambda found: found[0])
    return index > 0 and at < ranges[index - 1][1]


def _xml(text: str, lines: _Lines) -> _Found:
    del lines
    comments: list[int] = []
    tags: list[tuple[int, int]] = []
    for found in _XML.finditer(text):
        if found.group().startswith("<!--"):
            comments.append(found.start())
        elif found.group()[1] not in "!?":
            tags.append((found.start(), found.end() - 1))
    return comments, tags


def _python(text: str, lines: _Lines) -> _Found:
    # Here, because hardly any file has such comments.
    import io  # noqa: PLC0415
    import tokenize  # noqa: PLC0415

    comments: list[int] = []
    statements: list[tuple[int, int]] = []
    begin: int | None = None
    try:
        for token in tokenize.generate_tokens(io.StringIO(text, newline="").readline):
            if token.type == tokenize.COMMENT:
                comments.append(lines.begins[token.start[0] - 1] + token.start[1])
            elif token.type == tokenize.NEWLINE and begin is not None:
                statements.append((begin, lines.begins[token.start[0] - 1]))
                begin = None
            elif begin is None and token.type in (
                tokenize.NAME,
                tokenize.OP,
                tokenize.STRING,
                tokenize.NUMBER,
            ):
                begin = lines.begins[token.start[0] - 1]
    except (tokenize.TokenError, SyntaxError):
        pass  # a file with such a fault is not run: nothing in it can be silenced
    return comments, statements


_FINDERS: Final[dict[str, Callable[[str, _Lines], _Found]]] = {
    ".py": _python,
    ".xml": _xml,
    _EITHER: _xml,
    ".yaml": _yaml,
    ".yml": _yaml,
}
