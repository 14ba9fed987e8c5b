"""Controller and arbiter as a container makes them: nodes whose ticks come from a timer."""

import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter

from bringup.arbiter_node.node import Component as Arbiter
from bringup.control_node.parameters import UnusableSettingsError
from bringup.control_node.plain import Component as Controller

# What rclpy imports to find its types still uses the old name of a standard module.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

DOMAIN = 49
DEADLINE = 40.0
INPUT = [
    Parameter("topics.a.topic", value="wanted"),
    Parameter("topics.a.priority", value=1),
    Parameter("topics.a.timeout", value=0.5),
]


@pytest.fixture(scope="module")
def context() -> Iterator[Any]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        made = rclpy.Context()
        rclpy.init(context=made, domain_id=DOMAIN)
        yield made
        rclpy.shutdown(context=made)


def until(executor: SingleThreadedExecutor, condition: Callable[[], bool], what: str) -> None:
    end = time.monotonic() + DEADLINE
    while not condition():
        assert time.monotonic() < end, f"not within {DEADLINE} s: {what}"
        executor.spin_once(timeout_sec=0.1)


@pytest.mark.parametrize(("kind", "given"), [(Controller, []), (Arbiter, INPUT)])
def test_a_component_orders_to_stand_until_there_is_more_to_do_and_when_it_is_unloaded(
    context: Any, kind: Any, given: list[Parameter]
) -> None:
    ears = rclpy.create_node("ears", context=context)
    heard: list[Twist] = []
    ears.create_subscription(Twist, "/robot9/cmd_vel", heard.append, 10)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(ears)
    component = kind(context=context, namespace="robot9", parameter_overrides=given)
    executor.add_node(component)
    try:
        until(executor, lambda: len(heard) >= 3, "orders")
        executor.remove_node(component)
        del heard[:]
        component.destroy_node()
        until(executor, lambda: bool(heard), "the last order")
        assert heard[-1] == Twist()
        until(executor, lambda: not ears.get_publishers_info_by_topic("/robot9/cmd_vel"), "it has left")
    finally:
        executor.shutdown()
        ears.destroy_node()


@pytest.mark.parametrize(
    ("kind", "given", "reason"),
    [
        (Controller, [Parameter("mode", value="fly")], "mode is 'fly'"),
        (Arbiter, [], "no input"),
        (Arbiter, INPUT[:2], "topics.a.timeout is missing"),
    ],
)
def test_a_component_that_cannot_be_made_says_why(
    context: Any, kind: Any, given: list[Parameter], reason: str
) -> None:
    with pytest.raises(UnusableSettingsError, match=reason):
        kind(context=context, parameter_overrides=given)
