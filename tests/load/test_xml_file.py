"""XML launch files give the same trees as YAML, and every name and value in them has its place."""

from __future__ import annotations

import gc
import re
import time
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.description.source import Keyed, Written
from orchestra.errors import Code, Problems
from orchestra.load import xml_file, yaml_file
from orchestra.load.files import load
from orchestra.load.offsets import source
from orchestra.load.reader import Reader
from orchestra.load.xml_parser import parse

if TYPE_CHECKING:
    from orchestra.location import Span


def _tree(text: str) -> Any:
    problems = Problems()
    tree = xml_file.read(text, "a.xml", Reader(problems))
    assert not list(problems)
    return tree


def _plain(tree: Any) -> Any:
    """Return a tree as data, both ways to join words of a key as one."""
    if isinstance(tree, Written):
        return tree.text
    if isinstance(tree, dict):
        return {key.replace("-", "_"): _plain(value) for key, value in tree.items()}
    return [_plain(item) for item in tree]


SAME = {
    "an empty file": ("", "[]"),
    "attributes are keys": ("<let name='a' value='b'/>", "[let: {name: a, value: b}]"),
    "an action without attributes": ("<reset_env/>", "[reset_env: {}]"),
    "actions in order": (
        "<log message='a'/><let name='b' value='c'/><log message='d'/>",
        "[log: {message: a}, let: {name: b, value: c}, log: {message: d}]",
    ),
    "repeated elements are a list": (
        "<node exec='a'><env name='b' value='c'/><remap from='d' to='e'/><env name='f' value='g'/></node>",
        "[node: {exec: a, env: [{name: b, value: c}, {name: f, value: g}], remap: [{from: d, to: e}]}]",
    ),
    "parts in parts": (
        "<node exec='a'><param name='b'><param name='c' value='1'/><param name='d' value='2'/></param></node>",
        "[node: {exec: a, param: [{name: b, param: [{name: c, value: '1'}, {name: d, value: '2'}]}]}]",
    ),
    "elements in a group are its actions but for its keys": (
        "<group scoped='false'><keep name='a' value='b'/><log message='c'/><group><log message='d'/></group></group>",
        "[group: {scoped: 'false', keep: [{name: a, value: b}],"
        " children: [log: {message: c}, group: {children: [log: {message: d}]}]}]",
    ),
    "a timer": (
        "<timer period='1.5'><log message='a'/></timer>",
        "[timer: {period: '1.5', children: [log: {message: a}]}]",
    ),
    "a group of nothing": ("<group/>", "[group: {children: []}]"),
    "choices": (
        "<arg name='a' default='b'><choice value='b'/><choice value='c'/></arg>",
        "[arg: {name: a, default: b, choice: [{value: b}, {value: c}]}]",
    ),
    "a list after a separator": (
        "<node exec='a'><param name='b' value='1, 2,3' value-sep=', '/></node>",
        "[node: {exec: a, param: [{name: b, value: ['1', '2,3']}]}]",
    ),
    "blanks around a separator stay": (
        "<node exec='a'><param name='b' value=' x ; y ' value_sep=';'/></node>",
        "[node: {exec: a, param: [{name: b, value: [' x ', ' y ']}]}]",
    ),
    "a list in brackets": (
        "<arg name='a' choices='[b, \"c, d\", 5]'/>",
        "[arg: {name: a, choices: [b, 'c, d', '5']}]",
    ),
    "a list of one": ("<arg name='a' choices='b: c'/>", "[arg: {name: a, choices: ['b: c']}]"),
    "brackets that may as well be text stay text": (
        "<node exec='a'><param name='b' value='[1, 2]'/></node>",
        "[node: {exec: a, param: [{name: b, value: '[1, 2]'}]}]",
    ),
    "a part that stands once": (
        "<node exec='a'><ready message='/b' timeout='2'/><restart policy='always'/><stop signal='SIGTERM'/></node>",
        "[node: {exec: a, ready: {message: /b, timeout: '2'}, restart: {policy: always}, stop: {signal: SIGTERM}}]",
    ),
    "dependencies": (
        "<include file='a'><depends_on node='/b' condition='ready'/><depends_on label='c'/></include>",
        "[include: {file: a, depends_on: [{node: /b, condition: ready}, {label: c}]}]",
    ),
    "names of the user's choice": (
        "<group><for_each robot='a,b' side='l;r' side-sep=';'/></group>",
        "[group: {for_each: {robot: 'a,b', side: [l, r]}, children: []}]",
    ),
    "lists of names of the user's choice": (
        "<group><for_each robot='[a, b]' side='[c'/></group>",
        "[group: {for_each: {robot: [a, b], side: '[c'}, children: []}]",
    ),
    "output in one word": ("<node exec='a' output='screen'/>", "[node: {exec: a, output: screen}]"),
    "output by stream": (
        "<node exec='a'><output stdout='log' stderr='[screen, log]'/></node>",
        "[node: {exec: a, output: {stdout: log, stderr: [screen, log]}}]",
    ),
    "a command as a list": (
        "<executable cmd='a|b c' cmd-sep='|'/>",
        "[executable: {cmd: [a, b c]}]",
    ),
    "both ways to join words": (
        "<node exec='a' launch-prefix='b'><depends-on node='c'/><depends_on node='d'/></node>"
        "<push-ros-namespace namespace='e'/>",
        "[node: {exec: a, launch_prefix: b, depends_on: [{node: c}, {node: d}]},"
        " push_ros_namespace: {namespace: e}]",
    ),
    "comments, instructions and namespaces": (
        "<!-- a --><?b c?><log xmlns:d='e' message='f'/>",
        "[log: {message: f}]",
    ),
    "entities and line breaks": (
        "<log message='&quot;&lt;&amp;&gt;&apos;&#228;&#xe4;&#10;b\n\tc\r\nd'/>",
        """[log: {message: "\\"<&>'ää\\nb  c d"}]""",
    ),
    "an empty attribute is an empty text": (
        "<set_env name='a' value=''/>",
        "[set_env: {name: a, value: ''}]",
    ),
}


