"""Ends that nobody wanted: what is kept of them, and what is not one."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.plan.conditions import Alive, Ready
from orchestra.plan.reactions import SignalAction
from orchestra.supervise.crash import kernel_log
from orchestra.supervise.crash.causes import meaning, telling_lines
from orchestra.supervise.crash.cores import Victim, told
from orchestra.supervise.crash.crashes import KEPT_FIRST, KEPT_LAST
from orchestra.supervise.crash.dossier import Difference, difference, repetition
from orchestra.supervise.limits.capacity import capacity
from orchestra.supervise.limits.cgroups import Place
from orchestra.supervise.process.ending import Ending
from orchestra.values import Limits, Restart
from tests.supervise.plans import HERE, finished, launched, plan, process, when_ended

if TYPE_CHECKING:
    from tests.supervise.plans import Launched

_PLACE = capacity(os.getppid()).cap_place
_STORM = Restart("on-failure", delay=0.01, max_delay=0.01, growth=1.0, budget=11)


def python(code: str) -> tuple[str, ...]:
    """Return the command that runs code in an interpreter that heeds its environment, as that of a node does."""
    return (sys.executable, "-S", "-c", code)


def reports(run: Launched) -> list[dict[str, Any]]:
    """Return the dossiers of a run in the order of time."""
    found = [json.loads(path.read_text("utf-8")) for path in run.directory.glob("crash/*/report.json")]
    return sorted(found, key=lambda report: float(report["ended"]))


def only_report(run: Launched) -> dict[str, Any]:
    """Return the one dossier of a run."""
    (report,) = reports(run)
    return report


# What the words are.

MEANINGS = [
    (Ending(code=1), "reports a failure"),
    (Ending(code=66), "EX_NOINPUT"),
    (Ending(code=78), "EX_CONFIG"),
    (Ending(code=126), "could not execute"),
    (Ending(code=127), "did not find"),
    (Ending(code=139), "a shell says that what it ran was ended by SIGSEGV: an access to memory"),
    (Ending(code=255), "-1"),
    (Ending(code=128 + 35), "signal 35"),
    (Ending(code=42), ""),
    (Ending(code=250), ""),
    (Ending(signal=signal.SIGSEGV), "an access to memory that is not the program's"),
    (Ending(signal=signal.SIGABRT), "an assertion"),
    (Ending(signal=signal.SIGFPE), "division"),
    (Ending(signal=40), "no handler"),
    (Ending(code=127, reason="no such file"), "the program never ran"),
]


@pytest.mark.parametrize(("ending", "words"), MEANINGS)
def test_endings_in_words(ending: Ending, words: str) -> None:
    assert words in meaning(ending)
    assert bool(words) == bool(meaning(ending))


TRACEBACK = """\
[INFO] started
Traceback (most recent call last):
  File "node.py", line 3, in <module>
    main()
    ^^^^^^
rclpy.exceptions.ParameterNotDeclaredException: radius
[ERROR] bye
"""
CHAINED = (
    TRACEBACK
    + """
During handling of the above exception, another exception occurred:

Traceback (most recent call last):
  File "node.py", line 5, in <module>
