"""Pages as data: a title, a text, and the files of the wrong and of the right example."""

from __future__ import annotations

import re
from importlib.resources import files
from typing import Final

from orchestra.dataclass import dataclass
from orchestra.errors import Code, UsageError
from orchestra.nearest import nearest

_FENCE: Final = re.compile(r"^```(\w+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
_NAMED: Final = re.compile(r"(?:#|<!--)\s*(\S+)")
_CODE: Final = re.compile(r"(?:orc)?[-_]?0*(\d{1,3})", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Example:
    """A file of an example, named by its first line; `console` is what is typed, and no file."""

    file: str | None
    language: str
    text: str


@dataclass(frozen=True, slots=True)
class Page:
    """What there is to say about a code; `markdown` is all of it."""

    code: Code
    title: str
    text: str
    wrong: tuple[Example, ...]
    right: tuple[Example, ...]
    markdown: str


def code_of(word: str) -> Code:
    """Return the code that is meant: `ORC012`, `orc012` or `12`. Raises `UsageError` for any other."""
    number = _CODE.fullmatch(word.strip())
    name = f"ORC{int(number[1]):03}" if number is not None else word.upper()
    if name in list(Code):
        return Code(name)
    near = nearest(name, [code.value for code in Code])
    meant = "" if near is None else f", did you mean '{near}'?"
    raise UsageError(f"there is no code '{word}'{meant} ('orchestra explain' lists them all)")


def has_page(code: Code) -> bool:
    """Return whether a code is explained."""
    return (files(__package__) / "pages" / f"{code}.md").is_file()


def page_of(code: Code) -> Page:
    """Return the page of a code. Raises `OSError` where it has none."""
    return parsed(code, (files(__package__) / "pages" / f"{code}.md").read_text("utf-8"))


def parsed(code: Code, markdown: str) -> Page:
    """Return the page that a text is. Raises `ValueError` for a text that has not the parts of a page."""
    whole = re.fullmatch(r"# (.+?)\n\n(.+?)\n\n## Wrong\n(.+)\n## Right\n(.+)", markdown, re.DOTALL)
    if whole is None:
        raise ValueError(f"the page of {code} has no title, text, ## Wrong and ## Right in this order")
    title, text, wrong, right = whole.groups()
    return Page(code, title, text.strip(), _examples(wrong), _examples(right), markdown)


def _examples(text: str) -> tuple[Example, ...]:
    return tuple(_example(language, content) for language, content in _FENCE.findall(text))


def _example(language: str, content: str) -> Example:
    named = None if language == "console" else _NAMED.match(content)
    return Example(None if named is None else named[1], language, content)