@pytest.mark.conforms("2.1 child", "2.2 order")
@pytest.mark.parametrize("case", SAME)
def test_a_tree_is_the_same_as_in_yaml(case: str) -> None:
    xml, yaml = SAME[case]
    tree = _plain(_tree(f"<launch>{xml}</launch>"))["launch"]["children"]
    assert tree == _plain(yaml_file.read(yaml, "a.yaml", Reader(Problems())))


def test_the_root_may_say_that_it_is_not_to_be_used_any_more() -> None:
    tree = _tree("<?xml version='1.0' encoding='utf-16'?>\n<launch version='0.1' deprecated='why'/>")
    assert _plain(tree) == {"launch": {"deprecated": "why", "children": []}}


def _cut(text: str, span: Span) -> str:
    whole = source("a.xml", text)
    begin = whole.lines[span.line - 1] + span.column - 1
    return text[begin : whole.lines[span.end_line - 1] + span.end_column - 1]


def test_every_name_and_value_is_where_it_is_said_to_be() -> None:
    text = (
        "<launch>\r\n  <!-- ä -->\r\n"
        "  <node  exec = 'é&amp;x' \n\tname\n=\n\"b\" ><param name='ü' value='1,&quot;,2' value-sep=','/></node >\n"
        "</launch>"
    )
    tree = _tree(text)
    (item,) = tree["launch"]["children"]
    node = item["node"]
    (param,) = node["param"]
    assert _cut(text, tree.keys_at["launch"]) == "launch"
    assert _cut(text, item.keys_at["node"]) == _cut(text, node.head) == "node"
    assert [_cut(text, at) for at in node.keys_at.values()] == ["exec", "name", "param"]
    assert _cut(text, node["exec"].span) == "é&amp;x"
    assert _cut(text, node["exec"].spans(1, 3)) == "&amp;x"
    assert _cut(text, node["name"].span) == "b"
    assert [_cut(text, at) for at in param.keys_at.values()] == ["name", "value"]
    assert [_cut(text, item.span) for item in param["value"]] == ["1", "&quot;", "2"]
    assert (node["name"].span.line, node["name"].span.column) == (6, 2)


def test_items_of_a_list_in_brackets_are_where_they_are_said_to_be() -> None:
    text = """<launch><arg name='a' choices='[b&lt;c, "d", "e\\tf", &#9;g]'/></launch>"""
    items = _tree(text)["launch"]["children"][0]["arg"]["choices"]
    assert [item.text for item in items] == ["b<c", "d", "e\tf", "g"]
    assert [_cut(text, item.span) for item in items] == ["b&lt;c", "d", '"e\\tf"', "g"]
    assert _cut(text, items[0].spans(1, 2)) == "&lt;"
    assert _cut(text, items[2].spans(1, 2)) == '"e\\tf"'


_WAYS = {"&": ["&amp;", "&#38;"], "<": ["&lt;", "&#x3c;"], '"': ["&quot;"], "\n": ["&#10;"], "\t": ["&#x9;"]}
_characters = st.sampled_from("ab &<\"\n\t>'é\U0001f600;#").flatmap(
    lambda character: st.tuples(
        st.just(character), st.sampled_from([*_WAYS.get(character, [character]), f"&#{ord(character)};"])
    )
) | st.tuples(st.just(" "), st.sampled_from(["\n", "\t", "\r\n", "\r", " "]))


@given(st.lists(_characters, max_size=12).filter(lambda pieces: ("\r", "\n") not in _neighbours(pieces)))
def test_every_character_of_a_value_is_found_again(pieces: list[tuple[str, str]]) -> None:
    text = f'<!-- é -->\n<launch a="{"".join(written for _, written in pieces)}"/>'
    whole = source("a.xml", text)
    (attribute,) = parse(whole).attributes
    value = attribute.written(whole)
    assert value.text == "".join(character for character, _ in pieces)
    for at, (_, written) in enumerate(pieces):
        assert _cut(text, value.spans(at, at + 1)) == written
    assert _cut(text, value.spans(0, len(pieces))) == _cut(text, value.span)


