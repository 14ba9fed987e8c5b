"""What an earlier check has found counts only as long as a check from scratch would find the same."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

_MAIN = """\
launch:
  - arg: {name: robot, default: $(env ROBOT nobody)}
  - include: {file: part.launch.xml, arg: [{name: name, value: $(var robot)}]}
  - include: {file: part.launch.py, if: $(env WITH_PYTHON 'true')}
  - node: {pkg: demo, exec: talker, name: talker, param: [{from: params.yaml}]}
  - node: {pkg: demo, exec: talker, name: other, if: "false"}
  - group: {forwarding: false, children: [node: {pkg: demo, exec: talker, name: alone}]}
"""
_XML = '<launch><arg name="name"/><log message="$(var name)"/></launch>\n'
_PYTHON = """\
import os
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription, LogInfo
from part import helper

HERE = os.path.dirname(__file__)

def generate_launch_description():
    found = [LogInfo(msg=helper.WORDS)]
    if os.environ.get("MODE") == "wild":
        found.append(LogInfo(msg=1))
    if os.path.isdir(os.path.join(HERE, "extra")):
        found.append(LogInfo(msg=2))
    for name in sorted(os.listdir(os.path.join(HERE, "parts"))):
        found.append(IncludeLaunchDescription(os.path.join(HERE, "parts", name)))
    try:
        import absent_module
    except ImportError:
        pass
    else:
        found.append(LogInfo(msg=3))
    return LaunchDescription(found)
