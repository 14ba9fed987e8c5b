from __future__ import annotations

import pytest

from orchestra.plan.conditions import Ready
from orchestra.probes.graph import GraphProbe
from orchestra.probes.log import LogProbe
from orchestra.probes.table import probes_for


@pytest.mark.parametrize(
    ("pattern", "pieces", "ready"),
    [
        ("up", [("stdout", "up\n")], True),
        ("up", [("stderr", "is up now\n")], True),
        ("^up$", [("stdout", "not up\n")], False),
        ("^up$", [("stdout", "up\r\n")], True),
        ("up", [("stdout", "u"), ("stdout", "p")], True),
        ("up", [("stdout", "u"), ("stderr", "p")], False),
        ("up", [("stdout", "u\n"), ("stdout", "p\n")], False),
        ("up now", [("stdout", "\x1b[1mup\x1b[0m now\n")], True),
        (r"port \d+", [("stdout", "opening\nport 80\nport 81\n")], True),
    ],
)
def test_lines_of_output(pattern: str, pieces: list[tuple[str, str]], ready: bool) -> None:
    probe = LogProbe(pattern)
    answers = [probe.read(stream, text) for stream, text in pieces]
    assert any(answers) is ready


def test_an_endless_line_costs_bounded_memory() -> None:
    probe = LogProbe("never")
    for _ in range(100):
        assert not probe.read("stdout", "x" * 10_000)
    assert len(probe._unfinished["stdout"]) <= 65536


def test_a_message_is_for_the_observer_to_see() -> None:
    probe = probes_for(Ready(None, "/clock", None))["message"]
    assert isinstance(probe, GraphProbe)
    assert probe.request.order == {"do": "watch", "fact": "message", "topic": "/clock"}
    assert probe.words == "a message on /clock"


def test_readiness_without_a_condition_is_refused() -> None:
    with pytest.raises(ValueError, match="without a condition"):
        probes_for(Ready(None, None, 1.0))
