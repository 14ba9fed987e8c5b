"""The action go_to_goal for real: a controller, a client, and a robot in a room that drives as it is told."""

import math
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import bringup.interfaces  # noqa: F401 - makes the package that is imported next

# isort: split

from bringup_interfaces.action import GoToGoal
from bringup_interfaces.srv import ClaimGoal, ReleaseGoal
from nav_msgs.msg import Odometry
from rclpy.action import ActionClient
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Trigger

from bringup.fleet_node import visited
from tests.bringup.control.bench import NODE, TICK, Bench, on_bench

# What rclpy imports to find its types still uses the old name of a standard module.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

DOMAIN = 44
REACHED, UNREACHABLE, CANCELED, PREEMPTED, OVERRULED, LOST, REFUSED = range(1, 8)
SUCCEEDED, STATUS_CANCELED, ABORTED = 4, 5, 6
HALF = 2.5  # from the middle of the room to its walls
RAYS = 360
ANGLES = -math.pi + math.tau / RAYS * np.arange(RAYS)
TICKS_PER_COMMAND = 5
# A command that was lost, or an order that came instead of one, does not hold the time up for longer (real s).
LONGEST_WAIT = 0.5


class Room(Bench):
    """A bench whose robot obeys; time waits for the controller, so that a busy machine changes nothing."""

    stamped = True

    def __init__(self, domain: int, process: Any) -> None:
        super().__init__(domain, process)
        self.x = self.y = self.yaw = 0.0
        self.frame = "robot1/odom"
        self.client = ActionClient(self.node, GoToGoal, "/robot1/go_to_goal")
        self._known = False
        self._used, self._since = 0, time.monotonic()

    def close(self) -> None:
        self.client.destroy()
        super().close()

    def _step(self, ticks: int) -> None:
        waits = self.tick - self._used >= TICKS_PER_COMMAND
        if waits and not self._answered and time.monotonic() - self._since < LONGEST_WAIT:
            return
        if waits:
            self._used, self._count, self._since = self.tick, len(self.commands), time.monotonic()
        if self.commands:
            command = self.commands[-1]
            self.yaw += TICK * ticks * command.angular.z
            self.x += TICK * ticks * command.linear.x * math.cos(self.yaw)
            self.y += TICK * ticks * command.linear.x * math.sin(self.yaw)
        super()._step(ticks)

    _count = 0

    @property
    def _answered(self) -> bool:
        return len(self.commands) > self._count

    def _odometry(self) -> Odometry:
        message = Odometry(child_frame_id="robot1/base_footprint")
        message.header.frame_id = self.frame
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(self.tick * 20_000_000, 1_000_000_000)
        message.pose.pose.position.x, message.pose.pose.position.y = self.x, self.y
        message.pose.pose.orientation.z = math.sin(self.yaw / 2)
        message.pose.pose.orientation.w = math.cos(self.yaw / 2)
        return message

    def _scan(self) -> LaserScan:
        scan = LaserScan(range_min=0.12, range_max=12.0, angle_min=-math.pi, angle_increment=math.tau / RAYS)
        scan.header.stamp.sec, scan.header.stamp.nanosec = divmod(self.tick * 20_000_000, 1_000_000_000)
        east, north = np.cos(ANGLES + self.yaw), np.sin(ANGLES + self.yaw)
        walls = [
            (HALF - place * np.sign(way)) / np.maximum(np.abs(way), 1e-9)
            for place, way in ((self.x, east), (self.y, north))
        ]
        far = np.minimum(*walls)
        scan.ranges = far.astype(np.float32).tolist()
        return scan

    def goal(self, x: float, y: float, **more: Any) -> Any:
        """A goal's message."""
        frame, yaw = more.pop("frame", self.frame), more.pop("yaw", 0.0)
        goal = GoToGoal.Goal(**more)
        goal.pose.header.frame_id = frame
        goal.pose.pose.position.x, goal.pose.pose.position.y = x, y
        goal.pose.pose.orientation.z, goal.pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        return goal

    def send(self, goal: Any, feedback: Any = None) -> Any:
        """The handle of the goal, which has been accepted."""
        if not self._known:
            self.until(self.client.server_is_ready, "the action is there")
            self.greet()
            self._known = True
        sent = self.client.send_goal_async(goal, feedback_callback=feedback)
        self.until(sent.done, "the goal is answered")
        handle = sent.result()
        assert handle.accepted
        return handle

    def result(self, handle: Any) -> Any:
        """What a goal came to."""
        future = handle.get_result_async()
        self.until(future.done, "the goal ends")
        return future.result()

    def stands(self) -> bool:
        return bool(self.commands[-1].linear.x == 0.0 and self.commands[-1].angular.z == 0.0)


