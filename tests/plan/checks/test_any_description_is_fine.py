"""No check finds fault with descriptions that have none of its mistakes, whatever else is in them."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from hypothesis import HealthCheck, given, settings

from orchestra.errors import Code, Problems
from orchestra.pipeline import collect, inputs_from
from tests.plan.strategies import Actions, descriptions, inner_actions

if TYPE_CHECKING:
    from pathlib import Path

# The strategies make no such thing. They do declare arguments twice, and set parameters twice.
_NEVER = {
    Code.UNMATCHED_SECTION,
    Code.IMPOSSIBLE_CONDITION,
    Code.IDLE_KEY,
    Code.SPLIT_TOPIC,
    Code.IDLE_REMAP,
    Code.CONTESTED_CORE,
    Code.NEVER_READY,
    Code.MISSING_EXECUTABLE,
}


@given(descriptions, inner_actions)
@settings(
    max_examples=60,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
def test_what_has_no_mistake_is_left_alone(tmp_path: Path, written: Actions, inner: Actions) -> None:
    for name, content in (("main.launch.yaml", written), ("inner.launch.yaml", inner)):
        (tmp_path / name).write_text(json.dumps({"launch": content}), "utf-8")
    problems = Problems()
    collect(str(tmp_path / "main.launch.yaml"), inputs_from([], environment={"PATH": "/bin"}), problems)
    assert [problem for problem in problems if problem.code in _NEVER] == []
