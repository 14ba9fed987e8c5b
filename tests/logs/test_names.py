from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.logs.names import log_stems, prefixes


@pytest.mark.conforms("4.10 own_log files")
def test_logs_are_called_like_their_processes() -> None:
    assert log_stems(["/robot1/ekf", "/simulation", "robot1/tool#2", "/all", "a b"]) == {
        "/robot1/ekf": "robot1.ekf",
        "/simulation": "simulation",
        "robot1/tool#2": "robot1.tool#2",
        "/all": "all~2",
        "a b": "a_b",
    }


def test_prefixes_are_aligned_but_for_the_longest_names() -> None:
    long = "/" + "x" * 50
    assert prefixes(["/a", "/abc"]) == {"/a": "[a]   ", "/abc": "[abc] "}
    assert prefixes(["/a", long]) == {"/a": "[a]" + " " * 32, long: f"[{long[1:]}] "}


@given(st.lists(st.text(max_size=200), unique=True))
def test_no_two_processes_share_a_log_and_none_leaves_the_folder(processes: list[str]) -> None:
    stems = log_stems(processes)
    assert len(set(stems.values())) == len(processes)
    assert all("/" not in stem and stem[:1] not in ("", ".") for stem in stems.values())
    assert all(len(f"{stem}.log".encode()) < 500 for stem in stems.values())
