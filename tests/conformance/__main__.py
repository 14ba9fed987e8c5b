"""`python -m tests.conformance` writes the page on compatibility; `--check` only tells whether it is up to date."""

from __future__ import annotations

import sys

from tests.conformance.collecting import marked_tests
from tests.conformance.page import faults, render
from tests.conformance.rows import SOURCE, read_language

PAGE = SOURCE.with_suffix(".md")


def main(words: list[str]) -> int:
    """Write or check the page; return 1 where a row is not tested or the page is out of date."""
    language, tests = read_language(), marked_tests()
    wrong = faults(language, tests)
    page = render(language, tests)
    if words != ["--check"]:
        PAGE.write_text(page, "utf-8")
    elif PAGE.read_text("utf-8") != page:
        wrong.append("docs/compatibility.md is out of date: run `python -m tests.conformance`")
    sys.stdout.write("".join(f"{line}\n" for line in wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
