"""Parameters that are each written once, at the node, come to the same without the closer look that others take."""

from __future__ import annotations

import os
import random
from typing import TYPE_CHECKING, Any

import pytest

from orchestra import pipeline
from orchestra.errors import Problems
from orchestra.plan import parameters
from orchestra.plan.codec import dumps

if TYPE_CHECKING:
    from pathlib import Path

_NAMES = ("a", "a.b", "a.b.c", "b", "yes", "x y", "/c", "use_sim_time")
_VALUES = (
    *("1", "2.5", "true", "'quoted'", "text", "[1, 2]", "[a, b]", "''", "$(var v)"),
    *("$(var v)/$(var w)", "'1'"),
)
_PLACES = ("", ", name: n{0}", ", name: n{0}, namespace: x", ", namespace: x", ", name: /n{0}, namespace: /")


def _described(chance: random.Random) -> str:
    lines = ["launch:", "- arg: {name: v, default: '3'}", "- let: {name: w, value: $(var v)x}"]
    for number in range(5):
        names = chance.choices(_NAMES, k=chance.randrange(4))
        given = ", ".join(f"{{name: {name}, value: {chance.choice(_VALUES)}}}" for name in names)
        place = chance.choice(_PLACES).format(number)
        lines.append(f"- node: {{exec: /bin/true, exec_name: e{number}{place}, param: [{given}]}}")
        if chance.random() < 0.15:
            lines.append(
                f"- set_parameter: {{name: {chance.choice(_NAMES)}, value: {chance.choice(_VALUES)}}}"
            )
    return "\n".join(lines) + "\n"


def _found(path: Path, *, whole: bool) -> tuple[Any, Any]:
    problems = Problems()
    with pipeline.opened(
        str(path), pipeline.inputs_from((), environment=dict(os.environ)), problems, whole=whole
    ) as launch:
        assert launch is not None
        found = [(item.parameters, item.parameter_files) for item in launch.plan.processes]
        return (dumps(launch.plan) if whole else found), problems.ordered


@pytest.mark.parametrize("seed", range(8))
def test_a_closer_look_finds_the_same(seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "main.launch.yaml"
    path.write_text(_described(random.Random(seed)))  # noqa: S311 - the same each time
    plainly = [_found(path, whole=whole) for whole in (True, False)]
    monkeypatch.setattr(parameters, "_plain", lambda *_, **__: None)
    assert plainly == [_found(path, whole=whole) for whole in (True, False)]
