"""The table of codes in the documentation, made of the pages that explain them."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

from orchestra.cli.explaining.page import has_page, page_of
from orchestra.errors import Code

PAGE: Final = Path(__file__).parents[2] / "docs" / "checking.md"

_TABLE: Final = re.compile(r"(<!-- codes: .*? -->\n).*?(<!-- end of codes -->)", re.DOTALL)


def with_table(text: str) -> str:
    """Return the page with the table as it is to be."""
    rows = "".join(f"| {code} | {_title(code)} |\n" for code in sorted(Code))
    return _TABLE.sub(lambda found: f"{found[1]}| code | |\n|---|---|\n{rows}{found[2]}", text)


def _title(code: Code) -> str:
    return page_of(code).title if has_page(code) else code.name.replace("_", " ").capitalize()