def _neighbours(pieces: list[tuple[str, str]]) -> list[tuple[str, str]]:
    """Return the source of all pieces beside each other: a return before a line feed is one break with it."""
    written = [piece for _, piece in pieces]
    return [(one[-1], other[0]) for one, other in pairwise(written)]


def _loaded(text: str | bytes, folder: Path, name: str) -> list[tuple[Code, int, int]]:
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    problems = Problems()
    load(str(path), problems)
    return [(found.code, found.span.line, found.span.column) for found in problems if found.span is not None]


@pytest.mark.parametrize(
    "text",
    [
        "launch: []",
        "<launch/>",
        "\n <launch/>",
        "\ufeff<launch/>",
        "# <\nlaunch: []",
    ],
)
def test_a_file_that_ends_in_launch_is_what_it_begins_with(text: str, tmp_path: Path) -> None:
    assert _loaded(text, tmp_path, "a.launch") == []


@pytest.mark.conforms("2.1 file open order", "D5", "7 17")
@pytest.mark.parametrize(("name", "text"), [("a.launch.xml", "launch: []"), ("a.launch.yaml", "<launch/>")])
def test_no_format_is_tried_for_another(name: str, text: str, tmp_path: Path) -> None:
    assert [code for code, *_ in _loaded(text, tmp_path, name)] in ([Code.SYNTAX], [Code.WRONG_TYPE])


def test_what_the_page_on_launch_files_shows_is_read_without_a_fault(tmp_path: Path) -> None:
    page = Path(__file__).parents[2].joinpath("docs/launch-files.md").read_text("utf-8")
    (shown,) = re.findall(r"```xml\n(.*?)```", page, re.DOTALL)
    assert _loaded(shown, tmp_path, "a.launch.xml") == []


_MESSAGE = "<launch><log message='ä'/></launch>"


@pytest.mark.parametrize(
    ("value", "told"),
    [("maze'", True), ("maze&apos;", False), ("maze&quot;", False), ("&lt;'", True), ("'maze'", False)],
)
def test_a_quote_at_the_end_of_a_value_is_one_too_many_unless_it_is_an_entity(
    tmp_path: Path, value: str, *, told: bool
) -> None:
    found = _loaded(f'<launch><log message="{value}"/></launch>', tmp_path, "a.launch.xml")
    assert [code for code, *_ in found] == [Code.SURPRISING_SCALAR] * told


@pytest.mark.parametrize(
    ("content", "faults"),
    [
        (_MESSAGE.encode("utf-8-sig"), []),
        (_MESSAGE.encode("utf-16"), []),
        (_MESSAGE.encode("utf-16-le"), []),
        (_MESSAGE.encode("utf-16-be"), []),
        (b"<\0" + _MESSAGE[1:].encode(), [(Code.SYNTAX, 1, 2)]),
        (b"\0" + _MESSAGE.encode(), [(Code.SYNTAX, 1, 1)]),
        (f"<?xml version='1.0' encoding='latin-1'?>{_MESSAGE}".encode("latin-1"), []),
        (f"<?xml version='1.0' encoding='latin-1'?>{_MESSAGE}".encode(), []),
        (_MESSAGE.encode("latin-1"), [(Code.SYNTAX, 1, 23)]),
        (f"<?xml version='1.0' encoding='martian'?>{_MESSAGE}".encode("latin-1"), [(Code.SYNTAX, 1, 31)]),
        (f"<?xml version='1.0' encoding='ascii'?>{_MESSAGE}".encode("latin-1"), [(Code.SYNTAX, 1, 61)]),
    ],
)
def test_a_text_is_read_in_its_encoding(
    content: bytes, faults: list[tuple[Code, int, int]], tmp_path: Path
) -> None:
    assert _loaded(content, tmp_path, "a.launch.xml") == faults


def _seconds(nodes: int) -> float:
    node = "<node pkg='p' exec='e' name='n'><param name='a' value='x &quot;$(var b c)&quot;'/></node>\n"
    text = f"<launch>{node * nodes}</launch>"
    gc.disable()  # as while a plan is made: how long it takes depends on all that is there
    try:
        begin = time.process_time()
        assert isinstance(xml_file.read(text, "a.xml", Reader(Problems())), Keyed)
        return time.process_time() - begin
    finally:
        gc.enable()


def test_reading_takes_time_in_proportion_to_the_file() -> None:
    """Sixteen times the nodes would take 256 times as long if each were looked for from the beginning."""
    assert min(_seconds(1600) for _ in range(3)) < 80 * min(_seconds(100) for _ in range(5))
