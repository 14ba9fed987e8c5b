"""Whatever a description says, it says in every language, there and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.convert.turning import same_everywhere
from tests.load.test_same_plan import _rich as rich
from tests.load.written import WRITERS, Actions
from tests.plan.strategies import actions as ordinary
from tests.plan.strategies import inner_actions

if TYPE_CHECKING:
    from pathlib import Path

_ENVIRONMENT = {"PATH": "/bin", "A_1": "outside"}
_quickly = settings(
    max_examples=10,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
_languages = st.sampled_from(sorted(WRITERS))


@given(st.lists(ordinary | rich, max_size=4), inner_actions, _languages)
@_quickly
def test_a_description_says_the_same_in_every_language(
    tmp_path: Path, actions: Actions, inner: Actions, language: str
) -> None:
    _turn(tmp_path, actions, inner, language)


@pytest.mark.long
@pytest.mark.timeout(3_600)
@given(st.lists(ordinary | rich, max_size=8), inner_actions, _languages)
@settings(_quickly, max_examples=1_000)
def test_a_description_says_the_same_in_every_language_however_many_are_tried(
    tmp_path: Path, actions: Actions, inner: Actions, language: str
) -> None:
    _turn(tmp_path, actions, inner, language)


def _turn(folder: Path, actions: Actions, inner: Actions, language: str) -> None:
    (folder / "p.yaml").write_text("/**: {ros__parameters: {b: 1.5, d: [x, 'y']}}", "utf-8")
    (folder / "inner.launch.yaml").write_text(WRITERS["yaml"](inner), "utf-8")
    path = folder / f"a.launch.{language}"
    path.write_text(WRITERS[language](actions), "utf-8")
    same_everywhere(path, _ENVIRONMENT)
