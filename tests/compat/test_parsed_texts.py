"""What is wrong with texts that code of launch files has parsed is told at these texts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.cli.main import main
from orchestra.errors import Code, Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import encode

if TYPE_CHECKING:
    from pathlib import Path

_FILE = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.conditions import IfCondition
from launch.frontend.parse_substitution import parse_substitution

def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('x', default_value='maybe'),
        ExecuteProcess(cmd=['true', parse_substitution('<$(var x)>')], name='a', {}),
    ])
"""


@pytest.mark.parametrize(
    ("keyword", "code"),
    [
        ("condition=IfCondition({})", Code.BAD_CONDITION),
        ("sigterm_timeout={}", Code.BAD_VALUE),
        ("condition=IfCondition([*{}])", Code.BAD_CONDITION),
    ],
)
@pytest.mark.parametrize(
    "text", ["parse_substitution('$(var x)')", "parse_substitution('$(var $(env NAME))')"]
)
def test_a_mistake_in_a_parsed_text_is_told_there(
    keyword: str,
    code: Code,
    text: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    path = tmp_path / "a.launch.py"
    path.write_text(_FILE.format(keyword.format(text)))
    monkeypatch.setenv("NAME", "x")
    assert main(["plan", str(path)]) == 2
    told = capsys.readouterr().err
    line = next(number for number, line in enumerate(path.read_text().splitlines(), 1) if "name='a'" in line)
    assert f"a.launch.py:{line}:" in told
    assert f"[{code.value}]" in told
    assert "bug" not in told


def test_where_a_parsed_text_stands_is_written_with_the_plan(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.py"
    path.write_text(_FILE.format("cwd=parse_substitution('$(dirname)')"))
    problems = Problems()
    plan = collect(str(path), inputs_from([], environment={"PATH": "/bin"}), problems)
    assert plan is not None
    assert not list(problems)
    (process,) = encode(plan)["processes"]
    assert process["command"][-1] == "<maybe>"
