"""What comes of a resolver that hands over no plan."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING

import pytest

from orchestra.fields import replace
from orchestra.location import Location, Span
from orchestra.plan import codec
from orchestra.plan.model import Provenance
from orchestra.supervise.options import RunOptions
from orchestra.supervise.resolver import document
from tests.pressure import Deadline
from tests.supervise.plans import after, finished, launched, plan, process, wait_for

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.parametrize(
    ("word", "status", "told"),
    [
        ("exit=2", 2, ""),
        ("exit=1", 1, ""),
        ("garbage", 3, "[orchestra] this is a bug in Orchestra: the resolver handed over no plan"),
        ("exit=0", 3, "[orchestra] this is a bug in Orchestra: the resolver handed over no plan"),
        ("raise", 3, "RuntimeError: a bug of the resolver"),
        ("litter", 2, ""),
    ],
)
def test_its_status_is_that_of_the_run(tmp_path: Path, word: str, status: int, told: str) -> None:
    run = finished(tmp_path, (word,))
    assert run.popen.returncode == status
    assert told in run.stderr if told else run.stderr == ""
    assert not (tmp_path / "home").exists()


def test_ctrl_c_ends_it_at_once(tmp_path: Path) -> None:
    with launched(tmp_path, ("wait",)) as run:
        wait_for(lambda: "resolving" in run.stderr, "the resolver")
        deadline = Deadline(6.0)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert not deadline.is_over
        assert run.stderr.endswith("[orchestra] stopped by SIGINT before anything was started\n")


def test_a_bug_in_the_supervisor_ends_everything_and_leaves_a_report(tmp_path: Path) -> None:
    """A plan that no planner makes: a dependency on nothing."""
    run = finished(
        tmp_path, plan(process("b", "linger"), process("a", "linger", depends_on=after("nobody", "ready")))
    )
    assert run.popen.returncode == 3
    assert "this is a bug in Orchestra: KeyError: 'nobody'" in run.stderr
    (report,) = (tmp_path / "home" / "crash").iterdir()
    assert "Traceback" in report.read_text()


def test_a_run_directory_that_cannot_be_made_is_told(tmp_path: Path) -> None:
    (tmp_path / "home").write_text("a file, no folder")
    run = finished(tmp_path, plan(process("a", "linger")))
    assert run.popen.returncode == 1
    assert "the run directory cannot be written" in run.stderr


def test_a_document_comes_back_as_it_was() -> None:
    what, options = plan(process("a", "say=\udc80é")), RunOptions("name", fail_on_any=True, colour=False)
    assert document.loads(document.dumps(what, options)) == (
        what,
        options,
        codec.dumps(what, indent=2) + "\n",
    )


def test_where_values_come_from_is_in_the_text_alone() -> None:
    place = Location(Span("a.yaml", 3, 5, 3, 9))
    known = process("a", "true", provenance=Provenance(name=place))
    for count in (1, 300):
        read = document.loads(document.dumps(plan(*[known] * count), RunOptions("name")))
        assert read.plan == plan(*[replace(known, provenance=Provenance())] * count)
        assert codec.loads(read.text) == plan(*[known] * count)
        assert read.text.endswith("\n")
        assert (read.text.count("\n") == 1) == (count > 200)


@pytest.mark.parametrize(
    "content",
    [b"", b"[]", b"{}", b'{"plan": {}}', b'{"plan": {"version": 1}}', b'{"plan": {"version": 1}, "x": 0}'],
)
def test_other_documents_are_refused(content: bytes) -> None:
    with pytest.raises(ValueError, match=r"."):
        document.loads(content)
