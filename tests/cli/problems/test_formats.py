"""Problems in every format, from the same three."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import jsonschema
import pytest

from orchestra.cli.colour import painter
from orchestra.cli.problems.formats import renderer
from orchestra.cli.problems.sources import from_files
from orchestra.errors import Code, Problem, Severity
from orchestra.location import Span

if TYPE_CHECKING:
    from pathlib import Path

_TEXT = "launch:\n  - node:\n      outptu: screen\n"
_UNKNOWN = Problem(
    Code.UNKNOWN_KEY,
    Severity.ERROR,
    "unknown key `outptu`",
    Span("robot.yaml", 3, 7, 3, 13),
    (Span("all.yaml", 4, 5, 6, 1), Span("top.yaml", 1, 2, 1, 3)),
    "output",
    ("a note",),
)
_LEAK = Problem(Code.LEAKED_VALUE, Severity.WARNING, "100%: a,b\nc", Span("robot.yaml", 2, 5, 3, 21))
_PLACELESS = Problem(Code.UNFIT_MACHINE, Severity.ERROR, "no such core")
_ALL = (_UNKNOWN, _LEAK, _PLACELESS)


def _render(name: str, problems: tuple[Problem, ...] = _ALL, *, coloured: bool = False) -> str:
    return renderer(name)(problems, from_files({"robot.yaml": _TEXT}), painter(enabled=coloured))


def test_text() -> None:
    assert _render("text") == (
        "robot.yaml:3:7: error: unknown key `outptu` [ORC004]\n"
        "    3 |       outptu: screen\n"
        "      |       ^^^^^^\n"
        "help: did you mean 'output'?\n"
        "note: a note\n"
        "included from all.yaml:4:5\n"
        "included from top.yaml:1:2\n"
        "\n"
        "robot.yaml:2:5: warning: 100%: a,b\nc [ORC026]\n"
        "    2 |   - node:\n"
        "      |     ^^^^^ ...\n"
        "\n"
        "error: no such core [ORC055]\n"
        "\n"
        "2 errors, 1 warning\n"
    )


@pytest.mark.parametrize("name", ["text", "brief"])
def test_text_of_nothing_is_empty(name: str) -> None:
    assert _render(name, ()) == ""


def _lacking(package: str, *places: tuple[str, int], more: str = "") -> list[Problem]:
    message = f"there is no package '{package}' on this machine{more}"
    return [
        Problem(Code.MISSING_PACKAGE, Severity.NOTE, message, Span(file, line, 5, line, 9))
        for file, line in places
    ]


def test_in_brief_notes_stand_behind_what_is_wrong_and_say_everything_once() -> None:
    notes = [
        *_lacking("a", ("robot.yaml", 1)),
        *_lacking("b", ("robot.yaml", 2), ("other.yaml", 7)),
        *_lacking("b", ("other.yaml", 9), more=": it is left open"),
        *_lacking("c", ("robot.yaml", 2), ("robot.yaml", 3)),
    ]
    assert _render("brief", (*notes, _PLACELESS)) == (
        "error: no such core [ORC055]\n"
        "\n"
        "robot.yaml:2:5: note: there is no package 'b' on this machine [ORC030] (3 places in 2 files)\n"
        "robot.yaml:2:5: note: there is no package 'c' on this machine [ORC030] (2 places)\n"
        "robot.yaml:1:5: note: there is no package 'a' on this machine [ORC030]\n"
        "\n"
        "1 error, 6 notes\n"
    )


def test_in_brief_notes_never_hide_what_is_wrong() -> None:
    many = [note for number in range(300) for note in _lacking(f"p{number}", ("robot.yaml", 1))]
    lines = _render("brief", (*many, *_ALL)).splitlines()
    assert [line for line in lines if "note: there" in line][-1].startswith(
        "robot.yaml:1:5: note: there is no package 'p9'"
    )
    assert lines[-3:] == ["... and 290 others: see --notes all", "", "2 errors, 1 warning, 300 notes"]


def test_where_all_notes_are_wanted_they_stand_in_their_place() -> None:
    (note,) = _lacking("demo", ("robot.yaml", 2))
    told = _render("text", (note, _PLACELESS))
    assert told.startswith(
        "robot.yaml:2:5: note: there is no package 'demo' on this machine [ORC030]\n    2 |   - node:\n"
    )
    assert told.endswith("1 error, 1 note\n")


def test_a_line_of_a_note_is_faint() -> None:
    (note,) = _lacking("demo", ("robot.yaml", 2))
    line, *_ = _render("brief", (note,), coloured=True).splitlines()
    assert line == "\x1b[2mrobot.yaml:2:5: note: there is no package 'demo' on this machine [ORC030]\x1b[0m"


def test_programs_get_notes_by_the_names_that_their_formats_have() -> None:
    notes = (*_lacking("demo", ("robot.yaml", 2)),)
    assert _render("github", notes).startswith("::notice file=robot.yaml,line=2,")
    assert json.loads(_render("json", notes))[0]["severity"] == "note"
    assert json.loads(_render("sarif", notes))["runs"][0]["results"][0]["level"] == "note"


def test_a_colourless_text_is_what_remains_of_a_coloured_one() -> None:
    coloured = _render("text", coloured=True)
    assert "\x1b[1;31merror:\x1b[0m" in coloured
    assert re.sub("\x1b\\[[0-9;]*m", "", coloured) == _render("text")


def test_json_is_a_flat_list() -> None:
    unknown, leak, placeless = json.loads(_render("json"))
    assert unknown == {
        "code": "ORC004",
        "severity": "error",
        "message": "unknown key `outptu`",
        "file": "robot.yaml",
        "line": 3,
        "column": 7,
        "end_line": 3,
        "end_column": 13,
        "suggestion": "output",
        "notes": ["a note"],
        "included_from": [
            {"file": "all.yaml", "line": 4, "column": 5},
            {"file": "top.yaml", "line": 1, "column": 2},
        ],
    }
    assert leak["severity"] == "warning"
    assert placeless["file"] is None
    assert json.loads(_render("json", ())) == []


def test_github_commands_are_escaped() -> None:
    unknown, leak, placeless = _render("github").splitlines()
    assert unknown == (
        "::error file=robot.yaml,line=3,endLine=3,col=7,endColumn=12,title=ORC004::unknown key `outptu`"
        "%0Adid you mean 'output'?%0Aa note%0Aincluded from all.yaml:4:5%0Aincluded from top.yaml:1:2"
    )
    assert leak == "::warning file=robot.yaml,line=2,endLine=3,title=ORC026::100%25: a,b%0Ac"
    assert placeless == "::error title=ORC055::no such core"


def test_sarif_has_what_the_standard_asks_for() -> None:
    log = json.loads(_render("sarif"))
    assert log["version"] == "2.1.0"
    (run,) = log["runs"]
    rules = run["tool"]["driver"]["rules"]
    assert run["tool"]["driver"]["name"] == "orchestra"
    assert [rule["id"] for rule in rules] == [code.value for code in Code]
    for result, problem in zip(run["results"], _ALL, strict=True):
        assert rules[result["ruleIndex"]]["id"] == result["ruleId"] == problem.code
        assert result["level"] == problem.severity.value
        assert result["message"]["text"].startswith(problem.message)
    unknown = run["results"][0]
    assert unknown["locations"][0]["physicalLocation"] == {
        "artifactLocation": {"uri": "robot.yaml"},
        "region": {"startLine": 3, "startColumn": 7, "endLine": 3, "endColumn": 13},
    }
    assert unknown["fixes"][0]["artifactChanges"][0]["replacements"][0]["insertedContent"] == {
        "text": "output"
    }
    assert [at["physicalLocation"]["region"]["startLine"] for at in unknown["relatedLocations"]] == [4, 1]
    assert "locations" not in run["results"][2]


def _object(required: dict[str, Any], optional: dict[str, Any] | None = None) -> dict[str, Any]:
    properties = {**required, **(optional or {})}
    return {
        "type": "object",
        "properties": properties,
        "required": list(required),
        "additionalProperties": False,
    }


def _unique(items: dict[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": items, "uniqueItems": True}


_WORDS: dict[str, Any] = {"type": "string"}
_SAID = _object({"text": _WORDS})
_NUMBER = {"type": "integer", "minimum": 1}
_REGION = _object(dict.fromkeys(("startLine", "startColumn", "endLine", "endColumn"), _NUMBER))
_FILE = _object({"uri": {"type": "string", "format": "uri-reference"}})
_LOCATION = _object(
    {"physicalLocation": _object({"artifactLocation": _FILE, "region": _REGION})}, {"message": _SAID}
)
_REPLACEMENT = _object({"deletedRegion": _REGION, "insertedContent": _SAID})
_CHANGE = _object(
    {"artifactLocation": _FILE, "replacements": {"type": "array", "items": _REPLACEMENT, "minItems": 1}}
)
_FIX = _object({"artifactChanges": {**_unique(_CHANGE), "minItems": 1}}, {"description": _SAID})
_RESULT = _object(
    {"message": _SAID},
    {
        "ruleId": _WORDS,
        "ruleIndex": {"type": "integer", "minimum": -1},
        "level": {"enum": ["none", "note", "warning", "error"]},
        "locations": {"type": "array", "items": _LOCATION},
        "relatedLocations": _unique(_LOCATION),
        "fixes": _unique(_FIX),
    },
)
_HELP = _object({"text": _WORDS}, {"markdown": _WORDS})
_RULE = _object({"id": _WORDS}, {"name": _WORDS, "shortDescription": _SAID, "help": _HELP})
_RUN = _object(
    {"tool": _object({"driver": _object({"name": _WORDS}, {"rules": _unique(_RULE)})})},
    {
        "results": {"type": "array", "items": _RESULT},
        "columnKind": {"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
        "newlineSequences": {**_unique(_WORDS), "minItems": 1},
    },
)
_LOG = _object({"version": {"const": "2.1.0"}, "runs": {"type": "array", "items": _RUN}}, {"$schema": _WORDS})


def test_sarif_has_no_property_that_the_standard_lacks() -> None:
    """The part of its schema that is used here: types, names, what must be there, what must not repeat itself."""
    twice = replace(_UNKNOWN, included_from=_UNKNOWN.included_from * 2)
    jsonschema.validate(json.loads(_render("sarif", (*_ALL, twice))), _LOG)


@pytest.mark.parametrize(
    ("file", "uri"), [("a b/ü.yaml", "a%20b/%C3%BC.yaml"), ("/x y/z.yaml", "file:///x%20y/z.yaml")]
)
def test_sarif_names_files_by_uri(file: str, uri: str) -> None:
    problem = Problem(Code.SYNTAX, Severity.ERROR, "wrong", Span(file, 1, 1, 1, 1))
    place = json.loads(_render("sarif", (problem,)))["runs"][0]["results"][0]["locations"][0]
    assert place["physicalLocation"]["artifactLocation"]["uri"] == uri


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r", "\u2028"])
def test_lines_are_counted_as_the_parsers_do(tmp_path: Path, newline: str) -> None:
    file = tmp_path / "x.yaml"
    file.write_bytes(f"\ufeffone{newline}two{newline}".encode())
    sources = from_files()
    assert [sources(str(file), number) for number in (0, 1, 2, 3, 4)] == [None, "one", "two", "", None]
    assert sources(str(tmp_path / "none.yaml"), 1) is None
    assert sources("command line", 1) is None


def test_nothing_of_a_message_reaches_the_terminal_as_a_command() -> None:
    problem = Problem(Code.BAD_VALUE, Severity.ERROR, "a\x1b[2Jb", None, (), "\x07", ("\x9b",))
    assert not set(_render("text", (problem,))) & {"\x1b", "\x07", "\x9b"}
