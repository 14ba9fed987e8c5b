"""The checks of `doctor`, each by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

pytest.importorskip("rclpy", reason="needs ROS")

from orchestra.ros.tools.doctor.checks import clock, frames, settings, time, types, unmatched
from orchestra.ros.tools.doctor.observed import Heard, Member, Observed, Tick
from orchestra.ros.tools.graph.system import End, System

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.ros.tools.doctor.observed import Finding

_PROFILE: dict[str, Any] = {
    "reliability": "reliable",
    "durability": "volatile",
    "liveliness": "automatic",
    "deadline": None,
    "liveliness_lease_duration": None,
}


def _end(topic: str, node: str, kind: str = "a/msg/A", type_hash: str = "RIHS01_1") -> End:
    return End(topic, node, kind, type_hash, f"{topic}{node}", _PROFILE)


def _system(published: Sequence[tuple[str, str]], read: Sequence[tuple[str, str]]) -> System:
    publishers, subscriptions = (tuple(_end(*one) for one in sorted(ends)) for ends in (published, read))
    nodes = sorted({end.node for end in (*publishers, *subscriptions)})
    return System(tuple(nodes), publishers, subscriptions, [])


def _messages(found: Sequence[Finding]) -> list[str]:
    return [finding.message for finding in found]


@pytest.mark.parametrize(
    ("published", "read", "told"),
    [
        # A slip in the last part of a name, told once.
        ([("/cmd_vle", "/a")], [("/cmd_vel", "/b")], [("/cmd_vel", "/cmd_vle")]),
        # It is meant though others read the right one.
        ([("/odom", "/a")], [("/odom", "/b"), ("/odm", "/c")], [("/odm", "/odom")]),
        # A slip in a namespace in which nobody else is.
        ([("/robot/scan", "/a")], [("/robt/scan", "/b")], [("/robt/scan", "/robot/scan")]),
        # A slash or an underscore too many.
        ([("/cmdvel", "/a")], [("/cmd_vel", "/b")], [("/cmd_vel", "/cmdvel")]),
        # A namespace that one side lacks.
        ([("/scan", "/a")], [("/robot1/scan", "/b")], [("/robot1/scan", "/scan")]),
        # Other robots, other sides, and what is simply not there.
        ([("/robot1/scan", "/a")], [("/robot2/scan", "/b")], []),
        ([("/left/image", "/a")], [("/right/image", "/b")], []),
        ([("/robot_a/scan", "/a"), ("/robot_b/odom", "/b")], [("/robot_b/scan", "/c")], []),
        ([("/scan", "/a")], [("/map", "/b")], []),
        ([("/scan", "/a")], [("/scan", "/b")], []),
        # Somebody without the namespace is read by somebody else already.
        ([("/scan", "/a")], [("/scan", "/c"), ("/robot1/scan", "/b")], []),
    ],
)
def test_topics_that_are_meant_for_each_other(
    published: list[tuple[str, str]], read: list[tuple[str, str]], told: list[tuple[str, str]]
) -> None:
    found = unmatched.check(Observed(_system(published, read)))
    assert [finding.about for finding in found] == told


def test_a_name_of_another_type_is_not_meant() -> None:
    seen = System(("/a", "/b"), (_end("/scan", "/a", "a/msg/B"),), (_end("/scna", "/b"),), [])
    assert not list(unmatched.check(Observed(seen)))


def test_types_with_two_definitions_are_told() -> None:
    ends = (
        _end("/a", "/one"),
        _end("/a", "/two", type_hash="RIHS01_2"),
        _end("/b", "/old", type_hash="INVALID"),
    )
    services = [("/call", ["a/srv/A", "a/srv/B"]), ("/other", ["a/srv/A"])]
    found = types.check(Observed(System((), ends, (), services)))
    assert _messages(list(found)) == [
        "the service /call has 2 types: a/srv/A, a/srv/B",
        "a/msg/A has 2 definitions: RIHS01_1 (/one); RIHS01_2 (/two)",
    ]


@pytest.mark.parametrize(
    ("sim_time", "clock_of", "told"),
    [
        ({"/a": True, "/b": True}, ["/sim"], []),
        ({"/a": False, "/b": False}, [], []),
        ({"/a": True, "/sim": False}, ["/sim"], []),
        ({"/a": True, "/b": False}, ["/sim"], ["/a has use_sim_time, /b has not"]),
        ({"/a": True}, [], ["/a has use_sim_time, and nobody publishes /clock"]),
    ],
)
def test_times_of_nodes(sim_time: dict[str, bool], clock_of: list[str], told: list[str]) -> None:
    seen = Observed(_system([("/clock", node) for node in clock_of], []), sim_time=sim_time)
    assert _messages(list(time.check(seen))) == told


def _ticks(times: Sequence[float], period: float = 0.01) -> tuple[Tick, ...]:
    return tuple(Tick(1000 + number * period, time) for number, time in enumerate(times))


@pytest.mark.parametrize(
    ("times", "told"),
    [
        ([number * 0.01 for number in range(50)], []),
        ([number * 0.3 for number in range(50)], []),  # thirty times as quick
        ([5.0] * 50, []),  # it stands
        ([*(number * 0.01 for number in range(20)), *(9 + number * 0.01 for number in range(20))], ["ahead"]),
        ([*(8 + number * 0.01 for number in range(20)), *(number * 0.01 for number in range(20))], ["back"]),
        ([], []),
    ],
)
def test_jumps_of_a_clock(times: list[float], told: list[str]) -> None:
    seen = Observed(_system([("/clock", "/sim")], []), ticks=_ticks(times))
    assert [message.split()[2] for message in _messages(list(clock.check(seen)))] == told


def test_ticks_that_were_lost_are_no_jump() -> None:
    ticks = [
        tick for number, tick in enumerate(_ticks([n * 0.01 for n in range(300)])) if not 50 < number < 250
    ]
    assert not list(clock.jumps(ticks))


def test_two_clocks_are_told_once() -> None:
    seen = Observed(_system([("/clock", "/a"), ("/clock", "/b")], []), ticks=_ticks([1.0, 50.0, 1.1, 50.1]))
    assert _messages(list(clock.check(seen))) == ["/clock has 2 publishers: /a, /b"]


def test_a_machine_whose_clock_is_set_is_told() -> None:
    found = clock.check(Observed(_system([], []), set_by=-3.0))
    assert _messages(list(found)) == ["the clock of this machine was set by -3 s in the last seconds"]


def _heard(
    parent: str, child: str, *, every: float = 0.02, late: float = 0.0, gap: float = 0.0
) -> list[Heard]:
    """Return a transform for two seconds; after the first of them nothing comes for a while."""
    sent = [1000 + number * every for number in range(int(2 / every) + 1)]
    return [
        Heard(parent, child, static=False, stamp=moment - late, sent=moment)
        for moment in sent
        if not 1001 < moment < 1001 + gap
    ]


def _fixed(parent: str, child: str) -> list[Heard]:
    return [Heard(parent, child, static=True, stamp=0.0, sent=10.0)]


@pytest.mark.parametrize(
    ("heard", "told"),
    [
        ([*_heard("odom", "base"), *_fixed("base", "laser")], []),
        (_heard("odom", "base", every=0.1), []),
        (
            _heard("odom", "base", every=0.5),
            ["the transform odom -> base is 0.25 s old: it is renewed every 0.5 s"],
        ),
        (_heard("odom", "base", late=0.3), ["the transform odom -> base is 0.31 s old: it comes 0.3 s late"]),
        (
            _heard("odom", "base", gap=0.8),
            ["the transform odom -> base was not renewed for 0.8 s, which it is every 0.02 s else"],
        ),
        ([*_fixed("a", "b"), *_fixed("c", "b")], ["the frame b has 2 parents: a, c"]),
        ([*_fixed("a", "b"), *_fixed("b", "a")], ["the frames a -> b -> a are in a circle"]),
        ([*_fixed("a", "b"), *_fixed("c", "d")], ["nothing connects the frames below a with those below c"]),
        ([*_fixed("robot1/odom", "robot1/base"), *_fixed("robot2/odom", "robot2/base")], []),
        ([*_fixed("robot1_odom", "robot1_base"), *_fixed("robot2_odom", "robot2_base")], []),
    ],
)
def test_frames(heard: list[Heard], told: list[str]) -> None:
    seen = Observed(_system([], []), transforms=tuple(heard), until=1002.0)
    assert _messages(list(frames.check(seen))) == told


def test_stamps_are_held_against_the_clock_that_they_are_of() -> None:
    ticks = tuple(Tick(1000 + number * 0.02, 5 + number * 0.02) for number in range(101))
    heard = tuple(Heard("odom", "base", static=False, stamp=one.time, sent=one.sent + 0.001) for one in ticks)
    assert not list(frames.check(Observed(_system([], []), transforms=heard, ticks=ticks, until=1002.0)))


def test_settings_that_differ_in_one_run_are_told() -> None:
    members = (
        Member("one", "/a", {"ROS_DOMAIN_ID": "0"}),
        Member("one", "/b", {}),
        Member("one", "/c", {"RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"}),
        Member("two", "/d", {"ROS_DOMAIN_ID": "5"}),
    )
    found = settings.check(Observed(_system([], []), members=members))
    assert _messages(list(found)) == [
        "in the run one, RMW_IMPLEMENTATION is rmw_fastrtps_cpp for /a, /b, rmw_cyclonedds_cpp for /c"
    ]
