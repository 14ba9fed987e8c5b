"""Which processes can be forked warm, and the reason where one cannot."""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.plan import warm
from orchestra.plan.model import Warm
from orchestra.plan.portable import portable
from orchestra.plan.startup import is_read_at_startup
from orchestra.plan.warm import warmed, wish
from orchestra.values import Limits
from tests.plan.records import plan, process
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from orchestra.plan.model import Process

PYTHON = sys.executable
BESIDE = os.path.dirname(PYTHON)  # noqa: PTH120 - its folder as it is called, not where links lead to


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return a folder with programs."""
    programs = {
        "env.py": "#!/usr/bin/env python3\nimport rclpy",
        "direct.py": f"#!{PYTHON}\nimport rclpy",
        "plain.py": f"#!{PYTHON}\nprint()",
        "flags.py": f"#!{PYTHON} -u\nimport rclpy",
        "split.py": "#!/usr/bin/env -S python3 -u\nimport rclpy",
        "other.py": "#!/usr/bin/python9\nimport rclpy",
        "shell.sh": "#!/bin/sh\ntrue",
        "windows.py": "#!/usr/bin/env python3\r\nimport rclpy",
        "nothing": "",
        "binary": "\x7fELF",
    }
    for name, content in programs.items():
        (tmp_path / name).write_text(content, "utf-8", newline="")
        (tmp_path / name).chmod(0o755)
    return tmp_path


def decided(*command: str, environment: dict[str, str] | None = None, **changes: Any) -> Warm:
    """Return what is decided for a node with a command."""
    given = replace(process("n"), **{"kind": "node", "command": command, "shell": False, **changes})
    caller = {"PATH": f"{BESIDE}:/usr/bin:/bin", **(environment or {})}
    (planned,) = warmed(plan(given), caller).processes
    assert planned.warm is not None
    return planned.warm


def test_a_script_is_looked_at_once_whatever_its_arguments_are(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    looks: list[str] = []
    look = warm._first_line

    def counted(path: str) -> bytes:
        looks.append(path)
        return look(path)

    monkeypatch.setattr(warm, "_first_line", counted)
    script, other = str(folder / "direct.py"), str(folder / "plain.py")
    commands = ((script, "a"), (script, "b", "c"), (PYTHON, script), (PYTHON, other), (other,))
    nodes = [
        replace(process(f"n{number}"), kind="node", command=command, shell=False)
        for number, command in enumerate(commands)
    ]
    planned = warmed(replace(plan(nodes[0]), processes=tuple(nodes)), {"PATH": BESIDE}).processes
    assert looks == [script, other]
    assert [item.warm.target for item in planned if item.warm] == [script, script, script, other, other]


def test_scripts_by_their_first_line(folder: Path) -> None:
    path = str(folder / "env.py")
    assert decided(path, "a") == Warm(
        True, None, "script", path, ("python3",), f"{BESIDE}/python3", 0, "python3"
    )
    path = str(folder / "direct.py")
    assert decided(path) == Warm(True, None, "script", path, (PYTHON,), PYTHON, 0, "direct.py")


def test_a_program_of_the_search_path(folder: Path) -> None:
    found = decided("direct.py", environment={"PATH": f"{folder}:{BESIDE}"})
    assert (found.interpreter, found.skip) == ((PYTHON, str(folder / "direct.py")), 1)


def test_the_interpreter_with_a_script_or_a_module(folder: Path) -> None:
    called = decided(PYTHON, "env.py", "b", cwd=str(folder))
    assert called == Warm(
        True, None, "script", str(folder / "env.py"), (PYTHON,), PYTHON, 1, Path(PYTHON).name
    )
    module = decided(PYTHON, "-m", "bringup.nodes.simulation")
    assert (module.warm, module.kind, module.target, module.skip) == (
        *(True, "module"),
        *("bringup.nodes.simulation", 1),
    )


def test_a_module_and_a_script_of_a_description(tmp_path: Path) -> None:
    (tmp_path / "run.py").write_text("print()", "utf-8")
    actions = (
        "- node: {module: json.tool, name: a}\n- node: {script: run.py, name: b}\n"
        "- node: {script: run.py, name: c, warm: false}\n"
    )
    planned = warmed(outcome(tmp_path, f"launch:\n{actions}").plan, {"PATH": f"{BESIDE}:/usr/bin:/bin"})
    found = [process.warm for process in planned.processes]
    assert [(warm.warm, warm.kind, warm.target) for warm in found if warm is not None] == [
        (True, "module", "json.tool"),
        (True, "script", str(tmp_path / "run.py")),
        (False, None, None),
    ]


@pytest.mark.parametrize(
    ("command", "reason"),
    [
        (("flags.py",), "its first line is no plain call of an interpreter"),
        (("split.py",), "its first line is no plain call of an interpreter"),
        (("other.py",), "its interpreter is another one"),
        (("windows.py",), "its first line is no plain call of an interpreter"),
        (("shell.sh",), "its program is not written in Python"),
        (("nothing",), "its program is not written in Python"),
        (("binary",), "its program is not written in Python"),
        (("missing",), "its program is not written in Python"),
        ((PYTHON, "-u", "env.py"), "its interpreter is called with options of its own"),
        ((PYTHON, "-c", "import rclpy"), "its interpreter is called with options of its own"),
        ((PYTHON,), "its interpreter is called with options of its own"),
        ((PYTHON, "-m"), "it names no module"),
        ((PYTHON, "-m", "a-b"), "it names no module"),
        ((PYTHON, "."), "its script is no file that is here"),
        (("no_such_program_anywhere",), "its program is not here"),
        ((), "it has no command"),
    ],
)
def test_other_programs(folder: Path, command: tuple[str, ...], reason: str) -> None:
    inside = [path.name for path in folder.iterdir()]
    words = [
        str(folder / word) if word in (*inside, "missing") and "-u" not in command else word
        for word in command
    ]
    assert decided(*words, cwd=str(folder)) == Warm(False, reason)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"shell": True}, "a shell reads its command"),
        ({"prefix": ("gdb", "--args")}, "it has a launch prefix"),
        ({"inherit_environment": False}, "its environment is its own"),
        ({"stdin": True}, "it reads what is typed"),
        ({"cwd": "${run}/files"}, "its working directory is not there yet"),
        ({"warm": wish(False)}, "the description says so"),
        (
            {"limits": Limits(memory=1 << 30)},
            "its memory is capped, and what it shares with the server would not count",
        ),
        (
            {"limits": Limits(rlimits={"as": (1 << 30, 1 << 30)})},
            "its limits on memory would count what the server has loaded",
        ),
        (
            {"environment": {"PYTHONPATH": "/x"}},
            "its environment has another PYTHONPATH, which is read before a program begins",
        ),
        (
            {"environment": {"RMW_IMPLEMENTATION": None}},
            "its environment has another RMW_IMPLEMENTATION, which is read before a program begins",
        ),
    ],
)
def test_what_is_said_of_a_process(folder: Path, changes: dict[str, Any], reason: str) -> None:
    caller = {"RMW_IMPLEMENTATION": "rmw_fastrtps_cpp"}
    path, own = str(folder / "env.py"), dict(changes)
    given = replace(process("n"), **{"kind": "node", "command": (path,), "shell": False, **own})
    (planned,) = warmed(plan(given), {"PATH": BESIDE, **caller}).processes
    assert planned.warm == Warm(False, reason)


@pytest.mark.parametrize(
    "changes",
    [
        {"environment": {"RMW_IMPLEMENTATION": "rmw_fastrtps_cpp", "ROS_DOMAIN_ID": "3", "PATH": BESIDE}},
        {"limits": Limits(nice=1, rlimits={"nofile": (100, 100)})},
        {"emulate_tty": True},
        {"cwd": "/"},
    ],
)
def test_what_makes_no_difference(folder: Path, changes: dict[str, Any]) -> None:
    given = replace(
        process("n"), **{"kind": "node", "command": (str(folder / "env.py"),), "shell": False, **changes}
    )
    caller = {"PATH": BESIDE, "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp"}
    (planned,) = warmed(plan(given), caller).processes
    assert planned.warm is not None
    assert planned.warm.warm


def test_what_watches_from_the_start_of_an_interpreter(folder: Path) -> None:
    found = decided(str(folder / "env.py"), environment={"COVERAGE_PROCESS_START": "x"})
    assert found == Warm(
        False, "the environment has COVERAGE_PROCESS_START, which acts from the start of an interpreter"
    )


def test_an_executable_has_to_speak_of_rclpy_or_to_be_meant(folder: Path) -> None:
    plain, speaking = str(folder / "plain.py"), str(folder / "env.py")
    assert decided(plain, kind="process") == Warm(False, "it is no node, and says nothing of rclpy")
    assert decided(plain, kind="process", warm=wish(True)).warm
    assert decided(speaking, kind="process").warm
    assert decided(plain).warm


def test_another_environment_of_the_same_interpreter_is_another_one(folder: Path) -> None:
    elsewhere = folder / "venv" / "bin"
    elsewhere.mkdir(parents=True)
    (folder / "venv" / "pyvenv.cfg").touch()
    (elsewhere / "python3").symlink_to(PYTHON)
    found = decided(str(folder / "env.py"), environment={"PATH": f"{elsewhere}:{BESIDE}"})
    assert found == Warm(False, "its interpreter is another one")


def test_a_plan_for_any_machine_says_nothing_of_it(folder: Path) -> None:
    given: Process = replace(process("n"), kind="node", command=(str(folder / "env.py"),), shell=False)
    assert portable(warmed(plan(given), {"PATH": BESIDE}), {"/x": "${cwd}"}).processes[0].warm is None


def test_variables() -> None:
    early = (
        "PYTHONPATH",
        "LD_LIBRARY_PATH",
        "RMW_IMPLEMENTATION",
        "MALLOC_ARENA_MAX",
        "LANG",
        "LC_ALL",
        "HOME",
    )
    assert all(map(is_read_at_startup, early))
    assert not any(map(is_read_at_startup, ("ROS_DOMAIN_ID", "PATH", "DISPLAY", "RCUTILS_COLORIZED_OUTPUT")))