"""
_FILES = {
    "main.launch.yaml": _MAIN,
    "part.launch.xml": _XML,
    "part.launch.py": _PYTHON,
    "lib/part/__init__.py": "",
    "lib/part/helper.py": "WORDS = 'hello'\n",
    "parts/a.launch.yaml": "launch: [log: {message: hello}]\n",
    "params.yaml": "/talker:\n  ros__parameters: {rate: 1}\n",
    "prefix/share/ament_index/resource_index/packages/demo": "",
    "prefix/lib/demo/talker": "#!/bin/sh\n",
}
# Each is done to a folder and an environment; each may change what is found.
_CHANGES: dict[str, Callable[[Path, dict[str, str]], object]] = {
    "another default": lambda folder, _: _write(folder, "main.launch.yaml", _MAIN.replace("robot,", "robo,")),
    "a misspelt key in an include": lambda folder, _: _write(
        folder, "part.launch.xml", _XML.replace("msg", "x")
    ),
    "an include is gone": lambda folder, _: (folder / "part.launch.xml").unlink(missing_ok=True),
    "an include is broken": lambda folder, _: _write(folder, "part.launch.xml", "<launch>\n"),
    "an unreadable include": lambda folder, _: (folder / "parts/a.launch.yaml").write_bytes(b"\xff\xfe\x00"),
    "a new file in a folder": lambda folder, _: _write(folder, "parts/b.launch.yaml", "launch: [lgo: {}]\n"),
    "a helper of code": lambda folder, _: _write(folder, "lib/part/helper.py", "WORDS = 5\n"),
    "a new helper": lambda folder, _: _write(folder, "lib/absent_module.py", ""),
    "a helper is broken": lambda folder, _: _write(folder, "lib/part/__init__.py", "raise ValueError('x')\n"),
    "parameters are gone": lambda folder, _: (folder / "params.yaml").unlink(missing_ok=True),
    "other parameters": lambda folder, _: _write(
        folder, "params.yaml", "/listener:\n  ros__parameters: {a: 1}\n"
    ),
    "wrong parameters": lambda folder, _: _write(folder, "params.yaml", "/talker:\n  ros__parameters: [1]\n"),
    "a folder appears": lambda folder, _: (folder / "extra").mkdir(exist_ok=True),
    "a package is gone": lambda folder, _: shutil.rmtree(folder / "prefix/share", ignore_errors=True),
    "an executable is gone": lambda folder, _: (folder / "prefix/lib/demo/talker").unlink(missing_ok=True),
    "another name for it": lambda folder, _: _write(folder, "prefix/lib/demo/talkr", "#!/bin/sh\n", 0o755),
    "without run bit": lambda folder, _: _write(folder, "prefix/lib/demo/talker", "#!/bin/sh\n", 0o644),
    "settings": lambda folder, _: _write(folder, "orchestra.toml", "strict = true\n"),
    "broken settings": lambda folder, _: _write(folder, "orchestra.toml", "strikt = true\n"),
    "a variable": lambda _, environment: environment.update(MODE="wild"),
    "a variable is gone": lambda _, environment: environment.pop("MODE", None),
    "an empty variable": lambda _, environment: environment.update(WITH_PYTHON="false"),
    "a strange variable": lambda _, environment: environment.update(ROBOT="robot1", OTHER="x"),
    "no prefix": lambda _, environment: environment.pop("AMENT_PREFIX_PATH", None),
    "as it was": lambda folder, _: _write_all(folder),
}


def _write(folder: Path, name: str, text: str, mode: int = 0o644) -> None:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(mode)


def _write_all(folder: Path) -> None:
    for name, text in _FILES.items():
        _write(folder, name, text, 0o755 if name.endswith("talker") else 0o644)


class _Checker:
    def __init__(self, stdin: IO[str], stdout: IO[str]) -> None:
        self._stdin, self._stdout = stdin, stdout

    def ask(self, folder: Path, environment: dict[str, str], *, cache: bool) -> dict[str, Any]:
        question = {"folder": str(folder), "environment": environment, "cache": cache}
        self._stdin.write(json.dumps(question) + "\n")
        self._stdin.flush()
        answer: dict[str, Any] = json.loads(self._stdout.readline())
        return answer


@pytest.fixture(scope="module")
def checker() -> Iterator[_Checker]:
    program = str(Path(__file__).with_name("checker.py"))
    with subprocess.Popen(
        [sys.executable, program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        yield _Checker(process.stdin, process.stdout)
        process.stdin.close()


def _environment(folder: Path) -> dict[str, str]:
    return {
        "PATH": os.environ["PATH"],
        "PYTHONPATH": str(folder / "lib"),
        "AMENT_PREFIX_PATH": str(folder / "prefix"),
        "ORCHESTRA_CACHE": str(folder.parent / "cache"),
    }


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "work"
    _write_all(folder)
    return folder


def _with_libraries(folder: Path) -> None:
    """Let code of launch files import what is in `lib`: a prefix has it where installed packages have theirs."""
    link = folder / "prefix/lib/python3.11/site-packages"
    link.parent.mkdir(parents=True, exist_ok=True)
    if not link.is_symlink():
        link.symlink_to(folder / "lib")


def test_nothing_has_changed(checker: _Checker, project: Path) -> None:
    _with_libraries(project)
    environment = _environment(project)
    first = checker.ask(project, environment, cache=True)
    again = checker.ask(project, environment | {"UNRELATED": "x"}, cache=True)
    assert first["problems"] == []
    assert (first["known"], again["known"]) == (0, 5)
    assert again["problems"] == []


@pytest.mark.parametrize("change", sorted(_CHANGES))
def test_each_change_is_seen(checker: _Checker, project: Path, change: str) -> None:
    _with_libraries(project)
    environment = _environment(project)
    checker.ask(project, environment, cache=True)
    _CHANGES[change](project, environment)
    fresh = checker.ask(project, environment, cache=False)
    assert checker.ask(project, environment, cache=True)["problems"] == fresh["problems"]


def _compare(checker: _Checker, project: Path, changes: list[str]) -> None:
    shutil.rmtree(project)
    _write_all(project)
    _with_libraries(project)
    environment = _environment(project)
    checker.ask(project, environment, cache=True)
    for change in changes:
        _CHANGES[change](project, environment)
        fresh = checker.ask(project, environment, cache=False)
        assert checker.ask(project, environment, cache=True)["problems"] == fresh["problems"], changes


_SEQUENCES = st.lists(st.sampled_from(sorted(_CHANGES)), min_size=2, max_size=4)
_TOGETHER = [HealthCheck.function_scoped_fixture, HealthCheck.too_slow]


@settings(max_examples=6, deadline=None, suppress_health_check=_TOGETHER, database=None)
@given(changes=_SEQUENCES)
def test_changes_after_each_other_are_seen(checker: _Checker, project: Path, changes: list[str]) -> None:
    _compare(checker, project, changes)


@pytest.mark.long
@pytest.mark.timeout(1200)
@settings(max_examples=300, deadline=None, suppress_health_check=_TOGETHER)
@given(changes=st.lists(st.sampled_from(sorted(_CHANGES)), min_size=2, max_size=8))
def test_many_changes_are_seen(checker: _Checker, project: Path, changes: list[str]) -> None:
    _compare(checker, project, changes)


_UNKNOWABLE = {
    "time": "import time\nX = time.time()",
    "chance": "from random import random\nX = random()",
    "a program": "import subprocess\nX = subprocess.run(['true'])",
    "a socket": "__import__('socket').socket().close()",
    "the processor": "import os\nX = os.cpu_count()",
    "the size of a file": "import os\nX = os.path.getsize(__file__)",
    "the kernel": "X = open('/proc/uptime').read()",
    "a file that is written": "open('made.txt', 'w').close()",
}


@pytest.mark.parametrize("what", sorted(_UNKNOWABLE))
def test_nothing_is_kept_that_goes_by_what_nobody_can_record(
    checker: _Checker, tmp_path: Path, what: str
) -> None:
    folder = tmp_path / "work"
    body = "\nfrom launch import LaunchDescription\ndef generate_launch_description():\n    return LaunchDescription([])\n"
    _write(folder, "a.launch.py", _UNKNOWABLE[what] + body)
    environment = _environment(folder)
    checker.ask(folder, environment, cache=True)
    assert checker.ask(folder, environment, cache=True)["known"] == 0


_SERVED = """\
import launch.actions
from launch import LaunchDescription

