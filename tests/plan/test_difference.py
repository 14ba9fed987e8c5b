"""What lies between two plans."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan import codec
from orchestra.plan.conditions import Dependency, Ready
from orchestra.plan.difference.compare import compare
from orchestra.plan.digest import digest
from orchestra.plan.model import Argument, Candidate, Component, ParameterFile, Provenance
from orchestra.plan.reactions import LogAction, Trigger, TriggerEvent
from orchestra.plan.render import difference as text
from orchestra.values import Limits, Restart, Stop
from tests.plan.records import at, node, plan, process
from tests.plan.strategies import Actions, descriptions

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.difference.model import Difference, Item
    from orchestra.plan.model import Plan, Process

_quickly = settings(
    max_examples=40,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


def _planned(folder: Path, written: Actions) -> Plan:
    (folder / "main.launch.yaml").write_text(json.dumps({"launch": written}))
    made = collect(str(folder / "main.launch.yaml"), inputs_from([], environment={}), Problems())
    assert made is not None
    return made


@given(descriptions)
@_quickly
def test_a_plan_does_not_differ_from_itself(tmp_path: Path, written: Actions) -> None:
    made = _planned(tmp_path, written)
    assert compare(made, codec.loads(codec.dumps(made))).empty


@given(descriptions, descriptions)
@_quickly
def test_exactly_those_restart_whose_digest_differs(tmp_path: Path, one: Actions, other: Actions) -> None:
    before, after = _planned(tmp_path, one), _planned(tmp_path, other)
    found = compare(before, after)
    _holds(before, after, found)
    _holds(after, before, compare(after, before))


def _holds(before: Plan, after: Plan, found: Difference) -> None:
    old = {item.id: item.digest for item in before.processes}
    new = {item.id: item.digest for item in after.processes}
    assert set(found.ids("start")) == new.keys() - old.keys()
    assert set(found.ids("stop")) == old.keys() - new.keys()
    assert set(found.ids("restart")) == {key for key in new.keys() & old.keys() if new[key] != old[key]}
    assert len({item.id for item in found.processes}) == len(found.processes)
    for item in found.processes:
        assert (item.changes == ()) == (item.fate in ("start", "stop"))
        assert all(change.field != "digest" for change in item.changes)
    assert text.render(found, "a", "b")
    assert json.loads(json.dumps(codec.encode(found)))


_BASE = node(
    "/r/a",
    *("prog", "one", "two", "--ros-args", "-r", "__node:=a", "-r", "__ns:=/r", "--params-file", "x"),
    parameters={"p": 1, "q": "x"},
    environment={"A": "1"},
    remappings=(("a", "b"), ("c", "d")),
    provenance=Provenance(
        parameters={"p": (Candidate(1, at(20), won=True, rule=""),)},
        environment={"A": (Candidate("1", at(21), won=True, rule=""),)},
        remappings=(at(22), at(23)),
    ),
)


def _changed(**changes: Any) -> Item:
    """Return what becomes of the one process where something of it is changed."""
    after = replace(_BASE, **changes)
    (item,) = compare(plan(_BASE), plan(replace(after, digest=digest(after)))).processes
    return item


def _told(item: Item) -> list[tuple[str, str | None, Any, Any]]:
    return [(change.field, change.name, change.before, change.after) for change in item.changes]


def test_the_words_of_a_command_line_are_compared_one_by_one() -> None:
    item = _changed(command=("prog", "ONE", "two", "three", *_BASE.command[3:]))
    assert item.fate == "restart"
    assert _told(item) == [("command", "word 2", ["one"], ["ONE"]), ("command", "word 4", None, ["three"])]


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"parameters": {"p": 1.0, "q": "x"}}, ("parameters", "p", 1, 1.0)),
        ({"parameters": {"p": True, "q": "x"}}, ("parameters", "p", 1, True)),
        ({"parameters": {"q": "x"}}, ("parameters", "p", 1, None)),
        ({"environment": {"A": None}}, ("environment", "A", "1", None)),
        ({"cwd": "/x"}, ("cwd", None, None, "/x")),
        ({"shell": True}, ("shell", None, False, True)),
        ({"stdin": True}, ("stdin", None, None, True)),
        ({"parameter_files": (ParameterFile("f", "a\n"),)}, ("parameter_files", "f", None, ["a"])),
        (
            {"limits": Limits(nice=1)},
            ("limits", None, None, codec.encode(Limits(nice=1))),
        ),
    ],
)
def test_what_a_running_process_cannot_take_over_restarts_it(changes: dict[str, Any], told: Any) -> None:
    item = _changed(**changes)
    assert item.fate == "restart"
    assert _told(item) == [told]


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"restart": Restart("always")}, "restart"),
        ({"required": True}, "required"),
        ({"output": "log"}, "output"),
        ({"stop": Stop("SIGTERM")}, "stop"),
        ({"ready": Ready("up", None, None)}, "ready"),
        ({"success_exit_codes": (1,)}, "success_exit_codes"),
        ({"depends_on": (Dependency("/b", "ready", 2.0, at(9)),)}, "depends_on"),
    ],
)
def test_what_only_the_supervisor_needs_changes_without_a_restart(
    changes: dict[str, Any], field: str
) -> None:
    item = _changed(**changes)
    assert (item.fate, [change.field for change in item.changes]) == ("change", [field])


def test_where_things_are_written_is_no_difference() -> None:
    moved = replace(_BASE, location=at(99), provenance=Provenance())
    assert compare(plan(_BASE), plan(moved)).empty


def test_places_are_those_of_the_values() -> None:
    (change,) = _changed(parameters={"p": 2, "q": "x"}).changes
    assert (change.before_at, change.after_at) == (at(20), at(20))
    (change,) = _changed(environment={"A": "2"}).changes
    assert (change.before_at, change.after_at) == (at(21), at(21))


def test_remapping_rules_are_compared_by_name_and_in_another_order_one_by_one() -> None:
    words = (*_BASE.command, "x")
    item = _changed(remappings=(("a", "e"), ("c", "d")), command=words)
    assert ("remappings", "a", "b", "e") in _told(item)
    turned = _changed(remappings=(("c", "d"), ("a", "b")), command=words)
    assert [name for field, name, _, _ in _told(turned) if field == "remappings"] == ["rule 1", "rule 2"]


def test_a_digest_that_differs_for_no_reason_to_be_seen_is_told() -> None:
    (item,) = compare(plan(_BASE), plan(replace(_BASE, digest="other"))).processes
    assert (item.fate, [change.field for change in item.changes]) == ("restart", ["digest"])


def _component(**changes: Any) -> Component:
    made = Component(
        id="/r/c",
        name="c",
        namespace="/r",
        package="image",
        plugin="image::Camera",
        container="/box",
        process="/box",
        condition="started",
        parameters={"hz": 1},
        remappings=(),
        extra_arguments={},
        lifecycle=None,
        location=at(6),
        provenance=Provenance(),
    )
    return replace(made, **changes)


@pytest.mark.parametrize(
    ("changes", "fate"),
    [
        ({"parameters": {"hz": 2}}, "restart"),
        ({"container": "/other"}, "restart"),
        ({"extra_arguments": {"x": True}}, "restart"),
        ({"lifecycle": "active"}, "change"),
    ],
)
def test_components_are_loaded_anew_or_left_where_they_are(changes: dict[str, Any], fate: str) -> None:
    before, after = plan(components=(_component(),)), plan(components=(_component(**changes),))
    assert [item.fate for item in compare(before, after).components] == [fate]
    assert [item.fate for item in compare(before, plan()).components] == ["stop"]
    assert [item.fate for item in compare(plan(), before).components] == ["start"]


def _trigger(number: int, message: str, line: int = 4) -> Trigger:
    do = (LogAction(message, at(line)),)
    return Trigger(f"t{number}", TriggerEvent("run_started"), do, 1.0, deferred=False, location=at(line))


def test_triggers_are_told_apart_by_what_they_do() -> None:
    before = plan(triggers=(_trigger(1, "a"), _trigger(2, "b")))
    after = plan(triggers=(_trigger(1, "b", line=9), _trigger(2, "c")))
    found = compare(before, after).triggers
    assert [(item.id, item.fate) for item in found] == [("t2", "start"), ("t1", "stop")]


def test_arguments_differ_by_value_and_default() -> None:
    one, other = (Argument("mode", "x", value, None, None, at(2)) for value in ("x", "y"))
    (item,) = compare(plan(arguments=(one,)), plan(arguments=(other,))).arguments
    assert _told(item) == [("value", None, "x", "y")]


def test_the_text_in_full() -> None:
    gone, come = process("gone"), process("come")
    after = replace(_BASE, parameters={"p": 2, "q": "x"}, environment={"A": None})
    found = compare(plan(_BASE, gone), plan(replace(after, digest=digest(after)), come))
    assert text.render(found, "old", "new") == (
        "from old\n"
        "to   new\n"
        "\n"
        "! /r/a restarts  (two.yaml:3:5)\n"
        "    parameters p:\n"
        "      - 1  (two.yaml:20:5)\n"
        "      + 2  (two.yaml:20:5)\n"
        "    environment A:\n"
        '      - "1"  (two.yaml:21:5)\n'
        "      + unset  (two.yaml:21:5)\n"
        "+ come starts  (two.yaml:3:5)\n"
        "- gone stops  (two.yaml:3:5)\n"
        "\n"
        "processes: 1 to start, 1 to stop, 1 to restart\n"
    )
    assert text.render(compare(plan(_BASE), plan(_BASE)), "a", "b").endswith("\nno difference\n")


_processes = st.lists(
    st.tuples(st.sampled_from("abc"), st.sampled_from("xyz"), st.booleans(), st.sampled_from([None, "/d"])),
    max_size=3,
    unique_by=lambda item: item[0],
)


def _made(parts: list[tuple[str, str, bool, str | None]]) -> list[Process]:
    return [process(name, word, required=flag, cwd=cwd) for name, word, flag, cwd in parts]


@given(_processes, _processes)
@settings(deadline=None)
def test_carrying_out_a_difference_gives_the_second_plan(one: Any, other: Any) -> None:
    """Who starts, restarts and changes what is told, and stops the rest, runs what the second plan says."""
    before, after = plan(*_made(one)), plan(*_made(other))
    found = compare(before, after)
    running = {item.id: item for item in before.processes}
    wanted = {item.id: item for item in after.processes}
    for name in found.ids("stop"):
        del running[name]
    for name in found.ids("start", "restart", "change"):
        running[name] = wanted[name]
    assert running == wanted
