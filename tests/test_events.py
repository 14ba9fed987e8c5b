"""One event is one line of JSON, which holds what the event does."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.events import Event, dumps, loads

_PLAIN = st.none() | st.text() | st.integers() | st.floats(allow_nan=False) | st.booleans()
_DATA = st.dictionaries(st.text(), _PLAIN | st.lists(_PLAIN) | st.dictionaries(st.text(), _PLAIN))


@given(_DATA)
def test_data_is_written_as_json_and_read_again(data: dict[str, Any]) -> None:
    event = Event(1.5, 0.25, "process_ended", "/a/b", 7, "Ended", data)
    line = dumps(event)
    assert "\n" not in line
    assert f'"data": {json.dumps(data, ensure_ascii=False)}}}' in line
    assert loads(line) == event


@pytest.mark.parametrize("number", [float("inf"), float("-inf"), float("nan")])
def test_numbers_that_json_does_not_have_are_written_as_the_library_does(number: float) -> None:
    assert f'"data": {json.dumps({"a": number})}}}' in dumps(Event(0.0, 0.0, "message", data={"a": number}))


def test_a_text_with_lone_surrogates_stays() -> None:
    event = Event(0.0, 0.0, "message", data={"text": "\udc80"})
    assert loads(dumps(event)) == event