def generate_launch_description():
    return LaunchDescription([launch.actions.LogInfo(msg="hello")])
"""
_HIDING = """\
import sys
sys.modules["launch"] = sys.modules["launch.actions"] = sys
sys.modules.pop("launch.substitutions", None)
launch.LogInfo = launch.actions.LogInfo = None
"""


def test_modules_that_appear_matter_only_to_whoever_imports_such(checker: _Checker, tmp_path: Path) -> None:
    folder = tmp_path / "work"
    for name in "abcdef":  # each of two processes imports more of its own for the first that it looks at
        _write(folder, f"{name}.launch.py", _SERVED)
    _write(folder, "prefix/lib/python3.11/site-packages/old.py", "")
    environment = _environment(folder)
    first = checker.ask(folder, environment, cache=True)
    _write(folder, "prefix/lib/python3.11/site-packages/launch/__init__.py", "raise ValueError")
    again = checker.ask(folder, environment, cache=True)
    assert (first["problems"], again["problems"]) == ([], [])
    assert again["known"] >= 4


def test_what_one_file_does_to_served_modules_the_next_does_not_see(
    checker: _Checker, tmp_path: Path
) -> None:
    folder = tmp_path / "work"
    for name in "abcd":  # two for each of two processes, one after the other
        _write(folder, f"{name}.launch.py", _SERVED + (_HIDING if name in "ac" else ""))
    problems = checker.ask(folder, _environment(folder), cache=False)["problems"]
    assert not [problem for problem in problems if problem[3][0] in ("b.launch.py", "d.launch.py")]
    assert {problem[3][0] for problem in problems} == {"a.launch.py", "c.launch.py"}


def test_the_output_of_a_command_is_never_kept(checker: _Checker, tmp_path: Path) -> None:
    folder = tmp_path / "work"
    _write(folder, "a.launch.yaml", "launch: [log: {message: $(command 'echo x')}]\n")
    environment = _environment(folder)
    checker.ask(folder, environment, cache=True)
    assert checker.ask(folder, environment, cache=True)["known"] == 0


@pytest.mark.parametrize("damage", [b"", b"nonsense", b'{"key": 1}'])
def test_a_damaged_entry_counts_as_none(checker: _Checker, project: Path, damage: bytes) -> None:
    _with_libraries(project)
    environment = _environment(project)
    checker.ask(project, environment, cache=True)
    entries = list((project.parent / "cache/check").iterdir())
    assert entries
    for entry in entries:
        entry.write_bytes(damage)
    again = checker.ask(project, environment, cache=True)
    assert (again["known"], again["problems"]) == (0, [])
