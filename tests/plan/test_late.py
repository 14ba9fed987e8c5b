"""Some fields of a plan's records are worked out when somebody asks, and then they are what they always were."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import pytest

from orchestra.fields import replace
from orchestra.plan.digest import digest
from orchestra.plan.model import ParameterFile, Process, Provenance, new_file, new_process
from tests.plan.records import at, process

_WRITTEN = Provenance(name=at(3))


def _late(**makers: Any) -> Process:
    """Return a process of which some fields are made by what is given for them."""
    known = process("talker")
    return new_process(**{**{name: getattr(known, name) for name in Process.__slots__}, **makers})


def test_what_is_late_is_made_once_of_the_record_and_only_when_asked_for() -> None:
    made = []

    def make(owner: Process) -> Provenance:
        made.append(owner)
        return _WRITTEN

    late = _late(provenance=make)
    assert not made
    assert (late.provenance, late.provenance) == (_WRITTEN, _WRITTEN)
    assert made == [late]


def test_the_digest_is_that_of_the_process() -> None:
    late = _late(digest=digest, command=("sleep", "1"))
    assert late.digest == digest(late) == process("talker", "sleep", "1").digest


def test_the_content_of_a_file_is_made_for_it() -> None:
    late = new_file("${run}/params/a.yaml", lambda file: f"# {file.path}\n")  # type: ignore[arg-type]  # made of it
    assert late == ParameterFile("${run}/params/a.yaml", "# ${run}/params/a.yaml\n")


def _sent(record: Process) -> Any:
    return pickle.loads(pickle.dumps(record))  # noqa: S301 - our own


@pytest.mark.parametrize("changed", [lambda late: late, copy.copy, _sent])
def test_what_is_late_is_like_any_other(changed: Any) -> None:
    known = replace(process("talker"), provenance=_WRITTEN)
    late = changed(_late(provenance=lambda _: _WRITTEN, digest=digest))
    assert late == known
    assert repr(late) == repr(known)
    assert replace(late, namespace="/r") == replace(known, namespace="/r")
