"""A simulation that is told to follow simulated time does not listen to itself for that."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter

from bringup.world.course import Course
from bringup.world.settings import TABLE, settings

if TYPE_CHECKING:
    from collections.abc import Iterator

DOMAIN = 50


@pytest.fixture
def context(monkeypatch: pytest.MonkeyPatch) -> Iterator[Context]:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    context = Context()
    rclpy.init(context=context, domain_id=DOMAIN)
    yield context
    context.shutdown()


@pytest.mark.parametrize("simulated", [True, False])
def test_the_clock_of_the_node_goes_as_the_world_does(context: Context, simulated: bool) -> None:
    override = Parameter("use_sim_time", value=simulated)
    node = Node("world", context=context, parameter_overrides=[override])
    course = Course(node, settings({setting.name: setting.default for setting in TABLE}))
    course.tick()
    course.tick(4)
    now = node.get_clock().now().nanoseconds
    assert (now == 50_000_000) is simulated
    assert "/clock" not in [subscription.topic_name for subscription in node.subscriptions]
    assert node.get_parameter("use_sim_time").value is simulated
    course.reset()
    assert (node.get_clock().now().nanoseconds == 0) is simulated
    node.destroy_node()
