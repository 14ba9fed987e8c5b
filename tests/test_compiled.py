"""Modules of ours that are compiled are found without the import system's search; all else is left to it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from orchestra import compiled

_TOLD = """
import json, sys
from orchestra.compiled import install
install()
import orchestra.pack.inner, orchestra.plain
told = {}
for name in ("orchestra.pack", "orchestra.pack.inner", "orchestra.plain"):
    m = sys.modules[name]
    told[name] = [type(m.__loader__).__module__, m.__file__, m.__cached__, m.__package__, getattr(m, "__path__", None),
                  m.VALUE, m.__spec__.origin, m.__loader__.get_source(name), m.value.__code__.co_filename]
print(json.dumps(told))
"""
_SOURCE = "VALUE = {}\ndef value(): return VALUE\n"
_FILES = {"pack/__init__.py": 1, "pack/inner.py": 2, "plain.py": 3}


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """A package of the same name as ours, with the finder alone."""
    for file, number in _FILES.items():
        path = tmp_path / "orchestra" / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(_SOURCE.format(number))
    (tmp_path / "orchestra/__init__.py").write_text("")
    (tmp_path / "orchestra/compiled.py").write_bytes(Path(compiled.__file__).read_bytes())
    return tmp_path


def _told(tree: Path, *options: str, writes: bool = True, **variables: str) -> dict[str, list[object]]:
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    environment |= {"PYTHONPATH": str(tree), **variables} | (
        {} if writes else {"PYTHONDONTWRITEBYTECODE": "1"}
    )
    words = [sys.executable, "-P", *options, "-c", _TOLD]
    done = subprocess.run(words, env=environment, check=True, capture_output=True, timeout=60)
    told: dict[str, list[object]] = json.loads(done.stdout)
    return told


def _loaders(told: dict[str, list[object]]) -> set[object]:
    return {values[0] for values in told.values()}


def test_what_is_compiled_is_found_as_the_import_system_would(tree: Path) -> None:
    slow = _told(tree)
    assert _loaders(slow) == {"_frozen_importlib_external"}
    quick = _told(tree)
    assert _loaders(quick) == {"orchestra.compiled"}
    assert {name: values[1:] for name, values in quick.items()} == {
        name: values[1:] for name, values in slow.items()
    }


@pytest.mark.parametrize(
    "change", [_SOURCE.format(12345), _SOURCE.format(9)], ids=["another size", "another time"]
)
def test_a_source_that_has_changed_counts(tree: Path, change: str) -> None:
    _told(tree)
    path = tree / "orchestra/plain.py"
    before = path.stat()
    path.write_text(change)
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns + (len(change) == before.st_size) * 10**9))
    told = _told(tree, writes=False)
    assert told["orchestra.plain"][0] == "_frozen_importlib_external"
    assert told["orchestra.plain"][5] == int(change.split()[2])
    assert told["orchestra.pack.inner"][0] == "orchestra.compiled"


@pytest.mark.parametrize("damage", [b"", b"\0" * 16, b"half a he"], ids=["empty", "zeros", "short"])
def test_bytecode_that_is_none_is_not_used(tree: Path, damage: bytes) -> None:
    _told(tree)
    (cached,) = (tree / "orchestra/__pycache__").glob("plain.*.pyc")
    cached.write_bytes(damage)
    assert _told(tree)["orchestra.plain"][5] == 3


def test_bytecode_from_another_folder_tells_where_its_source_is_now(tree: Path) -> None:
    _told(tree)
    moved = tree / "moved"
    moved.mkdir()
    (tree / "orchestra").rename(moved / "orchestra")
    told = _told(moved)
    assert _loaders(told) == {"orchestra.compiled"}
    assert told["orchestra.plain"][8] == str(moved / "orchestra/plain.py")


def test_an_interpreter_out_of_the_common_has_its_own_way(tree: Path) -> None:
    _told(tree)
    assert _loaders(_told(tree, "-O")) == {"_frozen_importlib_external"}
    assert _loaders(_told(tree, PYTHONPYCACHEPREFIX=str(tree / "elsewhere"))) == {
        "_frozen_importlib_external"
    }


def test_bytecode_that_was_cut_short_is_made_anew(tree: Path) -> None:
    """A full disk cuts it, and the interpreter takes it for whole."""
    _told(tree)
    (cached,) = tree.glob("orchestra/__pycache__/plain.*.pyc")
    content = cached.read_bytes()
    cached.write_bytes(content[:-7])
    assert _told(tree)["orchestra.plain"][5] == 3
    assert cached.read_bytes() == content
