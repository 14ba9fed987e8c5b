"""What stands between the command and the first program is counted: modules, processes, system calls."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

_LAUNCH = "launch:\n  - executable: {cmd: ./true, name: first}\n"
# What is kept is kept beside the run, which waits for it only for a while: so the run is not over before it is there, and
# goes on if it never is, as where a file of ours is written to meanwhile.
_PROGRAM = """\
#!/bin/sh
end=$(($(date +%s) + 60))
until ls cache/plans | grep -qv '[.]' || [ "$(date +%s)" -gt $end ]; do sleep 0.02; done
"""
_COUNTING = Path(__file__).with_name("counting.py")
# Of ours and of the interpreter's library, in the supervisor when it starts its first program.
_OURS, _ALL = 143, 242
# The same in the process that makes the first plan of a file with one executable, or with one node in Python.
_OURS_OF_A_PLAN, _ALL_OF_A_PLAN = 266, 388
_OURS_OF_PYTHON, _ALL_OF_PYTHON = 345, 449
_NODE = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

def generate_launch_description():
    rate = LaunchConfiguration("rate")
    node = Node(executable="./true", name="first", parameters=[{"rate": rate}])
    return LaunchDescription([DeclareLaunchArgument("rate", default_value="1"), node])
"""
# What only some runs need, and none for its first program.
_UNWANTED = (
    *(
        "pydantic",
        "pydantic_core",
        "yaml",
        "rclpy",
        "rich",
        "jinja2",
        "jsonschema",
        "xml",
        "hashlib",
        "argparse",
    ),
    *(
        "dataclasses",
        "inspect",
        "ast",
        "tokenize",
        "subprocess",
        "traceback",
        "shutil",
        "random",
        "base64",
        "graphlib",
        "asyncio",
        "logging",
        "importlib.metadata",
    ),
    *(
        "orchestra.load",
        "orchestra.resolve",
        "orchestra.compat",
        "orchestra.description",
        "orchestra.settings",
    ),
    *("orchestra.plan.build", "orchestra.pipeline", "orchestra.cli.main", "orchestra.cli.launch"),
    *(
        "orchestra.supervise.crash.dossier",
        "orchestra.supervise.reactions.fragment",
        "orchestra.probes.table",
    ),
    *(
        "orchestra.supervise.graph.observer",
        "orchestra.supervise.limits.preflight",
        "orchestra.control.server",
    ),
    "orchestra.control.requests",
)
# Four processes of ours: keeper, guard, supervisor, and what finds out that the plan still holds while the supervisor
# imports what it needs; the program itself comes by posix_spawn(3).
_FORKS = 3
# System calls of the supervisor from its begin to that of its first program, with a plan that is remembered. Half as many
# where the modules are compiled.
_CALLS = 2300
# Of memory for frames of functions, in all processes of ours: `tests/test_stack`.
_CHUNK = "mmap(NULL, 16384, "
_FEW_CHUNKS = 40
# What such a plan has no use for: it takes half as long as all that is left.
_UNWANTED_IN_A_PLAN = (
    *(
        "pydantic",
        "typing_extensions",
        "dataclasses",
        "inspect",
        "ast",
        "tokenize",
        "linecache",
        "argparse",
        "gettext",
    ),
    *(
        "subprocess",
        "shutil",
        "tempfile",
        "random",
        "hashlib",
        "difflib",
        "decimal",
        "fractions",
        "csv",
        "shlex",
    ),
    *(
        "traceback",
        "copy",
        "logging",
        "threading",
        "socket",
        "importlib.abc",
        "importlib.metadata",
        "platform",
    ),
    *("rclpy", "rich", "jinja2", "jsonschema", "xml", "asyncio", "orchestra.cli.problems.text"),
)
_PLANNING = """
import io, sys
from orchestra.__main__ import _resolve
_resolve(["launch", sys.argv[1]], io.BytesIO())
print(*sorted(sys.modules), sep="\\n")
"""


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    (tmp_path / "one.launch.yaml").write_text(_LAUNCH)
    (tmp_path / "true").write_text(_PROGRAM)
    (tmp_path / "true").chmod(0o755)
    # Bytecode is written by the first launch, whatever whoever runs the tests wants of others.
    given = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return {
        **given,
        "ORCHESTRA_HOME": str(tmp_path / "home"),
        "ORCHESTRA_CACHE": str(tmp_path / "cache"),
        "XDG_RUNTIME_DIR": str(tmp_path),
        # A start of the interpreter that a package asks for once more would be counted too.
        "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1",
    }


