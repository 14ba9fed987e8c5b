"""Life cycles in Python: events, what waits for them, and the triggers of the plan."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch.actions import LogInfo
from orchestra.compat.launch.events import matches_action
from orchestra.compat.launch_ros import events
from orchestra.compat.launch_ros.actions import LifecycleNode, Node
from orchestra.compat.launch_ros.event_handlers import OnStateTransition
from orchestra.compat.launch_ros.events import lifecycle, matches_node_name
from orchestra.compat.launch_ros.events.lifecycle import ChangeState, StateTransition
from tests.compat.contexts import loading
from tests.compat.python_plans import of_python

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({"PATH": "/usr/bin:/bin"}):
        yield


def _lifecycle_node(name: str = "n") -> LifecycleNode:
    return LifecycleNode(executable="/bin/true", name=name, namespace="")


def _transition(action: Any, start: str, transition: str, goal: str) -> StateTransition:
    labels = {"start_state": start, "transition": transition, "goal_state": goal}
    fields = {name: SimpleNamespace(label=text) for name, text in labels.items()}
    message = SimpleNamespace(timestamp=7, **fields)  # a message of lifecycle_msgs has such fields
    return StateTransition(action=action, msg=message)


@pytest.mark.conforms("1.15 numbers")
def test_ids_are_those_of_lifecycle_msgs() -> None:
    messages = pytest.importorskip("lifecycle_msgs.msg", reason="needs ROS")
    for number, name in ChangeState.valid_transitions.items():
        assert getattr(messages.Transition, name) == number
    for number, name in ChangeState.valid_states.items():
        assert getattr(messages.State, name) == number
    assert (len(ChangeState.valid_transitions), len(ChangeState.valid_states)) == (9, 11)


@pytest.mark.conforms("1.15 events.lifecycle.ChangeState")
def test_a_change_of_state_tells_what_is_asked_of_whom() -> None:
    node = _lifecycle_node()
    event = ChangeState(lifecycle_node_matcher=matches_action(node), transition_id=3)
    assert event.name == "launch_ros.events.lifecycle.ChangeState"
    assert event.transition_id == 3
    assert event.lifecycle_node_matcher(node)
    assert not event.lifecycle_node_matcher(_lifecycle_node())


@pytest.mark.conforms("1.15 events.lifecycle.ChangeState")
@pytest.mark.parametrize("transition", [9, -1, "1", None])
def test_another_transition_is_refused(transition: Any) -> None:
    with pytest.raises(ValueError, match="no transition of a lifecycle node"):
        ChangeState(lifecycle_node_matcher=lambda _: True, transition_id=transition)


@pytest.mark.conforms("1.15 events.lifecycle.StateTransition")
def test_a_transition_tells_what_the_message_says() -> None:
    node = _lifecycle_node()
    event = _transition(node, "configuring", "on_configure_success", "inactive")
    assert event.name == "launch_ros.events.lifecycle.StateTransition"
    assert (event.action, event.msg.timestamp, event.timestamp) == (node, 7, 7)
    assert (event.start_state, event.transition, event.goal_state) == (
        "configuring",
        "on_configure_success",
        "inactive",
    )


@pytest.mark.conforms("1.15 events.matches_node_name")
@pytest.mark.parametrize(("asked", "holds"), [("/a/n", True), ("a/n", True), ("n", False), ("/n", False)])
def test_nodes_are_told_by_their_full_names(asked: str, holds: bool) -> None:
    assert matches_node_name(asked)(SimpleNamespace(node_name="/a/n")) is holds
    assert events.matchers.matches_node_name is matches_node_name


@pytest.mark.conforms("1.15 events.lifecycle.matches_node_name")
def test_the_older_matcher_warns() -> None:
    with pytest.warns(UserWarning, match="deprecated"):
        matcher = lifecycle.matches_node_name("n")
    assert matcher(SimpleNamespace(node_name="/n"))


_MATCHES: dict[str, tuple[dict[str, Any], bool]] = {
    "nothing asked": ({}, True),
    "the goal": ({"goal_state": "inactive"}, True),
    "another goal": ({"goal_state": "active"}, False),
    "everything": (
        {"start_state": "configuring", "transition": "on_configure_success", "goal_state": "inactive"},
        True,
    ),
    "another start": ({"start_state": "activating", "goal_state": "inactive"}, False),
    "another transition": ({"transition": "configure"}, False),
    "a matcher alone": ({"goal_state": "active", "matcher": lambda _: True}, True),
}


@pytest.mark.conforms("1.15 event_handlers.OnStateTransition")
@pytest.mark.parametrize(("filters", "matches"), _MATCHES.values(), ids=_MATCHES)
def test_a_handler_waits_for_what_is_asked(filters: dict[str, Any], matches: bool) -> None:
    handler = OnStateTransition(entities=[LogInfo(msg="x")], **filters)
    assert (
        handler.matches(_transition(_lifecycle_node(), "configuring", "on_configure_success", "inactive"))
        is matches
    )


@pytest.mark.conforms("1.15 event_handlers.OnStateTransition")
def test_a_handler_waits_for_its_node() -> None:
    one, other = _lifecycle_node("a"), _lifecycle_node("b")
    handler = OnStateTransition(target_lifecycle_node=one, goal_state="active", entities=[])
    assert handler.matches(_transition(one, "activating", "x", "active"))
    assert not handler.matches(_transition(other, "activating", "x", "active"))
    assert not handler.matches(SimpleNamespace(action=one, goal_state="active"))
    assert "LifecycleNode" in handler.matcher_description


@pytest.mark.conforms("1.15 event_handlers.OnStateTransition")
def test_only_lifecycle_nodes_have_states() -> None:
    with pytest.raises(RuntimeError, match="waits for a LifecycleNode"):
        OnStateTransition(target_lifecycle_node=Node(executable="x"), entities=[])
    with pytest.raises(TypeError, match="label"):
        OnStateTransition(goal_state=5, entities=[])


_NODE = "n = LifecycleNode(executable='/bin/true', name='n', namespace='a')"


def _triggers(folder: Path, rest: str) -> list[dict[str, Any]]:
    body = f"""
        {_NODE}
        change = lambda number: EmitEvent(event=ChangeState(
            lifecycle_node_matcher=matches_action(n), transition_id=number))
        return LaunchDescription([n, {rest}])
    """
    found = of_python(folder, body)
    assert found.messages == []
    triggers: list[dict[str, Any]] = found.content["triggers"]
    return triggers


def _orders(trigger: dict[str, Any]) -> list[tuple[Any, ...]]:
    return [
        tuple(step[key] for key in ("processes", "transitions", "message") if key in step)
        for step in trigger["do"]
    ]


@pytest.mark.conforms("4.11 usual pattern", "1.12 LifecycleNode")
def test_the_usual_way_up_is_two_triggers(tmp_path: Path) -> None:
    handler = "RegisterEventHandler(OnStateTransition(target_lifecycle_node=n, goal_state='inactive', entities=[change(3)]))"
    start, up = _triggers(tmp_path, f"change(1), {handler}")
    assert start["on"]["event"] == "run_started"
    assert _orders(start) == [(["/a/n"], [1])]
    assert (up["on"]["event"], up["on"]["target"], up["on"]["goal_state"]) == (
        "state_changed",
        "/a/n",
        "inactive",
    )
    assert _orders(up) == [(["/a/n"], [3])]
    assert not up["deferred"]


def test_a_handler_may_name_a_node_that_comes_later(tmp_path: Path) -> None:
    body = f"""
        {_NODE}
        handler = OnStateTransition(start_state='activating', transition='x', handle_once=True, entities=LogInfo(msg='up'))
        return LaunchDescription([RegisterEventHandler(handler), n])
    """
    found = of_python(tmp_path, body)
    (trigger,) = found.content["triggers"]
    assert (trigger["on"]["target"], trigger["on"]["start_state"], trigger["on"]["transition"]) == (
        None,
        "activating",
        "x",
    )
    assert trigger["once"] is True


def test_a_handler_of_a_user_is_left_for_the_run(tmp_path: Path) -> None:
    body = f"""
        class Tell(OnStateTransition):
            def handle(self, event, context):
                return [LogInfo(msg=event.goal_state)]

        {_NODE}
        handlers = [
            Tell(target_lifecycle_node=n, goal_state='active', entities=[]),
        ]
        return LaunchDescription([n, *map(RegisterEventHandler, handlers)])
    """
    found = of_python(tmp_path, body)
    assert found.messages == []
    (trigger,) = found.content["triggers"]
    assert trigger["deferred"] is True
    assert (trigger["on"]["event"], trigger["on"]["target"]) == ("state_changed", "/a/n")


@pytest.mark.conforms("1.12 LifecycleTransition", "4.11 LifecycleTransition")
def test_transitions_are_made_in_order(tmp_path: Path) -> None:
    action = "LifecycleTransition(lifecycle_node_names=['/a/n', ['a/', 'n']], transition_ids=[1, ['', '3']])"
    triggers = _triggers(tmp_path, action)
    assert [(trigger["on"]["event"], _orders(trigger)) for trigger in triggers] == [
        ("run_started", [(["/a/n"], [1, 3])]),
        ("run_started", [(["/a/n"], [1, 3])]),
    ]


@pytest.mark.conforms("1.12 LifecycleTransition")
@pytest.mark.parametrize("number", ["12", "'configure'"])
def test_a_transition_that_is_none_is_an_error(number: str, tmp_path: Path) -> None:
    body = f"[LifecycleTransition(lifecycle_node_names=['n'], transition_ids=[{number}])]"
    found = of_python(tmp_path, body)
    assert [problem.severity.value for problem in found.problems] == ["error"]
