"""Problems as a SARIF 2.1.0 log, the static analysis results interchange format.

Source: OASIS, "Static Analysis Results Interchange Format (SARIF) Version 2.1.0". Regions are 1-based with an
exclusive end column, as our spans are; `columnKind` says that columns count code points.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from orchestra.cli.explaining.page import page_of
from orchestra.errors import Code, Problem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.cli.colour import Paint
    from orchestra.cli.problems.sources import Sources
    from orchestra.location import Span

_BREAKS = ["\r\n", "\n", "\r", "\x85", "\u2028", "\u2029"]  # as `sources` counts lines
_LINES = ("from ", "import ")  # suggestions that are lines of their own, and stand in place of nothing
_SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"


def render(problems: Sequence[Problem], _sources: Sources, _paint: Paint) -> str:
    """Return one log with one run."""
    run = {
        "tool": {"driver": {"name": "orchestra", "rules": [_rule(code) for code in Code]}},
        "columnKind": "unicodeCodePoints",
        "newlineSequences": _BREAKS,
        "results": [_result(problem) for problem in problems],
    }
    return (
        json.dumps({"$schema": _SCHEMA, "version": "2.1.0", "runs": [run]}, indent=2, ensure_ascii=False)
        + "\n"
    )


def _rule(code: Code) -> dict[str, Any]:
    words = code.name.lower().replace("_", " ")
    page = page_of(code)
    return {
        "id": code.value,
        "name": words.title().replace(" ", ""),
        "shortDescription": {"text": words},
        "help": {"text": page.text, "markdown": page.markdown},
    }


def _result(problem: Problem) -> dict[str, Any]:
    result: dict[str, Any] = {
        "ruleId": problem.code.value,
        "ruleIndex": list(Code).index(problem.code),
        "level": problem.severity.value,
        "message": {"text": "\n".join([problem.message, *problem.notes])},
    }
    if problem.span:
        result["locations"] = [_place(problem.span)]
    if problem.included_from:
        result["relatedLocations"] = [
            {**_place(span), "message": {"text": "included from here"}}
            for span in dict.fromkeys(problem.included_from)  # no two of them may be equal
        ]
    if problem.span and problem.suggestion is not None and not problem.suggestion.startswith(_LINES):
        result["fixes"] = [_fix(problem.span, problem.suggestion)]
    return result


def _place(span: Span) -> dict[str, Any]:
    return {"physicalLocation": {"artifactLocation": {"uri": _uri(span.file)}, "region": _region(span)}}


def _fix(span: Span, replacement: str) -> dict[str, Any]:
    change = {"deletedRegion": _region(span), "insertedContent": {"text": replacement}}
    return {
        "description": {"text": f"write '{replacement}'"},
        "artifactChanges": [{"artifactLocation": {"uri": _uri(span.file)}, "replacements": [change]}],
    }


def _uri(file: str) -> str:
    return Path(file).as_uri() if file.startswith("/") else quote(file)


def _region(span: Span) -> dict[str, int]:
    return {
        "startLine": span.line,
        "startColumn": span.column,
        "endLine": span.end_line,
        "endColumn": span.end_column,
    }
