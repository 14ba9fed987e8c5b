"""Patterns mean what git means by them."""

from __future__ import annotations

import subprocess
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from orchestra.settings.globs import covers, ignored, patterns

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.parametrize(
    ("pattern", "path", "meant"),
    [
        ("a.yaml", "a.yaml", True),
        ("a.yaml", "x/y/a.yaml", True),
        ("/a.yaml", "x/a.yaml", False),
        ("x/a.yaml", "x/a.yaml", True),
        ("x/a.yaml", "y/x/a.yaml", False),
        ("**/x/a.yaml", "y/x/a.yaml", True),
        ("*.launch.py", "x/a.launch.py", True),
        ("*.launch.py", "x/a.launch.yaml", False),
        ("x", "x/y/a.yaml", True),
        ("x/", "x/y/a.yaml", True),
        ("x/", "x", False),
        ("x/**", "x/y/a.yaml", True),
        ("x/*", "y/x/a.yaml", False),
        ("a?.yaml", "ab.yaml", True),
        ("[ab].yaml", "a.yaml", True),
        ("[!ab].yaml", "a.yaml", False),
        ("a/**/b", "a/x/y/b", True),
        ("a/**/b", "a/b", True),
    ],
)
def test_what_a_pattern_covers(pattern: str, path: str, meant: bool) -> None:
    assert covers(pattern, path) is meant


def test_a_later_pattern_takes_back_an_earlier_one() -> None:
    among = patterns("# comment\n\n*.yaml\n!keep.yaml\n")
    assert ignored("a.yaml", among, folder=False) is True
    assert ignored("keep.yaml", among, folder=False) is False
    assert ignored("a.xml", among, folder=False) is None


_NAMES = st.sampled_from(["a", "b", "ab", "a.x"])
_PATTERNS = st.lists(
    st.sampled_from(
        ["a", "/a", "a/", "*", "a*", "**/b", "a/**", "a/b", "[ab]", "?", "!a", "!b/", "*.x", "a/*/b"]
    ),
    min_size=1,
    max_size=3,
)


@settings(max_examples=15, deadline=None)
@given(lines=_PATTERNS, paths=st.lists(st.lists(_NAMES, min_size=1, max_size=3), min_size=1, max_size=8))
def test_git_says_the_same_of_names_in_the_top_folder(
    lines: list[str], paths: list[list[str]], tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder: Path = tmp_path_factory.mktemp("git")
    subprocess.run(["git", "init", "-q", str(folder)], check=True)
    (folder / ".gitignore").write_text("\n".join(lines) + "\n")
    names = sorted({"/".join(path[:1]) for path in paths})
    for name in names:
        (folder / name).write_text("")
    found = subprocess.run(
        ["git", "check-ignore", *names], cwd=folder, capture_output=True, text=True, check=False
    ).stdout.splitlines()
    among = patterns("\n".join(lines))
    assert {name for name in names if ignored(name, among, folder=False)} == set(found)
