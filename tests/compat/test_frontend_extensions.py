"""Actions and substitutions that third parties add to the language of XML and YAML files."""

from __future__ import annotations

import sys
from textwrap import dedent
from typing import TYPE_CHECKING

import pytest

from orchestra.compat import hook
from orchestra.errors import Problem, Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.reactions import LogAction

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Plan

_ENVIRONMENT = {"PATH": "/usr/bin:/bin"}
_EXTENSION = """
from launch import Action, Substitution
from launch.frontend import expose_action, expose_substitution
from launch_ros.actions import Node


@expose_substitution("twice")
class Twice(Substitution):
    def __init__(self, text):
        super().__init__()
        self.text = text

    @classmethod
    def parse(cls, data):
        return cls, {"text": data[0]}

    def perform(self, context):
        return 2 * "".join(context.perform_substitution(item) for item in self.text)


@expose_action("robot_node")
class RobotNode(Node):
    def __init__(self, *, robot, **kwargs):
        super().__init__(arguments=["--robot", robot], **kwargs)

    @classmethod
    def parse(cls, entity, parser):
        _, kwargs = super().parse(entity, parser)
        kwargs["robot"] = parser.parse_substitution(entity.get_attr("robot"))
        return cls, kwargs


@expose_action("all-of")
class AllOf(Action):
    def __init__(self, actions, **kwargs):
        super().__init__(**kwargs)
        self.actions = actions

    @classmethod
    def parse(cls, entity, parser):
        _, kwargs = super().parse(entity, parser)
        kwargs["actions"] = [parser.parse_action(child) for child in entity.children]
        return cls, kwargs

    def execute(self, context):
        return self.actions


@expose_action("say")
def say(entity, parser):
    from launch.actions import LogInfo
    return LogInfo, {"msg": parser.parse_substitution(entity.get_attr("what"))}
"""
_INCLUDING = """
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription

def generate_launch_description():
    return LaunchDescription([IncludeLaunchDescription("inner.launch.{}")])
"""
_YAML = """
launch:
- let: {name: r, value: bob}
- robot_node:
    exec: prog
    name: $(twice $(var r))
    robot: <$(var r)>
    param: [{name: a, param: [{name: b, value: 3}]}]
- all-of:
  - executable: {cmd: prog '$(twice "a b")', if: $(var r 1), unless: "true"}
- all-of:
    unless: "$(equals $(var r) bob)"
    children: [{executable: {cmd: never}}]
- all-of: [{node: {exec: prog, name: inner}}, {all-of: [{say: {what: hi}}]}]
"""
_XML = """
<launch>
  <let name="r" value="bob"/>
  <robot_node exec="prog" name="$(twice $(var r))" robot="&lt;$(var r)>">
    <param name="a"><param name="b" value="3"/></param>
  </robot_node>
  <all-of unless="$(equals $(var r) bob)"><executable cmd="never"/></all-of>
  <group>
    <all-of>
      <node exec="prog" name="inner"/>
      <all-of><say what="hi"/></all-of>
    </all-of>
  </group>
</launch>
"""


def _collected(path: Path) -> tuple[Plan | None, tuple[Problem, ...]]:
    problems = Problems()
    plan = collect(str(path), inputs_from([], environment=_ENVIRONMENT), problems)
    return plan, problems.ordered


