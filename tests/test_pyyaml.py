"""PyYAML is imported where something of it is used, and is the one that is installed whatever code brings along."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

_PLANNING = """
import io, sys
from orchestra.__main__ import _resolve
_resolve(["launch", sys.argv[1], "--no-cache"], io.BytesIO())
print("yaml" in sys.modules)
"""
_OWN = """
import os, sys
sys.path.insert(0, os.path.dirname(__file__))
import yaml
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    file = os.path.join(os.path.dirname(__file__), "params.yaml")
    return LaunchDescription([Node(executable="/bin/true", name="first", parameters=[file, {"b": yaml.safe_load("[1]")}])])
"""


def _done(folder: Path, *words: str) -> str:
    words = (sys.executable, "-P", *words)
    return subprocess.run(words, cwd=folder, check=True, capture_output=True, text=True, timeout=100).stdout


@pytest.mark.parametrize(
    ("name", "text", "wanted"),
    [
        ("one.launch.xml", '<launch><executable cmd="/bin/true"/></launch>', False),
        ("one.launch.yaml", "launch:\n  - executable: {cmd: /bin/true}\n", True),
        ("odd.launch.xml", '<launch><let name="a" value="$(yaml-value a.yaml k)"/></launch>', True),
    ],
)
def test_a_plan_imports_it_where_there_is_yaml(tmp_path: Path, name: str, text: str, wanted: bool) -> None:
    (tmp_path / name).write_text(text)
    (tmp_path / "a.yaml").write_text("k: 1\n")
    assert _done(tmp_path, "-c", _PLANNING, name) == f"{wanted}\n"


def test_code_that_has_a_module_of_that_name_gets_the_one_that_is_installed(tmp_path: Path) -> None:
    (tmp_path / "yaml.py").write_text("raise AssertionError\n")
    (tmp_path / "own.launch.py").write_text(_OWN)
    (tmp_path / "params.yaml").write_text("first: {ros__parameters: {a: 1.5}}\n")
    plan = json.loads(
        _done(tmp_path, "-m", "orchestra", "plan", "own.launch.py", "--format", "json", "--no-cache")
    )
    assert plan["processes"][0]["parameters"] == {"a": 1.5, "b": [1]}
