"""Files that include themselves, scopes that include others, and what is left behind."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code, Severity
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path

COUNTDOWN = """launch:
- arg: {name: n, default: 3}
- log: {message: $(var n)}
- include:
    file: main.yaml
    if: $(eval $(var n)>0)
    arg: [{name: n, value: $(eval $(var n)-1)}]
"""


def test_a_file_may_include_itself_until_a_condition_ends_it(tmp_path: Path) -> None:
    found = outcome(tmp_path, COUNTDOWN)
    assert found.messages == ["3", "2", "1", "0"]
    assert list(found.problems) == []


def test_an_empty_list_of_values_ends_it_too(tmp_path: Path) -> None:
    text = (
        "launch:\n- arg: {name: l, default: '1,2'}\n- log: {message: $(var l)}\n"
        "- group: {for_each: {i: $(var l)}, children: [{include: {file: main.yaml, arg: [{name: l, value: ''}]}}]}\n"
    )
    found = outcome(tmp_path, text)
    assert found.messages == ["1,2", "", ""]
    assert list(found.problems) == []


@pytest.mark.conforms("D78")
@pytest.mark.parametrize(
    ("files", "file", "line", "way"),
    [
        ({"main.yaml": "launch:\n- include: {file: main.yaml}\n"}, "main.yaml", 2, 0),
        (
            {
                "main.yaml": "launch:\n- include: {file: b.yaml}\n",
                "b.yaml": "launch:\n- group: [{include: {file: main.yaml}}]\n",
            },
            *("b.yaml", 2, 1),
        ),
        (
            {
                "main.yaml": "launch:\n- include: {file: b.yaml}\n",
                "b.yaml": "launch:\n- arg: {name: n, default: 0}\n"
                + "- include: {file: b.yaml, arg: [{name: n, value: $(eval $(var n)+1)}]}\n" * 2,
            },
            *("b.yaml", 3, 1),
        ),
        (
            {"main.yaml": "launch:\n- push_ros_namespace: {namespace: a}\n- include: {file: main.yaml}\n"},
            *("main.yaml", 3, 0),
        ),
        (
            {
                "main.yaml": "launch:\n- group: {forwarding: false, children: [{include: {file: main.yaml}}]}\n"
            },
            *("main.yaml", 2, 0),
        ),
    ],
)
def test_a_circle_without_end_is_told_once_where_it_closes(
    files: dict[str, str], file: str, line: int, way: int, tmp_path: Path
) -> None:
    (problem,) = outcome(tmp_path, files).problems
    assert problem.code is Code.INCLUDE_CYCLE
    assert problem.span is not None
    assert problem.span.file.endswith(file)
    assert problem.span.line == line
    assert len(problem.included_from) == way


def test_a_product_that_nobody_wants_ends(tmp_path: Path) -> None:
    values = "[" + ", ".join(map(str, range(100))) + "]"
    text = f"launch:\n- group: {{for_each: {{a: {values}, b: {values}, c: {values}}}, children: []}}\n"
    (problem,) = outcome(tmp_path, text).problems
    assert "actions" in problem.message


INNER = "launch:\n- arg: {name: t, default: d}\n- log: {message: $(var t)}\n"

# What stands after an include of a file with an argument `t` and its default `d`, and whether that is a surprise.
LEFT_BEHIND = {
    "another file with the same default": ("- include: {file: inner.yaml}", False),
    "the same argument with another default": ("- arg: {name: t, default: e}", True),
    "reading it": ("- log: {message: $(var t)}", True),
    "giving it again": ("- include: {file: inner.yaml, arg: [{name: t, value: x}]}", False),
    "setting it": ("- let: {name: t, value: x}\n- log: {message: $(var t)}", False),
    "a default that says the same": (
        "- arg: {name: t, default: $(eval \"'d'\")}\n- log: {message: $(var t)}",
        False,
    ),
    "a scope without it": (
        "- group: {forwarding: false, children: [{log: {message: $(var t e)}}]}",
        False,
    ),
}


@pytest.mark.conforms("D1", "4.3 scope", "4.3 duplicate declarations")
@pytest.mark.parametrize("case", LEFT_BEHIND)
def test_a_value_that_an_include_left_behind(case: str, tmp_path: Path) -> None:
    text, surprise = LEFT_BEHIND[case]
    files = {"main.yaml": f"launch:\n- include: {{file: inner.yaml}}\n{text}\n", "inner.yaml": INNER}
    found = [(problem.code, problem.severity) for problem in outcome(tmp_path, files).problems]
    assert found == [(Code.LEAKED_VALUE, Severity.WARNING)] * surprise


@pytest.mark.conforms("4.3 scope", "D1")
def test_a_namespace_that_an_include_left_behind_is_a_surprise(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- include: {file: b.yaml}\n- node: {exec: a, name: n}\n",
        "b.yaml": "launch:\n- push_ros_namespace: {namespace: inner}\n",
    }
    found = outcome(tmp_path, files)
    assert [process.id for process in found.plan.processes] == ["/inner/n"]
    assert found.faults == [(Code.LEAKED_VALUE, "main.yaml", 3, 3)]


@pytest.mark.conforms("2.1 root attribute")
def test_a_deprecated_file_is_named_once(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- include: {file: old.yaml, for_each: {i: [1, 2]}}\n- include: {file: old.yaml}\n",
        "old.yaml": "launch: {deprecated: use new.yaml, children: []}\n",
    }
    (problem,) = outcome(tmp_path, files).problems
    assert (problem.code, problem.severity) == (Code.DEPRECATED, Severity.WARNING)
    assert problem.message.endswith("old.yaml is deprecated: use new.yaml")
    assert len(problem.included_from) == 1


@pytest.mark.conforms("2.5 file")
def test_places_in_an_evaluated_parameter_file_are_those_of_the_file(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- let: {name: r, value: robot1}\n"
        "- node: {exec: a, name: n, namespace: $(var r), param: [{from: p.yaml, allow_substs: true}]}\n",
        "p.yaml": "/$(var r)/n:\n  ros__parameters:\n    frame: $(var r)/odom\n    home: \\$HOME\n"
        '    "$(var r)_a": 2\n    "$(var r)_a": 3\n',
    }
    found = outcome(tmp_path, files)
    node = found.process("/robot1/n")
    assert node.parameters == {"frame": "robot1/odom", "home": "$HOME", "robot1_a": 3}
    (frame,) = node.provenance.parameters["frame"]
    span = frame.location.span
    assert (span.line, span.column, span.end_line, span.end_column) == (3, 12, 3, 25)
    assert found.faults == [(Code.DUPLICATE_PARAMETER, "p.yaml", 6, 5)]


def test_a_file_that_is_not_here_may_have_set_a_variable(tmp_path: Path) -> None:
    include = "- include: {file: $(find-pkg-share nowhere)/launch/env.launch.yaml}\n"
    scoped = include.replace("}\n", ", scoped: true}\n")
    text = "launch:\n- arg: {name: prefix, default: a}\n"

    def told(before: str, name: str = "preload") -> list[tuple[Code, str, int, int]]:
        faults = outcome(tmp_path, f"{text}{before}- log: {{message: $(var {name})}}\n").faults
        return [fault for fault in faults if fault[0] is Code.UNDEFINED_VARIABLE]

    assert told(include) == []
    assert told(f"- group: {{scoped: false, children: [{include[2:-1]}]}}\n") == []
    assert told("") == [(Code.UNDEFINED_VARIABLE, "main.yaml", 3, 24)]
    assert (
        told(scoped)
        == told(f"- group: [{include[2:-1]}]\n")
        == [(Code.UNDEFINED_VARIABLE, "main.yaml", 4, 24)]
    )
    assert told(include, "prefx") == [(Code.UNDEFINED_VARIABLE, "main.yaml", 4, 24)]
