"""What is written is read again, as far as a file goes."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bringup.evaluation import recording
from bringup.evaluation.errors import against_truth
from bringup.evaluation.recording import FILTERED, TRUTH, WHEELS, RecordingError, Writer, read
from bringup.evaluation.track import Track
from bringup.evaluation.tracks import tracks, write

SECOND = 10**9


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "run"


def test_tracks_come_back_as_they_were(file: Path, track: Callable[..., Track]) -> None:
    given_tracks = [track("robot1", contacts=3), track("robot2", seed=4)]
    with Writer(file) as writer:
        writer.tell({"robots": ["robot1", "robot2"], "starts": {"robot1": (1.0, -2.0, 0.5)}})
        write(writer, given_tracks)
    found = tracks(read(file))
    assert [each.robot for each in found] == ["robot1", "robot2"]
    assert (found[0].start, found[1].start) == ((1.0, -2.0, 0.5), (0.0, 0.0, 0.0))
    assert (found[0].contacts, found[1].contacts) == (3, 0)
    for one, other in zip(given_tracks, found, strict=True):
        for name in ("times", "filtered", "covariance"):
            assert np.allclose(getattr(one, name), getattr(other, name), atol=1e-9), name
        for poses, read_poses in ((one.truth, other.truth), (one.wheels, other.wheels)):
            assert np.allclose(against_truth(poses, read_poses), 0.0)
            assert np.abs(read_poses[:, 2]).max() <= np.pi
        assert np.allclose(one.nis["odom0_twist"], other.nis["odom0_twist"])


@given(cut=st.integers(0, 10**9), rows=st.integers(1, 40))
@settings(max_examples=60)
def test_a_file_that_breaks_off_anywhere_has_all_that_was_flushed_before(
    tmp_path_factory: pytest.TempPathFactory, cut: int, rows: int
) -> None:
    path = tmp_path_factory.mktemp("cut") / "run"
    ends = []
    with Writer(path) as writer:
        writer.tell({"robots": ["robot1"]})
        told = path.stat().st_size
        for stamp in range(rows):
            writer.add(TRUTH, 0, stamp, (stamp, 0.0, 0.0))
            writer.flush()
            ends.append(path.stat().st_size)
    length = cut % (ends[-1] + 1)
    path.write_bytes(path.read_bytes()[:length])
    if length < len(recording.MAGIC):
        with pytest.raises(RecordingError, match="is no recording"):
            read(path)
        return
    found = read(path)
    whole = sum(end <= length for end in ends)
    assert found.rows["stamp"].tolist() == list(range(whole))
    assert found.whole == (length in {len(recording.MAGIC), told, *ends})


def test_a_block_that_has_changed_is_not_believed(file: Path) -> None:
    with Writer(file) as writer:
        writer.tell({"robots": ["robot1"]})
        sound = file.stat().st_size
        writer.tell({"robots": ["robot2"]})
    content = bytearray(file.read_bytes())
    content[sound + recording.BLOCK.size + 3] ^= 0xFF
    file.write_bytes(content)
    found = read(file)
    assert found.facts == {"robots": ["robot1"]}
    assert not found.whole


def test_rows_before_a_new_beginning_do_not_count(file: Path) -> None:
    with Writer(file) as writer:
        writer.tell({"robots": ["robot1"]})
        writer.add(TRUTH, 0, 5, (1.0,))
        writer.flush()
        writer.add(TRUTH, 0, 6, (2.0,))
        writer.begin_afresh()
        writer.add(TRUTH, 0, 1, (3.0,))
    found = read(file)
    assert found.facts == {"robots": ["robot1"]}
    assert found.rows["stamp"].tolist() == [1]


def test_streams_with_stamps_of_their_own_are_brought_together(file: Path) -> None:
    """The truth between two of its stamps, headings over the half turn; what lies outside is left out."""
    with Writer(file) as writer:
        writer.tell({"robots": ["robot1"]})
        for stamp, x, yaw in ((0, 0.0, 3.0), (SECOND, 1.0, -3.0)):
            writer.add(TRUTH, 0, stamp, (x, 0.0, yaw))
            writer.add(WHEELS, 0, stamp, (2 * x, 0.0, yaw))
        for tenths in (-1, 5, 6, 11):
            spread = (0.1, 0.0, 0.0, 0.2, 0.0, 0.3)
            writer.add(FILTERED, 0, tenths * SECOND // 10, (0.5, 0.0, 0.0, *spread))
    (found,) = tracks(read(file))
    assert found.times.tolist() == [0.5, 0.6]
    assert found.truth[0, :2].tolist() == [0.5, 0.0]
    assert found.truth[0, 2] == pytest.approx(np.pi)
    assert found.wheels[1, 0] == pytest.approx(1.2)
    assert found.covariance[0].diagonal().tolist() == [0.1, 0.2, 0.3]


def test_a_recording_without_truth_has_nothing_to_draw(file: Path) -> None:
    with Writer(file) as writer:
        writer.tell({"robots": ["robot1"]})
        writer.add(FILTERED, 0, 1, (0.0,) * 9)
    with pytest.raises(RecordingError, match="no robot of which truth"):
        tracks(read(file))