@pytest.fixture(autouse=True, scope="module")
def _localhost() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        yield


@pytest.fixture(scope="module")
def shared() -> Iterator[Room]:
    with on_bench(DOMAIN, "mode:=hold", "use_stamped:=true", kind=Room) as (bench, _):
        assert isinstance(bench, Room)
        yield bench


@pytest.fixture
def room(shared: Room) -> Room:
    """The one node of these tests, standing still with the sensors on, and its robot where the last test left it."""
    shared.scanning = shared.locating = True
    assert shared.set(mode="hold", progress_timeout=15.0, claim_service="", max_linear_vel=0.5)[0][0]
    shared.until(shared.stands, "standing still")
    return shared


def elsewhere(room: Room) -> tuple[float, float]:
    """A place in the room that is 1 m or more away from the robot."""
    return (-1.2 if room.x > 0 else 1.2), (-0.6 if room.y > 0 else 0.6)


def test_a_goal_is_reached_with_its_heading_and_the_way_to_it_is_told(room: Room) -> None:
    told: list[Any] = []
    x, y = elsewhere(room)
    handle = room.send(
        room.goal(x, y, yaw=2.0, yaw_tolerance=0.1), lambda message: told.append(message.feedback)
    )
    room.until(lambda: room.modes[-1] == "go_to_goal", "the mode is told")
    ended = room.result(handle)
    assert (ended.status, ended.result.outcome) == (SUCCEEDED, REACHED)
    assert math.hypot(room.x - x, room.y - y) <= 0.1
    assert abs(math.remainder(room.yaw - 2.0, math.tau)) <= 0.1
    assert ended.result.final_distance == pytest.approx(math.hypot(room.x - x, room.y - y), abs=0.02)
    assert ended.result.text.startswith("reached within")
    assert told[0].distance_remaining > 1.0
    assert told[-1].distance_remaining <= 0.1
    assert {each.pose.header.frame_id for each in told} == {"robot1/odom"}
    assert told[0].elapsed.sec <= told[-1].elapsed.sec == ended.result.elapsed.sec
    assert room.get("mode") == ["go_to_goal"]
    room.until(room.stands, "standing at the goal")


def test_a_goal_that_is_canceled_makes_the_robot_stand(room: Room) -> None:
    handle = room.send(room.goal(*elsewhere(room)))
    room.until(lambda: not room.stands(), "driving")
    canceled = handle.cancel_goal_async()
    room.until(canceled.done, "the cancel is answered")
    assert len(canceled.result().goals_canceling) == 1
    ended = room.result(handle)
    assert (ended.status, ended.result.outcome) == (STATUS_CANCELED, CANCELED)
    room.until(room.stands, "standing still")


def test_a_newer_goal_takes_the_place_of_the_one_before(room: Room) -> None:
    first = room.send(room.goal(*elsewhere(room)))
    room.until(lambda: not room.stands(), "driving")
    second = room.send(room.goal(room.x, room.y, xy_tolerance=0.3))
    ended = room.result(first)
    assert (ended.status, ended.result.outcome) == (ABORTED, PREEMPTED)
    assert "newer goal" in ended.result.text
    assert room.result(second).result.outcome == REACHED


def test_a_goal_outside_of_the_walls_is_unreachable(room: Room) -> None:
    ended = room.result(room.send(room.goal(HALF + 1.0, 0.0)))
    assert (ended.status, ended.result.outcome) == (ABORTED, UNREACHABLE)
    assert ended.result.text == "no way leads there"
    room.until(room.stands, "standing still")


def test_a_goal_may_have_its_own_time(room: Room) -> None:
    ended = room.result(room.send(room.goal(*elsewhere(room), timeout=0.5)))
    assert (ended.result.outcome, ended.result.text) == (UNREACHABLE, "not reached within 0.5 s")


