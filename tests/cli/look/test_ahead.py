"""What another process finds out meanwhile comes as it would be found here; nothing of that process stays."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.cli.look.ahead import ahead
from orchestra.cli.look.gathered import gathered
from orchestra.cli.targets import targets
from orchestra.errors import UsageError
from orchestra.resolve.command_reaper import children
from orchestra.witness.identity import identity

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@pytest.fixture(autouse=True)
def _nothing_left() -> Iterator[None]:
    before = set(children())
    yield
    assert set(children()) <= before


def test_what_is_found_is_told() -> None:
    data = {"own": os.getpid(), "long": ["x" * 100] * 10_000, "odd": "\udcff"}
    with ahead(lambda: data) as wait:
        assert wait() == data


@pytest.mark.parametrize("error", [ValueError("wrong"), SystemExit(0), KeyboardInterrupt()])
def test_what_cannot_be_found_is_nothing(error: BaseException) -> None:
    def find() -> Any:
        raise error

    with ahead(find) as wait:
        assert wait() is None


def test_who_does_not_wait_leaves_no_process() -> None:
    reading, writing = os.pipe()

    def find() -> Any:
        os.close(writing)
        return os.read(reading, 1)

    with pytest.raises(UsageError), ahead(find):
        raise UsageError("something else is wrong")
    os.close(reading)
    os.close(writing)


def test_files_are_found_as_without_another_process(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ORCHESTRA_CACHE", str(tmp_path / "cache"))
    for name in ("a.launch.yaml", "inner/b.launch.py", "c\udcff.launch.xml"):
        path = tmp_path / "tree" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("launch: []\n")
    paths = [str(tmp_path / "tree")]
    assert gathered(paths, 2, cache=True) == (targets(paths), identity(os.environ))
    assert gathered(paths, 2, cache=False) == (targets(paths), None)
    assert gathered(paths, 1, cache=True) == (targets(paths), None)
    with pytest.raises(UsageError, match="there is no file or folder"):
        gathered([str(tmp_path / "tree"), str(tmp_path / "cache")], 2, cache=True)
    (tmp_path / "cache/check").mkdir(parents=True)
    (tmp_path / "cache/check/one.batch").touch()
    assert gathered(paths, 2, cache=True) == (targets(paths), None)
