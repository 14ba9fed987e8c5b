"""A program that is started warm finds the world, and ends, as one that is started cold."""

from __future__ import annotations

import json
import os
import shutil
import sys
from typing import TYPE_CHECKING, Any

from orchestra.values import Limits
from tests.processes.endings import WAYS
from tests.supervise.plans import PROCESSES, finished
from tests.supervise.warm.warming import both_ways, node, script, warm

if TYPE_CHECKING:
    from pathlib import Path

    from tests.supervise.plans import Launched

# Not every user may be nicer than what the tests are run with.
_NICE = max(3, os.getpriority(os.PRIO_PROCESS, 0))
WORLD, ENDINGS = str(PROCESSES / "world.py"), str(PROCESSES / "endings.py")


def test_the_world(tmp_path: Path) -> None:
    """Whatever the way of the call, with what a description may say of a process."""
    linked = tmp_path / "linked"
    linked.symlink_to(WORLD)
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    shutil.copy(WORLD, folder / "worldly.py")
    direct = script(tmp_path, "direct", (PROCESSES / "world.py").read_text(), f"#!{sys.executable}")
    searched = {"PATH": f"{tmp_path}:{os.environ['PATH']}"}
    run = finished(
        tmp_path,
        both_ways(
            node("plain", WORLD, "a", "--ros-args", "-r", "__node:=x"),
            node("linked", str(linked)),
            node("direct", direct, "word with blanks", ""),
            node("searched", "direct", environment=searched),
            node("called", sys.executable, WORLD, "b"),
            node("relative", "python3", "worldly.py", cwd=str(folder)),
            node("module", sys.executable, "-m", "worldly", "c", cwd=str(folder)),
            node("terminal", WORLD, emulate_tty=True),
            node(
                "special",
                WORLD,
                environment={"GIVEN": "ä=1\n2", "TZ": "Asia/Tokyo", "PWD": None, "ROS_DOMAIN_ID": "62"},
                cwd=str(tmp_path),
                limits=Limits(nice=_NICE, cores=(0,), rlimits={"nofile": (300, 400), "core": (0, 0)}),
            ),
        ),
    )
    worlds = {name: world for name, world in _told(run).items() if not name.endswith("_cold")}
    assert len(worlds) == 9
    for name, world in worlds.items():
        cold = _told(run)[f"{name}_cold"]
        assert {key: (value, cold[key]) for key, value in world.items() if value != cold[key]} == {}, name
    assert not run.of_kind("started_cold")
    drawn = [_line(run, name)["drawn"] for name in worlds]
    assert len(set(drawn)) == len(drawn), "each program draws numbers of its own"


def test_ends(tmp_path: Path) -> None:
    """The same status or signal, the same texts: tracebacks show nothing of the server.

    What the interpreter itself dumps where it is aborted has one line more, of the server, and lists more modules.
    """
    broken = tmp_path / "broken.py"
    shutil.copy(PROCESSES / "syntax_error.txt", broken)
    broken.chmod(0o755)
    names = {way: way.replace(" ", "_") for way in WAYS}
    modular = ("raises", "status", "interrupted", "hook")
    run = finished(
        tmp_path,
        both_ways(
            *(node(name, ENDINGS, way) for way, name in names.items()),
            *(node(f"m_{way}", sys.executable, "-m", "endings", way, cwd=str(PROCESSES)) for way in modular),
            node("broken", str(broken)),
            node("no_module", sys.executable, "-m", "no_such_module_here"),
        ),
    )
    ended = {event.process: event for event in run.of_kind("process_ended")}
    forked = [name for name in ended if name and not name.endswith("_cold")]
    assert len(forked) == len(names) + len(modular) + 2
    for name in forked:
        facts, cold = ended[name].data, ended[f"{name}_cold"].data
        assert [facts[key] for key in ("code", "signal")] == [cold[key] for key in ("code", "signal")], name
        if name == "aborts":
            more = [
                line for line in _written(run, name) if line.startswith("  File") and "/ros/warm/" not in line
            ]
            assert more == [line for line in _written(run, f"{name}_cold") if line.startswith("  File")]
        else:
            assert _written(run, name) == _written(run, f"{name}_cold"), name
    assert not run.of_kind("started_cold")


def test_the_end_of_a_program_that_has_had_threads(tmp_path: Path) -> None:
    """Of threads that a fork has left behind the C library gives back the memory with that of others."""
    program = (
        "import threading\nthreading.stack_size(8 << 20)\ngo = threading.Event()\n"
        "threads = [threading.Thread(target=go.wait) for _ in range(16)]\n"
        "[thread.start() for thread in threads]\ngo.set()\n[thread.join() for thread in threads]\n"
    )
    run = finished(tmp_path, warm(node("threads", script(tmp_path, "threads", program))))
    (ended,) = run.of_kind("process_ended")
    assert (ended.data["code"], ended.data["signal"]) == (0, None)
    assert not run.of_kind("started_cold")


def test_what_cannot_be_started_fails_as_a_cold_start_does(tmp_path: Path) -> None:
    gone, closed = script(tmp_path, "gone", "pass"), script(tmp_path, "closed", "pass")
    wanted = both_ways(
        node("gone", gone),
        node("closed", closed),
        node("no_folder", WORLD, cwd=str(tmp_path / "none")),
    )
    (tmp_path / "gone").unlink()
    (tmp_path / "closed").chmod(0o600)
    run = finished(tmp_path, wanted)
    ended = {event.process: event.data for event in run.of_kind("process_ended")}
    for name in ("gone", "closed", "no_folder"):
        assert ended[name]["reason"], name
        assert ended[name] == ended[f"{name}_cold"], name


def _told(run: Launched) -> dict[str, dict[str, Any]]:
    """Return what each process has told, without what is its own."""
    told = {}
    for event in run.of_kind("process_ended"):
        name = event.process or ""
        world = _line(run, name)["world"]
        world["environment"].pop("ORCHESTRA_PROCESS")
        world["shown"][2] = [line for line in world["shown"][2] if not line.startswith("ORCHESTRA_PROCESS=")]
        told[name] = world
    return told


def _line(run: Launched, name: str) -> dict[str, Any]:
    line: dict[str, Any] = json.loads(run.log(name).splitlines()[0])
    return line


def _written(run: Launched, name: str) -> list[str]:
    """Return the lines of a log; the order of the two streams says nothing."""
    path = run.directory / "logs" / f"{name}.log"
    return sorted(path.read_text("utf-8").splitlines()) if path.exists() else []
