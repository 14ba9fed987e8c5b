"""`orchestra plan`: parts of a plan, its forms, plans that are the same everywhere."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from subprocess import CompletedProcess
from typing import TYPE_CHECKING

import pytest

from orchestra.cli.plan import FORMATS
from orchestra.plan import codec
from orchestra.plan.render import yaml_text
from orchestra.plan.render.formats import FORMATS as RENDERERS

if TYPE_CHECKING:
    from pathlib import Path

Command = Callable[..., CompletedProcess[str]]


@pytest.fixture
def orchestra(orchestra_here: Command) -> Command:
    """Run the command in this process."""
    return orchestra_here


_FILE = """\
launch:
  - node: {pkg: demo, exec: talker, name: a, namespace: /r1}
  - node: {pkg: demo, exec: talker, name: b, namespace: /r1/arm}
  - node: {pkg: demo, exec: echo, name: a, namespace: /r2, param: [{name: where, value: $(find-pkg-share demo)/x}]}
  - executable: {cmd: echo done, name: tool}
"""


@pytest.fixture(autouse=True)
def _environment(folder: Path, prefix: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "main.yaml").write_text(_FILE)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))


def _ids(found: CompletedProcess[str]) -> list[str]:
    assert (found.returncode, found.stderr) == (0, "")
    return [process["id"] for process in json.loads(found.stdout)["processes"]]


@pytest.mark.parametrize(
    ("patterns", "ids"),
    [
        (["/r1/a"], ["/r1/a"]),
        (["r1/a"], ["/r1/a"]),
        (["/r1/**"], ["/r1/a", "/r1/arm/b"]),
        (["/r1/"], ["/r1/a", "/r1/arm/b"]),
        (["*/a"], ["/r1/a", "/r2/a"]),
        (["tool", "r2/?"], ["/r2/a", "tool"]),
        (["/**"], ["/r1/a", "/r1/arm/b", "/r2/a", "tool"]),
    ],
)
def test_nodes_are_chosen_by_names_patterns_and_namespaces(
    orchestra: Command, patterns: list[str], ids: list[str]
) -> None:
    words = [word for pattern in patterns for word in ("--node", pattern)]
    assert _ids(orchestra("plan", "main.yaml", "--format", "json", *words)) == ids


@pytest.mark.parametrize(
    ("pattern", "told"),
    [("/r1/b", "did you mean 'r1/a'"), ("/zzz/**", "there are /r1/a, /r1/arm/b, /r2/a, tool")],
)
def test_a_pattern_in_vain_is_a_mistake(orchestra: Command, pattern: str, told: str) -> None:
    found = orchestra("plan", "main.yaml", "--node", pattern)
    assert (found.returncode, found.stdout) == (2, "")
    assert told in found.stderr


def test_the_command_knows_every_format() -> None:
    assert set(FORMATS) == set(RENDERERS)


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_is_restricted_and_the_same_every_time(orchestra: Command, name: str) -> None:
    if name == "svg" and shutil.which("dot") is None:
        pytest.skip("Graphviz is not installed")
    words = ("plan", "main.yaml", "--format", name, "--node", "/r2/a")
    first, second = orchestra(*words), orchestra(*words)
    assert (first.returncode, first.stderr) == (0, "")
    assert first.stdout == second.stdout
    assert "/r2/a" in first.stdout
    assert "/r1/a" not in first.stdout


def test_problems_are_told_as_text_where_a_plan_has_a_form_of_its_own(
    orchestra: Command, folder: Path
) -> None:
    (folder / "bad.yaml").write_text("launch:\n  - nod: {}\n")
    found = orchestra("plan", "bad.yaml", "--format", "mermaid")
    assert (found.returncode, found.stdout) == (2, "")
    assert found.stderr.startswith("bad.yaml:2:5: error: ")


def test_a_saved_plan_may_stand_for_the_launch_file(orchestra: Command, folder: Path) -> None:
    plan = orchestra("plan", "main.yaml", "--format", "json").stdout
    for form, read in (("json", codec.loads), ("yaml", yaml_text.loads)):
        saved = orchestra("plan", "main.yaml", "--format", form).stdout
        (folder / f"saved.{form}").write_text(saved)
        assert codec.dumps(read(saved), indent=2) + "\n" == plan
        assert orchestra("plan", f"saved.{form}", "--format", "json").stdout == plan


def test_half_a_saved_plan_is_a_mistake(orchestra: Command, folder: Path) -> None:
    (folder / "saved.json").write_text('{"version": 1, "file": "x"')
    found = orchestra("plan", "saved.json")
    assert found.returncode == 2
    assert "saved.json cannot be read as a plan" in found.stderr


def test_a_portable_plan_names_nothing_of_this_machine(
    orchestra: Command, folder: Path, prefix: Path, tmp_path: Path
) -> None:
    found = orchestra("plan", "main.yaml", "--portable", "--format", "json")
    assert str(tmp_path) not in found.stdout
    process = json.loads(found.stdout)["processes"][2]
    assert process["command"][0] == "${prefix:demo}/lib/demo/echo"
    assert process["parameters"] == {"where": "${share:demo}/x"}
    elsewhere = tmp_path / "elsewhere"
    shutil.move(prefix, elsewhere)
    again = orchestra("plan", "main.yaml", "--portable", "--format", "json", AMENT_PREFIX_PATH=str(elsewhere))
    assert again.stdout == found.stdout
    assert folder.exists()


def test_what_a_run_adds_here_is_shown_where_it_is_asked_for(orchestra: Command) -> None:
    shown = orchestra("plan", "main.yaml", "--host", ROS_AUTOMATIC_DISCOVERY_RANGE="").stdout
    assert "\nhost\n  " in shown
    assert "  ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST\n" in shown
    assert "host" not in orchestra("plan", "main.yaml").stdout.splitlines()
    refused = orchestra("plan", "main.yaml", "--host", "--format", "dot")
    assert (refused.returncode, refused.stdout) == (2, "")


def test_a_script_brings_along_what_code_has_written(orchestra: Command, folder: Path) -> None:
    (folder / "code.launch.py").write_text(
        "import tempfile\n"
        "from launch import LaunchDescription\n"
        "from launch.actions import ExecuteProcess\n"
        "def generate_launch_description():\n"
        "    with tempfile.NamedTemporaryFile('w', delete=False) as file:\n"
        "        file.write('written $by `code`\\n')\n"
        "    return LaunchDescription([ExecuteProcess(cmd=['cat', file.name])])\n"
    )
    found = orchestra("plan", "code.launch.py", "--format", "sh")
    assert found.returncode == 0, found.stderr
    done = subprocess.run(
        ["bash"], input=found.stdout, capture_output=True, text=True, timeout=60, check=False
    )
    assert done.stdout == "written $by `code`\n"


def test_bytes_that_are_no_text_pass_through_a_script(folder: Path) -> None:
    """An argument of the command line may be any bytes."""
    words = [sys.executable, "-m", "orchestra", "plan", "any.yaml", "--format", "sh"]
    (folder / "any.yaml").write_text(
        'launch:\n  - arg: {name: word}\n  - executable: {cmd: [printf, "%s", $(var word)]}\n'
    )
    given = [*words, os.fsdecode(b"word:=\xff'$x\n\xe4")]
    made = subprocess.run(given, cwd=folder, capture_output=True, timeout=60, check=False)
    assert made.returncode == 0, made.stderr
    done = subprocess.run(
        ["bash"], input=made.stdout, capture_output=True, env={**os.environ}, timeout=60, check=False
    )
    assert done.stdout == b"\xff'$x\n\xe4"
