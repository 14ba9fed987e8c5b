"""No check finds fault with descriptions that have none of its mistakes, whatever else is in them."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

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
_LAST: Actions = [{"node": {"exec": "sleep"}}]


def _followed(actions: Actions) -> Actions:
    """Return actions with a node behind all others, so that each setting counts for something."""
    return [{name: _with_node(content) for name, content in action.items()} for action in actions] + _LAST


def _with_node(content: dict[str, Any]) -> dict[str, Any]:
    return {**content, "children": _followed(content["children"])} if "children" in content else content


@given(descriptions, inner_actions)
@settings(
    max_examples=60,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
def test_what_has_no_mistake_is_left_alone(tmp_path: Path, written: Actions, inner: Actions) -> None:
    for name, content in (("main.launch.yaml", _followed(written)), ("inner.launch.yaml", inner)):
        (tmp_path / name).write_text(json.dumps({"launch": content}), "utf-8")
    problems = Problems()
    collect(str(tmp_path / "main.launch.yaml"), inputs_from([], environment={"PATH": "/bin"}), problems)
    assert [problem for problem in problems if problem.code in _NEVER] == []
