"""Every way in which a command can end has its status, its words, and nothing more."""

from __future__ import annotations

import io
import os
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, NoReturn

import pytest

from orchestra.cli.boundary import Telling, guarded
from orchestra.cli.colour import wanted
from orchestra.errors import Code, DescriptionError, Problem, RunError, Severity, UsageError
from orchestra.location import Span

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

_PROBLEM = Problem(
    Code.UNKNOWN_ARGUMENT, Severity.ERROR, "no such argument", Span("command line", 1, 6, 1, 10)
)


def _raising(error: BaseException) -> Callable[[], NoReturn]:
    def work() -> NoReturn:
        raise error

    return work


@pytest.fixture(autouse=True)
def _plain(monkeypatch: pytest.MonkeyPatch, home: Path) -> None:
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("ORCHESTRA_HOME", str(home))


@pytest.mark.parametrize(
    ("error", "status", "told"),
    [
        (UsageError("this is wrong"), 2, "error: this is wrong\nhelp: see 'orchestra plan --help'\n"),
        (RunError("it went wrong"), 1, "error: it went wrong\n"),
        (KeyboardInterrupt(), 130, ""),
        (
            DescriptionError((_PROBLEM,)),
            2,
            (
                "command line:1:6: error: no such argument [ORC024]\n"
                "    1 | a:=1 wrld:=2\n"
                "      |      ^^^^\n"
                "\n1 error\n"
            ),
        ),
    ],
)
def test_statuses(error: BaseException, status: int, told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert guarded(_raising(error), Telling("plan", command_line="a:=1 wrld:=2")) == status
    assert capsys.readouterr() == ("", told)


@contextmanager
def deaf(manner: str) -> Iterator[None]:
    """Standard error takes nothing, and what it has kept can be dropped at its end."""
    if manner == "full":
        descriptor = os.open("/dev/full", os.O_WRONLY)
    else:
        reader, descriptor = os.pipe()
        os.close(reader)
    # Within a test: pytest puts its own stream there after the fixtures.
    with os.fdopen(descriptor, "w", buffering=1) as stream, pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "stderr", stream)
        yield


@pytest.mark.parametrize("manner", ["closed", "full"])
@pytest.mark.parametrize(
    ("error", "status"),
    [(UsageError("wrong"), 2), (RunError("wrong"), 1), (DescriptionError((_PROBLEM,)), 2)],
)
def test_statuses_are_the_same_where_nothing_can_be_told(error: Exception, status: int, manner: str) -> None:
    with deaf(manner):
        assert guarded(_raising(error), Telling("plan", command_line="a:=1 wrld:=2")) == status


def test_a_working_directory_that_is_gone_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    assert guarded(lambda: len(os.getcwd()), Telling("plan")) == 1  # noqa: PTH109 - as the product looks at it
    assert capfd.readouterr().err == "error: the folder in which this was started is not there any more\n"


def test_work_that_ends_well_keeps_its_status() -> None:
    assert guarded(lambda: 7, Telling()) == 7


def test_problems_can_be_had_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert guarded(_raising(DescriptionError((_PROBLEM,))), Telling(problem_format="json")) == 2
    assert '"code": "ORC024"' in capsys.readouterr().err


@pytest.mark.parametrize("debug", [True, False])
def test_a_bug_is_written_to_a_file_that_is_named(
    home: Path, debug: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    assert guarded(_raising(ZeroDivisionError("by nought")), Telling("plan", debug=debug)) == 3
    (report,) = (home / "crash").iterdir()
    told = capsys.readouterr().err
    assert "bug in Orchestra: ZeroDivisionError: by nought" in told
    assert str(report) in told
    assert ("Traceback" in told) is debug
    text = report.read_text()
    assert "Traceback" in text
    assert "by nought" in text
    assert "python: 3" in text


def test_a_report_finds_another_place_where_the_home_is_unwritable(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ORCHESTRA_HOME", str(tmp_path / "file"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert guarded(_raising(ZeroDivisionError()), Telling()) == 3
    (report,) = tmp_path.glob("*.txt")
    assert str(report) in capsys.readouterr().err


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(
    ("terminal", "environment", "expected"),
    [
        (True, {}, True),
        (False, {}, False),
        (True, {"NO_COLOR": "1"}, False),
        (True, {"NO_COLOR": ""}, True),  # no-color.org: when present and not empty
        (False, {"FORCE_COLOR": "1"}, True),
        (False, {"FORCE_COLOR": "0"}, False),
        (False, {"FORCE_COLOR": "1", "NO_COLOR": "1"}, False),
        (True, {"TERM": "dumb"}, False),
    ],
)
def test_when_to_colour(terminal: bool, environment: dict[str, str], expected: bool) -> None:
    assert wanted(_Terminal() if terminal else io.StringIO(), environment) is expected
