"""Every mistake is told once, at its place, however deep it stands; what only follows from it is not told."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code, Severity
from orchestra.resolve.command_line import COMMAND_LINE
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from orchestra.location import Span

Fault = tuple[Code, str, int, str, str | None]

EVERYTHING = {
    "main.yaml": """launch:
- arg: {name: world, default: arena, choices: [arena, maze]}
- arg: {name: speed, defualt: "1.0"}
- group:
    scoped: true
    children:
    - include: {file: $(dirname)/sub/innr.yaml}
    - include:
        file: sub/inner.yaml
        for_each: {robot: [r1, r2]}
        arg:
        - {name: naem, value: $(var robot)}
- timer:
    period: soon
    children:
    - node: {pkg: bringup, exec: ekff, name: n1}
- node:
    pkg: bringup
    exec: ekf
    exec: ekf
    name: n2
    param: [{from: sub/parms.yaml}]
- node: {pkg: bringup, exec: ekf, name: n2, depends_on: [{node: r1/tiwn}]}
- node: {pkg: bringupp, exec: ekf, name: n3}
- log: {message: $(vra world)}
""",
    "sub/inner.yaml": """launch:
- arg: {name: name}
- include: {file: deep.yaml}
- node: {pkg: bringup, exec: ekf, name: $(var name), outptu: screen}
""",
    "sub/deep.yaml": """launch:
