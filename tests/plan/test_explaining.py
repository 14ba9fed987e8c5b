"""Where the values of a node come from, and which rule decides."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan import codec
from orchestra.plan.explaining import UnknownSubjectError, explain
from orchestra.plan.render import explanation as text

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.explained import Explained
    from orchestra.plan.model import Candidate, Plan

_OUTER = """\
launch:
  - arg: {name: mode, default: slow}
  - let: {name: label, value: "<$(var mode)>"}
  - set_env: {name: LEVEL, value: $(env HOST_LEVEL low)}
  - set_remap: {from: scan, to: /all/scan}
  - include:
      file: inner.launch.yaml
      for_each: {robot: [r1, r2]}
      arg:
        - {name: namespace, value: $(var robot)}
        - {name: speed, value: $(var mode)-$(var label)}
"""
_INNER = """\
launch:
  - arg: {name: namespace}
  - arg: {name: speed, default: none}
  - arg: {name: file, default: params.yaml}
  - group:
      - push_ros_namespace: {namespace: $(var namespace)}
      - set_parameter: {name: speed, value: all}
      - node:
          pkg: demo
          exec: talker
          name: a
          namespace: arm
          param:
            - {from: $(var file)}
            - {name: speed, value: $(var speed)}
            - {name: nested, param: [{name: deep, value: 1}]}
          remap:
            - {from: scan, to: own_scan}
            - {from: odom, to: $(var speed_topic /odom)}
          env:
            - {name: LEVEL, value: $(env LEVEL)er}
      - node: {pkg: demo, exec: talker, name: $(var namespace)_b, namespace: /alone}
"""
_PARAMS = """\
/**:
  ros__parameters: {speed: file, rate: 2}
/**/a:
  ros__parameters: {rate: 3}
