"""The pure parts of recording and playing."""

from __future__ import annotations

import re
from argparse import Namespace
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("rclpy", reason="needs ROS")
pytest.importorskip("mcap", reason="needs the extra `ros`")

from orchestra.errors import RunError
from orchestra.ros.tools.bag import reading, summary
from orchestra.ros.tools.bag.ahead import ahead
from orchestra.ros.tools.bag.definitions import definition
from orchestra.ros.tools.bag.offering import offer
from orchestra.ros.tools.bag.pace import Pace, with_ticks
from orchestra.ros.tools.bag.reading import Recorded
from orchestra.ros.tools.bag.selection import Selection, selection
from orchestra.ros.tools.bag.summary import Part, Summary, Topic
from orchestra.ros.tools.keyboard import keys_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

_SPANS = st.none() | st.integers(1, 10**12).map(lambda nanoseconds: nanoseconds / 1e6)
_PROFILES = st.fixed_dictionaries(
    {
        "history": st.sampled_from(["keep_last", "keep_all", "unknown"]),
        "reliability": st.sampled_from(["reliable", "best_effort"]),
        "durability": st.sampled_from(["volatile", "transient_local"]),
        "liveliness": st.sampled_from(["automatic", "manual_by_topic"]),
        "depth": st.integers(0, 1000),
        "lifespan": _SPANS,
        "deadline": _SPANS,
        "liveliness_lease_duration": _SPANS,
    }
)


@given(st.lists(_PROFILES, max_size=3).map(tuple))
def test_profiles_are_read_as_they_were_written(profiles: tuple[dict[str, Any], ...]) -> None:
    read = summary.read_profiles(summary.profiles_text(profiles))
    assert len(read) == len(profiles)
    for one, other in zip(read, profiles, strict=True):
        for name, value in other.items():
            assert one[name] == (pytest.approx(value, abs=1e-9) if isinstance(value, float) else value)


def test_profiles_with_numbers_are_those_of_older_bags() -> None:
    text = """\
- history: 1
  depth: 10
  reliability: 2
  durability: 1
  deadline: {sec: 9223372036, nsec: 854775807}
  lifespan: {sec: 0, nsec: 0}
  liveliness: 3
  liveliness_lease_duration: {sec: 1, nsec: 500000000}
  avoid_ros_namespace_conventions: false
"""
    assert summary.read_profiles(text) == (
        {
            "history": "keep_last",
            "reliability": "best_effort",
            "durability": "transient_local",
            "liveliness": "manual_by_topic",
            "depth": 10,
            "lifespan": None,
            "deadline": None,
            "liveliness_lease_duration": 1.5,
        },
    )
    assert summary.read_profiles("[") == summary.read_profiles("a") == ()


def test_the_metadata_name_the_files_without_references() -> None:
    text = summary.metadata_text(
        Summary((Part("a_0.mcap", 5, 9, 3),), (Topic("/a", "b/msg/C", "RIHS01_", (), 3),), 5, 9)
    )
    assert "&" not in text
    assert "message_count: 3" in text
    assert summary.storage_files(text) == (["a_0.mcap"], "jazzy")
    with pytest.raises(ValueError, match=r".*"):
        summary.storage_files("a: b")


