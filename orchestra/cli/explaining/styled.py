"""Pages on a terminal: headings strong, examples as they are and indented, without the marks of Markdown."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.cli.colour import Paint
    from orchestra.cli.explaining.page import Page

_WORDS = re.compile(r"`([^`]+)`")


def styled(page: Page, paint: Paint) -> str:
    """Return a page for people to read."""
    return "\n".join([paint("strong", f"{page.code}: {page.title}"), *_lines(page, paint)]) + "\n"


def _lines(page: Page, paint: Paint) -> Iterator[str]:
    inside = False
    for line in page.markdown.rstrip().splitlines()[1:]:
        if line.startswith("```"):
            inside = not inside
        elif inside:
            yield f"    {line}".rstrip()
        elif line.startswith("## "):
            yield paint("strong", line.removeprefix("## "))
        else:
            yield _WORDS.sub(lambda word: paint("help", word[1]), line)