def _launch(folder: Path, environment: dict[str, str], *before: str) -> set[str]:
    told = folder / "modules"
    words = [*before, sys.executable, str(_COUNTING), str(told), "launch", "one.launch.yaml"]
    subprocess.run(words, cwd=folder, env=environment, check=True, capture_output=True, timeout=100)
    names = set(told.read_text().split())
    told.unlink()
    return names


def _plan(folder: Path) -> object:
    """Return the plan of the latest run."""
    return json.loads((max((folder / "home/runs").iterdir()) / "plan.json").read_text())


def test_a_second_launch_makes_no_plan(tmp_path: Path, environment: dict[str, str]) -> None:
    first = _launch(tmp_path, environment)
    plan = _plan(tmp_path)
    second = _launch(tmp_path, {**environment, "COUNT_RESOLVER": "no"})
    assert _plan(tmp_path) == plan
    for names in (first, second):
        unwanted = {
            name for name in names for what in _UNWANTED if name == what or name.startswith(f"{what}.")
        }
        assert not unwanted
        assert len([name for name in names if name.startswith("orchestra")]) <= _OURS
        assert len(names) <= _ALL


@pytest.mark.parametrize(
    ("name", "ours", "every"),
    [
        ("one.launch.yaml", _OURS_OF_A_PLAN, _ALL_OF_A_PLAN),
        ("one.launch.py", _OURS_OF_PYTHON, _ALL_OF_PYTHON),
    ],
)
def test_a_first_plan_imports_only_what_it_needs(
    tmp_path: Path, environment: dict[str, str], name: str, ours: int, every: int
) -> None:
    (tmp_path / "one.launch.py").write_text(_NODE)
    done = subprocess.run(
        [sys.executable, "-P", "-c", _PLANNING, name],
        cwd=tmp_path,
        env=environment,
        check=True,
        capture_output=True,
        text=True,
        timeout=100,
    )
    names = set(done.stdout.split())
    if sys.version_info >= (3, 12):  # whose sysconfig needs threads
        names -= {"threading", "_weakrefset"}
    if sys.version_info >= (3, 13):  # whose -c needs the one, and whose pathlib the others
        names -= {"linecache", "glob", "grp", "pwd", "pathlib._abc", "pathlib._local"}
    assert not {
        name for name in names for what in _UNWANTED_IN_A_PLAN if name == what or name.startswith(f"{what}.")
    }
    assert len([name for name in names if name.startswith("orchestra")]) <= ours
    assert len(names) <= every


def test_a_change_makes_another_plan(tmp_path: Path, environment: dict[str, str]) -> None:
    _launch(tmp_path, environment)
    (tmp_path / "one.launch.yaml").write_text(_LAUNCH.replace("first", "another"))
    _launch(tmp_path, environment)
    assert "another" in json.dumps(_plan(tmp_path))


@pytest.mark.skipif(
    shutil.which("strace") is None and not os.environ.get("CI"),
    reason="there is no strace(1) on this machine",
)
def test_processes_and_system_calls_are_few(tmp_path: Path, environment: dict[str, str]) -> None:
    _launch(tmp_path, environment)
    trace = tmp_path / "trace"
    _launch(tmp_path, {**environment, "COUNT_RESOLVER": "no"}, "strace", "-f", "-o", str(trace))
    lines = trace.read_text(errors="replace").splitlines()
    begun = next(number for number, line in enumerate(lines) if re.search(r"execve\(.*/true\"", line))
    before = lines[:begun]
    forks = [line for line in before if re.search(r"\b(clone3?|fork)\(", line) and "CLONE_VM" not in line]
    assert len(forks) == _FORKS, forks
    first = before[0].split()[0]
    supervisor = next(line.split()[0] for line in before if '"orc-supervisor"' in line)
    calls = [line for line in before if line.startswith(f"{supervisor} ") and "resumed>" not in line]
    assert supervisor != first
    assert len(calls) <= _CALLS
    assert sum(_CHUNK in line for line in lines) <= _FEW_CHUNKS
