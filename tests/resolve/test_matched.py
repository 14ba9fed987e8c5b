"""What is read by what was learned of others comes to the same plan, with the same places and the same problems."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.errors import Problems
from orchestra.load import files
from orchestra.load.alike import yaml_items
from orchestra.load.alike.learned import FEW, Forms
from orchestra.pipeline import collect, inputs_from
from orchestra.plan import codec

if TYPE_CHECKING:
    from pathlib import Path

_HEAD = "launch:\n- arg: {name: a, default: '1'}\n- let: {name: c, value: $(var a)x}\n- let: {name: ok, value: true}\n- let: {name: empty, value: ''}\n- include: {file: b.launch.yaml}\n"
_TEMPLATES = (
    "- node:\n    exec: /bin/true\n    name: {0}\n    namespace: {1}\n    args: {2}\n    ros_args: {2}\n    param:\n"
    "    - {{name: x, value: {3}}}\n    - {{name: y.{0}, value: '{3}'}}\n    - {{name: z, value: [{3}, 1]}}\n"
    "    remap:\n    - {{from: {1}, to: {2}}}\n",
    "- executable: {{cmd: /bin/echo {2}, name: {0}, env: [{{name: E, value: {1}}}], cwd: {3}}}\n",
    "- let: {{name: {0}, value: {3}}}\n- log: {{message: {2} $(var {0}), level: info}}\n",
    "- group:\n  - push_ros_namespace: {{namespace: {1}}}\n  - set_parameter: {{name: {0}, value: {3}}}\n"
    "  - node: {{exec: /bin/true, name: {0}, if: $(var ok)}}\n",
    "- set_env: {{name: {0}, value: {3}}}\n- set_remap: {{from: {1}, to: {2}}}\n",
    "- include: {{file: b.launch.yaml, for_each: {{i: [{3}, 2]}}, arg: [{{name: {0}, value: {2}}}]}}\n",
)
_NAMES = ("a", "n1", "c", "$(var a)", "$(var c)_n", "n$(var none 2)", "$(env E)", "9", "a-b", "__x")
_PATHS = ("/r", "s/t", "$(var c)", "/$(var c)/u", "$(var a)", "a b", "/v/", "$(dirname)", "$(var none)")
_ARGUMENTS = (
    "--id 1",
    "x  y",
    "-a",
    "$(var c) --b",
    "$(var c)$(var a) x$(var a)y  $(var c)",
    "$(var a) $(var leaked)",
    "$(var empty) z",
    "$(var c)$(var none 2)",
    "$(var leaked)",
    "it's",
    'q"r s"',
    "a\\ b",
    "--log-level x",
    "$(eval 1+1)",
    "$(dirname)/$(var c) $(dirname)",
)
_SCALARS = (
    "1",
    "2.5",
    "true",
    "on",
    "012",
    "x",
    "$(var a)",
    "$(var c)",
    "$(env E)",
    "1e3",
    "$(dirname)/$(var a).x",
    "$(dirname)/x/$(var none)",
    "-3",
    "$(find-pkg-share no)",
    "$(eval \"'$(var a)' == '1'\")",
    "$(eval '$(var a) < 2')",
    "$(var leaked)",
)


def _read(folder: Path, monkeypatch: pytest.MonkeyPatch, *, by_forms: bool) -> tuple[Any, ...]:
    monkeypatch.setattr(yaml_items, "FORMS", Forms())
    monkeypatch.setattr(files, "_pays", lambda _: by_forms)
    problems = Problems()
    inputs = inputs_from([], environment={"PATH": "/bin", "E": "e"})
    plan = collect(str(folder / "a.launch.yaml"), inputs, problems)
    return plan and codec.dumps(plan), problems.ordered


def _compare(folder: Path, monkeypatch: pytest.MonkeyPatch, rnd: Random) -> bool:
    """Hold both ways to each other; return whether any form was learned."""
    plain, odd = [], []
    for template in rnd.sample(_TEMPLATES, 2):
        plain += [template.format(f"p{number}", "/p", "p", "1") for number in range(FEW)]
        values = [map(rnd.choice, (_NAMES, _PATHS, _ARGUMENTS, _SCALARS)) for _ in range(6)]
        odd += [template.format(*item) for item in values]
    rnd.shuffle(odd)
    actions = [*plain, *odd]
    (folder / "a.launch.yaml").write_text(_HEAD + "".join(actions))
    (folder / "b.launch.yaml").write_text(
        "launch:\n- arg: {name: n1, default: d}\n- log: {message: $(var n1)}\n- let: {name: leaked, value: 3}\n"
    )
    assert _read(folder, monkeypatch, by_forms=True) == _read(folder, monkeypatch, by_forms=False)
    _read(folder, monkeypatch, by_forms=True)
    return bool(yaml_items.FORMS.known)


def test_plans_of_forms_are_those_of_other_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rnd = Random(1)  # noqa: S311 - the same every time
    assert sum(_compare(tmp_path, monkeypatch, rnd) for _ in range(6)) > 3


@pytest.mark.long
@pytest.mark.timeout(900)
def test_hundreds_of_plans_of_forms_are_those_of_other_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for seed in range(200):
        _compare(tmp_path, monkeypatch, Random(seed))  # noqa: S311 - as above
