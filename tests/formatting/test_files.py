"""Files on the disk: what is kept of them, and that nothing is lost."""

from __future__ import annotations

import os
import resource
import stat
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Problems
from orchestra.formatting.formatted import formatted
from orchestra.formatting.refusal import NotFormatted
from orchestra.formatting.replacing import replace

if TYPE_CHECKING:
    from pathlib import Path

_WRITTEN = "launch:\n- log: {message: grüße}\n"
_WANTED = "launch:\n  - log: {message: grüße}\n"


def _formatted(content: bytes, name: str = "a.launch.yaml") -> bytes | None:
    return formatted(content, name, lambda _text: "launch", Problems())


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_the_encoding_and_its_mark_are_kept(encoding: str) -> None:
    assert _formatted(_WRITTEN.encode(encoding)) == _WANTED.encode(encoding)


def test_the_encoding_that_xml_declares_is_kept() -> None:
    text = "<?xml version='1.0' encoding='latin-1'?>\n<launch><log message='grüße'/></launch>\n"
    content = _formatted(text.encode("latin-1"), "a.launch.xml")
    assert content is not None
    assert 'message="grüße"' in content.decode("latin-1")


def test_line_breaks_are_those_of_the_first_line() -> None:
    assert _formatted(_WRITTEN.replace("\n", "\r\n").encode()) == _WANTED.replace("\n", "\r\n").encode()
    assert _formatted(b"launch:\r\n- log: {message: a}\n") == b"launch:\r\n  - log: {message: a}\r\n"


def test_what_is_no_text_is_reported_in_its_place() -> None:
    problems = Problems()
    assert formatted(b"launch:\n  \xff\n", "a.yaml", lambda _text: "launch", problems) is None
    (problem,) = problems.errors
    assert problem.span is not None
    assert (problem.span.line, problem.span.column) == (2, 3)


def test_bytes_that_cannot_be_written_again_are_left() -> None:
    """In this encoding one sign has two codes."""
    declaration = b"<?xml version='1.0' encoding='cp932'?>\n"
    with pytest.raises(NotFormatted):
        _formatted(declaration + b"<launch><log message='\x87\x90 \x81\xe0'/></launch>\n", "a.launch.xml")


def test_permissions_and_links_are_kept(tmp_path: Path) -> None:
    file, link = tmp_path / "a.yaml", tmp_path / "link.yaml"
    file.write_text("x")
    file.chmod(0o750)
    link.symlink_to("a.yaml")
    replace(link, b"y")
    assert link.is_symlink()
    assert file.read_bytes() == b"y"
    assert stat.S_IMODE(file.stat().st_mode) == 0o750
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.yaml", "link.yaml"]


def test_a_file_that_nobody_may_write_is_not_replaced(tmp_path: Path) -> None:
    """Not even by root, who may do everything."""
    file = tmp_path / "a.yaml"
    file.write_text("x")
    file.chmod(0o444)
    with pytest.raises(PermissionError):
        replace(file, b"y")
    assert file.read_text() == "x"


def test_a_disk_without_room_loses_nothing(tmp_path: Path) -> None:
    """The limit of the size of files lets a write fail half-way, as a full disk does."""
    file = tmp_path / "a.launch.yaml"
    text = "launch:\n" + "- log: {message: a}\n" * 2000
    file.write_text(text)
    done = subprocess.run(
        [sys.executable, "-m", "orchestra", "format", str(file)],
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)),
        env={**os.environ, "NO_COLOR": "1", "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 1
    assert "error: cannot write" in done.stderr
    assert file.read_text() == text
    assert [path.name for path in tmp_path.iterdir()] == ["a.launch.yaml"]
