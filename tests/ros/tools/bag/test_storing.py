"""How bags are stored: compressed or not, in chunks or not, with which times."""

from __future__ import annotations

import re
from argparse import Namespace
from typing import TYPE_CHECKING, Any

import pytest
import yaml

pytest.importorskip("rclpy", reason="needs ROS")
pytest.importorskip("mcap", reason="needs the extra `ros`")

from orchestra.errors import RunError, UsageError
from orchestra.ros.tools.bag.overrides import overrides
from orchestra.ros.tools.bag.reading import Bag
from orchestra.ros.tools.bag.reindexing import reindex
from orchestra.ros.tools.bag.settings import PRESETS, Settings, settings
from orchestra.ros.tools.bag.simulated import SimulatedTime, time_of
from orchestra.ros.tools.bag.summary import Topic
from orchestra.ros.tools.bag.writing import BagWriter, Layout

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.ros.tools.bag.storing import Message

_TEXT = "std_msgs/msg/String"
_COUNT = 500


def _message(number: int) -> bytes:
    text = f"message {number}".encode()
    return b"\0\1\0\0" + (len(text) + 1).to_bytes(4, "little") + text + b"\0"


def _written(folder: Path, layout: Layout) -> list[bytes]:
    made = [_message(number) for number in range(_COUNT)]
    writer = BagWriter(folder, layout, "test")
    writer.declare(Topic("/a", _TEXT), "string data\n")
    writer.add([("/a", 1000 + number, 900 + number, number, data) for number, data in enumerate(made)])
    assert writer.close().count == _COUNT
    return made


@pytest.mark.parametrize("most", [0, 5000])
@pytest.mark.parametrize(
    ("layout", "mode"),
    [
        *((Layout(preset), "") for preset in PRESETS.values()),
        (Layout(mode="file", custom=(("robot", "r1"),)), "FILE"),
        (Layout(mode="message"), "MESSAGE"),
        (Layout(Settings("lz4"), mode="message"), "MESSAGE"),
    ],
)
def test_what_is_written_is_read_by_us_and_by_others(
    tmp_path: Path, layout: Layout, mode: str, most: int
) -> None:
    folder = tmp_path / "bag"
    made = _written(folder, Layout(layout.settings, most, 0, layout.mode, layout.custom))
    about = yaml.safe_load((folder / "metadata.yaml").read_text("utf-8"))["rosbag2_bagfile_information"]
    assert (about["compression_mode"], about["compression_format"]) == (mode, "zstd" if mode else "")
    assert about["custom_data"] == (dict(layout.custom) or None)
    files = sorted(path.name for path in folder.iterdir() if path.name != "metadata.yaml")
    assert sorted(about["relative_file_paths"]) == files
    assert (len(files) > 1) == bool(most)
    with Bag(folder) as bag:
        assert bag.broken == []
        assert [(one.log_time, one.data) for one in bag.messages(lambda _: True)] == [
            (1000 + number, data) for number, data in enumerate(made)
        ]
        assert [one.data for one in bag.messages(lambda _: True, 1010, 1012)] == made[10:13]
    (folder / "metadata.yaml").rename(tmp_path / "metadata.yaml")
    with Bag(folder) as bag:  # its files are found without it
        assert bag.summary().count == _COUNT
    (tmp_path / "metadata.yaml").rename(folder / "metadata.yaml")
    highlevel = pytest.importorskip("rosbags.highlevel")
    with highlevel.AnyReader([folder]) as reader:
        assert [bytes(data) for _, _, data in reader.messages()] == made


@pytest.mark.parametrize("mode", ["none", "file", "message"])
def test_metadata_are_made_anew_of_the_files(tmp_path: Path, mode: str) -> None:
    folder = tmp_path / "bag"
    _written(folder, Layout(most_bytes=5000, mode=mode))
    about = folder / "metadata.yaml"
    key = "rosbag2_bagfile_information"
    before = yaml.safe_load(about.read_text("utf-8"))[key]
    about.write_text("no metadata", "utf-8")
    assert reindex(Namespace(bag=str(folder), format="text")) == 0
    after = yaml.safe_load(about.read_text("utf-8"))[key]
    assert after == {**before, "ros_distro": "unknown"}


