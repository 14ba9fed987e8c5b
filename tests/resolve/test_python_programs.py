"""Nodes in Python without an ament package: modules and scripts that are run, and told where they are not there."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code, Severity
from orchestra.resolve.packages.modules import unrunnable
from tests.plan.checks.told import told
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a working directory with a launch file's neighbours; importing any of them fails."""
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "path"
    monkeypatch.syspath_prepend(path)
    for name in (
        "walkers/__init__",
        "walkers/talker",
        "walkers/arms/__init__",
        "walkers/arms/__main__",
        "alone",
    ):
        file = path / f"{name}.py"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("raise SystemExit('user code is imported')", "utf-8")
    (path / "spread" / "inner").mkdir(parents=True)
    (path / "spread" / "inner" / "node.py").touch()
    (tmp_path / "nodes").mkdir()
    (tmp_path / "nodes" / "listener.py").touch()
    (tmp_path / "beside.py").touch()
    return tmp_path


@pytest.mark.parametrize(
    "module", ["walkers.talker", "walkers.arms", "alone", "spread.inner.node", "beside", "json.tool"]
)
def test_a_module_that_can_be_run(module: str, folder: Path) -> None:
    assert unrunnable(module, str(folder)) is None


@pytest.mark.parametrize(
    ("module", "meant"),
    [
        ("walkers.taker", "walkers.talker"),
        ("walkesr.talker", "walkers.talker"),
        ("alnoe", "alone"),
        ("bseide", "beside"),
        ("spread.inner.ndoe", "spread.inner.node"),
        ("walkers.quite_another", None),
        ("walkers", None),
        ("spread.inner", None),
        ("alone.talker", None),
        ("a b", None),
        ("walkers..talker", None),
        ("", None),
    ],
)
def test_a_module_that_cannot(module: str, meant: str | None, folder: Path) -> None:
    fault = unrunnable(module, str(folder))
    assert fault is not None
    assert fault.meant == meant


def test_what_a_node_is_started_with(folder: Path) -> None:
    found = outcome(
        folder,
        "launch:\n"
        "- node: {module: $(var m walkers).talker, name: a, namespace: n, args: x y, ros_args: [--log-level, debug],"
        " remap: [{from: c, to: d}], param: [{name: rate, value: 5}]}\n"
        "- node: {script: $(dirname)/nodes/listener.py, name: b}\n"
        "- node: {script: nodes/listener.py}\n"
        "- lifecycle_node: {module: walkers.arms, name: l, namespace: ''}\n",
    )
    assert list(found.problems) == []
    script = str(folder / "nodes" / "listener.py")
    talker = found.process("/n/a")
    assert talker.command[:6] == (sys.executable, "-m", "walkers.talker", "x", "y", "--ros-args")
    assert (talker.kind, talker.package, talker.executable) == ("node", None, "walkers.talker")
    assert (talker.parameters, talker.remappings) == ({"rate": 5}, (("c", "d"),))
    assert found.process("/b").command[:2] == (sys.executable, script)
    assert found.process("/listener.py").name is None
    lifecycle = found.process("/l")
    assert (lifecycle.kind, lifecycle.command[:3]) == (
        "lifecycle_node",
        (sys.executable, "-m", "walkers.arms"),
    )


@pytest.mark.parametrize(
    ("node", "expected"),
    [
        ("module: walkers.taker", (Code.MISSING_EXECUTABLE, "walkers.taker", "walkers.talker")),
        ("script: nodes/listner.py", (Code.MISSING_FILE, "nodes/listner.py", "nodes/listener.py")),
        ("script: nodes", (Code.MISSING_FILE, "nodes", None)),
        ("module: alone, script: beside.py", (Code.CONFLICTING_KEYS, "script", None)),
        ("exec: sleep, module: alone", (Code.CONFLICTING_KEYS, "module", None)),
        ("pkg: demo, script: beside.py", (Code.CONFLICTING_KEYS, "script", None)),
        ("name: a", (Code.MISSING_KEY, "node", None)),
        ("modul: alone", (Code.UNKNOWN_KEY, "modul", "module")),
        ("module: alone, zzz: 1", (Code.UNKNOWN_KEY, "zzz", None)),
        ("module: alone, respawn: maybe", (Code.WRONG_TYPE, "maybe", None)),
        ("module: [a, b]", (Code.WRONG_TYPE, "[a, b]", None)),
        ("module: $(var nothing)", (Code.UNDEFINED_VARIABLE, "nothing", None)),
        ("module: walkers.taker, if: 'false'", (Code.MISSING_EXECUTABLE, "walkers.taker", "walkers.talker")),
        ("script: besde.py, unless: 'true'", (Code.MISSING_FILE, "besde.py", "beside.py")),
    ],
)
def test_one_mistake_is_told_once(node: str, expected: tuple[Code, str, str | None], folder: Path) -> None:
    assert told(folder, f"- node: {{{node}}}\n") == [expected]