def _messages(plan: Plan) -> list[str]:
    steps = [step for trigger in plan.triggers for step in trigger.do]
    return [step.message for step in steps if isinstance(step, LogAction)]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder that is the working directory, with a launch file that brings the extension."""
    monkeypatch.chdir(tmp_path)
    for language in ("yaml", "xml"):
        (tmp_path / f"{language}.launch.py").write_text(_EXTENSION + _INCLUDING.format(language))
    return tmp_path


@pytest.mark.conforms("1.10 expose_action", "1.10 expose_substitution", "1.2 Action.parse")
@pytest.mark.parametrize(
    ("language", "text", "name_at", "inner_at"),
    [
        ("yaml", _YAML.replace(', if: $(var r 1), unless: "true"', ""), (4, 3), (14, 13)),
        ("xml", _XML, (4, 4), (10, 8)),
    ],
)
def test_what_is_exposed_can_be_written(
    folder: Path, language: str, text: str, name_at: tuple[int, int], inner_at: tuple[int, int]
) -> None:
    (folder / f"inner.launch.{language}").write_text(text)
    plan, problems = _collected(folder / f"{language}.launch.py")
    assert not problems
    assert plan is not None
    robot, *others, inner = plan.processes
    assert robot.id == "/bobbob"
    assert robot.command[:3] == ("prog", "--robot", "<bob>")
    assert robot.parameters == {"a.b": 3}
    assert [process.command for process in others] == ([("prog", "a ba b")] if language == "yaml" else [])
    assert inner.id == "/inner"
    places = [process.location.span for process in (robot, inner)]
    assert [(place.file, place.line, place.column) for place in places] == [
        (f"inner.launch.{language}", *name_at),
        (f"inner.launch.{language}", *inner_at),
    ]
    assert _messages(plan) == ["hi"]


@pytest.mark.conforms("1.10 expose_action")
@pytest.mark.parametrize(
    ("text", "place", "message", "raised"),
    [
        ("launch: [{robot_node: {exec: prog}}]", 11, "'robot_node' lacks 'robot'", 29),
        (
            "launch: [{robot_node: {exec: prog, robot: r, rob: 1}}]",
            11,
            "Unexpected in `robot_node`: `rob`",
            None,
        ),
        ("launch: [{robot_node: {exec: prog, robot: $(va r)}}]", 45, "there is no substitution $(va)", None),
        ("launch: [{say: {what: $(twice)}}]", 23, "IndexError: list index out of range", 15),
        ("launch: [{say: {what: hi, if: x}}]", 11, "Unexpected in `say`: `if`", None),
        ("launch: [{say: {}}]", 11, "'say' lacks 'what'", 52),
        ("launch: [{all-of: {if: x}}]", 11, "'all-of' has a list of actions", 42),
        ("launch: [{all-of: [{nod: {exec: prog}}]}]", 11, "there is no action 'nod'", 42),
        ("launch: [{group: [{all-of: [{node: {name: x}}]}]}]", 20, "'node' lacks 'exec'", 42),
    ],
)
def test_what_their_code_refuses_is_told_where_it_is_written(
    folder: Path, text: str, place: int, message: str, raised: int | None
) -> None:
    (folder / "inner.launch.yaml").write_text(text)
    _, problems = _collected(folder / "yaml.launch.py")
    (problem,) = problems
    assert message in problem.message
    assert problem.span is not None
    assert (problem.span.file, problem.span.line, problem.span.column) == ("inner.launch.yaml", 1, place)
    assert problem.included_from[0].file == "yaml.launch.py"
    assert any(f"yaml.launch.py:{raised}:" in note for note in problem.notes) is (raised is not None)


def test_one_resolution_leaves_nothing_to_the_next(folder: Path) -> None:
    (folder / "inner.launch.yaml").write_text("launch: [{say: {what: $(twice x)}}]")
    assert not _collected(folder / "yaml.launch.py")[1]
    _, problems = _collected(folder / "inner.launch.yaml")
    assert [problem.message for problem in problems] == ["unknown action 'say'"]


@pytest.mark.conforms("1.10 expose_action", "1.10 expose_substitution")
@pytest.mark.parametrize(
    ("code", "message"),
    [
        (
            "@expose_action('node')\ndef parse(entity, parser): ...",
            "two different actions are exposed as 'node'",
        ),
        (
            "@expose_substitution('var')\ndef parse(data): ...",
            "two different substitutions are exposed as 'var'",
        ),
        (
            "@expose_action('x')\ndef f(entity, parser): ...\n@expose_action('x')\ndef g(entity, parser): ...",
            "two different actions are exposed as 'x'",
        ),
        ("expose_action('x')(5)", "Exposed action parser for x is not a callable"),
        ("@expose_action('x')\nclass X: ...", "Exposed action parser for x is not a callable"),
    ],
)
def test_a_name_stands_for_one_thing(tmp_path: Path, code: str, message: str) -> None:
    path = tmp_path / "a.launch.py"
    path.write_text(f"from launch.frontend import *\n{code}\n")
    _, problems = _collected(path)
    assert message in problems[0].message


def test_the_same_class_may_be_exposed_again(tmp_path: Path) -> None:
    """A module that is imported under two names runs twice."""
    (tmp_path / "extension.py").write_text(_EXTENSION)
    path = tmp_path / "a.launch.py"
    path.write_text(
        dedent("""
        import runpy
        from launch import LaunchDescription

        def generate_launch_description():
            for _ in range(2):
                runpy.run_path(__file__.replace("a.launch.py", "extension.py"), run_name="extension")
            return LaunchDescription()
        """)
    )
    assert not _collected(path)[1]


def _install(folder: Path, name: str, code: str) -> None:
    """Install an extension as `pip install --target` does."""
    (folder / f"{name}.py").write_text(code)
    info = folder / f"{name}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[launch.frontend.launch_extension]\n{name} = {name}\n")


@pytest.mark.conforms("1.10 entry points")
def test_installed_extensions_are_found_when_a_name_is_unknown(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    site = folder / "site-packages"
    site.mkdir()
    _install(site, "saying_extension", _EXTENSION)
    monkeypatch.syspath_prepend(site)
    (folder / "ordinary.launch.yaml").write_text("launch: [{log: {message: hi}}]")
    (folder / "inner.launch.yaml").write_text("launch: [{say: {what: $(twice x)}}]")
    assert not _collected(folder / "ordinary.launch.yaml")[1]
    assert "saying_extension" not in sys.modules
    monkeypatch.setattr(hook, "_INSTALLED", (*hook._INSTALLED, f"{site.resolve()}/"))
    for _ in range(2):  # the second resolution imports it anew
        plan, problems = _collected(folder / "inner.launch.yaml")
        assert not problems
        assert plan is not None
        assert _messages(plan) == ["xx"]


@pytest.mark.conforms("1.10 entry points")
def test_an_extension_that_fails_is_warned_of(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    site = folder / "site-packages"
    site.mkdir()
    _install(site, "failing_extension", "import no_such_module_anywhere")
    monkeypatch.syspath_prepend(site)
    (folder / "inner.launch.yaml").write_text("launch: [{say: {what: x}}]")
    with pytest.warns(UserWarning, match="Failed to load failing_extension.*no_such_module_anywhere"):
        _, problems = _collected(folder / "inner.launch.yaml")
    assert [problem.message for problem in problems] == ["unknown action 'say'"]


def test_what_a_parameter_file_comes_to_is_asked_of_who_is_there(folder: Path) -> None:
    """What others have added to the language is gone in another plan, and makes an object for each node."""
    node = "Node(executable='/bin/sh', parameters=[ParameterFile('p.yaml', allow_substs=True)])"
    begin = "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
    begin += "from launch_ros.parameter_descriptions import ParameterFile\n"
    end = f"\ndef generate_launch_description():\n    return LaunchDescription([{node}, {node}])\n"
    (folder / "p.yaml").write_text("/**: {ros__parameters: {a: $(twice x)}}\n")
    counting = _EXTENSION.replace("self.text = text", "self.text = text\n        made.append(self)").replace(
        "        return 2 *", "        return str(len(made)) + 2 *"
    )
    (folder / "without.launch.py").write_text(begin + end)
    (folder / "with.launch.py").write_text("made = []\n" + counting + begin + end)
    for _ in range(2):
        _, problems = _collected(folder / "without.launch.py")
        assert {problem.message for problem in problems} == {"there is no substitution $(twice)"}
        plan, problems = _collected(folder / "with.launch.py")
        assert problems == ()
        assert plan is not None
        assert [process.parameters for process in plan.processes] == [{"a": "1xx"}, {"a": "2xx"}]
