"""Names that are nowhere in the plan: which of them are mistakes of their own."""

from __future__ import annotations

from dataclasses import replace

import pytest

from orchestra.plan.absent import is_mistake
from orchestra.resolve.model import Resolved

_WHOLE = Resolved("a.yaml", (), (), (), (), ())
_KNOWN = ("/robot1/ekf", "/talker")


@pytest.mark.parametrize("name", ["/nobody", "/talkr", "/robot2/ekf"])
def test_where_everything_was_read_every_unknown_name_is_a_mistake(name: str) -> None:
    assert is_mistake(name, _KNOWN, _WHOLE)


@pytest.mark.parametrize(("name", "mistake"), [("/nobody", False), ("/talkr", True), ("/robot2/ekf", False)])
def test_where_a_file_is_missing_only_a_slip_is_one(name: str, mistake: bool) -> None:
    assert is_mistake(name, _KNOWN, replace(_WHOLE, incomplete=True)) is mistake


def test_the_name_of_what_was_left_out_is_none() -> None:
    assert not is_mistake("/robot1/talkr", _KNOWN, replace(_WHOLE, lost=frozenset({"talkr"})))
