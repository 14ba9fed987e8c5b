"""Event handlers of public launch files whose process is not there when the run begins, or never."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from tests.compat import plans
from tests.compat.idioms import planned

if TYPE_CHECKING:
    from pathlib import Path

_DEADLINE = 60.0


@pytest.mark.parametrize(
    "target",
    [
        "Node(package='demo', executable='talker', condition=IfCondition('false'))",
        "Node(package='demo', executable='talker')",
        "lambda action: False",
    ],
    ids=["left-out-by-a-condition", "in-no-description", "that-nothing-matches"],
)
def test_what_follows_a_process_that_never_starts_does_not_start_with_the_run(
    target: str, tmp_path: Path
) -> None:
    plan = planned(
        tmp_path,
        f"""
        first = {target}
        after = Node(package="demo", executable="listener")
        shown = [first] if isinstance(first, Node) and first.condition is not None else []
        return LaunchDescription([
            RegisterEventHandler(OnProcessExit(target_action=first, on_exit=[after])), *shown
        ])
        """,
    )
    (process,), (trigger,) = plan.content["processes"], plan.content["triggers"]
    assert [step["process"] for step in trigger["do"]] == [process["id"]]
    assert not trigger["armed"]
    assert plan.problems == ()


_BEFORE = """
def say(word):
    return ExecuteProcess(cmd=['echo', word], output='screen')

never = say('left out')
third = say('third')
second = say('second')
first = say('first')
chain = [third, second]
"""
_ACTIONS = """
    RegisterEventHandler(OnProcessExit(target_action=first, on_exit=lambda event, context: [chain.pop()])),
    RegisterEventHandler(OnProcessExit(target_action=second, on_exit=lambda *happened: chain.pop())),
    RegisterEventHandler(OnProcessExit(target_action=third, on_exit=[say('fourth')])),
    RegisterEventHandler(OnProcessExit(target_action=never, on_exit=[say('fifth')])),
    first,
"""


def test_a_handler_hears_of_a_process_that_the_code_of_another_one_starts(tmp_path: Path) -> None:
    path = plans.write(tmp_path / "a.launch.py", _ACTIONS, _BEFORE)
    run = subprocess.run(
        [sys.executable, "-m", "orchestra", "launch", str(path)],
        capture_output=True,
        text=True,
        timeout=_DEADLINE,
        check=False,
        env={**os.environ, "XDG_STATE_HOME": str(tmp_path), "ROS_LOG_DIR": str(tmp_path / "log")},
    )
    words = [line.rpartition(" ")[2] for line in run.stdout.splitlines() if line.startswith("[echo")]
    assert words == ["first", "second", "third", "fourth"], run.stdout + run.stderr
    assert run.returncode == 0
