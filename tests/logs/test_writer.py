from __future__ import annotations

import json
import os
import select
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.logs import forms
from orchestra.logs.rotation import ENDLESS, Form, Rotation
from orchestra.logs.writer import FEW, MOST, Writer
from tests.logs.files import Failures, writing

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


def settled(writer: Writer) -> None:
    assert writer.finish(5.0, 20.0)


def called(writer: Writer) -> bool:
    """Wait until the thread calls, and attend to it."""
    poll = select.poll()
    poll.register(writer.descriptor, select.POLLIN)
    if poll.poll(10_000):
        writer.attend()
        return True
    return False


def test_any_text_is_written_as_it_came(tmp_path: Path) -> None:
    with writing() as writer:
        file = writer.file(tmp_path / "a.log", ENDLESS, forms.OUTPUT)
        file.write("é".encode() + b"\xff\n")
        file.close()
        file.write(b"more\n")
        file.close()
        settled(writer)
        assert (tmp_path / "a.log").read_bytes() == "é".encode() + b"\xff\nmore\n"
        assert writer.lost == 0


def test_a_full_disk_is_told_and_what_is_lost_is_counted(tmp_path: Path) -> None:
    failures: Failures = []
    with writing(failures) as writer:
        path = tmp_path / "a.log"
        path.symlink_to("/dev/full")
        file = writer.file(path, ENDLESS, forms.OUTPUT)
        file.write(b"12345")
        assert called(writer)
        file.write(b"678")
        settled(writer)
        assert writer.lost == file.lost == 8
        assert (failures[0][0], failures[0][1].strerror) == (path, "No space left on device")


@pytest.mark.parametrize(("form", "begin"), [(forms.OUTPUT, "\n[orchestra] "), (forms.RECORDS, '{"time": ')])
def test_when_there_is_room_again_a_line_tells_how_much_is_missing(
    tmp_path: Path, form: Form, begin: str
) -> None:
    failures: Failures = []
    with writing(failures) as writer:
        path = tmp_path / "a.log"
        path.symlink_to("/dev/full")
        file = writer.file(path, ENDLESS, form)
        file.write(b"lost\n")
        file.close()
        settled(writer)
        path.unlink()
        file.write(b"written\n")
        file.write(b"on\n")
        settled(writer)
        text = path.read_text()
        assert text.startswith(begin)
        assert "5 bytes are missing here" in text
        assert text.endswith("\nwritten\non\n")
        assert file.lost == 5


def test_a_folder_that_is_gone_is_told(tmp_path: Path) -> None:
    failures: Failures = []
    with writing(failures) as writer:
        writer.file(tmp_path / "missing" / "a.log", ENDLESS, forms.OUTPUT).write(b"x")
        assert called(writer)
        assert [(path.name, type(error)) for path, error in failures] == [("a.log", FileNotFoundError)]


def test_what_fails_last_is_told_although_nobody_attends_any_more(tmp_path: Path) -> None:
    failures: Failures = []
    with writing(failures) as writer:
        writer.file(tmp_path / "missing" / "a.log", ENDLESS, forms.OUTPUT).write(b"x")
        settled(writer)
        assert [path.name for path, _ in failures] == ["a.log"]


def test_nothing_of_a_line_that_had_to_be_torn_stays_among_records(tmp_path: Path) -> None:
    """A limit on the size of files stands for a full disk: a write is cut short, the next one fails."""
    script = f"""
import resource, signal
from pathlib import Path
from orchestra.logs import forms
from orchestra.logs.rotation import ENDLESS
from orchestra.logs.writer import Writer
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, resource.RLIM_INFINITY))
writer = Writer(lambda *_: None)
file = writer.file(Path({str(tmp_path / "a")!r}), ENDLESS, forms.RECORDS)
for number in range(100):
    file.write(b'{{"number": %d, "x": "%s"}}' % (number, b"x" * 20) + bytes([10]))
    writer.finish(5, 20)
resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
file.write(b'{{"number": 100}}' + bytes([10]))
writer.finish(5, 20)
print(file.lost)
"""
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True, timeout=60
    )
    *lines, gap, last = (json.loads(line) for line in (tmp_path / "a").read_text().splitlines())
    assert [line["number"] for line in lines] == list(range(len(lines)))
    assert last == {"number": 100}
    missing = sum(len(json.dumps({"number": n, "x": "x" * 20})) + 1 for n in range(len(lines), 100))
    assert gap["text"].startswith(f"{missing} bytes are missing")
    assert int(done.stdout) == missing


