"""Where things were written is worked out when somebody asks, and then it is what it always was."""

from __future__ import annotations

import copy
import pickle
from dataclasses import FrozenInstanceError
from typing import Any

import pytest

from orchestra.fields import replace
from orchestra.location import Location, point
from orchestra.plan.model import Provenance, late_provenance

_AT = Location(point("a.yaml", 3, 4))


def test_what_is_late_is_made_once_and_only_when_asked_for() -> None:
    made = []

    def make() -> Provenance:
        made.append(Provenance(name=_AT))
        return made[-1]

    late = late_provenance(make)
    assert not made
    assert (late.name, late.remappings, late.name) == (_AT, (), _AT)
    assert len(made) == 1


def _sent(record: Provenance) -> Any:
    return pickle.loads(pickle.dumps(record))  # noqa: S301 - our own


@pytest.mark.parametrize("changed", [lambda late: late, copy.copy, _sent])
def test_what_is_late_is_like_any_other(changed: Any) -> None:
    late = changed(late_provenance(lambda: Provenance(name=_AT)))
    assert late == Provenance(name=_AT)
    assert repr(late) == repr(Provenance(name=_AT))
    assert replace(late, namespace=_AT) == Provenance(name=_AT, namespace=_AT)


def test_what_is_late_has_no_other_fields_and_lets_none_be_changed() -> None:
    late: Any = late_provenance(Provenance)
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = late.nothing
    with pytest.raises(FrozenInstanceError):
        late.name = _AT
