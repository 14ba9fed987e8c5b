"""The event loop that actions of users find: what it is given runs during the run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.later_loop import LaterLoop
from orchestra.compat.launch.launch_context import LaunchContext
from tests.compat import plans
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_WAITING = """\
class Wait(launch.Action):
    def execute(self, context):
        self.future = context.asyncio_loop.create_future()
        async def poll():
            raise AssertionError('this is not the run')
        context.asyncio_loop.create_task(poll())
        context.add_completion_future(self.future)

    def get_asyncio_future(self):
        return self.future
"""


@pytest.fixture(autouse=True)
def _loading() -> Iterator[None]:
    with loading({}):
        yield


def _run(action: Any) -> None:
    """Do what an action does during the run."""
    (child,) = action._to_model({}).children
    child.target.execute(LaunchContext())


@pytest.mark.filterwarnings("error")
def test_an_action_that_waits_for_something_is_planned(tmp_path: Path) -> None:
    """As those do that wait for a topic."""
    found = plans.python(tmp_path, "Wait(), LogInfo(msg='behind')", "import launch\n" + _WAITING)
    assert (found.messages, found.problems) == (["behind"], [])
    (trigger,) = (trigger for trigger in found.triggers if trigger["deferred"])
    assert trigger["on"]["event"] == "run_started"


def test_a_task_runs_later_and_its_future_is_done_then() -> None:
    visited: list[Any] = []
    seen: list[Any] = []

    async def two() -> int:
        return 2

    done = LaterLoop(visited.extend).create_task(two())
    done.add_done_callback(lambda future: seen.append(future.result()))
    assert not done.done()
    (action,) = visited
    _run(action)
    assert seen == [2]


def test_callbacks_are_called_later_unless_they_are_cancelled() -> None:
    visited: list[Any] = []
    seen: list[Any] = []
    loop = LaterLoop(visited.extend)
    loop.call_soon(seen.append, "soon")
    loop.call_later(0.5, seen.append, "later")
    loop.call_later(0.5, seen.append, "never").cancel()
    assert not seen
    for action in visited:
        _run(action)
    assert seen == ["soon", "later"]