def test_bags_and_files_that_are_not_there_are_told(tmp_path: Path) -> None:
    _written(tmp_path / "drive", Layout())
    for path, told in (
        (tmp_path / "driv", f"there is no bag {tmp_path}/driv; did you mean {tmp_path}/drive?"),
        (tmp_path / "a" / "b", f"there is no bag {tmp_path}/a/b"),
    ):
        with pytest.raises(RunError, match=f"^{re.escape(told)}$"):
            Bag(path)
    (tmp_path / "drive" / "drive_0.mcap").rename(tmp_path / "drive" / "first.mcap")
    with pytest.raises(RunError, match=r"drive_0.mcap is not there, .*: `orchestra bag reindex"):
        Bag(tmp_path / "drive")


def test_a_file_that_is_not_what_its_name_says_is_told(tmp_path: Path) -> None:
    (tmp_path / "a_0.mcap.zstd").write_bytes(b"nothing of the kind")
    with pytest.raises(RunError, match=r"a_0\.mcap\.zstd cannot be unpacked"):
        Bag(tmp_path)


def test_settings_are_those_of_a_preset_then_of_a_file_then_of_the_command_line(tmp_path: Path) -> None:
    file = tmp_path / "mcap.yaml"
    file.write_text("{compression: Lz4, chunkSize: 1000, noMessageIndex: false, compressionLevel: Fast}")
    assert settings("zstd_small", None, None) == PRESETS["zstd_small"]
    assert settings("zstd_small", str(file), None) == Settings("lz4", 1000)
    assert settings("zstd_small", str(file), "none") == Settings("none", 1000)
    for text, told in (
        ("compresion: Zstd", "did you mean compression?"),
        ("chunkSize: big", "chunkSize cannot be 'big'"),
        ("[", "is no YAML"),
        ("a", "has no settings"),
    ):
        file.write_text(text)
        with pytest.raises(UsageError, match=told.replace("?", r"\?")):
            settings("none", str(file), None)


def test_profiles_of_topics_come_from_a_file(tmp_path: Path) -> None:
    file = tmp_path / "qos.yaml"
    file.write_text(
        "/scan: {reliability: best_effort, depth: 5, deadline: {sec: 1, nsec: 500000000}}\nmap: {durability: transient_local}\n"
    )
    made = overrides(str(file))
    assert (made["/scan"].reliability.name, made["/scan"].depth) == ("BEST_EFFORT", 5)
    assert made["/scan"].deadline.nanoseconds == 1_500_000_000
    assert (made["/map"].durability.name, made["/map"].reliability.name) == ("TRANSIENT_LOCAL", "RELIABLE")
    assert overrides(None) == {}
    for text, told in (
        ("/a: {reliability: good}", "reliability cannot be 'good'"),
        ("/a: {relability: reliable}", "did you mean reliability"),
        ("/a: {deadline: 3}", "/a: "),
        ("a", "is no mapping"),
    ):
        file.write_text(text)
        with pytest.raises(UsageError, match=told):
            overrides(str(file))


class _Tap:
    """What has come on /clock, once."""

    def __init__(self, *ticks: tuple[int, int]) -> None:
        self.ticks = ticks

    def take(self) -> list[Message]:
        taken, self.ticks = self.ticks, ()
        return [("/clock", received, 0, 0, _clock(told)) for received, told in taken]


def _clock(nanoseconds: int) -> bytes:
    seconds, rest = divmod(nanoseconds, 1_000_000_000)
    return b"\0\1\0\0" + seconds.to_bytes(4, "little") + rest.to_bytes(4, "little")


def test_messages_have_the_time_that_the_clock_had_told_when_they_came() -> None:
    tap: Any = _Tap((100, 5_000_000_007), (200, 6_000_000_000))
    time = SimulatedTime(tap)
    assert not time.told
    came: list[Message] = [("/a", at, 1, 2, b"x") for at in (99, 100, 150, 200, 250)]
    stamped = time.stamped(came)
    assert [one[1] for one in stamped] == [5_000_000_007, 5_000_000_007, 6_000_000_000, 6_000_000_000]
    assert time.told
    assert [one[1] for one in time.stamped([("/a", 300, 1, 2, b"x")])] == [6_000_000_000]
    assert time_of(b"\0\0\0\0" + (1).to_bytes(4, "big") + (2).to_bytes(4, "big")) == 1_000_000_002
