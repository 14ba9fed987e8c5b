"""`module` and `script` of nodes say the same in every language."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from tests.load.planning import installed, planned

if TYPE_CHECKING:
    from pathlib import Path

    from tests.load.written import Actions

_ACTIONS: Actions = [
    {"arg": {"name": "tool", "default": "tool"}},
    {"node": {"module": "json.$(var tool)", "name": "a", "namespace": "n", "args": "b c"}},
    {"node": {"script": "run.py", "name": "b", "param": [{"name": "x", "value": 1}]}},
    {"lifecycle_node": {"script": "$(dirname)/run.py", "name": "c", "namespace": "/"}},
]


def test_the_same_in_yaml_and_xml(tmp_path: Path) -> None:
    (tmp_path / "run.py").touch()
    found = [planned(tmp_path, language, _ACTIONS, installed(tmp_path)) for language in ("yaml", "xml")]
    assert found[0] == found[1]
    assert found[0].problems == ()
    script = [sys.executable, str(tmp_path / "run.py")]
    assert [process["command"][:3] for process in found[0].processes] == [
        [sys.executable, "-m", "json.tool"],
        [*script, "--ros-args"],
        [*script, "--ros-args"],
    ]
