"""Programs that cannot be started, told before anything starts."""

from __future__ import annotations

import stat
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code, Severity
from orchestra.resolve.runnable import fault_of
from orchestra.resolve.typos import distance, is_typo
from tests.plan.checks.told import told
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path

# An ELF file for a machine, as far as anybody looks: the number stands at byte 18.
_ELF = b"\x7fELF\x02\x01\x01" + bytes(9) + b"\x02\x00%b" + bytes(40)


def _program(folder: Path, content: bytes, *, runs: bool = True) -> Path:
    path = folder / "run.sh"
    path.write_bytes(content)
    path.chmod(stat.S_IRWXU if runs else stat.S_IRUSR | stat.S_IWUSR)
    return path


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"#!/bin/sh\r\necho\r\n", "carriage return"),
        (b"#!/no/such/python3\n", "/no/such/python3 is not here"),
        (b"#!/usr/bin/env pyhton3\n", "pyhton3 is not on the search path"),
        (b"#!/usr/bin/env -S FOO=1 nosuchprogram -u\n", "nosuchprogram"),
        (b"#!\n", "no interpreter"),
        (_ELF % b"\xf3\x00", "built for riscv64"),
    ],
)
def test_a_file_that_the_system_would_not_start(content: bytes, reason: str, tmp_path: Path) -> None:
    _program(tmp_path, content)
    (problem,) = outcome(tmp_path, "launch:\n- executable: {cmd: ./run.sh}\n").problems
    assert (problem.code, problem.severity) == (Code.MISSING_EXECUTABLE, Severity.ERROR)
    assert reason in problem.message


@pytest.mark.parametrize(
    "content",
    [
        b"#!/bin/sh\n",
        b"#! /bin/sh -e\n",
        b"#!/usr/bin/env sh\n",
        b"#!/usr/bin/env -S sh -e\n",
        b"",
        b"\x7fELF",
        b"text",
    ],
)
def test_a_file_that_it_may_start(content: bytes, tmp_path: Path) -> None:
    assert fault_of(str(_program(tmp_path, content)), {"PATH": "/bin:/usr/bin"}) is None


def test_what_only_this_machine_lacks_is_a_warning_where_nothing_starts(tmp_path: Path) -> None:
    _program(tmp_path, b"#!/opt/python/bin/python3\n")
    text = "launch:\n- executable: {cmd: ./run.sh}\n"
    (problem,) = outcome(tmp_path, text, launching=False).problems
    assert problem.severity is Severity.WARNING


def test_what_is_there_and_is_no_program(tmp_path: Path) -> None:
    _program(tmp_path, b"#!/bin/sh\n", runs=False)
    (tmp_path / "sub").mkdir()
    assert told(tmp_path, "- executable: {cmd: ./run.sh}\n") == [(Code.MISSING_EXECUTABLE, "./run.sh", None)]
    assert told(tmp_path, "- executable: {cmd: $(dirname)/run.sh}\n") == [
        (Code.MISSING_EXECUTABLE, "$(dirname)/run.sh", None)
    ]
    assert told(tmp_path, "- executable: {cmd: ./sub}\n") == [(Code.MISSING_EXECUTABLE, "./sub", None)]


def test_an_executable_of_a_package_that_lacks_the_right_to_run(tmp_path: Path) -> None:
    prefix = tmp_path / "install"
    for folder in ("share/ament_index/resource_index/packages", "lib/demo", "share/demo"):
        (prefix / folder).mkdir(parents=True)
    (prefix / "share/ament_index/resource_index/packages/demo").touch()
    (prefix / "lib/demo/talker").write_text("#!/bin/sh\n", "utf-8")
    environment = {"AMENT_PREFIX_PATH": str(prefix), "PATH": "/bin"}
    text = "launch:\n- node: {pkg: demo, exec: talker}\n"
    (problem,) = outcome(tmp_path, text, environment=environment).problems
    assert problem.message.endswith("talker is not executable")


def test_a_slip_for_a_program_of_the_search_path(tmp_path: Path) -> None:
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/mapviewer").write_text("#!/bin/sh\n", "utf-8")
    (tmp_path / "bin/mapviewer").chmod(stat.S_IRWXU)
    environment = {"PATH": f"{tmp_path}/bin"}
    (problem,) = outcome(
        tmp_path, "launch:\n- executable: {cmd: mapviewr x}\n", environment=environment
    ).problems
    assert (problem.severity, problem.suggestion) == (Severity.WARNING, "mapviewer")
    for fine in ("gazebo", "mapviewer", "mp"):
        text = f"launch:\n- executable: {{cmd: {fine} x}}\n"
        assert list(outcome(tmp_path, text, environment=environment).problems) == []


def test_a_working_directory_that_is_not_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "maps").mkdir()
    assert told(tmp_path, "- executable: {cmd: sleep 1, cwd: map}\n") == [(Code.MISSING_FILE, "map", "maps")]
    assert told(tmp_path, "- executable: {cmd: sleep 1, cwd: maps}\n") == []
    assert told(tmp_path, "- executable: {cmd: sleep 1, cwd: /srv/robot/no/such}\n") == []


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        ("talkre", "talker"),
        ("listner", "listener"),
        ("mapserver", "map_server"),
        ("Talker", "talker"),
        ("controler_server", "controller_server"),
    ],
)
def test_a_slip_is_told_from(word: str, meant: str) -> None:
    assert is_typo(word, meant)


@pytest.mark.parametrize(
    ("word", "other"),
    [
        ("talker", "talker"),
        ("front_lidar", "rear_lidar"),
        ("left_wheel", "right_wheel"),
        ("camera1", "camera2"),
        ("camera_l", "camera_r"),
        ("amcl", "slam"),
        ("map_server", "map_saver"),
        ("planner_server", "planner"),
    ],
)
def test_names_that_are_two(word: str, other: str) -> None:
    assert not is_typo(word, other)


def test_the_distance_of_words_counts_swaps_as_one() -> None:
    cases = [
        ("abc", "acb", 1),
        ("abc", "abc", 0),
        ("abc", "bcd", 2),
        ("abc", "xyz", 3),
        ("", "ab", 2),
        ("a", "abcdef", 4),
    ]
    assert [distance(one, other, 3) for one, other, _ in cases] == [expected for *_, expected in cases]
