"""What is wrong with an XML launch file is told once, at its place, in the words of who wrote it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from orchestra.errors import Code, Problems, Severity
from orchestra.load.files import load
from orchestra.load.reader import Reader
from orchestra.load.xml_file import read

if TYPE_CHECKING:
    from pathlib import Path

# In a launch element: source, code, the text that is marked, a part of the message, what is suggested.
FAULTS: dict[str, tuple[str, Code, str, str, str | None]] = {
    "a tag that is closed by another": (
        "<group></grup>", Code.SYNTAX, "grup", "</grup> stands where </group> is expected", "group",
    ),
    "a tag that is closed in another case": ("<log message='a'></Log>", Code.SYNTAX, "Log", "</log> is expected", "log"),
    "a tag that is not closed": ("<group>", Code.SYNTAX, "group", "</group> is missing before </launch>", None),
    "a value without quotes": ("<log message=a/>", Code.SYNTAX, "a", "needs quotes", '"a"'),
    "a value in quotes of a word processor": ("<log message=“a”/>", Code.SYNTAX, "“a”", "needs quotes", '"a"'),
    "an attribute without a value": ("<log message/>", Code.SYNTAX, "message", 'write message="..."', None),
    "no space between attributes": ("<let name='a'value='b'/>", Code.SYNTAX, "value", "a space is missing", " value"),
    "a quote that is not closed": (
        "<node exec='a' name=\"b>\n<param name='x' value=\"1\"/></node>", Code.SYNTAX, '"', "a quote is missing", None,
    ),
    "an ampersand": ("<log message='a & b'/>", Code.SYNTAX, "&", "write &amp;", "&amp;"),
    "an entity that is not closed": ("<log message='a &amp b'/>", Code.SYNTAX, "&", "write &amp;", "&amp;"),
    "an unknown entity": ("<log message='a &foo; b'/>", Code.SYNTAX, "&foo;", "no entity &foo;", "&amp;foo;"),
    "an impossible character": ("<log message='&#0;'/>", Code.SYNTAX, "&#0;", "no character", None),
    "a control character": ("<log message='\x01'/>", Code.SYNTAX, "\x01", "U+0001", None),
    "a less-than sign in a value": ("<log message='1 < 2'/>", Code.SYNTAX, "<", "cannot hold '<'", "&lt;"),
    "a less-than sign in a text": ("1 < 2", Code.SYNTAX, "<", "'<' begins a tag", "&lt;"),
    "an attribute twice": ("<let name='a' name='b'/>", Code.DUPLICATE_KEY, "name", "stands twice", None),
    "an attribute in both spellings": (
        "<executable cmd='a' launch-prefix='b' launch_prefix='c'/>",
        Code.DUPLICATE_KEY, "launch_prefix", "stands twice", None,
    ),
    "dashes in a comment": ("<!-- a -- b -->", Code.SYNTAX, "--", "inside a comment", None),
    "a comment that is not closed": ("<!-- a", Code.SYNTAX, "<!--", "'-->' is missing", None),
    "a section that is not closed": ("<![CDATA[a", Code.SYNTAX, "<![CDATA[", "']]>' is missing", None),
    "the end of a section in a text": ("]]>", Code.SYNTAX, "]]>", "cannot stand in a text", None),
    "an unknown action": ("<ndoe exec='a'/>", Code.UNKNOWN_ACTION, "ndoe", "unknown action", "node"),
    "a word of another dialect": (
        "<param name='a' value='b'/>", Code.UNKNOWN_ACTION, "param", "unknown action", "set_parameter",
    ),
    "an unknown attribute": ("<node exce='a'/>", Code.UNKNOWN_KEY, "exce", "unknown attribute 'exce'", "exec"),
    "an unknown element": (
        "<node exec='a'><praam name='b' value='1'/></node>",
        Code.UNKNOWN_KEY, "praam", "unknown element <praam>", "param",
    ),
    "a misspelt key of a group": (
        "<group><kep name='a' value='b'/></group>", Code.UNKNOWN_KEY, "kep", "unknown element <kep>", "keep",
    ),
    "an action in a node": (
        "<node exec='a'><let name='b' value='c'/></node>", Code.UNKNOWN_KEY, "let", "unknown element <let>", None,
    ),
    "a misspelt attribute of a part": (
        "<node exec='a'><ready mesage='b'/></node>", Code.UNKNOWN_KEY, "mesage", "unknown attribute", "message",
    ),
    "a missing attribute": ("<let name='a'/>", Code.MISSING_KEY, "let", "the attribute 'value' is missing", None),
    "a text for a value": (
        "<let name='a'>5</let>", Code.WRONG_TYPE, "<let name='a'>5</let>", 'write it as value="..."',
        "<let name='a' value=\"5\"/>",
    ),
    "a text for a parameter": (
        "<node exec='a'><param name='b'> 5 </param></node>", Code.WRONG_TYPE, "<param name='b'> 5 </param>",
        'write it as value="..."', "<param name='b' value=\"5\"/>",
    ),
    "an element for an attribute": (
        "<node exec='a'><name>b</name></node>", Code.WRONG_TYPE, "name", 'as an attribute: name="b"', None,
    ),
    "an attribute for an element": (
        "<node exec='a' env='B=c'/>", Code.WRONG_TYPE, "env", "as an element: <env .../>", None,
    ),
    "children as an attribute": ("<group children='a'/>", Code.WRONG_TYPE, "children", "no attribute", None),
    "a list for a text": (
        "<log message='a,b' message-sep=','/>", Code.WRONG_TYPE, "a,b", "expected text, found a list", None,
    ),
    "an empty separator": (
        "<node exec='a'><param name='b' value='c' value-sep=''/></node>",
        Code.BAD_VALUE, "value-sep", "the separator of 'value' is empty", None,
    ),
    "a separator of nothing": (
        "<node exec='a'><param name='b' from='c' value-sep=','/></node>",
        Code.UNKNOWN_KEY, "value-sep", "unknown attribute 'value-sep'", "value",
    ),
    "a part twice": (
        "<node exec='a'><ready message='b'/><ready log='c'/></node>",
        Code.DUPLICATE_KEY, "ready", "<ready> stands twice in <node>", None,
    ),
    "nothing to repeat for": ("<group><for_each/></group>", Code.WRONG_TYPE, "for_each", "at least one item", None),
    "two conditions": ("<log message='a' if='1' unless='0'/>", Code.CONFLICTING_KEYS, "unless", "`unless`", None),
    "a condition where none can stand": (
        "<node exec='a'><env name='b' value='c' if='true'/></node>", Code.UNKNOWN_KEY, "if", "unknown attribute", None,
    ),
    "a word for a number": ("<timer period='soon'/>", Code.WRONG_TYPE, "soon", "a number of seconds", None),
    "a word for a status": (
        "<node exec='a' success_exit_codes='[0, x]'/>", Code.WRONG_TYPE, "x", "a whole number", None,
    ),
    "a substitution behind an entity": (
        "<log message='&quot;ä&#10;$(vra a)'/>", Code.UNKNOWN_SUBSTITUTION, "vra", "no substitution", "var",
    ),
}  # fmt: skip


def _problems(text: str, folder: Path) -> Problems:
    path = folder / "a.launch.xml"
    path.write_text(text, "utf-8")
    problems = Problems()
    load(str(path), problems)
    return problems


@pytest.mark.parametrize("case", FAULTS)
def test_a_fault_is_told_once_at_its_place(case: str, tmp_path: Path) -> None:
    source, code, marked, message, suggestion = FAULTS[case]
    text = f"<launch>{source}</launch>"
    (problem,) = _problems(text, tmp_path)
    assert (problem.code, problem.severity, problem.suggestion) == (code, Severity.ERROR, suggestion)
    assert message in problem.message
    assert problem.span is not None
    line = text.split("\n")[problem.span.line - 1]
    assert line[problem.span.column - 1 : problem.span.end_column - 1] == marked


# Whole files: line and column of the one error, a part of its message.
FILES: dict[str, tuple[str, int, int, str]] = {
    "an empty file": ("", 1, 1, "the file is empty"),
    "blanks": (" \n", 1, 1, "the file is empty"),
    "no XML": ("hello\n<launch/>", 1, 1, "it begins with 'hello'"),
    "another root": ("<robot name='a'/>", 1, 2, "the root element of a launch file is <launch>, not <robot>"),
    "a misspelt root": ("<lunch/>", 1, 2, "not <lunch>"),
    "two roots": ("<launch/>\n<launch/>", 2, 2, "one root element"),
    "text behind the root": ("<launch/>\nx y", 2, 1, "'x y' stands behind the root element"),
    "a root that is not closed": ("<launch>\n", 1, 2, "<launch> is not closed"),
    "a tag that is not finished": ("<launch>\n<log", 2, 1, "this tag is not closed"),
    "a tag that closes nothing": ("</launch>", 1, 1, "'</launch>' closes nothing"),
    "a late declaration": ("\n<?xml version='1.0'?><launch/>", 2, 1, "must be the very first"),
    "an entity of its own": (
        "<!DOCTYPE launch [<!ENTITY a 'b'>]><launch><log message='&a;'/></launch>", 1, 1, "document type",
    ),
    "an entity of another file": (
        "<!-- <!DOCTYPE a> --><!DOCTYPE launch [<!ENTITY a SYSTEM '/etc/hostname'>]><launch/>", 1, 22, "document type",
    ),
    "a document type elsewhere": ("<!DOCTYPE launch SYSTEM 'http://a/b.dtd'><launch/>", 1, 1, "document type"),
    "laughs": (
        "<!DOCTYPE launch [<!ENTITY a 'aaaaaaaa'>"
        + "".join(f"<!ENTITY {new} '{f'&{old};' * 10}'>" for old, new in zip("abcdefgh", "bcdefghi", strict=True))
        + "]><launch>&i;</launch>",
        1, 1, "document type",
    ),
    "a file that nests too deep": ("<launch>" + "<group>" * 200_000, 1, 8 + 99 * 7 + 2, "nests more than 100 deep"),
}  # fmt: skip


@pytest.mark.conforms("2.1 root", "2.1 empty", "D7", "D77")
@pytest.mark.parametrize("case", FILES)
def test_a_file_that_is_no_launch_file_is_told_once(case: str, tmp_path: Path) -> None:
    text, line, column, message = FILES[case]
    (problem,) = _problems(text, tmp_path)
    assert message in problem.message
    assert problem.span is not None
    assert (problem.span.line, problem.span.column) == (line, column)


@pytest.mark.conforms("2.1 root attribute", "2.1 child", "D61")
@pytest.mark.parametrize(
    ("text", "marked", "suggestion"),
    [
        ("<launch>hello <log message='a'/></launch>", "hello", None),
        ("<launch><arg name='a' default='b'>ä\nb</arg></launch>", "ä", None),
        ("<launch><![CDATA[a]]></launch>", None, None),
        ("<launch deprecatde='a'/>", "deprecatde", "deprecated"),
        ("<launch if='false'/>", "if", None),
    ],
)
def test_what_upstream_ignores_is_a_warning(
    text: str, marked: str | None, suggestion: str | None, tmp_path: Path
) -> None:
    (problem,) = _problems(text, tmp_path)
    assert (problem.severity, problem.suggestion) == (Severity.WARNING, suggestion)
    assert problem.span is not None
    assert problem.span.line == 1
    if marked is not None:
        assert text[problem.span.column - 1 : problem.span.end_column - 1] == marked


@pytest.mark.parametrize(
    "text", ["<!DOCTYPE launch><launch/>", "<launch version='1' xsi:a='b' xmlns:xsi='c'/>"]
)
def test_what_says_nothing_is_no_fault(text: str, tmp_path: Path) -> None:
    assert not list(_problems(text, tmp_path))


def test_all_faults_of_a_file_are_told_in_one_pass(tmp_path: Path) -> None:
    text = "<launch>\n<nod exec='a' nmae='b'/>\n<let name='a'/>\n<log message='$(nix)'/>\n</launch>"
    faults = [
        (found.span.line, found.span.column) for found in _problems(text, tmp_path) if found.span is not None
    ]
    assert faults == [(2, 2), (2, 15), (3, 2), (4, 17)]


_SEED = (
    "<?xml version='1.0'?>\n<launch>\n  <!-- a -->\n  <arg name=\"ä\" default='&quot;b'/>\n  <group if=\"$(var a)\">\n"
    "    <node pkg='p' exec='e'>text<param name='x' value='1,2' value-sep=','/></node>\n  </group>\n</launch>\n"
)
_PIECES = (
    *(
        "<",
        ">",
        "/",
        "'",
        '"',
        "&",
        "&#1;",
        "&#xD800;",
        "]]>",
        "<![CDATA[",
        "<!--",
        "-->",
        "--",
        "<?",
        "?>",
        "=",
    ),
    *(
        "<a",
        "</a>",
        "<a/>",
        "<!DOCTYPE a [",
        "\x00",
        "\ufffe",
        "\U0001f600",
        "\n",
        " ",
        "$(",
        ":",
        "xmlns:a='b'",
    ),
)


def _edited(edits: list[tuple[int, int, str]]) -> str:
    text = _SEED
    for at, removed, piece in edits:
        text = text[:at] + piece + text[at + removed :]
    return text


@given(
    st.text(max_size=100)
    | st.lists(
        st.tuples(st.integers(0, len(_SEED)), st.integers(0, 8), st.sampled_from(("", *_PIECES))),
        min_size=1,
        max_size=4,
    ).map(_edited)
)
@example("<a &")
@example("<launch a='b")
@settings(max_examples=600, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_no_text_breaks_the_reader(text: str) -> None:
    """Whatever stands in a file, it gives a tree or located problems."""
    problems = Problems()
    tree = read(text, "f.xml", Reader(problems))
    assert tree is not None or len(problems.errors) == 1
    lines = text.count("\n") + len(text.splitlines()) + 1
    for problem in problems:
        assert problem.span is not None
        assert 1 <= problem.span.line <= problem.span.end_line <= lines
        assert "\n" not in problem.message
