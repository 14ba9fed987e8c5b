from __future__ import annotations

import time
from datetime import UTC, datetime

import pytest

from orchestra.cli import past
from orchestra.errors import UsageError


@pytest.mark.parametrize(
    ("text", "ago"), [("10s", 10), ("5m", 300), ("2h", 7200), ("1d", 86400), ("1.5m", 90), ("7", 7)]
)
def test_so_long_ago(text: str, ago: float) -> None:
    before = time.time()
    assert before - ago <= past.since(text) <= time.time() - ago


def test_points_in_time() -> None:
    assert past.since("2026-08-21T10:30:00+00:00") == datetime(2026, 8, 21, 10, 30, tzinfo=UTC).timestamp()
    assert past.since("2026-08-21 10:30") == datetime(2026, 8, 21, 10, 30).timestamp()  # noqa: DTZ001 - as the user


@pytest.mark.parametrize("text", ["", "soon", "10 s", "-5m", "5w"])
def test_what_is_no_time(text: str) -> None:
    with pytest.raises(UsageError, match="is no time"):
        past.since(text)


def test_the_time_of_day_has_milliseconds() -> None:
    moment = datetime(2026, 8, 21, 10, 30, 5, 250_000).timestamp()  # noqa: DTZ001 - of this machine
    assert past.clock(moment) == "10:30:05.250"
