"""Participants that are asked in the protocol of the wire: how it is written and read, and that nothing gets lost."""

from __future__ import annotations

import os
import random
import socket
import struct
import time
import tracemalloc
from argparse import Namespace
from typing import TYPE_CHECKING, Any, ClassVar

import pytest
from rcl_interfaces.srv import GetParameters

from orchestra.ros.tools.graph.asking import Deadline, ask
from orchestra.ros.tools.graph.names import nodes, services, topics
from orchestra.ros.tools.graph.seeing import looking
from orchestra.ros.tools.graph.wire.endpoints import service, service_type, type_of
from orchestra.ros.tools.graph.wire.own import PUBLICATIONS, READERS, announcement, endpoint, farewell
from orchestra.ros.tools.graph.wire.parameters import (
    END,
    ENDPOINT_GUID,
    KEY_HASH,
    TOPIC,
    TYPE,
    described,
    read_text,
)
from orchestra.ros.tools.graph.wire.received import LARGEST, Received
from orchestra.ros.tools.graph.wire.speaking import domain_on_wire
from orchestra.ros.tools.graph.wire.submessages import (
    Acknowledgement,
    Data,
    Fragment,
    Gap,
    Heartbeat,
    acknowledgement,
    data,
    heartbeat,
    message,
    read,
    sample,
    to,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.ros.tools.conftest import Graph

_PREFIX = b"\x01\x0f" + bytes(range(10))
_READER, _WRITER = READERS[PUBLICATIONS], PUBLICATIONS
_LOCAL = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


def test_what_is_written_is_read() -> None:
    number = (1 << 32) + 7
    wanted = frozenset((number, number + 31, number + 32, number + 255))
    parts = (
        data(_READER, _WRITER, number, b"\0\3\0\0text"),
        heartbeat(_READER, _WRITER, number, 1),
        acknowledgement(_READER, _WRITER, number, [*wanted, number + 256], 1),
        acknowledgement(_READER, _WRITER, 0, (), 2),
    )
    heard: list[Any] = [Data(_WRITER, number, {}, b"\0\3\0\0text", "<"), Heartbeat(_WRITER, 1, number)]
    heard += [
        Acknowledgement(_READER, _WRITER, number, wanted),
        Acknowledgement(_READER, _WRITER, 0, frozenset()),
    ]
    assert list(read(message(_PREFIX, to(bytes(12)), *parts))) == [(_PREFIX, one) for one in heard]


def test_the_bytes_of_others_may_be_in_the_other_order() -> None:
    body = struct.pack(">4s4siIiII", _READER, _WRITER, 0, 3, 0, 9, 1)
    part = struct.pack(">BBH", 7, 0, len(body)) + body
    assert list(read(message(_PREFIX, part))) == [(_PREFIX, Heartbeat(_WRITER, 3, 9))]


def test_an_endpoint_says_what_it_is() -> None:
    fields, order = described(endpoint(_PREFIX + b"\0\0\1\3", "rt/größe", "a::msg::dds_::B_", 7411))
    assert fields[ENDPOINT_GUID] == _PREFIX + b"\0\0\1\3"
    assert [read_text(fields[which], order) for which in (TOPIC, TYPE)] == ["rt/größe", "a::msg::dds_::B_"]


def test_who_leaves_says_who_it_is() -> None:
    ((_, left),) = read(farewell(_PREFIX))
    assert isinstance(left, Data)
    assert left.payload is None
    assert left.qos[KEY_HASH][:12] == _PREFIX


def _gap(start: int, end: int) -> bytes:
    body = struct.pack("<4s4siIiII", _READER, _WRITER, 0, start, 0, end, 0)
    return struct.pack("<BBH", 8, 1, len(body)) + body


def test_what_is_no_message_is_passed_over() -> None:
    chance = random.Random(9)  # noqa: S311 - the same each time
    whole = message(_PREFIX, heartbeat(_READER, _WRITER, 3, 1), data(_READER, _WRITER, 1, b"\0\3\0\0"))
    whole += announcement(_PREFIX, 7410, 3, 1)[20:] + _gap(1, 2)
    received = Received()
    for _ in range(1000):
        broken = bytearray(whole[: chance.randrange(len(whole))])
        for _ in range(chance.randrange(4)):
            if broken:
                broken[chance.randrange(len(broken))] = chance.randrange(256)
        for _, heard in read(bytes(broken)):
            if isinstance(heard, Gap):
                received.lack(heard)
            elif isinstance(heard, Heartbeat):
                received.tell(heard)
                assert len(received.missing) <= 256


def _sample(number: int) -> Data:
    return Data(_WRITER, number, {}, b"", "<")


def test_a_writer_is_known_whole_when_all_that_it_says_it_has_has_come() -> None:
    received = Received()
    received.take(_sample(2))
    assert not received.whole
    received.tell(Heartbeat(_WRITER, 1, 5))
    assert received.missing == [1, 3, 4, 5]
    received.lack(Gap(_WRITER, 1, 2, frozenset((4,))))
    assert received.take(_sample(3))
    assert not received.take(_sample(3))
    assert received.missing == [5]
    received.tell(Heartbeat(_WRITER, 6, 5))  # it has forgotten it
    assert received.whole


def test_pieces_make_a_sample_in_any_order() -> None:
    received, text = Received(), bytes(range(250))
    pieces = [
        Fragment(_WRITER, 1, 1 + at // 100, 100, 250, {}, text[at : at + 100], "<") for at in (200, 0, 0)
    ]
    assert [received.piece(piece) for piece in pieces] == [None] * 3
    last = received.piece(pieces[0]._replace(first=2, content=text[100:200]))
    assert last is not None
    assert last.payload == text


def _piece(number: int, first: int, content: bytes, *, size: int = 100, whole: int = 250) -> Fragment:
    return Fragment(_WRITER, number, first, size, whole, {}, content, "<")


def test_pieces_that_fit_nowhere_are_passed_over() -> None:
    received, text = Received(), bytes(range(250))
    odd = [
        _piece(1, 0, text[:100]),  # they count from 1
        _piece(1, 4, text[:100]),
        _piece(1, 1, text[:99]),
        _piece(1, 1, text[:10], size=1, whole=LARGEST),
        _piece(1, 1, text, whole=2**32 - 1),
        _piece(1, 1, text, size=250, whole=251),
    ]
    assert [received.piece(one) for one in odd] == [None] * len(odd)
    whole = received.piece(_piece(1, 1, text + text))
    assert whole is not None
    assert whole.payload == text
    received.take(whole)
    assert received.piece(_piece(1, 1, text)) is None  # it is there already


def test_of_what_is_begun_no_more_is_kept_than_of_one_large_sample() -> None:
    received, half = Received(), LARGEST // 2
    tracemalloc.start()
    try:
        for number in range(1, 7):
            assert received.piece(_piece(number, 1, bytes(1024), size=1024, whole=half)) is None
        for number in range(7, 400):
            assert received.piece(_piece(number, 1, b"a", size=1, whole=2)) is None
        kept, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert kept < 2 * LARGEST
    last = received.piece(_piece(399, 2, b"b", size=1, whole=2))
    assert last is not None
    assert last.payload == b"ab"


def test_a_large_sample_goes_in_messages_that_udp_takes() -> None:
    received, payload = Received(), random.Random(5).randbytes(200_000)  # noqa: S311 - the same each time
    messages = [message(_PREFIX, to(bytes(12)), part) for part in sample(_READER, _WRITER, 4, payload, END)]
    assert all(len(one) < 65_507 for one in messages)
    pieces = [heard for one in messages for _, heard in read(one)]
    whole = [received.piece(piece) for piece in reversed(pieces) if isinstance(piece, Fragment)]
    assert whole[-1] == Data(_WRITER, 4, {}, payload, "<")


def test_a_time_that_is_left_out_hides_nothing() -> None:
    no_time = struct.pack("<BBH", 9, 3, 0)
    assert len(list(read(message(_PREFIX, no_time, heartbeat(_READER, _WRITER, 3, 1))))) == 1


@pytest.mark.parametrize(
    ("on_wire", "name"),
    [
        ("std_msgs::msg::dds_::String_", "std_msgs/msg/String"),
        ("a::action::dds_::Go_FeedbackMessage_", "a/action/Go_FeedbackMessage"),
        ("Square", "Square"),
    ],
)
def test_types_have_their_names_of_ros(on_wire: str, name: str) -> None:
    assert type_of(on_wire) == name


def test_services_have_their_names_of_ros() -> None:
    assert [service(topic) for topic in ("rq/a/bRequest", "rr/a/bReply", "rt/a/bReply", "rq/a/bReply")] == [
        *("/a/b", "/a/b"),
        *("", ""),
    ]
    assert service_type("a::srv::dds_::B_Request_") == service_type("a::srv::dds_::B_Response_") == "a/srv/B"
    assert service_type("a::msg::dds_::B_") == ""


@pytest.mark.parametrize(
    ("environment", "domain"),
    [
        (_LOCAL, 0),
        ({**_LOCAL, "ROS_DOMAIN_ID": "7", "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp"}, 7),
        ({**_LOCAL, "ROS_DOMAIN_ID": "seven"}, None),
        ({**_LOCAL, "ROS_DOMAIN_ID": "233"}, None),
        ({**_LOCAL, "RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"}, None),
        ({**_LOCAL, "ROS_DISCOVERY_SERVER": "127.0.0.1:11811"}, None),
        ({**_LOCAL, "FASTRTPS_DEFAULT_PROFILES_FILE": "profile.xml"}, None),
        ({**_LOCAL, "ROS_SECURITY_ENABLE": "true"}, None),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, None),
        ({"ROS_LOCALHOST_ONLY": "1"}, 0),
        ({**_LOCAL, "ROS_LOCALHOST_ONLY": "0"}, None),
        ({}, None),
    ],
)
def test_who_configures_the_middleware_is_served_by_it(
    environment: dict[str, str], domain: int | None
) -> None:
    assert domain_on_wire(environment) == domain


@pytest.fixture
def beside(graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    """Be where those nodes are."""
    for name, value in graph.environment.items():
        monkeypatch.setenv(name, value)


class _Lossy(socket.socket):
    """A socket that loses every fifth message, in and out."""

    _chance = random.Random(3)  # noqa: S311 - the same each time

    def recv(self, *arguments: Any) -> bytes:
        while True:
            heard = super().recv(*arguments)
            if self._chance.randrange(5):
                return heard

    def sendto(self, *arguments: Any) -> int:
        return super().sendto(*arguments) if self._chance.randrange(5) else 0


def _seen() -> Iterator[list[Any]]:
    for look in (nodes, topics, services):
        with looking(Namespace(spin_time=20.0)) as graph:
            yield graph.whole(lambda look=look, graph=graph: look(graph))  # type: ignore[misc]


@pytest.mark.usefixtures("beside")
def test_what_gets_lost_is_asked_for_again(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = list(_seen())
    assert whole[0] == ["/robot1/actor", "/robot1/machine"]
    monkeypatch.setattr(socket, "socket", _Lossy)
    assert list(_seen()) == whole


class _Unoffered(socket.socket):
    """A socket that hears nothing of the samples that are offered to whom it says it is first."""

    first: ClassVar[list[bytes]] = []
    lost: ClassVar[list[bytes]] = []

    def recv(self, *arguments: Any) -> bytes:
        while True:
            heard = super().recv(*arguments)
            offers = (
                isinstance(one, Heartbeat) and one.writer not in READERS and not one.writer[3] & 0xC0
                for _source, one in read(heard)
            )
            if not (self.first[0] in heard and any(offers)):
                return heard
            self.lost.append(heard)

    def sendto(self, *arguments: Any) -> int:
        self.first.append(arguments[0][8:20])
        return super().sendto(*arguments)


@pytest.mark.usefixtures("beside")
def test_who_is_offered_nothing_comes_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """A server offers what it has to a new reader only once or twice: else there would be no client for ever."""
    monkeypatch.setattr(socket, "socket", _Unoffered)
    _Unoffered.first.clear()
    _Unoffered.lost.clear()
    with looking(Namespace(spin_time=20.0)) as graph:
        answer = ask(
            graph,
            GetParameters,
            "/robot1/machine/get_parameters",
            GetParameters.Request(names=["use_sim_time"]),
            Deadline(20.0),
            repeat=False,
        )
    assert [one.type for one in answer.values] == [1]
    assert _Unoffered.lost


@pytest.mark.usefixtures("beside")
def test_a_request_and_its_response_may_be_larger_than_a_message(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(socket, "socket", _Lossy)
    request = GetParameters.Request(names=["use_sim_time"] * 6000)
    with looking(Namespace(spin_time=20.0)) as graph:
        answer = ask(
            graph, GetParameters, "/robot1/machine/get_parameters", request, Deadline(20.0), repeat=False
        )
    assert [one.type for one in answer.values] == [1] * 6000


@pytest.mark.usefixtures("beside")
def test_nothing_of_us_stays_with_those_who_were_asked(graph: Graph) -> None:
    """Each would go on sending to whom it takes for a participant."""
    os.environ["ROS_DOMAIN_ID"] = graph.environment["ROS_DOMAIN_ID"]
    with looking(Namespace(spin_time=20.0)) as asked:
        asked.whole(lambda: nodes(asked))
        ours = asked.node._names.member
        port = ours._socket.getsockname()[1]
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as heard:
        heard.bind(("127.0.0.1", port))
        heard.settimeout(0.01)
        until = time.monotonic() + 20
        silent_from = time.monotonic()
        while time.monotonic() - silent_from < 0.5:
            assert time.monotonic() < until
            try:
                heard.recv(1 << 16)
            except TimeoutError:
                continue
            silent_from = time.monotonic()