def test_a_container_is_an_executable(folder: Path) -> None:
    found = told(folder, "- node_container: {module: alone, name: c, namespace: ''}\n")
    assert found == [(Code.UNKNOWN_KEY, "module", None)]


@pytest.mark.parametrize(("launching", "severity"), [(True, Severity.ERROR), (False, Severity.WARNING)])
def test_a_module_of_another_environment(launching: bool, severity: Severity, folder: Path) -> None:
    (problem,) = outcome(folder, "launch:\n- node: {module: zqxj.y}\n", launching=launching).problems
    assert (problem.code, problem.severity, problem.suggestion) == (Code.MISSING_EXECUTABLE, severity, None)


@pytest.mark.parametrize(
    "actions",
    [
        "- node: {module: nosuch.y, env: [{name: PYTHONPATH, value: /elsewhere}]}\n",
        "- set_env: {name: PYTHONPATH, value: /elsewhere}\n- node: {module: nosuch.y}\n",
        "- node: {module: listener, cwd: nodes}\n",
    ],
)
def test_where_a_node_looks_for_modules_itself(actions: str, folder: Path) -> None:
    assert list(outcome(folder, f"launch:\n{actions}").problems) == []


def test_a_module_is_not_imported(folder: Path) -> None:
    outcome(folder, "launch:\n- node: {module: walkers.arms}\n")
    assert not {name for name in sys.modules if name.partition(".")[0] == "walkers"}
    assert os.getcwd() == str(folder)  # noqa: PTH109 - as the system has it


_OF_THE_NAME = "launch: [node: {pkg: walkers, exec: driver}, log: {message: $(exec-in-pkg driver walkers)}]\n"


@pytest.mark.parametrize(
    ("beside", "code"),
    [
        ({"walkers/package.xml": "<package><name>walkers</name></package>"}, Code.MISSING_PACKAGE),
        ({}, Code.MISSING_PACKAGE),
        ({"walkers/package.xml": "<package><name>others</name></package>"}, Code.MISSING_EXECUTABLE),
        ({"walkers/__init__.py": ""}, Code.MISSING_EXECUTABLE),  # a copy of what is here
    ],
)
def test_a_module_is_not_the_package_whose_source_holds_the_launch_file(
    folder: Path, beside: dict[str, str], code: Code
) -> None:
    """A workspace may have a package `serial` where the interpreter has a module of that name."""
    files = {"walkers/launch/main.yaml": _OF_THE_NAME, **beside}
    found = outcome(folder, files, launching=False)
    assert {problem.code for problem in found.problems} == {code}


@pytest.mark.parametrize("beside", [{"resource/walkers": ""}, {}], ids=["ament_python", "ament_cmake"])
def test_a_source_that_nobody_has_built_has_no_executables_yet(folder: Path, beside: dict[str, str]) -> None:
    """A launch file may import from it, as from its own package: on a robot it is built."""
    for name, text in {"package.xml": "<package><name>walkers</name></package>", **beside}.items():
        (folder / "path" / name).parent.mkdir(exist_ok=True)
        (folder / "path" / name).write_text(text)
    found = outcome(folder, {"launch/main.yaml": _OF_THE_NAME}, launching=False)
    assert {problem.code for problem in found.problems} == {Code.MISSING_PACKAGE}