@pytest.mark.parametrize(
    ("more", "text"),
    [
        ({"frame": "map"}, "the goal is in frame 'map', this robot knows where it is in 'robot1/odom'"),
        ({"frame": ""}, "the goal is in no frame, this robot knows where it is in 'robot1/odom'"),
        ({"x": math.nan}, "the goal's pose is no numbers"),
        ({"x": 1000.0}, "the goal is more than 40 m away"),
        ({"xy_tolerance": -0.1}, "xy_tolerance is -0.1, must be a number of 0 or more"),
        ({"xy_tolerance": 0.001}, "xy_tolerance is 0.001, must be 0 or at least 0.02"),
        ({"yaw_tolerance": 0.01}, "yaw_tolerance is 0.01, must be 0 or at least 0.02"),
        ({"timeout": math.inf}, "timeout is inf, must be a number of 0 or more"),
    ],
)
def test_a_goal_that_cannot_be_meant_says_why_and_changes_nothing(
    room: Room, more: dict[str, Any], text: str
) -> None:
    goal = room.goal(**{"x": 1.0, "y": 0.0, **more})
    ended = room.result(room.send(goal))
    assert (ended.status, ended.result.outcome, ended.result.text) == (ABORTED, REFUSED, text)
    assert room.get("mode") == ["hold"]


def test_another_mode_ends_a_goal(room: Room) -> None:
    handle = room.send(room.goal(*elsewhere(room)))
    room.until(lambda: not room.stands(), "driving")
    assert room.call(Trigger, f"{NODE}/hold", Trigger.Request()).success
    ended = room.result(handle)
    assert (ended.status, ended.result.outcome) == (ABORTED, OVERRULED)
    assert ended.result.text == "the mode was changed to hold"


def test_a_goal_is_given_up_when_odometry_stays_away(room: Room) -> None:
    room.set(progress_timeout=2.0)
    handle = room.send(room.goal(*elsewhere(room)))
    room.until(lambda: not room.stands(), "driving")
    room.locating = False
    room.until(room.stands, "standing without odometry")
    ended = room.result(handle)
    assert (ended.result.outcome, ended.result.text) == (LOST, "no odometry for 0.2 s")


def test_a_filter_that_begins_again_ends_a_goal(room: Room) -> None:
    handle = room.send(room.goal(*elsewhere(room)))
    room.until(lambda: not room.stands(), "driving")
    room.x = -room.x + math.copysign(1.0, -room.x)
    ended = room.result(handle)
    assert ended.result.outcome == LOST
    assert "jumped" in ended.result.text


def test_a_filter_that_begins_again_near_its_origin_ends_a_goal(room: Room) -> None:
    """Its pose does not jump, but what it is counted from is another place all the same."""
    room.set(progress_timeout=600.0)
    handle = room.send(room.goal(*elsewhere(room)))
    room.until(lambda: not room.stands(), "driving")
    room.node.destroy_publisher(room.odometry)
    room.odometry = room.node.create_publisher(Odometry, "/robot1/odometry/filtered", 1)
    ended = room.result(handle)
    assert ended.result.outcome == LOST
    assert "begun again" in ended.result.text


class _Blind(Room):
    """A room in which a robot does not know yet where it is."""

    def __init__(self, domain: int, process: Any) -> None:
        super().__init__(domain, process)
        self.locating = False


def test_a_goal_waits_for_the_first_odometry() -> None:
    """A controller and its filter that begin together meet when the network lets them."""
    with on_bench(39, "mode:=go_to_goal", "use_stamped:=true", kind=_Blind) as (room, _):
        assert isinstance(room, _Blind)
        handle = room.send(room.goal(0.0, 0.0))
        told = len(room.commands)
        room.until(lambda: len(room.commands) > told + 2, "the controller has looked at it")
        room.locating = True
        assert room.result(handle).result.outcome == REACHED


