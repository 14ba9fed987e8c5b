"""A file in YAML or XML means the same to code that parses it as to the loaders."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from orchestra.errors import Code, Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import encode
from tests.load.planning import Planned, _same_ending, _without_places, planned
from tests.plan.strategies import Actions, actions, inner_actions

if TYPE_CHECKING:
    from pathlib import Path

_ENVIRONMENT = {"PATH": "/bin", "A_1": "outside"}
_PARSING = """
from launch.frontend import Parser

def generate_launch_description():
    entity, parser = Parser.load({!r})
    return parser.parse_description(entity)
"""


def _parsed(folder: Path, language: str) -> Planned:
    """Return the plan of a file in Python that parses the launch file written last."""
    path = folder / "b.launch.py"
    path.write_text(_PARSING.format(str(folder / f"a.launch.{language}")), "utf-8")
    problems = Problems()
    plan = collect(str(path), inputs_from([], environment=_ENVIRONMENT), problems)
    assert plan is not None, [problem.message for problem in problems]
    content = _same_ending(_without_places(encode(plan)), language)
    del content["problems"]
    return Planned(content, tuple(sorted((found.code.value, found.severity.value) for found in problems)))


def _is_upstreams(written: Any) -> bool:
    """Return whether actions have no keys but those that entities of upstream have."""
    if isinstance(written, list):
        return all(map(_is_upstreams, written))
    if not isinstance(written, dict):
        return True
    include = written.get("include") or {}
    return "for_each" not in written and "scoped" not in include and all(map(_is_upstreams, written.values()))


def _comparable(plan: Planned) -> Planned:
    """Return what both have: what stands twice is told by its places, which a parsed text has only one of."""
    told = tuple(problem for problem in plan.problems if problem[0] != Code.DUPLICATE_PARAMETER)
    return replace(plan, content={**plan.content, "file": None}, problems=told)


@pytest.mark.conforms("1.10 Parser", "1.10 Entity")
@pytest.mark.parametrize("language", ["xml", "yaml"])
@given(written=st.lists(actions, max_size=6), inner=inner_actions)
@settings(
    max_examples=40,
    deadline=None,
    suppress_health_check=[
        HealthCheck.function_scoped_fixture,
        HealthCheck.too_slow,
        HealthCheck.filter_too_much,
    ],
)
def test_parsing_a_file_gives_the_plan_that_loading_it_gives(
    tmp_path: Path, language: str, written: Actions, inner: Actions
) -> None:
    assume(_is_upstreams(written))
    loaded = planned(tmp_path, language, written, _ENVIRONMENT, inner=inner)
    assume(not loaded.failed)
    assert _comparable(_parsed(tmp_path, language)) == _comparable(loaded)