"""


@pytest.fixture
def made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Plan:
    monkeypatch.chdir(tmp_path)
    for name, content in {
        "outer.launch.yaml": _OUTER,
        "inner.launch.yaml": _INNER,
        "params.yaml": _PARAMS,
    }.items():
        (tmp_path / name).write_text(content)
    programs = tmp_path / "prefix" / "lib" / "demo"
    index = tmp_path / "prefix" / "share" / "ament_index" / "resource_index" / "packages"
    for folder in (programs, index):
        folder.mkdir(parents=True)
    (index / "demo").touch()
    (programs / "talker").write_text("#!/bin/sh\n")
    (programs / "talker").chmod(0o755)
    environment = {"AMENT_PREFIX_PATH": str(tmp_path / "prefix"), "HOST_LEVEL": "high"}
    problems = Problems()
    found = collect("outer.launch.yaml", inputs_from(["mode:=fast"], environment=environment), problems)
    assert found is not None
    assert problems.errors == ()
    return codec.loads(codec.dumps(found))  # all that is told is in the plan itself


def _one(made: Plan, subject: str) -> Explained:
    (value,) = explain(made, subject, {}).values
    return value


def _where(candidate: Candidate) -> str:
    return str(candidate.location.span)


def test_a_parameter_is_followed_through_files_scopes_includes_and_variables(made: Plan) -> None:
    found = _one(made, "/r1/arm/a.speed")
    assert found.value == "fast-<fast>"
    assert [(item.value, _where(item), item.won) for item in found.candidates] == [
        ("all", "inner.launch.yaml:7:45", False),
        ("file", "params.yaml:2:28", False),
        ("fast-<fast>", "inner.launch.yaml:15:36", True),
    ]
    losers, winner = found.candidates[:2], found.candidates[2]
    assert all("'/**'" in item.rule and "'/r1/arm/a'" in item.rule for item in losers)
    assert [(via.name, via.value, via.setter, str(via.location), via.depth) for via in winner.through] == [
        ("speed", "fast-<fast>", "include", "outer.launch.yaml:11:32", 0),
        ("mode", "fast", "command line", "command line:1:1", 1),
        ("label", "<fast>", "let", "outer.launch.yaml:3:32", 1),
    ]


def test_a_value_in_a_file_is_followed_to_who_named_the_file(made: Plan) -> None:
    found = _one(made, "r2/arm/a.rate")
    assert [(item.value, item.won) for item in found.candidates] == [(2, False), (3, True)]
    assert found.candidates[1].rule.startswith("'/**/a' is the matching pattern that appears last")
    (via,) = found.candidates[1].through
    assert (via.name, via.value, via.setter) == ("file", "params.yaml", "default")
    assert str(via.location) == "inner.launch.yaml:4:5"
    assert [str(span) for span in found.candidates[1].location.included_from] == [
        "inner.launch.yaml:14:22",
        "outer.launch.yaml:6:5",
    ]


def test_the_command_line_overrules_and_says_so(tmp_path: Path, made: Plan) -> None:
    environment = {"AMENT_PREFIX_PATH": str(tmp_path / "prefix")}
    given = inputs_from(["mode:=x", "/r1/arm/a:speed:=9"], environment=environment)
    again = collect("outer.launch.yaml", given, Problems())
    assert again is not None
    found = _one(again, "/r1/arm/a.speed")
    assert (found.value, found.candidates[-1].rule) == (9, "the command line wins")
    assert all("overruled by the command line" in item.rule for item in found.candidates[:-1])
    assert made.processes


def test_all_parameters_below_a_name_are_meant_by_it(made: Plan) -> None:
    assert [item.name for item in explain(made, "/r1/arm/a.nested", {}).values] == ["nested.deep"]


def test_namespaces_are_pushed_joined_or_absolute(made: Plan) -> None:
    joined = {item.name: item for item in explain(made, "/r1/arm/a", {}).values}["namespace"]
    assert [(item.value, item.won, item.rule) for item in joined.candidates] == [
        ("/r1", False, "pushed for all that stands below it"),
        ("/r1/arm", True, "the namespace of the node itself, below what is pushed"),
    ]
    assert [(via.name, via.setter) for via in joined.candidates[0].through] == [
        ("namespace", "include"),
        ("robot", "for_each"),
    ]
    alone = {item.name: item for item in explain(made, "/alone/r1_b", {}).values}["namespace"]
    assert [(item.value, item.won) for item in alone.candidates] == [("/r1", False), ("/alone", True)]
    assert alone.candidates[0].rule == "pushed, but the node has an absolute namespace"


def test_rules_are_told_in_order_and_the_first_that_matches_counts(made: Plan) -> None:
    for name in ("scan", "/r1/arm/scan"):
        found = _one(made, f"/r1/arm/a:{name}")
        assert found.value == "/all/scan"
        assert [(item.value, item.won) for item in found.candidates] == [
            ("scan:=/all/scan", True),
            ("scan:=own_scan", False),
            ("odom:=/odom", False),
        ]
        assert "rule 1 comes first" in found.candidates[1].rule
        assert found.candidates[2].rule == "matches /r1/arm/odom, not /r1/arm/scan"
    untouched = _one(made, "/r1/arm/a:~/other")
    assert (untouched.value, untouched.note) == ("/r1/arm/a/other", "no rule matches /r1/arm/a/other")


def test_variables_of_the_environment_are_followed_to_the_caller(made: Plan) -> None:
    found = _one(made, "/r1/arm/a$LEVEL")
    assert [(item.value, item.won) for item in found.candidates] == [("high", False), ("higher", True)]
    via = found.candidates[1].through[0]
    assert (via.kind, via.name, via.value, via.setter) == ("environment", "LEVEL", "high", "environment")
    behind = found.candidates[1].through[1]
    assert (behind.name, behind.setter, behind.location, behind.depth) == ("HOST_LEVEL", "caller", None, 1)


def test_a_variable_that_the_description_leaves_alone_is_the_callers(made: Plan) -> None:
    (found,) = explain(made, "/r1/arm/a$HOME", {"HOME": "/h"}).values
    assert (found.value, found.candidates) == ("/h", ())
    (set_here,) = explain(made, "/r1/arm/a$LEVEL", {"LEVEL": "other"}).values
    assert set_here.note == "without the description it would be 'other'"


@pytest.mark.parametrize(
    ("subject", "meant"),
    [
        ("/r1/arm/c", "/r1/arm/a"),
        ("/r1/arm/a.sped", "speed"),
        ("/r1/arm/a$LEVLE", "LEVEL"),
        ("/r1/arm/x.speed", "/r1/arm/a"),
        ("nothing like it", None),
        ("/r1/arm/a:sc an", "scan"),
        ("/r1/arm/a.", None),
        ("/r1/arm/a$", None),
    ],
)
def test_what_is_not_there_is_refused_with_what_is_near(made: Plan, subject: str, meant: str | None) -> None:
    with pytest.raises(UnknownSubjectError) as raised:
        explain(made, subject, {})
    assert raised.value.meant == meant


def test_the_text_in_full(made: Plan) -> None:
    shown = text.render(explain(made, "/r2/arm/a.rate", {}))
    assert shown == (
        "/r2/arm/a  (node, inner.launch.yaml:8:9, included from outer.launch.yaml:6:5)\n"
        "  parameter rate: 3\n"
        "       2\n"
        "         set for '/**', which appears before '/**/a' does\n"
        "         at params.yaml:2:40, included from inner.launch.yaml:14:22,"
        " included from outer.launch.yaml:6:5\n"
        '           $(var file) is "params.yaml", the default of the argument at inner.launch.yaml:4:5,'
        " included from outer.launch.yaml:6:5\n"
        "    -> 3\n"
        "         '/**/a' is the matching pattern that appears last for the first time, after '/**'\n"
        "         at params.yaml:4:27, included from inner.launch.yaml:14:22,"
        " included from outer.launch.yaml:6:5\n"
        '           $(var file) is "params.yaml", the default of the argument at inner.launch.yaml:4:5,'
        " included from outer.launch.yaml:6:5\n"
    )


def test_chains_that_branch_at_every_step_stay_short(tmp_path: Path) -> None:
    """Each variable is told once, however many ways lead to it."""
    steps = [{"name": "x0", "value": "a"}, {"name": "y0", "value": "b"}]
    for number in range(40):
        read = f"$(if true $(var x{number}) $(var y{number}))$(if false x $(var y{number}))"
        steps += [
            {"name": f"{name}{number + 1}", "value": f"$(if $(equals '{read}' z) q r)"} for name in "xy"
        ]
    lines = [f'  - let: {{name: {step["name"]}, value: "{step["value"]}"}}' for step in steps]
    lines.append('  - executable: {cmd: "true", name: p, env: [{name: E, value: "$(var x40) $(var y40)"}]}')
    (tmp_path / "deep.launch.yaml").write_text("launch:\n" + "\n".join(lines) + "\n")
    made = collect(str(tmp_path / "deep.launch.yaml"), inputs_from([], environment={}), Problems())
    assert made is not None
    (candidate,) = made.processes[0].provenance.environment["E"]
    assert 2 <= len(candidate.through) <= 16
    assert candidate.through[0].name == "x40"


def test_components_and_code_are_followed_too(tmp_path: Path) -> None:
    (tmp_path / "code.launch.py").write_text(
        "from launch import LaunchDescription\n"
        "from launch.actions import DeclareLaunchArgument, SetLaunchConfiguration\n"
        "from launch.substitutions import LaunchConfiguration\n"
        "from launch_ros.actions import ComposableNodeContainer\n"
        "from launch_ros.descriptions import ComposableNode\n"
        "def generate_launch_description():\n"
        "    part = ComposableNode(package='image', plugin='image::Camera', name='cam',\n"
        "                          parameters=[{'hz': LaunchConfiguration('hz')}],\n"
        "                          remappings=[('image', LaunchConfiguration('topic'))])\n"
        "    return LaunchDescription([\n"
        "        DeclareLaunchArgument('hz', default_value='5'),\n"
        "        SetLaunchConfiguration('topic', '/seen'),\n"
        "        ComposableNodeContainer(package='demo', executable='box', name='box', namespace='',\n"
        "                                composable_node_descriptions=[part]),\n"
        "    ])\n"
    )
    path = str(tmp_path / "code.launch.py")
    made = collect(path, inputs_from([], environment={}), Problems())
    assert made is not None
    found = _one(made, "cam.hz")
    assert (found.value, [via.setter for via in found.candidates[0].through]) == (5, ["default"])
    rule = _one(made, "/cam:image")
    assert rule.value == "/seen"
    assert [(via.name, via.setter) for via in rule.candidates[0].through] == [("topic", "let")]


def test_substitutions_in_a_file_are_followed_too(tmp_path: Path) -> None:
    (tmp_path / "p.yaml").write_text("/**:\n  ros__parameters: {a: $(var x), b: 1, c: <$(var y)$(var x)>}\n")
    (tmp_path / "main.launch.yaml").write_text(
        "launch:\n"
        "  - arg: {name: x, default: '5'}\n"
        "  - let: {name: y, value: $(var x)}\n"
        "  - arg: {name: file, default: p.yaml}\n"
        "  - node: {exec: /bin/true, name: n, namespace: /,"
        " param: [{from: $(dirname)/$(var file), allow_substs: true}]}\n"
    )
    made = collect(str(tmp_path / "main.launch.yaml"), inputs_from([], environment={}), Problems())
    assert made is not None
    told = {
        name: [(via.name, via.depth) for via in _one(made, f"n.{name}").candidates[0].through]
        for name in "abc"
    }
    assert told == {
        "a": [("x", 0), ("file", 0)],
        "b": [("file", 0)],
        "c": [("y", 0), ("x", 1), ("file", 0)],
    }


def test_the_words_of_a_command_line_are_followed(tmp_path: Path) -> None:
    (tmp_path / "main.launch.yaml").write_text(
        "launch:\n"
        "  - arg: {name: x, default: '5'}\n"
        "  - let: {name: y, value: $(var x)}\n"
        "  - node: {exec: /bin/true, name: n, args: one $(var y), ros_args: --log-level $(var x)}\n"
        "  - executable: {cmd: echo $(var y), name: $(var x)}\n"
    )
    made = collect(str(tmp_path / "main.launch.yaml"), inputs_from([], environment={}), Problems())
    assert made is not None
    told = [[(via.name, via.depth) for via in process.provenance.command] for process in made.processes]
    assert told == [[("y", 0), ("x", 1)], [("y", 0), ("x", 1)]]
