"""The words of a line that is being typed in bash, and how a completion is written into it.

Readline replaces the text behind the last break (a quote that is open, or one of `COMP_WORDBREAKS`), which may be in
the middle of a word of the shell: in `world:=m` it is `m` (bash manual, "Programmable Completion").
"""

from __future__ import annotations

from orchestra.dataclass import dataclass
from orchestra.fields import field

_SPECIAL = frozenset("\\\"'`$&;()<>|*?[]{}!# \t\n")
_BLANKS = " \t\n"
_BRACES = frozenset("{}")
_SPECIAL_IN_DOUBLE = frozenset('\\"`$')


@dataclass(slots=True)
class Line:
    """A line up to the cursor: the words before the one at the cursor, and that one without its quotes.

    `quote` is the quote that is open at the cursor, `kept` how much of the word readline leaves as it is.
    """

    before: list[str] = field(default_factory=list)
    begun: str = ""
    quote: str = ""
    kept: int = 0


def split_line(text: str, breaks: str) -> Line:
    """Split a line up to the cursor as bash does; `breaks` are the characters of `COMP_WORDBREAKS`."""
    line = Line()
    inside = escaped = False
    for character in text:
        if escaped:
            kept = line.quote and character not in _SPECIAL_IN_DOUBLE
            line.begun += f"\\{character}" if kept else character
            escaped = False
        elif character == "\\" and line.quote != "'":
            inside = escaped = True
        elif line.quote:
            line.quote, line.begun = _in_quotes(line, character)
        elif character in "\"'":
            inside, line.quote, line.kept = True, character, len(line.begun)
        elif character in _BLANKS:
            if inside:
                line.before.append(line.begun)
            line.begun, line.kept, inside = "", 0, False
        else:
            line.begun += character
            inside = True
            line.kept = len(line.begun) if character in breaks else line.kept
    return line


def written(word: str, line: Line, *, finished: bool) -> str:
    """Return what readline is to put in place of what is begun, with a space where nothing can follow."""
    rest = word[line.kept :]
    if line.quote == "'":
        return rest.replace("'", "'\\''")
    if (
        not (line.quote or line.begun)
        and set(word) & _BRACES
        and not set(word) & (_SPECIAL_IN_DOUBLE | {"!"})
    ):
        return f'"{word}" ' if finished else f'"{word}'  # a message, which is read better so
    special = _SPECIAL_IN_DOUBLE if line.quote else _SPECIAL
    text = "".join(f"\\{character}" if character in special else character for character in rest)
    if text.startswith("~") and not line.quote and not line.begun:
        text = f"\\{text}"  # a name, where the user has not begun with the sign for a home folder
    return f"{text} " if finished and not line.quote else text


def _in_quotes(line: Line, character: str) -> tuple[str, str]:
    if character == line.quote:
        return "", line.begun
    return line.quote, line.begun + character
