import math

import pytest

from bringup.filter.frames import FrameResolver
from bringup.filter.rigid import IDENTITY
from bringup.filter.rotation import quaternion_from_rpy, rpy_from_matrix
from bringup.filter.settings import NANOSECONDS
from bringup.filter.transforms import Sample, TransformBuffer, TransformUnavailableError

SECOND = NANOSECONDS


def _sample(stamp: int, x: float, yaw: float = 0.0) -> Sample:
    return Sample(stamp, (x, 0.0, 0.0), quaternion_from_rpy(0.0, 0.0, yaw))


@pytest.fixture
def buffer() -> TransformBuffer:
    """A robot that drives from 0 to 2 m in two seconds while it turns left, with a laser half a metre ahead."""
    buffer = TransformBuffer()
    buffer.set_static("base", "laser", _sample(0, 0.5))
    buffer.set_static("base", "imu", _sample(0, 0.0, math.pi / 2))
    for stamp in (0, 1, 2):
        buffer.add("odom", "base", _sample(stamp * SECOND, float(stamp), stamp * math.pi / 4))
    return buffer


def test_a_chain_is_followed_up_and_down(buffer: TransformBuffer) -> None:
    """The laser seen by the IMU, which is turned to the left: half a metre to its right."""
    assert buffer.lookup("imu", "laser").translation == pytest.approx([0.0, -0.5, 0.0])
    assert buffer.lookup("laser", "imu").translation == pytest.approx([-0.5, 0.0, 0.0])


def test_between_samples_place_and_heading_are_interpolated(buffer: TransformBuffer) -> None:
    found = buffer.lookup("odom", "base", SECOND // 2)
    assert found.translation == pytest.approx([0.5, 0.0, 0.0])
    assert rpy_from_matrix(found.rotation)[2] == pytest.approx(math.pi / 8)


def test_without_a_stamp_the_newest_time_counts(buffer: TransformBuffer) -> None:
    assert buffer.lookup("odom", "laser").translation == pytest.approx([2.0, 0.5, 0.0])


def test_the_newest_time_is_one_that_all_frames_have(buffer: TransformBuffer) -> None:
    buffer.add("map", "odom", _sample(SECOND // 2, 10.0))
    assert buffer.lookup("map", "base").translation == pytest.approx([10.5, 0.0, 0.0])


@pytest.mark.parametrize(
    ("target", "source"), [("odom", "elsewhere"), ("elsewhere", "odom"), ("laser", "moon")]
)
def test_frames_that_are_not_connected_are_refused(buffer: TransformBuffer, target: str, source: str) -> None:
    with pytest.raises(TransformUnavailableError):
        buffer.lookup(target, source)


@pytest.mark.parametrize("stamp", [-1, 2 * SECOND + 1])
def test_nothing_is_extrapolated(buffer: TransformBuffer, stamp: int) -> None:
    with pytest.raises(TransformUnavailableError):
        buffer.lookup("odom", "base", stamp)


def test_late_samples_find_their_place(buffer: TransformBuffer) -> None:
    buffer.add("odom", "base", _sample(SECOND * 3 // 2, 5.0))
    assert buffer.lookup("odom", "base", SECOND * 3 // 2).translation == pytest.approx([5.0, 0.0, 0.0])
    assert buffer.lookup("odom", "base").translation == pytest.approx([2.0, 0.0, 0.0])


def test_ten_seconds_are_kept(buffer: TransformBuffer) -> None:
    buffer.add("odom", "base", _sample(11 * SECOND, 11.0))
    with pytest.raises(TransformUnavailableError):
        buffer.lookup("odom", "base", SECOND // 2)
    assert buffer.lookup("odom", "base", SECOND).translation == pytest.approx([1.0, 0.0, 0.0])


def test_a_circle_of_frames_is_survived() -> None:
    buffer = TransformBuffer()
    buffer.set_static("a", "b", _sample(0, 1.0))
    buffer.set_static("b", "a", _sample(0, 1.0))
    with pytest.raises(TransformUnavailableError):
        buffer.lookup("a", "c")


def test_clearing_keeps_what_is_sent_only_once(buffer: TransformBuffer) -> None:
    buffer.clear()
    assert buffer.is_static("imu", "laser")
    with pytest.raises(TransformUnavailableError):
        buffer.lookup("odom", "base")


def test_a_sensor_without_a_frame_stands_in_the_target(buffer: TransformBuffer) -> None:
    frames = FrameResolver(buffer)
    assert frames.between("base", "", 0) is IDENTITY
    assert frames.between("unheard", "unheard", 0) is IDENTITY
    assert not frames.needs_moving_transforms()


def test_outside_of_the_samples_the_newest_is_taken(buffer: TransformBuffer) -> None:
    found = FrameResolver(buffer).between("odom", "base", 5 * SECOND)
    assert found is not None
    assert found.translation == pytest.approx([2.0, 0.0, 0.0])


def test_a_mounting_that_is_sent_again_and_again_is_one_transform() -> None:
    buffer = TransformBuffer()
    for stamp in range(5):
        buffer.add("base", "imu", _sample(stamp * SECOND, 0.3, 1.0))
    frames = FrameResolver(buffer)
    found = [frames.between("base", "imu", stamp * SECOND // 3) for stamp in range(12)]
    assert len(set(map(id, found))) == 1
    buffer.add("base", "imu", _sample(5 * SECOND, 0.4, 1.0))
    moved = frames.between("base", "imu", 5 * SECOND)
    assert moved is not None
    assert moved.translation[0] == 0.4


def test_moving_transforms_are_needed_until_static_ones_do() -> None:
    frames = FrameResolver(TransformBuffer())
    assert frames.between("base", "imu", SECOND) is None
    assert frames.needs_moving_transforms()
    frames.add_static("base", "imu", _sample(0, 0.3))
    assert frames.between("base", "imu", SECOND) is frames.between("base", "imu", 2 * SECOND)
    assert not frames.needs_moving_transforms()


def test_a_static_transform_that_changes_is_looked_up_again() -> None:
    frames = FrameResolver(TransformBuffer())
    for x in (0.3, 0.4):
        frames.add_static("base", "imu", _sample(0, x))
        found = frames.between("base", "imu", SECOND)
        assert found is not None
        assert found.translation[0] == x
