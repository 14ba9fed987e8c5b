from __future__ import annotations

from pathlib import Path

from orchestra.logs.files import LogFile

Failures = list[tuple[Path, OSError]]


def test_any_text_is_written_as_it_came(tmp_path: Path) -> None:
    file = LogFile(tmp_path / "a.log", lambda *_: None)
    file.write("é\udcff\n")
    file.close()
    file.write("more\n")
    file.close()
    assert (tmp_path / "a.log").read_bytes() == "é".encode() + b"\xff\nmore\n"


def test_a_full_disk_is_told_once_and_what_is_lost_is_counted() -> None:
    failures: Failures = []
    file = LogFile(Path("/dev/full"), lambda path, error: failures.append((path, error)))
    file.write("12345")
    file.write("678")
    file.close()
    assert file.lost == 8
    assert [(str(path), error.strerror) for path, error in failures] == [
        ("/dev/full", "No space left on device")
    ]


def test_a_folder_that_is_gone_is_told(tmp_path: Path) -> None:
    failures: Failures = []
    file = LogFile(tmp_path / "missing" / "a.log", lambda path, error: failures.append((path, error)))
    file.write("x")
    assert len(failures) == 1
