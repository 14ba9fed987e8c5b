"""Bags of real messages: what is recorded, what others read of it, and how it is played."""

from __future__ import annotations

import json
import os
import resource
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
import yaml

from orchestra.testing.domain import free_domain
from tests.killing import kill, let_nobody_hang
from tests.ros.tools.conftest import Graph

if TYPE_CHECKING:
    from collections.abc import Iterator

pytest.importorskip("mcap", reason="needs the extra `ros`")

from orchestra.ros.tools.bag.reading import Bag

_COUNTING = str(Path(__file__).parents[3] / "processes" / "counting.py")
_COUNT = 300
_SOME_CHUNKS = 2_000_000
_HALVES = 0.4  # seconds between both halves of what is published, at least


@pytest.fixture(scope="module")
def shell() -> Iterator[Graph]:
    """A domain with nobody in it."""
    pytest.importorskip("rclpy", reason="needs ROS")
    with free_domain({}) as number:
        yield Graph(
            {
                **os.environ,
                "ROS_DOMAIN_ID": str(number),
                "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
                "NO_COLOR": "1",
            }
        )


@contextmanager
def _counting(shell: Graph, *words: str) -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen(
        [sys.executable, _COUNTING, *words],
        env=shell.environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            yield process
        finally:
            kill(process)


def _line(process: subprocess.Popen[str]) -> str:
    assert process.stdout is not None
    return process.stdout.readline()


@pytest.fixture(scope="module")
def bag(shell: Graph, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All that was published while a recorder was there, which was ended by Ctrl-C."""
    folder = tmp_path_factory.mktemp("bags") / "all"
    with (
        shell.asking("bag", "record", "--all", "-o", str(folder), "--format", "json") as recorder,
        _counting(shell, "publish", str(_COUNT)) as publisher,
    ):
        assert _line(publisher) == "done\n"
        recorder.send_signal(signal.SIGINT)
        told = json.loads(_line(recorder))
        assert recorder.wait() == (1 if told["lost"] else 0)  # of /lossy, where the machine has no time
    assert told["topics"]["/fast"] == told["topics"]["/late"] == _COUNT
    assert "/_hidden" not in told["topics"]
    return folder


def test_nothing_is_lost_also_of_topics_that_come_later(bag: Path, shell: Graph) -> None:
    told = shell.ask("bag", "info", str(bag), "--format", "json").data
    topics = {topic["name"]: topic for topic in told["topics"]}
    assert {"/fast", "/late", "/latched", "/lossy"} <= set(topics)
    assert topics["/fast"]["messages"] == topics["/late"]["messages"] == _COUNT
    assert topics["/latched"]["messages"] == 1
    assert topics["/latched"]["qos"][0]["durability"] == "transient_local"
    assert topics["/lossy"]["qos"][0]["reliability"] == "best_effort"
    assert told["messages"] == sum(topic["messages"] for topic in told["topics"])
    text = shell.told("bag", "info", str(bag))
    assert f"Topic: /fast | Type: std_msgs/msg/Int32 | Count: {_COUNT} |" in text


def test_other_tools_read_it(bag: Path) -> None:
    """The reader of rosbags goes by `metadata.yaml` and takes the definitions from the file."""
    highlevel = pytest.importorskip("rosbags.highlevel")
    with highlevel.AnyReader([bag]) as reader:
        connections = {connection.topic: connection for connection in reader.connections}
        assert connections["/late"].msgtype == "std_msgs/msg/Header"
        assert "builtin_interfaces/Time stamp" in connections["/late"].msgdef.data
        assert connections["/late"].digest.startswith("RIHS01_")
        assert [profile.durability.name for profile in connections["/latched"].ext.offered_qos_profiles] == [
            "TRANSIENT_LOCAL"
        ]
        times, numbers = [], []
        for connection, time, data in reader.messages([connections["/late"]]):
            times.append(time)
            numbers.append(reader.deserialize(data, connection.msgtype).frame_id)
    assert numbers == [str(number) for number in range(_COUNT)]
    assert times == sorted(times)


def test_messages_have_the_time_at_which_they_were_published(bag: Path) -> None:
    with Bag(bag) as opened:
        times = [message.publish_time for message in opened.messages("/fast".__eq__)]
    assert times == sorted(times)
    assert (times[_COUNT // 2] - times[_COUNT // 2 - 1]) / 1e9 >= _HALVES


def test_it_is_played_in_the_recorded_order(bag: Path, shell: Graph) -> None:
    with _counting(shell, "hear", str(2 * _COUNT)) as hearer:
        assert _line(hearer) == "ready\n"
        played = shell.ask("bag", "play", str(bag), "--topics", "/fast", "/late", "--format", "json")
        heard: list[tuple[str, int, int]] = json.loads(_line(hearer))
    assert played.data["messages"] == 2 * _COUNT
    for topic in ("fast", "late"):
        times = [time for name, _, time in heard if name == topic]
        assert [number for name, number, _ in heard if name == topic] == list(range(_COUNT))
        with Bag(bag) as opened:
            recorded = [message.log_time for message in opened.messages(f"/{topic}".__eq__)]
        # Nothing is played before its time, and nothing later than is told.
        for place in (0, _COUNT // 2 - 1, _COUNT - 2):
            gap = (times[-1] - times[place] - (recorded[-1] - recorded[place])) / 1e9
            assert gap >= -played.data["late"] - 0.001


def test_it_is_played_under_another_name_with_its_clock(bag: Path, shell: Graph) -> None:
    start = shell.ask("bag", "info", str(bag), "--format", "json").data["start"]
    words = (
        "bag",
        "play",
        str(bag),
        "--loop",
        "--topics",
        "fast",
        "--remap",
        "fast:=/other",
        "--clock",
        "100",
    )
    with shell.asking(*words):
        heard = shell.ask("topic", "echo", "/other", "std_msgs/msg/Int32", "--once", "--format", "json").data
        assert 0 <= heard["data"] < _COUNT
        clock = shell.ask("topic", "echo", "/clock", "rosgraph_msgs/msg/Clock", "--once", "--format", "json")
        stamp = clock.data["clock"]
    assert stamp["sec"] * 1_000_000_000 + stamp["nanosec"] >= start


def test_a_bag_is_split_and_told_and_played_as_one(shell: Graph, tmp_path: Path) -> None:
    """By size and by time; each file is whole, and without `metadata.yaml` they are in their order too."""
    folder = tmp_path / "split"
    words = ("bag", "record", "--all", "-o", str(folder), "-b", "20000", "-d", "0.3", "--format", "json")
    with (
        shell.asking(*words) as recorder,
        _counting(shell, "publish", str(_COUNT)) as publisher,
    ):
        assert _line(publisher) == "done\n"
        recorder.send_signal(signal.SIGINT)
        told = json.loads(_line(recorder))
    about = yaml.safe_load((folder / "metadata.yaml").read_text("utf-8"))["rosbag2_bagfile_information"]
    names = [file["path"] for file in about["files"]]
    assert names == about["relative_file_paths"] == [f"split_{number}.mcap" for number in range(len(names))]
    assert len(names) > 1
    assert sum(file["message_count"] for file in about["files"]) == about["message_count"] == told["messages"]
    for file in about["files"]:
        with Bag(folder / file["path"]) as one:
            assert (one.summary().count, one.broken) == (file["message_count"], [])
    (folder / "metadata.yaml").unlink()
    with Bag(folder) as whole:
        assert [message.data[16:].split(b"\0")[0] for message in whole.messages("/late".__eq__)] == [
            str(number).encode() for number in range(_COUNT)
        ]


def test_what_was_published_before_both_had_met_is_not_lost(shell: Graph, tmp_path: Path) -> None:
    publishing = ("topic", "pub", "-r", "100", "/met", "std_msgs/msg/Empty")
    with shell.asking("bag", "record", "/met", "-o", str(tmp_path / "met")) as recorder:
        assert _line(recorder).startswith("recording")
        with shell.asking(*publishing), shell.asking(*publishing) as second:
            assert _line(recorder) == "+ /met [std_msgs/msg/Empty]\n"
            while "#150" not in _line(second):
                assert second.poll() is None
            recorder.send_signal(signal.SIGINT)
            out, told = recorder.communicate()
    assert (recorder.returncode, told) == (0, "")
    assert "messages of 1 topics" in out


def test_a_recorder_that_was_killed_leaves_what_it_has_written(shell: Graph, tmp_path: Path) -> None:
    folder = tmp_path / "killed"
    with (
        shell.asking("bag", "record", "/fast", "/late", "/lossy", "/latched", "-o", str(folder)) as recorder,
        _counting(shell, "publish", "300", "20000") as publisher,
    ):
        file = folder / "killed_0.mcap"
        while not file.exists() or file.stat().st_size < _SOME_CHUNKS:
            assert publisher.poll() is recorder.poll() is None
            time.sleep(0.01)
        # It stands meanwhile: whoever sends to a reader that died over a message may wait for ever.
        publisher.send_signal(signal.SIGSTOP)
        recorder.kill()
        recorder.wait()
        let_nobody_hang()
        publisher.send_signal(signal.SIGCONT)
    assert not (folder / "metadata.yaml").exists()
    done = shell.ask("bag", "info", str(folder), "--format", "json")
    counts = {topic["name"]: topic["messages"] for topic in done.data["topics"]}
    assert 0 < counts["/late"] <= 300
    assert "has no end" in done.errors


def _full_after(size: int) -> None:
    """Let no file grow beyond a size, as a disk that is full: writing fails then."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def test_a_disk_without_room_is_told(shell: Graph, tmp_path: Path) -> None:
    folder = tmp_path / "full"
    words = ("bag", "record", "/fast", "/late", "/lossy", "/latched", "-o", str(folder), "--format", "json")
    with (
        subprocess.Popen(
            shell.command(*words),
            env={**shell.environment, "PYTHONDONTWRITEBYTECODE": "1"},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=lambda: _full_after(1_000_000),  # noqa: PLW1509 - no thread runs in this process
        ) as recorder,
        _counting(shell, "publish", "300", "20000"),
    ):
        output, errors = recorder.communicate()
    assert (recorder.returncode, output) == (1, "")
    assert errors == f"error: File too large: {folder}/full_0.mcap\n"
    counts = shell.ask("bag", "info", str(folder), "--format", "json").data
    assert counts["messages"] > 30


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("info", "nowhere"), "error: there is no bag nowhere\n"),
        (("info", _COUNTING), f"error: {_COUNTING} is no MCAP file\n"),
        (("record", "-a", "-o", "/"), "error: / is there already\n"),
    ],
)
def test_what_cannot_be_done_is_told(shell: Graph, words: tuple[str, ...], told: str) -> None:
    done = shell.ask("bag", *words)
    assert (done.status, done.errors) == (1, told)


def test_words_that_mean_nothing_are_told(shell: Graph) -> None:
    for words, told in (
        (("record",), "say which topics"),
        (("record", "-e", "("), "'(' is no regular expression"),
    ):
        done = shell.ask("bag", *words)
        assert done.status == 2
        assert told in done.errors
