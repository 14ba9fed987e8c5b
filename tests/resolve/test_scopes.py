"""Who sees which value: groups, includes, repetition, deferred actions, in upstream's order."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path

SAY = "- log: {message: $(var t unset)}"
MESSAGES = {
    "a variable is seen by what follows": ("launch:\n- let: {name: t, value: a}\n" + SAY, ["a"]),
    "a default counts where nothing is set": ("launch:\n- arg: {name: t, default: d}\n" + SAY, ["d"]),
    "a value that is set already wins over a default": (
        "launch:\n- let: {name: t, value: a, if: true}\n- arg: {name: t, default: d}\n" + SAY,
        ["a"],
    ),
    "a group ends what is set in it": (
        "launch:\n- group:\n  - let: {name: t, value: a}\n  " + SAY + "\n" + SAY,
        ["a", "unset"],
    ),
    "a group that is not scoped does not": (
        "launch:\n- group: {scoped: false, children: [{let: {name: t, value: a}}]}\n" + SAY,
        ["a"],
    ),
    "a group without forwarding sees only what it keeps": (
        "launch:\n- let: {name: t, value: a}\n- let: {name: u, value: b}\n"
        "- group: {forwarding: false, keep: [{name: t, value: $(var u)}], children: ["
        "{log: {message: $(var t unset)}}, {log: {message: $(var u unset)}}]}",
        ["b", "unset"],
    ),
    "conditions are evaluated in order": (
        "launch:\n- let: {name: t, value: a}\n- let: {name: t, value: b, if: $(equals $(var t) a)}\n" + SAY,
        ["b"],
    ),
    "unless is the negation": (
        "launch:\n- let: {name: t, value: a, unless: false}\n- let: {name: t, value: b, unless: true}\n"
        + SAY,
        ["a"],
    ),
    "a group is repeated once per value": (
        "launch:\n- group: {for_each: {t: [a, b], u: [1, 2]}, children: [{log: {message: $(var t)$(var u)}}]}\n"
        + SAY,
        ["a1", "a2", "b1", "b2", "unset"],
    ),
    "an argument can carry the values": (
        "launch:\n- arg: {name: all, default: 'a, b'}\n"
        "- group: {for_each: {t: $(var all)}, children: [{log: {message: $(var t)}}]}",
        ["a", "b"],
    ),
}


@pytest.mark.conforms(
    "4.2 scoped and forwarding",
    "4.2 scoped without forwarding",
    "4.2 not scoped",
    "4.3 default values",
    "1.3.1 value that is set",
    "1.3.1 default",
    "7 3",
    "7 4",
    "7 5",
)
@pytest.mark.parametrize("case", MESSAGES)
def test_what_is_seen_where(case: str, tmp_path: Path) -> None:
    text, messages = MESSAGES[case]
    found = outcome(tmp_path, text)
    assert found.messages == messages
    assert list(found.problems) == []


INNER = "launch:\n- arg: {name: t, default: d}\n" + SAY


@pytest.mark.conforms("4.3 scope", "4.3 arguments", "7 2", "D1", "1.3.1 effect")
def test_arguments_of_an_include_reach_its_file_and_stay_set_as_upstream(tmp_path: Path) -> None:
    main = "launch:\n- include: {file: inner.yaml, arg: [{name: t, value: a}]}\n" + SAY
    found = outcome(tmp_path, {"main.yaml": main, "inner.yaml": INNER})
    assert found.messages == ["a", "a"]
    assert found.faults == [(Code.LEAKED_VALUE, "main.yaml", 3, 18)]


@pytest.mark.conforms("4.3 default values", "7 1", "D1", "4.3 duplicate declarations")
def test_the_first_default_of_two_siblings_wins_with_a_warning(tmp_path: Path) -> None:
    main = "launch:\n- include: {file: one.yaml}\n- include: {file: two.yaml}\n"
    two = INNER.replace("default: d", "default: e")
    found = outcome(tmp_path, {"main.yaml": main, "one.yaml": INNER, "two.yaml": two})
    assert found.messages == ["d", "d"]
    assert found.faults == [(Code.LEAKED_VALUE, "two.yaml", 2, 3)]


@pytest.mark.conforms("D1")
def test_a_scoped_include_leaves_nothing_behind(tmp_path: Path) -> None:
    main = "launch:\n- include: {file: inner.yaml, scoped: true, arg: [{name: t, value: a}]}\n" + SAY
    found = outcome(tmp_path, {"main.yaml": main, "inner.yaml": INNER})
    assert found.messages == ["a", "unset"]
    assert list(found.problems) == []


def test_an_include_is_repeated_with_its_own_arguments(tmp_path: Path) -> None:
    main = (
        "launch:\n- include: {file: inner.yaml, for_each: {r: [a, b]}, arg: [{name: t, value: $(var r)}]}\n"
        + SAY
    )
    found = outcome(tmp_path, {"main.yaml": main, "inner.yaml": INNER})
    assert found.messages == ["a", "b", "unset"]
    assert list(found.problems) == []


@pytest.mark.conforms("4.3 path", "4.3 current file", "D2", "D38")
def test_an_include_is_found_beside_the_including_file_not_the_first_one(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- include: {file: sub/a.yaml}\n- log: {message: $(dirname)}",
        "sub/a.yaml": "launch:\n- include: {file: b.yaml}\n",
        "sub/b.yaml": "launch:\n- log: {message: $(filename)}",
    }
    found = outcome(tmp_path, files)
    assert found.messages == [str(tmp_path / "sub/b.yaml"), str(tmp_path)]


def test_a_file_that_includes_itself_is_reported(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- include: {file: b.yaml}",
        "b.yaml": "launch:\n- include: {file: main.yaml}",
    }
    found = outcome(tmp_path, files)
    assert found.faults == [(Code.INCLUDE_CYCLE, "b.yaml", 2, 19)]


def test_problems_of_an_included_file_name_the_way_to_it(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- include: {file: b.yaml}",
        "b.yaml": "launch:\n- include: {file: c.yaml}",
        "c.yaml": "launch:\n- log: {message: $(var x)}",
    }
    (problem,) = outcome(tmp_path, files).problems
    assert [span.file.rsplit("/")[-1] for span in problem.included_from] == ["b.yaml", "main.yaml"]
    assert [span.line for span in problem.included_from] == [2, 2]


@pytest.mark.conforms("4.1 3", "4.2 deferred actions", "D26", "7 14", "4.12 delayed")
def test_a_timer_sees_the_scope_it_was_written_in(tmp_path: Path) -> None:
    text = (
        "launch:\n- group:\n  - push_ros_namespace: {namespace: a}\n  - set_env: {name: X, value: y}\n"
        "  - timer: {period: 2, children: [{node: {exec: sleep, name: n}}, {timer: {period: 1.5, children: "
        "[{shutdown: {reason: done}}]}}]}\n"
    )
    found = outcome(tmp_path, text)
    process = found.process("/a/n")
    assert process.environment == {"X": "y"}
    assert [(trigger.delay, [action.action for action in trigger.do]) for trigger in found.plan.triggers] == [
        (2.0, ["start"]),
        (3.5, ["shutdown"]),
    ]


@pytest.mark.conforms("4.2 scoped and forwarding", "7 3")
def test_the_environment_of_a_group_ends_with_it(tmp_path: Path) -> None:
    text = (
        "launch:\n- group:\n  - set_env: {name: X, value: y}\n  - unset_env: {name: GONE}\n"
        "  - log: {message: $(env X) $(env GONE none)}\n  - executable: {cmd: 'true', env: [{name: X, value: z}]}\n"
        "- log: {message: $(env X none) $(env GONE)}\n- executable: {cmd: 'true'}\n"
    )
    found = outcome(tmp_path, text, environment={"GONE": "here", "PATH": "/bin"})
    assert found.messages == ["y none", "none here"]
    inside, outside = found.plan.processes
    assert inside.environment == {"X": "z", "GONE": None}
    assert [candidate.won for candidate in inside.provenance.environment["X"]] == [False, True]
    assert outside.environment == {}


ARGUMENTS = "launch:\n- arg: {name: world, default: arena, choices: [arena, maze]}\n- arg: {name: speed}\n"


@pytest.mark.conforms("5.3 a:=b", "5.3 a:=b:=c")
def test_arguments_of_the_command_line(tmp_path: Path) -> None:
    found = outcome(tmp_path, ARGUMENTS, "world:=maze", "speed:=a:=b")
    assert [(argument.name, argument.default, argument.value) for argument in found.plan.arguments] == [
        ("world", "arena", "maze"),
        ("speed", None, "a:=b"),
    ]
    assert list(found.problems) == []


@pytest.mark.conforms("1.3.1 no default", "1.3.1 value that is no choice", "D3", "7 15", "5.3 undeclared")
@pytest.mark.parametrize(
    ("words", "code", "suggestion"),
    [
        (("speed:=1", "wrold:=maze"), Code.UNKNOWN_ARGUMENT, "world"),
        (("speed:=1", "world:=mase"), Code.NOT_A_CHOICE, "maze"),
        ((), Code.MISSING_ARGUMENT, None),
    ],
)
def test_arguments_that_are_wrong(
    words: tuple[str, ...], code: Code, suggestion: str | None, tmp_path: Path
) -> None:
    (problem,) = outcome(tmp_path, ARGUMENTS, *words).problems
    assert (problem.code, problem.suggestion) == (code, suggestion)


@pytest.mark.conforms("D3")
def test_an_argument_is_known_where_it_is_only_read(tmp_path: Path) -> None:
    assert list(outcome(tmp_path, "launch:\n" + SAY, "t:=1").problems) == []


def test_an_unknown_argument_is_a_warning_where_a_condition_hides_an_include(tmp_path: Path) -> None:
    found = outcome(tmp_path, "launch:\n- include: {file: a.yaml, if: false}", "t:=1")
    assert [problem.code for problem in found.problems] == [Code.UNREAD_ARGUMENT]


@pytest.mark.conforms("4.3 extra arguments", "D3")
def test_an_include_argument_that_was_misspelt(tmp_path: Path) -> None:
    main = "launch:\n- include: {file: inner.yaml, arg: [{name: tt, value: a}]}"
    inner = INNER.replace("name: t,", "name: ttt,").replace("$(var t", "$(var ttt")
    found = outcome(tmp_path, {"main.yaml": main, "inner.yaml": inner})
    (problem,) = found.problems
    assert (problem.code, problem.suggestion) == (Code.UNKNOWN_ARGUMENT, "ttt")


@pytest.mark.conforms("4.3 extra arguments", "D3")
def test_an_include_argument_that_nobody_reads_is_a_warning(tmp_path: Path) -> None:
    main = "launch:\n- include: {file: inner.yaml, arg: [{name: colour, value: a}]}"
    found = outcome(tmp_path, {"main.yaml": main, "inner.yaml": INNER})
    assert [problem.code for problem in found.problems] == [Code.UNREAD_ARGUMENT]


def test_a_faulty_value_is_reported_once_however_often_it_is_used(tmp_path: Path) -> None:
    text = (
        "launch:\n- let: {name: t, value: $(var nothing)}\n"
        + SAY
        + "\n"
        + SAY
        + "\n- log: {message: a, if: $(var t)}"
    )
    assert [fault[2:] for fault in outcome(tmp_path, text).faults] == [(2, 31)]


@pytest.mark.conforms("D1", "4.3 scope")
def test_a_file_of_nothing_but_values_is_included_for_their_sake(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- include: {file: preset.yaml}\n- include: {file: inner.yaml}\n" + SAY,
        "preset.yaml": "launch:\n- arg: {name: t, default: p}\n",
        "inner.yaml": INNER,
    }
    found = outcome(tmp_path, files)
    assert found.messages == ["p", "p"]
    assert list(found.problems) == []