- ndoe: {pkg: bringup, exec: ekf, name: other, namespace: $(var robot)}
- log: {message: $(var wrold)}
- node: {pkg: bringup, exec: ekf, name: twin, respawn: perhaps, namespace: $(var robot)}
- node: {pkg: bringup, exec: ekf, name: twin, namespace: $(var robot)}
""",
    "sub/params.yaml": "/**: {ros__parameters: {a: 1}}\n",
}


def faults(folder: Path, files: dict[str, str] | str, *words: str) -> list[Fault]:
    """Return code, file, line, marked text and suggestion of each problem, in the order in which people see them."""
    problems = outcome(folder, files, *words).problems.ordered
    return [
        (
            problem.code,
            Path(problem.span.file).name,
            problem.span.line,
            marked(problem.span),
            problem.suggestion,
        )
        for problem in problems
        if problem.span is not None
    ]


def marked(span: Span) -> str:
    """Return the text of a span, of its first line where it has several."""
    if span.file == COMMAND_LINE:
        return "wordl"[span.column - 1 : span.end_column - 1]
    line = Path(span.file).read_bytes().decode().replace("\r\n", "\n").split("\n")[span.line - 1]
    return line[span.column - 1 : span.end_column - 1 if span.end_line == span.line else None]


def test_all_kinds_of_mistakes_in_one_run(tmp_path: Path) -> None:
    assert faults(tmp_path, EVERYTHING, "wordl:=maze") == [
        (Code.UNKNOWN_KEY, "main.yaml", 3, "defualt", "default"),
        (Code.MISSING_FILE, "main.yaml", 7, "$(dirname)/sub/innr.yaml", "$(dirname)/sub/inner.yaml"),
        (Code.UNKNOWN_ARGUMENT, "main.yaml", 12, "naem", "name"),
        (Code.WRONG_TYPE, "main.yaml", 14, "soon", None),
        (Code.MISSING_EXECUTABLE, "main.yaml", 16, "ekff", "ekf"),
        (Code.DUPLICATE_KEY, "main.yaml", 20, "exec", None),
        (Code.MISSING_FILE, "main.yaml", 22, "sub/parms.yaml", "sub/params.yaml"),
        (Code.DUPLICATE_NODE, "main.yaml", 23, "n2", None),
        (Code.UNKNOWN_DEPENDENCY, "main.yaml", 23, "r1/tiwn", "r1/twin"),
        (Code.MISSING_PACKAGE, "main.yaml", 24, "bringupp", "bringup"),
        (Code.UNKNOWN_SUBSTITUTION, "main.yaml", 25, "vra", "var"),
        (Code.UNKNOWN_KEY, "inner.yaml", 4, "outptu", "output"),
        (Code.UNKNOWN_ACTION, "deep.yaml", 2, "ndoe", "node"),
        (Code.UNDEFINED_VARIABLE, "deep.yaml", 3, "wrold", "world"),
        (Code.WRONG_TYPE, "deep.yaml", 4, "perhaps", None),
        (Code.DUPLICATE_NODE, "deep.yaml", 5, "twin", None),
        (Code.UNKNOWN_ARGUMENT, "command line", 1, "wordl", "world"),
    ]


def test_the_includes_on_the_way_are_named_innermost_first(tmp_path: Path) -> None:
    problems = outcome(tmp_path, EVERYTHING).problems
    ways = {
        tuple((span.file.rsplit("/")[-1], span.line) for span in problem.included_from)
        for problem in problems
        if problem.span is not None and problem.span.file.endswith("deep.yaml")
    }
    assert ways == {(("inner.yaml", 3), ("main.yaml", 8))}


# A launch file, and the mistakes in it: code, line, marked text, suggestion.
ONE_FILE: dict[str, tuple[str, list[tuple[Code, int, str, str | None]]]] = {
    "a value is read behind a mistyped key": (
        "- node: {pkg: bringup, exec: ekf, nmae: $(vra x)}",
        [(Code.UNKNOWN_KEY, 2, "nmae", "name"), (Code.UNKNOWN_SUBSTITUTION, 2, "vra", "var")],
    ),
    "the children of a mistyped group are read": (
        "- gruop: {childern: [{log: {mesage: $(var nope)}}]}",
        [
            (Code.UNKNOWN_ACTION, 2, "gruop", "group"),
            (Code.UNKNOWN_KEY, 2, "childern", "children"),
            (Code.UNKNOWN_KEY, 2, "mesage", "message"),
            (Code.UNDEFINED_VARIABLE, 2, "nope", None),
        ],
    ),
    "a variable of a mistyped action is set": (
        "- lett: {name: a, value: b}\n- log: {message: $(var a)}",
        [(Code.UNKNOWN_ACTION, 2, "lett", "let")],
    ),
    "a variable without a value is not undefined": (
        "- let: {name: a}\n- log: {message: $(var a)}",
        [(Code.MISSING_KEY, 2, "let", None)],
    ),
    "a variable of an action that is left out is not undefined": (
        "- letter: [a]\n- log: {message: $(var a)}",
        [(Code.UNKNOWN_ACTION, 2, "letter", "let")],
    ),
    "a faulty environment variable is not unset": (
        "- set_env: {name: E_1, value: $(var nope)}\n- log: {message: $(env E_1)}",
        [(Code.UNDEFINED_VARIABLE, 2, "nope", None)],
    ),
    "a faulty parameter of all nodes is not unset": (
        "- set_parameter: {name: p, value: $(var nope)}\n- log: {message: $(param p)}",
        [(Code.UNDEFINED_VARIABLE, 2, "nope", None)],
    ),
    "nodes in a faulty namespace are not called the same": (
        "- group:\n"
        "  - push_ros_namespace: {namespace: $(var nope)}\n"
        "  - node: {exec: a, name: n}\n"
        "- node: {exec: a, name: n}\n"
        "- executable: {cmd: a, depends_on: [{node: n}]}",
        [(Code.UNDEFINED_VARIABLE, 3, "nope", None)],
    ),
    "a dependency on what is left out is not unknown": (
        "- node: {name: a, exec: {}}\n"
        "- node: [{name: b}]\n"
        "- executable: {cmd: x, depends_on: [{node: a}, {node: b}]}",
        [(Code.WRONG_TYPE, 2, "{}", None), (Code.WRONG_TYPE, 3, "[{name: b}]", None)],
    ),
    "names with other numbers are no slips": (
        "- include: {file: nope.yaml}\n"
        "- node: {exec: a, name: robot1}\n"
        "- executable: {cmd: x, depends_on: [{node: robot2}]}",
        [(Code.MISSING_FILE, 2, "nope.yaml", None)],
    ),
    "a slip is one beside other mistakes too": (
        "- include: {file: nope.yaml}\n"
        "- node: {exec: a, name: robot1}\n"
        "- executable: {cmd: x, depends_on: [{node: robto1}]}",
        [(Code.MISSING_FILE, 2, "nope.yaml", None), (Code.UNKNOWN_DEPENDENCY, 4, "robto1", "robot1")],
    ),
    "a timer without a period is gone into": (
        "- timer: {children: [{log: {message: $(var nope)}}]}",
        [(Code.MISSING_KEY, 2, "timer", None), (Code.UNDEFINED_VARIABLE, 2, "nope", None)],
    ),
    "a folder that is misspelt": (
        "- include: {file: sbu/innr.yaml}\n- executable: {cmd: ./sbu/inner.yaml}",
        [
            (Code.MISSING_FILE, 2, "sbu/innr.yaml", "sub/inner.yaml"),
            (Code.MISSING_EXECUTABLE, 3, "./sbu/inner.yaml", "./sub/inner.yaml"),
        ],
    ),
    "a file that cannot be executed": (
        "- executable: {cmd: 'sub/inner.yaml --x'}",
        [(Code.MISSING_EXECUTABLE, 2, "sub/inner.yaml", None)],
    ),
    "keys beside the name of their action": (
        "- node:\n  pkg: bringup\n  exce: ekf",
        [(Code.WRONG_TYPE, 3, "pkg", None), (Code.UNKNOWN_KEY, 4, "exce", "exec")],
    ),
    "keys of other dialects": (
        "- node: {package: bringup, executable: ekf, parameters: [{a: 1}]}",
        [
            (Code.UNKNOWN_KEY, 2, "package", "pkg"),
            (Code.UNKNOWN_KEY, 2, "executable", "exec"),
            (Code.UNKNOWN_KEY, 2, "parameters", "param"),
        ],
    ),
    "a word that is none of those it can be, once it is known": (
        "- let: {name: w, value: scren}\n"
        "- executable: {cmd: x, output: $(var w), restart: {policy: $(var w)}}\n"
        "- executable: {cmd: y, on_exit: $(var w), depends_on: [{process: x, condition: $(var w)}]}",
        [
            (Code.BAD_VALUE, 2, "scren", "screen"),
            (Code.BAD_VALUE, 3, "$(var w)", None),
            (Code.BAD_VALUE, 4, "$(var w)", None),
            (Code.BAD_VALUE, 4, "$(var w)", None),
        ],
    ),
    "variables that upstream gives a meaning": (
        "- let: {name: launch-prefix, value: '\"'}\n"
        "- let: {name: emulate_tty, value: perhaps}\n"
        "- executable: {cmd: x}",
        [(Code.BAD_VALUE, 2, '"', None), (Code.BAD_VALUE, 3, "perhaps", None)],
    ),
    "circles of dependencies, each once": (
        "- executable: {cmd: x, name: a, depends_on: [{process: b}]}\n"
        "- executable: {cmd: x, name: b, depends_on: [{process: a}]}\n"
        "- executable: {cmd: x, name: c, depends_on: [{process: d}]}\n"
        "- executable: {cmd: x, name: d, depends_on: [{process: c}]}\n"
        "- executable: {cmd: x, name: e, depends_on: [{process: e}]}\n",
        [
            (Code.DEPENDENCY_CYCLE, 3, "a", None),
            (Code.DEPENDENCY_CYCLE, 5, "c", None),
            (Code.DEPENDENCY_CYCLE, 6, "e", None),
        ],
    ),
    "lists point at their faulty item": (
        "- set_parameter: {name: a, value: [1, {b: c}]}\n- group: {for_each: {r: [x, [y]]}, children: []}",
        [(Code.WRONG_TYPE, 2, "{b: c}", None), (Code.WRONG_TYPE, 3, "[y]", None)],
    ),
    "a default that is no choice": (
        "- let: {name: w, value: a}\n- arg: {name: w, default: c, choices: [a, b]}",
        [(Code.NOT_A_CHOICE, 3, "c", None)],
    ),
}


@pytest.mark.parametrize("case", ONE_FILE)
def test_mistakes_of_one_file(case: str, tmp_path: Path) -> None:
    text, expected = ONE_FILE[case]
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "inner.yaml").write_text("launch: []\n")
    found = [(code, line, mark, near) for code, _, line, mark, near in faults(tmp_path, f"launch:\n{text}\n")]
    assert found == expected


INNER = "launch:\n- arg: {name: robot}\n- arg: {name: colour, default: red, choices: [red, green]}\n- log: {message: $(var robot)}\n"

# How a file with a required argument and one of two choices is included, and the mistakes in that.
INCLUDES: dict[str, tuple[str, list[tuple[Code, int, str, str | None]]]] = {
    "nothing is given": (
        "{file: inner.yaml}",
        [(Code.MISSING_ARGUMENT, 2, "include", None)],
    ),
    "a misspelt name is told, and not that the right one lacks": (
        "{file: inner.yaml, arg: [{name: robto, value: r}]}",
        [(Code.UNKNOWN_ARGUMENT, 2, "robto", "robot")],
    ),
    "a misspelt name of one with a default": (
        "{file: inner.yaml, arg: [{name: robot, value: r}, {name: color, value: red}]}",
        [(Code.UNKNOWN_ARGUMENT, 2, "color", "colour")],
    ),
    "a misspelt choice": (
        "{file: inner.yaml, arg: [{name: robot, value: r}, {name: colour, value: gren}]}",
        [(Code.NOT_A_CHOICE, 2, "gren", "green")],
    ),
    "a name that nobody knows": (
        "{file: inner.yaml, arg: [{name: robot, value: r}, {name: shape, value: round}]}",
        [(Code.UNREAD_ARGUMENT, 2, "shape", None)],
    ),
    "a faulty value is none that lacks": (
        "{file: inner.yaml, arg: [{name: robot, value: $(var nope)}]}",
        [(Code.UNDEFINED_VARIABLE, 2, "nope", None)],
    ),
}


@pytest.mark.parametrize("case", INCLUDES)
@pytest.mark.parametrize("times", [1, 3])
def test_mistakes_in_including(case: str, times: int, tmp_path: Path) -> None:
    """Each include of a file has mistakes of its own; those of a repeated one are told once."""
    written, expected = INCLUDES[case]
    again = written.replace("{file:", "{scoped: true, file:")
    main = "launch:\n" + f"- include: {again}\n" * times
    found = faults(tmp_path, {"main.yaml": main, "inner.yaml": INNER})
    every = [
        (code, "main.yaml", line + index, mark, near)
        for index in range(times)
        for code, line, mark, near in expected
    ]
    assert found == every
    repeated = written.replace("{file:", "{for_each: {i: [1, 2, 3]}, file:")
    assert len(
        faults(tmp_path, {"main.yaml": f"launch:\n- include: {repeated}\n", "inner.yaml": INNER})
    ) == len(expected)


def test_a_faulty_file_that_is_included_twice_is_told_once(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- include: {file: a.yaml}\n- group: [{include: {file: b.yaml}}]\n",
        "a.yaml": "launch:\n- include: {file: b.yaml}\n",
        "b.yaml": "launch:\n- lgo: {}\n- log: {message: $(var nope)}\n- node: {exec: ./nope.sh, param: [{from: p.yaml}]}\n",
        "p.yaml": "/**: {ros__parameters: {a: [1, b]}}\n",
    }
    problems = outcome(tmp_path, files).problems
    assert [problem.code for problem in problems.ordered] == [
        *(Code.UNKNOWN_ACTION, Code.UNDEFINED_VARIABLE, Code.MISSING_EXECUTABLE),
        Code.PARAMETER_TYPE,
    ]
    assert all(len(problem.included_from) >= 1 for problem in problems)


def test_a_file_that_is_no_yaml_is_told_once_and_the_rest_is_read(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- include: {file: a.yaml}\n- include: {file: a.yaml}\n- lgo: {}\n",
        "a.yaml": "launch:\n- log: [\n",
    }
    assert [fault[:2] for fault in faults(tmp_path, files)] == [
        (Code.UNKNOWN_ACTION, "main.yaml"),
        (Code.SYNTAX, "a.yaml"),
    ]


PLACES = {
    "flow style": "- node: {pkg: a, exce: b}",
    "block style": "- node:\n    pkg: a\n    exce: b",
    "quoted": '- node: {pkg: a, "exce": b}',
    "behind wide characters": "- node: {pkg: 日本, exce: b}",
    "with CRLF": "- node:\r\n    pkg: a\r\n    exce: b",
    "with an anchor": "- node: &n\n    pkg: a\n    exce: b",
    "merged": "- node: {<<: {pkg: a, exce: b}}",
    "behind a folded scalar": "- node:\n    args: >-\n      a\n\n      b\n    exce: b",
}


@pytest.mark.parametrize("style", PLACES)
def test_the_place_of_a_key_is_exact_in_every_style(style: str, tmp_path: Path) -> None:
    text = f"launch:\n{PLACES[style]}\n"
    (problem,) = [problem for problem in outcome(tmp_path, text).problems if problem.code is Code.UNKNOWN_KEY]
    assert problem.span is not None
    assert marked(problem.span).strip('"') == "exce"


def test_a_package_that_only_ros_1_has_is_told_with_what_does_its_work(tmp_path: Path) -> None:
    index = tmp_path / "prefix/share/ament_index/resource_index/packages"
    index.mkdir(parents=True)
    (index / "rviz2").touch()
    text = "launch:\n- node: {pkg: rviz, exec: rviz}\n- node: {pkg: tf, exec: static_transform_publisher}\n"
    found = outcome(
        tmp_path, text, launching=False, environment={"AMENT_PREFIX_PATH": str(tmp_path / "prefix")}
    )
    told = [(item.severity, item.suggestion) for item in found.problems if item.code is Code.MISSING_PACKAGE]
    assert told == [(Severity.ERROR, "rviz2"), (Severity.WARNING, None)]


def test_a_missing_package_is_a_warning_where_nothing_starts(tmp_path: Path) -> None:
    text = (
        "launch:\n- node: {pkg: nav2_bringup, exec: a, name: n, param: [{from: $(find-pkg-share nav2_bringup)/x.yaml}]}\n"
        "- include: {file: $(find-pkg-share nav2_bringup)/launch/x.py}\n- executable: {cmd: x, depends_on: [{node: m}]}\n"
    )
    there = outcome(tmp_path, text, launching=False)
    assert [(problem.code, problem.severity) for problem in there.problems] == [
        (Code.MISSING_PACKAGE, Severity.WARNING)
    ]
    here = outcome(tmp_path, text)
    assert [(problem.code, problem.severity) for problem in here.problems] == [
        (Code.MISSING_PACKAGE, Severity.ERROR)
    ] * 3
    slip = outcome(tmp_path, "launch:\n- node: {pkg: brinugp, exec: ekf}\n", launching=False)
    assert [(problem.severity, problem.suggestion) for problem in slip.problems] == [
        (Severity.ERROR, "bringup")
    ]