def test_the_fleet_is_asked_for_the_place_and_told_when_it_is_free_again(room: Room) -> None:
    asked: list[Any] = []
    released: list[str] = []
    grants = [False, True]

    def claim(request: Any, response: Any) -> Any:
        asked.append(request)
        response.granted, response.message = grants.pop(0), "robot2 has a goal 0.30 m from there"
        return response

    def release(request: Any, response: Any) -> Any:
        released.append(request.robot)
        return response

    services = [
        room.node.create_service(ClaimGoal, "/monitor/claim_goal", claim),
        room.node.create_service(ReleaseGoal, "/monitor/release_goal", release),
    ]
    try:
        assert room.set(claim_service="/monitor/claim_goal")[0][0]
        refused = room.result(room.send(room.goal(*elsewhere(room))))
        assert (refused.status, refused.result.outcome) == (ABORTED, OVERRULED)
        assert refused.result.text == "robot2 has a goal 0.30 m from there"
        assert room.get("mode") == ["hold"]
        driven = room.result(room.send(room.goal(room.x, room.y)))
        assert driven.result.outcome == REACHED
        room.until(lambda: released == ["robot1"], "the place is given back")
        assert [request.robot for request in asked] == ["robot1", "robot1"]
    finally:
        for service in services:
            room.node.destroy_service(service)


def test_a_place_that_is_granted_after_the_goal_was_canceled_is_given_back(room: Room) -> None:
    """To nobody, or to the goal that is driven to all the while."""
    service = visited.serve(room.node, ClaimGoal, "/slow_monitor/claim_goal")
    released: list[str] = []

    def release(request: Any, response: Any) -> Any:
        released.append(request.robot)
        return response

    releasing = room.node.create_service(ReleaseGoal, "/slow_monitor/release_goal", release)

    def question() -> tuple[Any, Any]:
        asked: list[tuple[Any, Any]] = []

        def heard() -> bool:
            asked.extend(visited.requests(service))
            return bool(asked)

        room.until(heard, "the place is asked for")
        (only,) = asked
        return only

    def canceled_while_asking(goal: Any) -> None:
        handle = room.send(goal)
        _, header = question()
        room.until(handle.cancel_goal_async().done, "the goal is to be canceled")
        assert room.result(handle).result.outcome == CANCELED
        service.send_response(ClaimGoal.Response(granted=True), header)

    try:
        assert room.set(claim_service="/slow_monitor/claim_goal")[0][0]
        canceled_while_asking(room.goal(*elsewhere(room)))
        room.until(lambda: released == ["robot1"], "the place is given back")
        driven = room.send(room.goal(*elsewhere(room)))
        first, header = question()
        service.send_response(ClaimGoal.Response(granted=True), header)
        room.until(lambda: not room.stands(), "driving")
        canceled_while_asking(room.goal(0.0, 0.0))
        again, header = question()
        assert again == first
        service.send_response(ClaimGoal.Response(granted=True), header)
        room.until(driven.cancel_goal_async().done, "it is canceled")
        room.until(lambda: released == ["robot1", "robot1"], "the place is given back")
    finally:
        room.node.destroy_service(service)
        room.node.destroy_service(releasing)


def test_with_nobody_to_answer_a_goal_is_driven_to_until_the_place_is_told_to_be_taken(room: Room) -> None:
    service = visited.serve(room.node, ClaimGoal, "/silent_monitor/claim_goal")
    asked: list[tuple[Any, Any]] = []

    def heard(count: int) -> bool:
        asked.extend(visited.requests(service))
        return len(asked) >= count

    try:
        standing: dict[str, Any] = {"max_linear_vel": 0.0, "progress_timeout": 600.0}
        assert room.set(claim_service="/silent_monitor/claim_goal", **standing)[0][0]
        handle = room.send(room.goal(*elsewhere(room)))
        room.until(lambda: heard(1), "the place is asked for")
        room.until(lambda: room.get("mode") == ["go_to_goal"], "it is driven to")
        room.until(lambda: heard(2), "the place is asked for again")
        (first, _), (again, header) = asked[:2]
        assert again == first
        service.send_response(ClaimGoal.Response(message="robot2 has a goal 0.30 m from there"), header)
        refused = room.result(handle)
        assert (refused.status, refused.result.outcome) == (ABORTED, OVERRULED)
        assert refused.result.text == "robot2 has a goal 0.30 m from there"
    finally:
        room.node.destroy_service(service)
