"""What a process is usually given is looked at no closer: what tells of other values is not even imported."""

from __future__ import annotations

from typing import Any

import pytest

from orchestra.compat import refused_upstream
from orchestra.compat.launch.actions.execute_process import ExecuteProcess


@pytest.mark.parametrize(
    ("given", "closer"),
    [
        ({}, False),
        ({"respawn": True, "respawn_delay": 1.5, "respawn_max_retries": 3}, False),
        ({"respawn_delay": 2, "emulate_tty": True, "shell": True}, False),
        ({"respawn_delay": "2"}, True),
        ({"respawn": "true"}, True),
        ({"sigterm_timeout": 5}, True),
    ],
)
def test_a_process_is_looked_at_closer(
    monkeypatch: pytest.MonkeyPatch, given: dict[str, Any], closer: bool
) -> None:
    looks: list[object] = []
    monkeypatch.setattr(refused_upstream, "tell_of_process", lambda *_: looks.append(given))
    ExecuteProcess(cmd=["true"], **given)
    assert bool(looks) is closer
