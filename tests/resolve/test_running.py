"""How processes run: the short way for actions that say nothing of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.resolve import running
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path

    import pytest

    from orchestra.description.running import Running
    from orchestra.resolve.resolution import Resolution

_TEXT = """\
launch:
- arg: {name: who, default: mars}
- let: {name: place, value: there}
- set_env: {name: GREETING, value: hello}
- executable: {cmd: sh -c 'exit 0', name: plain}
- executable: {cmd: sh -c 'exit 1', output: screen}
- executable: {cmd: sh -c $(var who), if: $(eval '1 == 1')}
- group:
  - push_ros_namespace: {namespace: robot}
  - set_remap: {from: a, to: b}
  - node: {exec: sh, name: talker, args: -c true, param: [{name: x, value: 1}], remap: [{from: c, to: d}]}
  - node: {exec: sh, name: $(var place), output: log}
  - node: {exec: sh, unless: $(eval '1 == 2')}
"""


def test_the_short_way_gives_what_the_long_one_does(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    taken = []
    whole = running._say

    def counted(action: Running, process: Any, run: Resolution) -> bool:
        taken.append(process.executable)
        return whole(action, process, run)

    monkeypatch.setattr(running, "_say", counted)
    short = outcome(tmp_path, _TEXT)
    assert not taken
    monkeypatch.setattr(running, "_says_nothing", lambda *_: False)
    long = outcome(tmp_path, _TEXT)
    assert len(taken) == len(short.plan.processes) == 6
    assert [str(problem) for problem in short.problems] == [str(problem) for problem in long.problems]
    assert short.plan == long.plan
