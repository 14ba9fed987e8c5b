"""In lockstep a node that answers the clock drives the same run, however quick either of them is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.qos import HistoryPolicy, QoSProfile
from rosgraph_msgs.msg import Clock

from bringup.world.messages import ticks_of

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager

    Start = Callable[..., AbstractContextManager[Any]]
    Listen = Callable[[int], AbstractContextManager[Any]]

DOMAIN = 25
STRETCHES = 30
ALL = QoSProfile(history=HistoryPolicy.KEEP_ALL)


def course(start: Start, listen: Listen, stretch: int) -> Odometry:
    """Where two robots end that were sent one command after another, some before they were asked for."""
    arguments = (
        "lockstep:=true",
        f"lockstep_ticks:={stretch}",
        "speed:=0.0",
        "status_period:=1000",
        "odometry_rate:=100",
    )
    with listen(DOMAIN) as ears:
        ears.listen(Odometry, "/robot1/ground_truth")
        ears.listen(Clock, "/clock")
        with start(DOMAIN, *(part for each in arguments for part in ("-p", each))) as run:
            commands = [
                ears.node.create_publisher(Twist, f"/robot{number}/cmd_vel", ALL) for number in (1, 2)
            ]
            # The clock goes on saying at which stretch the world waits.
            ears.wait(
                "/clock", lambda heard: heard and all(topic.get_subscription_count() for topic in commands)
            )
            for number in range(STRETCHES):
                for topic in commands:
                    command = Twist()
                    command.linear.x, command.angular.z = 0.1 + 0.01 * number, 0.5 - 0.04 * number
                    topic.publish(command)
            # The first stretch is nobody's.
            end = (STRETCHES + 1) * stretch
            found = ears.wait(
                "/robot1/ground_truth",
                lambda heard: [one for one in heard if ticks_of(one.header.stamp) == end],
            )
            run.process.terminate()
            status, said = run.end()
            assert status == 0
            # Without another command the world stands still.
            assert f"simulated {end / 100:.2f} s" in said
    return found


def test_the_same_commands_give_the_same_bits(start: Start, listen: Listen) -> None:
    one, other = (course(start, listen, 10) for _ in range(2))
    assert one.pose == other.pose
    assert one.twist == other.twist
    assert one.pose.pose.position.x > 0.3


def stands(clock: list[Clock]) -> list[float]:
    """The time that the clock says again, after the beginning."""
    ticks = [ticks_of(message.clock) for message in clock[-2:]]
    return ticks[1:] if len(ticks) > 1 and ticks[0] == ticks[1] > 0 else []


@pytest.mark.long
def test_an_unthrottled_world_waits_for_a_filter_that_is_behind_and_gives_up_a_silent_one(
    start: Start, listen: Listen
) -> None:
    arguments = ("speed:=0.0", "status_period:=1000")
    with listen(DOMAIN) as ears:
        estimates = ears.node.create_publisher(Odometry, "/robot1/odometry/filtered", 10)
        # A filter that is always at the beginning still.
        ears.node.create_subscription(Clock, "/clock", lambda _: estimates.publish(Odometry()), 10)
        ears.listen(Clock, "/clock")
        with start(DOMAIN, *(part for each in arguments for part in ("-p", each))) as run:
            tick = ears.wait("/clock", stands)
            assert tick > 100
            run.wait_for("the filter of robot1 has said nothing new for 3 s")
            ears.wait("/clock", lambda heard: ticks_of(heard[-1].clock) > tick)
