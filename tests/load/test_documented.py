"""What the documentation of the launch language shows can be launched."""

from __future__ import annotations

import json
import re
from pathlib import Path

import jsonschema
import pytest
import yaml

from orchestra.description.conditions import FACTS, Alive
from orchestra.description.limits import Limits
from orchestra.description.parts import DependsOn, Restart, Stop
from orchestra.description.running import Running
from tests.resolve.launching import outcome

_ROOT = Path(__file__).parents[2]
_PAGE = (_ROOT / "docs" / "launch-files.md").read_text("utf-8")
_SCHEMA = json.loads((_ROOT / "schemas" / "launch.schema.json").read_text("utf-8"))
_BLOCKS = re.findall(r"^```yaml\n(.*?)^```$", _PAGE, re.DOTALL | re.MULTILINE)
_ADDED = _PAGE.partition("## What Orchestra adds")[2].partition("### In Python")[0]
_OTHERS = """
- node: {pkg: bringup, exec: simulation, name: simulation, ready: {message: /clock}}
- executable: {cmd: recorder}
"""


def _file(block: str) -> str:
    """Return a launch file of a block, which holds actions, or keys of one."""
    if block.startswith("- "):
        return f"launch:\n{block}"
    keys = re.sub("^", "    ", block, flags=re.MULTILINE)
    return f"launch:\n- node:\n    exec: shown\n    name: shown\n{keys}{_OTHERS}"


@pytest.mark.parametrize("block", [block for block in _BLOCKS if not block.startswith("#")])
def test_every_example_has_a_plan_and_fulfils_the_schema(tmp_path: Path, block: str) -> None:
    (tmp_path / "params").mkdir()
    (tmp_path / "params" / "robot.yaml").write_text("/**: {ros__parameters: {a: 1}}", "utf-8")
    text = f"{_file(block)}\n- let: {{name: id, value: x}}".replace(
        "launch:\n", "launch:\n- arg: {name: id, default: '7'}\n"
    )
    faults = jsonschema.Draft202012Validator(_SCHEMA).iter_errors(yaml.safe_load(text))
    assert [f"{fault.json_path}: {fault.message}" for fault in faults] == []
    found = outcome(tmp_path, text, launching=False, environment={"PATH": "/bin"})
    assert found.problems.errors == ()


@pytest.mark.parametrize(
    "key", sorted({*FACTS, *Limits.known_keys(), *Alive.known_keys(), *Restart.known_keys()})
)
def test_every_key_is_documented(key: str) -> None:
    assert re.search(rf"`{key}\b|\b{key}:", _ADDED)


@pytest.mark.parametrize("key", sorted({*DependsOn.known_keys(), *Stop.known_keys(), *Running.known_keys()}))
def test_every_key_of_a_process_is_on_the_page(key: str) -> None:
    assert re.search(rf"`{key}\b|\b{key}:", _PAGE.replace("launch-prefix", "launch_prefix"))
