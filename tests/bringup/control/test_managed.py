"""The managed velocity controller for real: it drives while it is active, and in no other state."""

import signal
from collections.abc import Iterator
from typing import Any

import pytest

import bringup.interfaces  # noqa: F401 - makes the package that is imported next

# isort: split

from bringup_interfaces.action import GoToGoal
from lifecycle_msgs.msg import State, Transition
from lifecycle_msgs.srv import ChangeState, GetState
from rclpy.action import ActionClient

from tests.bringup.control.bench import DEADLINE, NODE, Bench, controller

# What rclpy imports to find its types still uses the old name of a standard module.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

DOMAIN = 48


@pytest.fixture(autouse=True, scope="module")
def _localhost() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        yield


def change(bench: Bench, transition: int) -> bool:
    request = ChangeState.Request(transition=Transition(id=transition))
    return bool(bench.call(ChangeState, f"{NODE}/change_state", request, again=False).success)


def state(bench: Bench) -> int:
    return int(bench.call(GetState, f"{NODE}/get_state", GetState.Request()).current_state.id)


def publishers(bench: Bench) -> int:
    return len(bench.node.get_publishers_info_by_topic("/robot1/cmd_vel"))


def ordered(bench: Bench, speed: float) -> None:
    """A few new orders have this speed."""
    del bench.commands[:]
    bench.until(lambda: len(bench.commands) >= 5 and bench.drives(speed)(), f"orders of {speed} m/s")


def refused(bench: Bench) -> Any:
    """The result of a goal that is sent while the controller does not drive."""
    client = ActionClient(bench.node, GoToGoal, "/robot1/go_to_goal")
    try:
        bench.until(client.server_is_ready, "the action is there")
        bench.greet()
        sent = client.send_goal_async(GoToGoal.Goal())
        bench.until(sent.done, "the goal is answered")
        future = sent.result().get_result_async()
        bench.until(future.done, "the goal ends")
        return future.result().result
    finally:
        client.destroy()


def test_it_drives_while_it_is_active_and_leaves_the_graph_when_it_is_cleaned_up() -> None:
    with controller(
        DOMAIN, "use_sim_time:=true", "mode:=linear", executable="velocity_controller_lifecycle"
    ) as process:
        bench = Bench(DOMAIN, process)
        try:
            assert state(bench) == State.PRIMARY_STATE_UNCONFIGURED
            assert bench.get("mode") == ["linear"]
            assert publishers(bench) == 0
            assert change(bench, Transition.TRANSITION_CONFIGURE)
            ordered(bench, 0.0)
            bench.until(bench.is_told(b"\x00", "not active"), "its health is told")
            result = refused(bench)
            assert (result.outcome, result.text) == (result.OVERRULED, "the controller is not active")
            assert change(bench, Transition.TRANSITION_ACTIVATE)
            ordered(bench, 0.5)
            assert change(bench, Transition.TRANSITION_DEACTIVATE)
            ordered(bench, 0.0)
            assert state(bench) == State.PRIMARY_STATE_INACTIVE
            assert change(bench, Transition.TRANSITION_CLEANUP)
            bench.until(lambda: publishers(bench) == 0, "it has left the graph")
            assert change(bench, Transition.TRANSITION_CONFIGURE)
            assert change(bench, Transition.TRANSITION_ACTIVATE)
            ordered(bench, 0.5)
            assert change(bench, Transition.TRANSITION_ACTIVE_SHUTDOWN)
            assert state(bench) == State.PRIMARY_STATE_FINALIZED
            bench.until(bench.drives(0.0), "the last order is to stand")
            bench.until(lambda: publishers(bench) == 0, "it has left the graph")
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate(timeout=DEADLINE)
            assert process.returncode == 0
            assert "Traceback" not in errors
        finally:
            bench.close()