@pytest.mark.parametrize(
    ("options", "taken", "left"),
    [
        ({"names": ["a"]}, {"/a"}, {"/b", "/a/c"}),
        ({"topics": ["/a", "b"]}, {"/a", "/b"}, {"/c"}),
        ({"names": ["/_a"]}, {"/_a"}, {"/_b"}),
        ({"all": True}, {"/a", "/b/c"}, {"/_a", "/b/_c"}),
        ({"all": True, "include_hidden_topics": True}, {"/_a"}, set()),
        ({"regex": "scan$"}, {"/robot1/scan"}, {"/scan/raw"}),
        ({"regex": "scan$", "names": ["/map"]}, {"/robot1/scan", "/map"}, {"/odom"}),
        ({"all": True, "exclude_regex": "image"}, {"/a"}, {"/image/raw"}),
        ({"all": True, "exclude_topics": ["a"]}, {"/b"}, {"/a"}),
        ({"all": True, "names": ["/a"]}, {"/b", "/a/_service_event"}, {"/_b"}),
        ({"all_topics": True}, {"/a"}, {"/a/_service_event"}),
        ({"all_services": True}, {"/a/_service_event"}, {"/a"}),
        ({"services": ["a"]}, {"/a/_service_event"}, {"/a", "/b/_service_event"}),
        ({"all": True, "exclude_services": ["a"]}, {"/b/_service_event"}, {"/a/_service_event"}),
        ({"regex": "^/a$"}, {"/a/_service_event", "/a"}, {"/b"}),
    ],
)
def test_topics_are_chosen(options: dict[str, Any], taken: set[str], left: set[str]) -> None:
    chosen = _chosen(options)
    assert {topic for topic in taken | left if chosen.takes(topic)} == taken


def _chosen(options: dict[str, Any]) -> Selection:
    given_options: dict[str, Any] = {
        "names": [],
        "topics": [],
        "all": False,
        "regex": None,
        "exclude_regex": None,
        "exclude_topics": [],
        "include_hidden_topics": False,
        "all_topics": False,
        "all_services": False,
        "services": [],
        "exclude_services": [],
        "topic_types": [],
        "exclude_topic_types": [],
        **options,
    }
    return selection(Namespace(**given_options))


def test_names_that_are_not_there_are_told_with_those_that_are_meant() -> None:
    chosen = _chosen({"names": ["/robot1/scn", "map", "odd"], "services": ["swich"]})
    assert chosen.missing(["/robot1/scan", "/map"], ["/switch"]) == [
        ("/odd", ""),
        ("/robot1/scn", "; did you mean /robot1/scan?"),
        ("/swich", "; did you mean /switch?"),
    ]


def test_topics_are_chosen_by_type() -> None:
    nothing: dict[str, Any] = {
        "names": [],
        "topics": [],
        "services": [],
        "regex": None,
        "exclude_regex": None,
    }
    nothing |= {"exclude_topics": [], "exclude_services": [], "include_hidden_topics": False}
    nothing |= {"all": False, "all_topics": False, "all_services": False}
    chosen = selection(Namespace(**nothing, topic_types=["a/msg/A"], exclude_topic_types=[]))
    assert [chosen.takes("/x", kind) for kind in ("a/msg/A", "a/msg/B")] == [True, False]
    rest = selection(Namespace(**nothing, topic_types=[], exclude_topic_types=["a/msg/A"]), default=True)
    assert [rest.takes("/x", kind) for kind in ("a/msg/A", "a/msg/B")] == [False, True]


def _known(texts: Mapping[str, str]) -> Callable[[str], str]:
    """Return what gives the text of a definition, or refuses what is not among these."""

    def text_of(name: str) -> str:
        if name not in texts:
            raise RunError(name)
        return texts[name]

    return text_of


def test_definitions_have_those_of_what_they_use_once_each() -> None:
    texts = {
        "a/msg/A": "B one\nB[3] two  # a comment\nstd/Time stamp\nstring name\nfloat64 NUMBER=1.0",
        "a/msg/B": "std/msg/Time stamp\n",
        "std/msg/Time": "int32 sec\n",
    }

    made = definition("a/msg/A", _known(texts))
    parts = re.split(r"\n={80}\nMSG: ", made)
    assert parts[0] == texts["a/msg/A"]
    assert [part.partition("\n")[0] for part in parts[1:]] == ["a/B", "std/Time"]
    assert definition("a/msg/Unknown", _known(texts)) == ""