@pytest.fixture
def hanging(tmp_path: Path) -> Path:
    """A file whose opening blocks until somebody reads it, as on a network file system that has gone."""
    path = tmp_path / "hanging.log"
    os.mkfifo(path)
    return path


def read_all(path: Path) -> Iterator[bytes]:
    descriptor = os.open(path, os.O_RDONLY)
    while data := os.read(descriptor, 1 << 16):
        yield data
    os.close(descriptor)


def test_a_disk_that_hangs_holds_up_nobody_and_bounds_what_waits(hanging: Path) -> None:
    with writing() as writer:
        file = writer.file(hanging, ENDLESS, forms.OUTPUT)
        line = b"x" * 999 + b"\n"
        resumed: list[bool] = []
        while not writer.full:
            file.write(line)
        assert MOST < writer.lost <= MOST + 1000
        writer.when_room(lambda: resumed.append(True))
        assert not resumed
        assert not writer.finish(0.05, 0.1)
        writer.give_up()
        assert resumed == [True]
        assert not writer.full
        for _ in range(5000):
            file.write(line)
        assert writer.lost >= MOST + 5000 * 1000
        with hanging.open("rb", buffering=0) as reader:
            received = 0
            while received <= MOST:  # the pipe has room for the rest
                received += len(reader.read(1 << 16))
            assert called(writer)  # before that more would be dropped
            file.write(b"back\n")
            file.close()
            settled(writer)
            assert b"5000000 bytes are missing here" in reader.read(1 << 16)
        assert file.lost == 5000 * 1000


def test_room_is_told_once_most_has_been_written(hanging: Path) -> None:
    with writing() as writer:
        file = writer.file(hanging, ENDLESS, forms.OUTPUT)
        while not writer.full:
            file.write(b"x" * 999 + b"\n")
        resumed: list[bool] = []
        writer.when_room(lambda: resumed.append(True))
        file.close()
        size = sum(map(len, read_all(hanging)))
        assert size > MOST
        assert called(writer)
        assert resumed == [True]
        assert writer.lost <= FEW


@pytest.mark.parametrize("keep", [0, 1, 3])
def test_old_pieces_go_and_what_stays_is_whole(tmp_path: Path, keep: int) -> None:
    with writing() as writer:
        file = writer.file(tmp_path / "a.log", Rotation(100, keep), forms.RECORDS)
        for number in range(100):
            file.write(b"%09d\n" % number)
        settled(writer)
        names = sorted(path.name for path in tmp_path.iterdir())
        assert names == ["a.log", *(f"a.log.{number}" for number in range(10 - keep, 10))]
        text = "".join((tmp_path / name).read_text() for name in [*names[1:], "a.log"])
        assert text == "".join(f"{number:09d}\n" for number in range(100 - 10 * (keep + 1), 100))


def test_a_line_that_is_longer_than_a_piece(tmp_path: Path) -> None:
    with writing() as writer:
        for name, form in (("whole", forms.RECORDS), ("cut", forms.OUTPUT)):
            file = writer.file(tmp_path / name, Rotation(10, 50), form)
            file.write(b"short\n" + b"x" * 25 + b"\nend\n")
        settled(writer)
        pieces = {path.name: path.read_text() for path in tmp_path.iterdir()}
        assert pieces == {
            "whole.1": "short\n",
            "whole.2": "x" * 25 + "\n",
            "whole": "end\n",
            "cut.1": "short\n",
            "cut.2": "x" * 10,
            "cut.3": "x" * 10,
            "cut": "x" * 5 + "\nend\n",
        }


def test_where_a_file_cannot_be_put_away_it_grows(tmp_path: Path) -> None:
    (tmp_path / "a.log.1").mkdir()
    (tmp_path / "a.log.1" / "occupied").touch()
    with writing() as writer:
        file = writer.file(tmp_path / "a.log", Rotation(10, 5), forms.OUTPUT)
        file._file._newest = 0
        file.write(b"123456789\n" * 3)
        settled(writer)
        assert (tmp_path / "a.log").read_text() == "123456789\n" * 3
        assert writer.lost == 0
