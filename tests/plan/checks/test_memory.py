"""Memory caps against the memory of a machine."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code, Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.checks.memory import check_memory

if TYPE_CHECKING:
    from pathlib import Path

_CAPPED = """\
launch:
  - executable: {cmd: sleep 1, name: a, limits: {memory: 600 MiB}}
  - executable: {cmd: sleep 1, name: b, limits: {memory: 500 MiB}}
  - executable: {cmd: sleep 1, name: c}
"""


@pytest.mark.parametrize(("mebibytes", "told"), [(1000, ["b"]), (1100, [])])
def test_caps_that_come_to_more_than_there_is_are_told_once(
    tmp_path: Path, mebibytes: int, told: list[str]
) -> None:
    file = tmp_path / "a.launch.yaml"
    file.write_text(_CAPPED, "utf-8")
    problems = Problems()
    plan = collect(str(file), inputs_from([], environment={"PATH": "/usr/bin:/bin"}), Problems())
    assert plan is not None
    check_memory(plan, problems, mebibytes << 20)
    places = {process.location.span: process.id for process in plan.processes}
    assert [places[problem.span] for problem in problems if problem.span is not None] == told


@pytest.mark.parametrize(("launching", "codes"), [(False, [Code.UNFIT_MACHINE]), (True, [])])
def test_a_run_looks_at_its_machine_itself(tmp_path: Path, launching: bool, codes: list[Code]) -> None:
    file = tmp_path / "a.launch.yaml"
    file.write_text(_CAPPED.replace("600 MiB", "6000000 GiB"), "utf-8")
    problems = Problems()
    collect(
        str(file),
        replace(inputs_from([], environment={"PATH": "/usr/bin:/bin"}), launching=launching),
        problems,
    )
    assert [problem.code for problem in problems] == codes