def test_the_event_of_a_service_is_defined_by_what_is_asked_and_answered() -> None:
    texts = {
        "a/srv/Do": "bool data\n---\nbool success\n",
        "service_msgs/msg/ServiceEventInfo": "uint8 event_type\n",
    }

    made = definition("a/srv/Do_Event", _known(texts))
    assert "a/Do_Request[<=1] request\n" in made
    assert "MSG: a/Do_Request\nbool data\n" in made
    assert "MSG: a/Do_Response\nbool success\n" in made


def test_what_is_due_follows_rate_pauses_and_steps() -> None:
    pace = Pace(1_000_000_000, 10.0, 2.0)
    assert pace.due(3_000_000_000) == 11.0
    assert pace.at(10.5) == 2_000_000_000
    pace.pause(10.5, paused=True)
    assert pace.due(3_000_000_000) is None
    assert pace.at(99.0) == 2_000_000_000
    pace.pause(20.0, paused=False)
    assert pace.due(3_000_000_000) == 20.5
    pace.quicken(2.0, 20.0)
    assert pace.due(4_000_000_000) == 20.5
    pace.step(0, 30.0)
    assert pace.due(4_000_000_000) == 31.0


def test_the_clock_is_told_between_messages() -> None:
    messages = [(0, "a"), (25, "b"), (30, "c")]
    assert list(with_ticks(messages, 10)) == [
        (0, None),
        (0, "a"),
        (10, None),
        (20, None),
        (25, "b"),
        (30, None),
        (30, "c"),
    ]
    assert list(with_ticks(messages, None)) == messages


@given(st.lists(st.integers(0, 50), max_size=60))
def test_messages_of_a_broken_file_come_in_order(times: list[int]) -> None:
    messages = (Recorded("/a", time, time, bytes([place])) for place, time in enumerate(times))
    found = list(reading._ordered(messages))
    assert [message.log_time for message in found] == sorted(times)
    for one, other in pairwise(found):
        assert one.log_time < other.log_time or one.data < other.data


def test_reading_ahead_gives_all_and_raises_what_is_raised() -> None:
    assert list(ahead(range(1234))) == list(range(1234))

    def failing() -> Iterator[int]:
        yield 1
        raise ValueError("no more")

    with pytest.raises(ValueError, match="no more"):
        list(ahead(failing()))


def test_who_reads_ahead_ends_when_nobody_wants_more() -> None:
    read = 0

    def endless() -> Iterator[int]:
        nonlocal read
        while True:
            read += 1
            yield read

    items = ahead(endless())
    assert next(items) == 1
    items.close()
    after = read
    assert read == after


def test_topics_are_offered_as_they_were() -> None:
    none = {"lifespan": None, "deadline": None, "liveliness_lease_duration": None, "liveliness": "automatic"}
    one = {**none, "reliability": "best_effort", "durability": "volatile", "depth": 0, "deadline": 0.5}
    other = {**none, "reliability": "reliable", "durability": "transient_local", "depth": 3}
    lossy, both = offer([one]), offer([one, other])
    assert (lossy.reliability.name, lossy.durability.name) == ("BEST_EFFORT", "VOLATILE")
    assert lossy.deadline.nanoseconds == 500_000_000
    assert (both.reliability.name, both.durability.name, both.depth) == ("RELIABLE", "TRANSIENT_LOCAL", 3)
    assert both.deadline.nanoseconds != 500_000_000
    assert offer([]).reliability.name == "RELIABLE"


@pytest.mark.parametrize(
    ("text", "keys", "rest"),
    [
        ("ab", ["a", "b"], ""),
        ("\x1b[A\x1bOB", ["up", "down"], ""),
        ("x\x1b[", ["x"], "\x1b["),
        ("\x1b", [], "\x1b"),
        ("\x1b[1;5Cq", ["q"], ""),
        ("\x1b[3~\x1b[D", ["left"], ""),
        ("\x1bq", ["escape", "q"], ""),
    ],
)
def test_keys_are_told_apart(text: str, keys: list[str], rest: str) -> None:
    assert keys_of(text) == (keys, rest)
