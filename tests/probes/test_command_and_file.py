from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.probes import command, file
from orchestra.probes.command import command_probe
from orchestra.probes.file import file_probe, remote
from tests.probes.sites import place
from tests.supervise.plans import alive, wait_for

if TYPE_CHECKING:
    from pathlib import Path


def python(text: str) -> tuple[str, ...]:
    return (sys.executable, "-S", "-E", "-c", text)


def test_a_command_runs_where_and_as_its_process_does(tmp_path: Path) -> None:
    (tmp_path / "here").touch()
    with place(tmp_path, {**os.environ, "OF_THE_PROCESS": "yes"}) as here:
        probe = command_probe(("sh", "-c", "test -e here && test $OF_THE_PROCESS = yes && ! read line"), 0.02)
        here.begin(probe)
        here.holds(probe)


def test_it_is_tried_until_it_succeeds(tmp_path: Path) -> None:
    with place(tmp_path) as here:
        probe = command_probe(("test", "-e", "there"), 0.02)
        here.begin(probe)
        here.until(lambda: "(" in probe.words, "no failure")
        assert probe.words == "the command test -e there (exit code 1)"
        (tmp_path / "there").touch()
        here.holds(probe)


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (("sh", "-c", "echo out; echo 'no  database\x1b[0m' >&2; exit 3"), "exit code 3: no  database[0m"),
        (("sh", "-c", "echo only; exit 3"), "exit code 3: only"),
        (("sh", "-c", "kill -TERM $$"), "SIGTERM"),
        (("echo", "\0"), "could not be started: a word of it has a byte that is 0"),
        (
            ("there-is-no-such-program",),
            "could not be started: no such file or directory: there-is-no-such-program",
        ),
    ],
)
def test_why_it_fails_is_told(words: tuple[str, ...], fault: str) -> None:
    with place() as here:
        probe = command_probe(words, 0.02)
        here.begin(probe)
        here.until(lambda: "(" in probe.words, "no failure")
        assert probe.words.endswith(f" ({fault})")
        probe.end()


def test_one_that_takes_too_long_ends_with_all_that_it_started(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(command, "WITHIN", 1.0)
    with place(tmp_path) as here:
        probe = command_probe(("sh", "-c", "sleep 60 & echo $! > pid; sleep 60; true"), 30.0)
        here.begin(probe)
        here.until(lambda: "(" in probe.words, "no end")
        assert probe.words.endswith("(it took longer than 1 s)")
        child = int((tmp_path / "pid").read_text())
        wait_for(lambda: not alive(child), "the end of its child")
        probe.end()


def test_one_that_is_not_wanted_any_more_ends(tmp_path: Path) -> None:
    with place(tmp_path) as here:
        probe = command_probe(("sh", "-c", "trap '' TERM INT; echo $$ > pid; sleep 60; true"), 0.02)
        here.begin(probe)
        here.until(lambda: (tmp_path / "pid").exists() and (tmp_path / "pid").read_text(), "no start")
        probe.end()
        here.until(lambda: here.idle, "not reaped")
        assert not alive(int((tmp_path / "pid").read_text()))


def test_what_it_leaves_running_does_not_pile_up(tmp_path: Path) -> None:
    with place(tmp_path) as here:
        probe = command_probe(("sh", "-c", "sleep 60 & echo $! > pid"), 0.02)
        here.begin(probe)
        here.holds(probe)
        child = int((tmp_path / "pid").read_text())
        wait_for(lambda: not alive(child), "the end of what it left")


def test_one_that_writes_without_end_is_neither_blocked_nor_kept() -> None:
    with place() as here:
        probe = command_probe(python("import os\nfor _ in range(400): os.write(1, b'x' * 10000)"), 0.02)
        here.begin(probe)
        here.holds(probe)


def test_a_file_may_come_later(tmp_path: Path) -> None:
    with place(tmp_path) as here:
        probe = file_probe("deep/er", 0.02)
        here.begin(probe)
        here.until(lambda: "(" in probe.words, "no fault")
        assert probe.words == "the file deep/er (it does not exist)"
        (tmp_path / "deep").mkdir()
        (tmp_path / "deep" / "er").touch()
        here.holds(probe)


@pytest.mark.parametrize("name", [".", "", "/", "no/../."])
def test_folders_are_files_too(tmp_path: Path, name: str) -> None:
    with place(tmp_path) as here:
        probe = file_probe(name, 0.02)
        here.begin(probe)
        here.holds(probe)


def test_where_a_server_may_not_answer_a_program_asks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = str(tmp_path).replace(" ", r"\040")
    monkeypatch.setattr(file, "_mounts", lambda: f"1 0 0:1 / {folder} rw - fuse.sshfs robot: rw")
    with place(tmp_path) as here:
        probe = file_probe("it", 0.02)
        here.begin(probe)
        here.until(lambda: here.trials.alive, "nobody asks")
        here.until(lambda: "(" in probe.words, "no fault")
        assert probe.words == "the file it (exit code 1: it does not exist)"
        (tmp_path / "it").touch()
        here.holds(probe)


def test_a_working_directory_that_is_gone_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    with place() as here:
        probe = file_probe("it", 0.02)
        here.begin(probe)
        here.fails(probe, "the file it (no such file or directory)")


_MOUNTS = """\
22 1 8:1 / / rw,relatime shared:1 - ext4 /dev/sda1 rw
31 22 0:29 / /home rw - nfs4 server:/home rw
32 31 8:2 / /home/of\\040me/local rw - ext4 /dev/sdb rw
33 22 0:30 / /homes rw - tmpfs tmpfs rw
36 22 0:32 / /o\udcff\u2028ä rw - nfs4 server:/odd rw
34 22 0:31 / /fast rw - autofs systemd-1 rw
35 34 8:3 / /fast rw - xfs /dev/sdc rw
"""


@pytest.mark.parametrize(
    ("path", "wanted"),
    [
        ("/tmp/file", False),  # noqa: S108 - never touched
        ("/home/file", True),
        ("/home", True),
        ("/homes/file", False),
        ("/home/of me/local/file", False),
        ("/home/of me/file", True),
        ("/fast/file", False),
        ("/o\udcff\u2028ä/file", True),
    ],
)
def test_which_file_systems_have_a_server(path: str, wanted: bool) -> None:
    assert remote(path, _MOUNTS) is wanted


def test_this_machine_tells_its_mounts() -> None:
    assert not remote("/proc/self/stat", file._mounts())