KeyError
"""
)
TELLING = [
    (TRACEBACK, ["rclpy.exceptions.ParameterNotDeclaredException: radius"]),
    (CHAINED, ["KeyError"]),
    (
        "terminate called after throwing an instance of 'std::runtime_error'\n  what():  no device\n",
        ["terminate called after throwing an instance of 'std::runtime_error'", "what():  no device"],
    ),
    (
        "Fatal Python error: Segmentation fault\n\nCurrent thread 0x1 (most recent call first):\n  File x\n",
        ["Fatal Python error: Segmentation fault"],
    ),
    (
        "drive: main.c:7: main: Assertion `speed < 3' failed.\n",
        ["drive: main.c:7: main: Assertion `speed < 3' failed."],
    ),
    (
        "drive: error while loading shared libraries: libx.so: cannot open shared object file\n",
        ["drive: error while loading shared libraries: libx.so: cannot open shared object file"],
    ),
    ("free(): invalid pointer\n", ["free(): invalid pointer"]),
    ("all is well\n", []),
    ("", []),
]


@pytest.mark.parametrize(("text", "lines"), TELLING)
def test_what_a_program_says_of_its_end(text: str, lines: list[str]) -> None:
    assert telling_lines(text.splitlines()) == lines


def victim(cwd: Path, *, dumped: bool, limit: int = -1) -> Victim:
    """Return a program that crashed."""
    return Victim(123, "/opt/drive", str(cwd), signal.SIGSEGV, limit, dumped)


def test_where_a_core_file_is_or_how_to_get_one(tmp_path: Path) -> None:
    place = tmp_path / "core.123"
    assert (
        "limits: {rlimits: {core: unlimited}}"
        in told(victim(tmp_path, dumped=False, limit=0), "core", with_pid=True).advice
    )
    assert told(victim(tmp_path, dumped=True), "core", with_pid=True).path is None
    place.write_bytes(b"")
    assert told(victim(tmp_path, dumped=True), "core", with_pid=True).path == str(place)
    assert told(victim(tmp_path, dumped=True), f"{tmp_path}/%e.%%.%p", with_pid=False).path is None
    (tmp_path / "some.%.123").write_bytes(b"")
    found = told(victim(Path("/"), dumped=True), f"{tmp_path}/%e.%%.%p", with_pid=False)
    assert found.path == str(tmp_path / "some.%.123")
    assert found.advice == f"gdb /opt/drive {found.path}"


def test_who_has_the_core_file_where_it_is_piped(tmp_path: Path) -> None:
    piped = victim(tmp_path, dumped=True, limit=0)
    systemd = "|/usr/lib/systemd/systemd-coredump %P %u %g %s %t %c %h"
    assert "coredumpctl debug 123" in told(piped, systemd, with_pid=False).advice
    assert "/var/crash" in told(piped, "|/usr/share/apport/apport -p%p", with_pid=False).advice
    assert "handed it to keep-core" in told(piped, "|/opt/keep-core %p", with_pid=False).advice
    assert "writes no core files" in told(piped, "", with_pid=False).advice


def test_how_an_environment_differs() -> None:
    launcher = {"HOME": "/root", "PATH": "/bin", "GONE": "1", "ORCHESTRA_RUN": "x"}
    node = {"HOME": "/root", "PATH": "/opt:/bin", "NEW": "2", "ORCHESTRA_RUN": "x", "ORCHESTRA_PROCESS": "a"}
    assert difference(launcher, node) == Difference({"NEW": "2"}, {"PATH": ("/bin", "/opt:/bin")}, ("GONE",))


def test_a_command_can_be_repeated_by_hand(tmp_path: Path) -> None:
    """Whatever is in it: a shell gives the program the very same words and variables."""
    folder = tmp_path / "it's a folder"
    folder.mkdir()
    shows = "import os, sys; print(os.getcwd(), sys.argv[1:], os.environ.get('A b'), os.environ.get('GONE'))"
    words = ["$HOME", "a 'b' \"c\"", "", "*", "line\nbreak"]
    changes = Difference({"A b": "x $y\n'z'"}, {"PATH": ("", os.environ["PATH"])}, ("GONE",))
    line = repetition([sys.executable, "-c", shows, *words], str(folder), changes)
    shell = subprocess.run(
        ["/bin/sh", "-c", line], env={**os.environ, "GONE": "1"}, capture_output=True, text=True, check=True
    )
    assert shell.stdout == f"{folder} {words} x $y\n'z' None\n"


def test_what_the_kernel_says_of_a_process_since_its_begin() -> None:
    lines = [
        kernel_log.Line(10.0, "drive[7]: segfault at 0 ip 0 sp 0 error 4 in libc.so.6"),
        kernel_log.Line(50.0, "Out of memory: Killed process 7 (drive) total-vm:1kB"),
        kernel_log.Line(51.0, "Out of memory: Killed process 77 (other) total-vm:1kB"),
    ]
    found = kernel_log.about(7, 40.0, lines)
    assert found == ["Out of memory: Killed process 7 (drive) total-vm:1kB"]
    assert kernel_log.tells_of_want_of_memory(found)
    assert not kernel_log.tells_of_want_of_memory(kernel_log.about(7, 9.0, lines[:1]))


# Runs.


def test_an_exit_code(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(process("/robot/a", "say=so be it", "exit=66")))
    report = only_report(run)
    assert (report["process"], report["start"], report["cause"]["code"]) == ("/robot/a", 1, 66)
    assert report["lines"] == ["so be it"]
    assert report["location"] == str(HERE)
    assert report["resources"]["peak_memory"] > 0
    assert Path(report["log"]).read_text() == "so be it\n"
    folder = run.directory / "crash" / "robot.a-1"
    text = (folder / "report.txt").read_text()
    assert text.startswith("/robot/a: exit code 66\n    an input file is missing")
    assert f"robot/a has a crash report: {folder} (orchestra crash robot/a)\n" in run.stderr
    assert run.of_kind("crash_recorded", "/robot/a")[0].data == {"folder": str(folder)}
    assert folder.stat().st_mode & 0o077 == 0


def test_an_uncaught_exception(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(process("a", command=python("raise ValueError('no good')"))))
    assert only_report(run)["cause"]["evidence"] == ["ValueError: no good"]


@pytest.mark.parametrize(
    ("code", "number", "said"),
    [
        ("import ctypes; ctypes.string_at(0)", "SIGSEGV", "Segmentation fault"),
        ("import os; os.abort()", "SIGABRT", "Aborted"),
    ],
)
def test_a_crash_of_an_interpreter_has_its_stack_in_the_last_lines(
    tmp_path: Path, code: str, number: str, said: str
) -> None:
    run = finished(tmp_path, plan(process("a", command=python(f"def drive():\n    {code}\ndrive()\n"))))
    report = only_report(run)
    assert report["cause"]["signal"] == number
    assert f"Fatal Python error: {said}" in report["cause"]["evidence"]
    assert any(line.endswith("in drive") for line in report["lines"])
    assert report["core_advice"]


def test_a_program_that_cannot_be_started(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(process("a", command=("/no/such/program", "x"))))
    report = only_report(run)
    assert report["cause"]["reason"] == "no such file or directory: /no/such/program"
    assert (report["pid"], report["lines"], report["uptime"]) == (None, [], 0.0)


def test_the_core_file_is_found(tmp_path: Path) -> None:
    pattern = Path("/proc/sys/kernel/core_pattern").read_text().strip()
    if pattern.startswith(("|", "/")) or not pattern:
        pytest.skip(f"core files of this machine go elsewhere: {pattern}")
    folder = tmp_path / "cwd"
    folder.mkdir()
    limits = Limits(rlimits={"core": (-1, -1)})
    run = finished(tmp_path, plan(process("a", "kill=SEGV", cwd=str(folder), limits=limits)))
    report = only_report(run)
    assert report["cause"]["core_dumped"]
    assert [report["core"]] == [str(path) for path in folder.iterdir()]


@pytest.mark.skipif(not isinstance(_PLACE, Place), reason=str(_PLACE))
def test_want_of_memory(tmp_path: Path) -> None:
    hog = python("kept = []\nwhile True: kept.append(b'x' * (1 << 20))")
    run = finished(tmp_path, plan(process("a", command=hog, limits=Limits(memory=40 << 20))))
    report = only_report(run)
    assert report["cause"]["out_of_memory"] == "the kernel ended it: its memory cap of 40 MiB was used up"
    assert report["resources"]["capped_peak"] >= 39 << 20
    assert report["limits"]["memory"] == 40 << 20


def test_a_kill_by_somebody_else(tmp_path: Path) -> None:
    with launched(tmp_path, plan(process("a", "say=up", "linger"))) as run:
        run.await_line("a", "up")
        os.kill(run.await_event("process_running", "a").pid or 0, signal.SIGKILL)
        run.wait()
        assert "somebody killed it" in only_report(run)["cause"]["meaning"]


def test_a_report_has_the_runs_before_it_and_its_own_last_lines(tmp_path: Path) -> None:
    once = process(
        "a", "say=hello", "exit=3", restart=Restart("on-failure", delay=0.01, max_delay=0.01, budget=2)
    )
    run = finished(tmp_path, plan(once))
    last = reports(run)[-1]
    assert [(before["start"], before["ending"]) for before in last["history"]] == [
        (1, "exit code 3"),
        (2, "exit code 3"),
        (3, "exit code 3"),
    ]
    assert last["lines"] == ["hello"]
    assert run.stderr.count("a has a crash report") == 1


def test_what_starts_again_at_once_does_not_wait_for_the_report_which_is_of_the_run_before(
    tmp_path: Path,
) -> None:
    own_pid = python("import os, sys; print(os.getpid()); sys.exit(3)")
    run = finished(
        tmp_path, plan(process("a", command=own_pid, restart=Restart("on-failure", delay=0.0, budget=1)))
    )
    kinds = [event.kind for event in run.events]
    assert kinds.index("crash_recorded") > [n for n, kind in enumerate(kinds) if kind == "process_running"][1]
    first, second = reports(run)
    assert [(first["start"], len(first["history"])), (second["start"], len(second["history"]))] == [
        (1, 1),
        (2, 2),
    ]
    assert first["lines"] == [str(first["pid"])]
    assert second["lines"] == [str(second["pid"])]
    assert [event.pid for event in run.of_kind("crash_recorded", "a")] == [first["pid"], second["pid"]]
    assert first["ended"] <= second["ended"]


def test_a_program_that_is_gone_when_it_shall_start_again_has_two_reports(tmp_path: Path) -> None:
    program = tmp_path / "once"
    program.write_text('#!/bin/sh\nrm "$0"\nexit 3\n')
    program.chmod(0o755)
    again = Restart("on-failure", delay=0.0, budget=1)
    run = finished(tmp_path, plan(process("a", command=(str(program),), restart=again)))
    first, second = reports(run)
    assert (first["cause"]["code"], second["cause"]["reason"]) == (3, f"no such file or directory: {program}")


def test_a_crash_loop_keeps_the_first_and_the_last(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(process("a", "exit=3", restart=_STORM)))
    first = list(range(1, KEPT_FIRST + 1))
    last = list(range(12 - KEPT_LAST + 1, 13))
    assert [report["start"] for report in reports(run)] == first + last


def test_what_an_operator_or_the_plan_ends_is_no_crash(tmp_path: Path) -> None:
    kills = when_ended("a", SignalAction(("b",), "SIGUSR1", HERE))
    processes = (process("a", "exit=0"), process("b", "say=up", "linger"), process("c", "polite=9", "linger"))
    with launched(tmp_path, plan(*processes, triggers=(kills,))) as run:
        run.await_event("process_failed", "b")
        run.send(signal.SIGTERM)
        run.wait()
        assert reports(run) == []
        assert "crash report" not in run.stderr


def test_success_is_no_crash_whatever_its_code(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(process("a", "exit=4", success_exit_codes=(0, 4))))
    assert not (run.directory / "crash").exists()


def test_a_report_that_cannot_be_written_is_told_once_and_stops_nothing(tmp_path: Path) -> None:
    code = "import sys; open(sys.argv[1], 'w').close(); sys.exit(3)"
    stubborn = process(
        "a",
        command=(sys.executable, "-S", "-E", "-c", code, "${run}/crash"),
        restart=Restart("on-failure", delay=0.01, max_delay=0.01, budget=2),
    )
    run = finished(tmp_path, plan(stubborn))
    assert run.stderr.count("a has no crash report: File exists") == 1
    assert len(run.of_kind("process_ended", "a")) == 3
    assert run.wait() == 0


def test_the_launcher_and_the_node_differ_by_what_the_report_says(tmp_path: Path) -> None:
    changed = process("a", "exit=1", environment={"MADE_UP": "1 2", "HOME": "/nowhere", "TOLD": None})
    run = finished(tmp_path, plan(changed), environment={"TOLD": "you"})
    environment = only_report(run)["environment"]
    assert environment["added"]["MADE_UP"] == "1 2"
    assert environment["changed"]["HOME"] == [os.environ["HOME"], "/nowhere"]
    assert environment["removed"] == ["TOLD"]


def test_a_hung_process_has_its_threads_in_the_report(tmp_path: Path) -> None:
    """And the stack of an interpreter, where it is aborted."""
    code = "import os, time\nos.write(1, b'up\\n')\ndef stuck():\n    time.sleep(600)\nstuck()"
    stuck = process(
        "a", command=python(code), ready=Ready("up", None, None), alive=Alive(notify=0.2, abort=True)
    )
    run = finished(tmp_path, plan(stuck))
    report = only_report(run)
    assert report["cause"]["hang"] == "no WATCHDOG=1 for 0.2 s"
    assert any(str(report["pid"]) in line for line in report["threads"])
    assert any(line.endswith("in stuck") for line in report["lines"])
    text = (run.directory / "crash" / "a-1" / "report.txt").read_text()
    assert "where its threads were when it hung" in text
