"""`orchestra explain`: what a code of a problem means, what to do, with a wrong and a right example."""

from __future__ import annotations

import json
import os
import sys
from typing import TYPE_CHECKING, Any

from orchestra.cli.colour import painter, wanted
from orchestra.cli.explaining.page import Example, Page, code_of, has_page, page_of
from orchestra.cli.explaining.styled import styled
from orchestra.cli.parser import CommandParser
from orchestra.errors import Code

if TYPE_CHECKING:
    from argparse import Namespace


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("explain", "Explain a code of a problem; without one, list them all.")
    made.add_argument("code", nargs="?", metavar="CODE", help="as ORC012, orc012 or 12")
    made.add_argument("--format", choices=("text", "json"), default="text", help="(default: text)")
    return made


def run(options: Namespace) -> int:
    """Print the page, or the list of codes."""
    if options.code is not None:
        page = page_of(code_of(options.code))
        paint = painter(enabled=wanted(sys.stdout, os.environ))
        sys.stdout.write(_json(_data(page)) if options.format == "json" else styled(page, paint))
        return 0
    pages = [page_of(code) for code in Code if has_page(code)]
    if options.format == "json":
        sys.stdout.write(_json([{"code": page.code, "title": page.title} for page in pages]))
    else:
        sys.stdout.write("".join(f"{page.code}  {page.title}\n" for page in pages))
    return 0


def _json(data: Any) -> str:  # noqa: ANN401 - whatever JSON has
    return json.dumps(data, indent=2, ensure_ascii=False) + "\n"


def _data(page: Page) -> dict[str, Any]:
    return {
        "code": page.code,
        "title": page.title,
        "text": page.text,
        "wrong": [_file(example) for example in page.wrong],
        "right": [_file(example) for example in page.right],
    }


def _file(example: Example) -> dict[str, str | None]:
    return {"file": example.file, "language": example.language, "text": example.text}
