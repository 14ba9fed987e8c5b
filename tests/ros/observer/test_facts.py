"""Facts of the graph, with real nodes. One observer sees all of them, as in a run."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import TYPE_CHECKING, Any

import pytest
from rclpy.parameter import Parameter

from orchestra.ros.observer.facts.parameter import same_value
from orchestra.ros.observer.facts.tf import connected
from orchestra.ros.observer.kinds import FACTS, maker
from tests.killing import let_nobody_hang
from tests.ros.observer.conversation import Domain, graph_node, observing
from tests.supervise.plans import PROCESSES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.ros.observer.conversation import Conversation, Node


@pytest.fixture(scope="module")
def domain(tmp_path_factory: pytest.TempPathFactory) -> Domain:
    return Domain(33, tmp_path_factory.mktemp("discovery"))


@pytest.fixture(scope="module")
def observer(domain: Domain) -> Iterator[Conversation]:
    with observing(domain) as conversation:
        yield conversation


@pytest.fixture(scope="module")
def node(observer: Conversation, domain: Domain) -> Iterator[Node]:
    """A node that is awaited before it starts."""
    observer.watch("early", "node", name="/ns/one")
    observer.watch("nobody", "node", name="/one")
    with graph_node(domain, "/ns/one") as found:
        yield found


def test_a_node_comes_into_the_graph_by_its_full_name(observer: Conversation, node: Node) -> None:
    assert node.popen.poll() is None
    observer.said("early", "done")
    observer.watch("late", "node", name="/ns/one")
    observer.said("late", "done")
    assert observer.heard("nobody") == []


@pytest.mark.parametrize("fact", ["topic", "service", "action"])
def test_what_a_node_offers_is_seen_when_it_is_there(observer: Conversation, node: Node, fact: str) -> None:
    """A part of an action is none yet."""
    observer.watch(fact, fact, name=f"/ns/{fact}")
    observer.watch(f"other {fact}", fact, name=f"/{fact}")
    node.do(f"service /ns/{fact}/_action/send_goal")
    observer.caught_up()
    assert observer.heard(fact) == []
    node.do(f"{fact} /ns/{fact}")
    observer.said(fact, "done")
    assert observer.heard(f"other {fact}") == []


VALUES: list[tuple[Any, Any]] = [
    (1, 2),
    (1, 1.0),
    (1.0, 1),
    (1, True),
    (True, 1),
    ("1", 1),
    ("", []),
    ([1, 2], [1]),
    ([1, 2], [1.0, 2.0]),
    ([1.0, 2.0], [1, 2]),
    (["a", ""], ["a"]),
    ([True, False], [True]),
    ([1], []),
]


@pytest.mark.parametrize(("held", "wanted"), VALUES)
def test_parameters_are_compared_with_their_types(held: Any, wanted: Any) -> None:
    value = Parameter("p", value=held).get_parameter_value()
    assert same_value(value, held)
    assert not same_value(value, wanted)


@pytest.mark.parametrize("kind", [Parameter.Type.STRING_ARRAY, Parameter.Type.DOUBLE_ARRAY])
def test_an_empty_list_is_the_same_whatever_its_elements_would_be(kind: Parameter.Type) -> None:
    assert same_value(Parameter("p", kind, []).get_parameter_value(), [])


def test_a_parameter_is_awaited_until_it_is_there_and_has_the_value(
    observer: Conversation, node: Node
) -> None:
    about = {"node": "/ns/one", "name": "speed"}
    observer.watch("any value", "parameter", **about)
    observer.watch("this value", "parameter", **about, value=2.0)
    observer.watch("never", "parameter", **about, value=2)
    observer.caught_up()
    assert observer.heard("any value") == []
    node.do("set speed 1.0")
    observer.said("any value", "done")
    assert observer.heard("this value") == []
    node.do("set speed 2.0")
    observer.said("this value", "done")
    assert observer.heard("never") == []


def test_a_state_of_a_lifecycle_node_is_seen_and_one_that_lasts_for_a_moment_too(
    observer: Conversation, domain: Domain
) -> None:
    """The states on the way from one to the other are over when they are heard of."""
    states = ("unconfigured", "configuring", "inactive", "activating", "active")
    for state in (*states, "finalized"):
        observer.watch(f"to be {state}", "lifecycle", node="/managed", state=state)
    command = [sys.executable, str(PROCESSES / "lifecycle_node.py"), "managed"]
    with subprocess.Popen(command, env=domain.environment, stdout=subprocess.DEVNULL) as managed:
        observer.said("to be unconfigured", "done")
        assert observer.heard("to be inactive") == []
        for order, transition in (("configure", 1), ("activate", 3)):
            observer.ask(order, "change_state", node="/managed", transition=transition)
            observer.said(order, "done")
        for state in states:
            observer.said(f"to be {state}", "done")
        assert observer.heard("to be finalized") == []
        managed.kill()
        managed.wait()
        let_nobody_hang()


def test_transforms_make_a_chain_in_either_direction(
    observer: Conversation, node: Node, domain: Domain
) -> None:
    """Static ones are latched: this one is published before anybody listens. What is no transform is passed over."""
    with graph_node(domain, "/wrong") as wrong:
        wrong.do("topic /tf")
        node.do("tf_static base laser", "tf /map odom")
        observer.watch("one", "tf", parent="map", child="odom")
        observer.said("one", "done")
        observer.watch("chain", "tf", parent="map", child="laser")
        observer.watch("upwards", "tf", parent="laser", child="/map")
        observer.watch("nowhere", "tf", parent="map", child="moon")
        observer.watch("static", "tf", parent="base", child="laser")
        observer.said("static", "done")
        assert observer.heard("chain") == []
        node.do("tf odom base")
        observer.said("chain", "done")
        observer.said("upwards", "done")
        assert observer.heard("nowhere") == []


@pytest.mark.parametrize(
    ("parents", "one", "other", "expected"),
    [
        ({}, "a", "a", False),
        ({"a": "b"}, "b", "a", True),
        ({"a": "b"}, "b", "b", True),
        ({"a": "c", "b": "c"}, "a", "b", True),
        ({"a": "b", "c": "d"}, "a", "c", False),
        ({"a": "b", "b": "c", "c": "a"}, "a", "c", True),
        ({"a": "b", "b": "a", "c": "a", "d": "d"}, "c", "b", True),
        ({"a": "b", "b": "a", "d": "d"}, "a", "d", False),
    ],
)
def test_frames_are_connected_where_they_hang_on_one_tree(
    parents: dict[str, str], one: str, other: str, expected: bool
) -> None:
    """Also where somebody has made a circle."""
    assert connected(parents, one, other) is expected
    assert connected(parents, other, one) is expected


def test_a_node_that_was_killed_is_not_taken_for_the_one_that_comes_after_it(
    observer: Conversation, domain: Domain
) -> None:
    """It stays in the graph for 20 s: who sees it there looks again with other eyes."""
    facts = [("node", "/ns/two"), ("topic", "/two/topic"), ("service", "/two/service")]
    offers = [f"{fact} {name}" for fact, name in facts[1:]]

    def watch(when: str) -> None:
        for fact, name in facts:
            observer.watch(f"{when} {fact}", fact, name=name)

    with graph_node(domain, "/ns/two") as first:
        first.do(*offers)
        watch("first")
        for fact, _ in facts:
            observer.said(f"first {fact}", "done")
    watch("again")
    with graph_node(domain, "/ns/three"):
        observer.watch("three", "node", name="/ns/three")
        observer.said("three", "done")
        assert [observer.heard(f"again {fact}") for fact, _ in facts] == [[], [], []]
    with graph_node(domain, "/ns/two") as second:
        second.do(*offers)
        for fact, _ in facts:
            observer.said(f"again {fact}", "done")


@pytest.mark.parametrize(
    ("order", "reason"),
    [
        ({"do": "watch", "fact": "weather"}, "KeyError: 'weather'"),
        ({"do": "nothing"}, "KeyError: 'nothing'"),
        ({"do": "watch", "fact": "lifecycle", "node": "no name", "state": "x"}, "InvalidTopicName"),
    ],
)
def test_an_order_that_nobody_can_carry_out_is_impossible_and_the_others_go_on(
    observer: Conversation, order: dict[str, Any], reason: str
) -> None:
    observer.tell(json.dumps({"id": reason, **order}))
    assert reason in observer.said(reason, "impossible")["reason"]
    observer.caught_up()


def test_every_fact_has_its_module() -> None:
    for fact in FACTS:
        assert callable(maker({"do": "watch", "fact": fact}))
