from __future__ import annotations

import pytest

from orchestra.control.selection import UnmatchedError, select

_PROCESSES = [
    "/simulation",
    "/robot1/ekf",
    "/robot1/controller",
    "/robot2/ekf",
    "/robot2/arm/driver",
    "bag",
    "a[1]",
]


@pytest.mark.parametrize(
    ("patterns", "meant"),
    [
        (["/robot1/ekf"], ["/robot1/ekf"]),
        (["robot1/ekf"], ["/robot1/ekf"]),
        (["bag"], ["bag"]),
        (["/bag"], ["bag"]),
        (["robot1/"], ["/robot1/ekf", "/robot1/controller"]),
        (["/robot2/"], ["/robot2/ekf", "/robot2/arm/driver"]),
        (["/robot2/*"], ["/robot2/ekf", "/robot2/arm/driver"]),
        (["*ekf"], ["/robot1/ekf", "/robot2/ekf"]),
        (["robot[12]/e??"], ["/robot1/ekf", "/robot2/ekf"]),
        (["/"], _PROCESSES),
        (["*"], _PROCESSES),
        (["a[1]"], ["a[1]"]),
        (["robot2/ekf", "bag", "/simulation", "bag"], ["/simulation", "/robot2/ekf", "bag"]),
    ],
)
def test_what_patterns_mean(patterns: list[str], meant: list[str]) -> None:
    assert select(patterns, _PROCESSES) == meant


def test_an_id_wins_over_a_name_and_a_name_over_a_pattern() -> None:
    assert select(["/a"], ["a", "/a"]) == ["/a"]
    assert select(["a"], ["a", "/a"]) == ["a"]
    assert select(["b*"], ["/b*", "/bc"]) == ["/b*"]


@pytest.mark.parametrize(
    ("pattern", "message"),
    [
        ("robot1/efk", "no process is called 'robot1/efk'; did you mean 'robot1/ekf'?"),
        ("simulatoin", "no process is called 'simulatoin'; did you mean 'simulation'?"),
        ("robot3/", "no process fits 'robot3/'; did you mean 'robot1/'?"),
        ("x*y", "no process fits 'x*y'"),
        ("zzz", "no process is called 'zzz'"),
    ],
)
def test_a_pattern_in_vain_names_what_was_meant(pattern: str, message: str) -> None:
    with pytest.raises(UnmatchedError) as caught:
        select(["bag", pattern], _PROCESSES)
    assert str(caught.value) == message
