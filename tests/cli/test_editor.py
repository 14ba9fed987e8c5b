"""What an editor makes of the schemas: the language server behind the YAML support of most of them is asked.

It comes from npm (`npm install yaml-language-server`); the tests look for it on the PATH.
"""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.cli.language_server import LanguageServer, language_server

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = pytest.mark.long

_ROOT = Path(__file__).parents[2]
_NAME = "yaml-language-server"


@pytest.fixture(scope="module")
def server() -> Iterator[LanguageServer]:
    command = shutil.which(_NAME)
    if command is None:
        pytest.skip(f"there is no {_NAME} on the PATH (npm install {_NAME})")
    with language_server([command, "--stdio"]) as running:
        yield running


def _written(text: str, schema: str = "launch") -> str:
    return f"# {_NAME}: $schema={_ROOT / 'schemas' / schema}.schema.json\n{text}"


_LAUNCH = {
    "launch:\n  - nod: {exec: a}\n": "nod",
    "launch:\n  - node: {exec: a, nmae: b}\n": "nmae",
    "launch:\n  - group:\n      - node: {exec: a, nmae: b}\n": "nmae",
    "launch:\n  - node: {exec: a, depends_on: [{node: b, condition: redy}]}\n": "redy",
    "launch:\n  - node: {exec: a, respawn: maybe}\n": "maybe",
    "launch:\n  - node: {exec: a, restart: sometimes}\n": "sometimes",
    "launch:\n  - node: {exec: a, output: {stdout: [screen, lgo]}}\n": "lgo",
    "launch:\n  - node: {exec: a, param: {x: 1}}\n": "{x: 1}",
    "launch:\n  - node: {exec: a, if: true, unless: true}\n": "unless",
    "launch:\n  - node: {pkg: a}\n": "node",
}
_PARAMETERS = {
    "/**:\n  ros__parameters:\n    a: [1, x, 3]\n": "x",
    "/**:\n  ros__parameters:\n    a: [true, 1]\n": "1",
    "a b:\n  ros__parameters: {}\n": "a b",
}
_MARKED = [("launch", *case) for case in _LAUNCH.items()] + [
    ("params", *case) for case in _PARAMETERS.items()
]


@pytest.mark.parametrize(("schema", "text", "wrong"), _MARKED, ids=[wrong for *_, wrong in _MARKED])
def test_what_is_wrong_is_marked_itself(
    server: LanguageServer, tmp_path: Path, schema: str, text: str, wrong: str
) -> None:
    text = _written(text, schema)
    (mark,) = server.open(tmp_path / "a.yaml", text)
    begin, end = mark["range"]["start"], mark["range"]["end"]
    assert begin["line"] == end["line"]
    assert text.split("\n")[begin["line"]][begin["character"] : end["character"]] == wrong


@pytest.mark.parametrize("path", sorted(_ROOT.glob("bringup/**/*.yaml")), ids=lambda path: path.name)
def test_nothing_is_marked_in_the_bringup(server: LanguageServer, path: Path) -> None:
    """Its files name their schema themselves."""
    assert server.open(path, path.read_text("utf-8")) == []


def _proposed(server: LanguageServer, file: Path, text: str) -> dict[str, str]:
    """Return what is proposed at the end of a text, with what is said of it."""
    text = _written(text)
    server.open(file, text)
    lines = text.split("\n")
    found = server.at("completion", file, len(lines) - 1, len(lines[-1]))
    return {item["label"]: str(item.get("documentation", "")) for item in found["items"]}


def test_actions_are_proposed_and_explained(server: LanguageServer, tmp_path: Path) -> None:
    found = _proposed(server, tmp_path / "a.yaml", "launch:\n  - ")
    assert {"node", "include", "arg", "group"} <= found.keys()
    assert "ROS node" in found["node"]


def test_keys_are_proposed_and_explained(server: LanguageServer, tmp_path: Path) -> None:
    found = _proposed(server, tmp_path / "a.yaml", "launch:\n  - node:\n      pkg: a\n      exec: b\n      ")
    assert {"name", "namespace", "param", "remap", "ready", "depends_on"} <= found.keys()
    assert not {"pkg", "exec"} & found.keys()
    assert all(found.values())


@pytest.mark.parametrize(
    ("key", "word"), [("restart", "on-failure"), ("output", "screen"), ("respawn", "true")]
)
def test_words_are_proposed(server: LanguageServer, tmp_path: Path, key: str, word: str) -> None:
    found = _proposed(server, tmp_path / "a.yaml", f"launch:\n  - node:\n      exec: b\n      {key}: ")
    assert word in {label.strip('"') for label in found}


def test_a_key_is_explained_where_one_points_at_it(server: LanguageServer, tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    server.open(file, _written("launch:\n  - node:\n      exec: b\n      required: true\n"))
    found = server.at("hover", file, 4, 8)
    assert "ends the run" in found["contents"]["value"]
