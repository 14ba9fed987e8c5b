"""What a conversion tells: what is lost, what comes out otherwise, and what code has come to."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import pytest
import yaml

from orchestra.convert.converting import convert
from orchestra.errors import DescriptionError, UsageError
from tests.convert.turning import seen, turned
from tests.load.planning import installed

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path
    from typing import Any

_HEAD = """\
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription, Substitution
from launch.actions import *
from launch.conditions import *
from launch.event_handlers import *
from launch.events import Shutdown as ShutdownEvent
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import *
from launch_ros.substitutions import *


class Own(Substitution):
    def perform(self, context):
        return "own"


def generate_launch_description():
    node = Node(package="demo", executable="tool", name="n")
    return LaunchDescription([
        {}
    ])
"""
_ENVIRONMENT: Mapping[str, str] = {"PATH": "/usr/bin:/bin"}


def _file(folder: Path, actions: str) -> Path:
    path = folder / "a.launch.py"
    path.write_text(_HEAD.replace("{}", actions), "utf-8")
    return path


def _actions(text: str | None) -> Any:
    assert text is not None
    return yaml.safe_load(text)["launch"]


LOST: Final = {
    "OpaqueFunction(function=lambda context: [])": "only Python code knows what this OpaqueFunction of <lambda>() does",
    "RegisterEventHandler(OnProcessExit(target_action=node, on_exit=[node])), node": "only Python has event handlers (OnProcessExit); near to it is `depends_on` with `condition: exited` on what follows",
    "RegisterEventHandler(OnProcessExit(target_action=node, on_exit=[EmitEvent(event=ShutdownEvent())])), node": "only Python has event handlers (OnProcessExit); near to it is `on_exit: shutdown` on the process",
    "RegisterEventHandler(OnProcessExit(target_action=node, on_exit=[Shutdown()])), node": "only Python has event handlers (OnProcessExit); near to it is `on_exit: shutdown` on the process",
    "LogInfo(msg=Own())": "only Python code knows what this Own comes to",
    "LogInfo(msg='a', condition=IfCondition(Own()))": "only Python code knows what this Own comes to",
    "GroupAction([PushEnvironment()])": "only Python has PushEnvironment",
    "UnsetLaunchConfiguration('a')": "only Python has UnsetLaunchConfiguration",
    "Node(executable='e', on_exit=lambda event, context: [])": "`on_exit` does more than end the run: no key says that",
    "LogInfo(msg=PythonExpression([\"'\", LaunchConfiguration('a', default='b c'), \"' == ''\"]))": "a substitution in quotes cannot have"
    " arguments in quotes itself: the launch language has no way to write that",
}


@pytest.mark.parametrize("actions", LOST)
@pytest.mark.parametrize("language", ["xml", "yaml"])
def test_what_only_python_can_say_is_told_where_it_stands(
    actions: str, language: str, tmp_path: Path
) -> None:
    path = _file(tmp_path, f"LogInfo(msg='kept'), {actions}, LogInfo(msg='too')")
    found = convert(str(path), language, _ENVIRONMENT)
    assert (found.text, found.lossy) == (None, True)
    (remark,) = found.remarks
    assert (remark.message, remark.span.line) == (LOST[actions], 23)


@pytest.mark.parametrize("language", ["xml", "yaml"])
def test_a_part_of_a_file_has_comments_for_the_rest(language: str, tmp_path: Path) -> None:
    path = _file(tmp_path, "LogInfo(msg='kept'), OpaqueFunction(function=print), LogInfo(msg='too')")
    found = convert(str(path), language, _ENVIRONMENT, partial=True)
    assert found.text is not None
    assert found.lossy
    told = "not converted: only Python code knows what this OpaqueFunction of print() does"
    kept, comment, too = (found.text.index(text) for text in ("kept", told, "too"))
    assert kept < comment < too
    other = tmp_path / f"b.launch.{language}"
    other.write_text(found.text, "utf-8")
    assert not seen(other, _ENVIRONMENT).errors


def test_xml_refuses_what_it_has_no_characters_for(tmp_path: Path) -> None:
    path = _file(tmp_path, r"LogInfo(msg='bell: \a')")
    (remark,) = convert(str(path), "xml", _ENVIRONMENT).remarks
    assert remark.message == "XML cannot have this control character"
    assert turned(path, "yaml", _ENVIRONMENT).read_text("utf-8").count(r'"bell: \a"') == 1


def test_folders_that_code_has_asked_for_are_calls_again(tmp_path: Path) -> None:
    environment = installed(tmp_path)
    (tmp_path / "beside.yaml").write_text("launch: []", "utf-8")
    path = _file(
        tmp_path,
        """
        IncludeLaunchDescription(AnyLaunchDescriptionSource(os.path.join(os.path.dirname(__file__), "beside.yaml"))),
        LogInfo(msg="in " + os.path.join(get_package_share_directory("demo"), "config", "a.yaml")),
        Node(package="demo", executable="tool", parameters=[
            get_package_share_directory("absent_package") + "/b.yaml",
            {"path": os.path.join(get_package_share_directory("demo"), "c"), "paths": [get_package_share_directory("demo"), "d"]},
        ]),
        """,
    )
    include, log, node = _actions(convert(str(path), "yaml", environment).text)
    assert include["include"]["file"] == "$(dirname)/beside.yaml"
    assert log["log"]["message"] == "in $(find-pkg-share demo)/config/a.yaml"
    assert node["node"]["param"] == [
        {"from": "$(find-pkg-share absent_package)/b.yaml"},
        {"name": "path", "value": "$(find-pkg-share demo)/c"},
        {"name": "paths", "value": ["$(find-pkg-share demo)", "d"]},
    ]


def test_a_path_of_this_machine_is_told(tmp_path: Path) -> None:
    path = _file(tmp_path, "LogInfo(msg=os.path.join('/usr', 'bin'))")
    (remark,) = convert(str(path), "yaml", _ENVIRONMENT).remarks
    assert not remark.lost
    assert remark.message == "code has come to the path /usr/bin: the result has it as it is here"


def test_code_that_reads_the_environment_is_told(tmp_path: Path) -> None:
    path = _file(tmp_path, "LogInfo(msg=os.environ['ROBOT'])")
    found = convert(str(path), "yaml", {**_ENVIRONMENT, "ROBOT": "r2"})
    assert _actions(found.text) == [{"log": {"message": "r2"}}]
    (remark,) = found.remarks
    assert remark.message == "os.environ is read when the file is converted: the result has what it is then"


def test_what_code_changes_in_the_environment_is_an_action(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.py"
    text = _HEAD.replace("{}", "node").replace("    node =", "    os.environ['LEVEL'] = 'high'\n    node =")
    path.write_text(text, "utf-8")
    environment = installed(tmp_path)
    assert _actions(convert(str(path), "yaml", environment).text)[0] == {
        "set_env": {"name": "LEVEL", "value": "high"}
    }
    assert seen(turned(path, "yaml", environment), environment) == seen(path, environment)


def test_a_condition_on_a_configuration_holds_for_the_same_texts(tmp_path: Path) -> None:
    texts = ("sim", "true", "True", "1", "", "1.0", "it's")
    actions = [
        f"GroupAction([{setting}LogInfo(msg={expected + kind!r}, "
        f"condition=LaunchConfiguration{kind}('mode', {expected!r}))])"
        for setting in ("", *(f"SetLaunchConfiguration('mode', {text!r}), " for text in texts))
        for expected in texts
        for kind in ("Equals", "NotEquals")
    ]
    path = _file(tmp_path, ", ".join(actions))
    there = turned(path, "yaml", _ENVIRONMENT)
    assert seen(there, _ENVIRONMENT) == seen(path, _ENVIRONMENT)


def test_an_action_that_is_named_by_its_object_is_named_by_its_name(tmp_path: Path) -> None:
    path = _file(
        tmp_path,
        """
        container := ComposableNodeContainer(package="p", executable="c", name="box", namespace="/in"),
        LoadComposableNodes(target_container=container, composable_node_descriptions=[
            ComposableNode(package="p", plugin="P", name="part"),
        ]),
        Node(executable="e", name="late", depends_on=[{"process": container, "condition": "started"}]),
        """,
    )
    _, load, late = _actions(convert(str(path), "yaml", _ENVIRONMENT).text)
    assert load["load_composable_node"]["target"] == "/in/box"
    assert late["node"]["depends_on"] == [{"node": "/in/box", "condition": "started"}]


def test_relative_paths_stay_right_in_another_folder(tmp_path: Path) -> None:
    folder, other = tmp_path / "launch", tmp_path / "elsewhere" / "deep"
    folder.mkdir()
    other.mkdir(parents=True)
    (folder / "p.yaml").write_text("/**: {ros__parameters: {a: 1}}", "utf-8")
    (folder / "inner.launch.yaml").write_text("launch: [{log: {message: inner}}]", "utf-8")
    (folder / "run.py").touch()
    path = folder / "a.launch.yaml"
    path.write_text(
        "launch:\n- include: {file: inner.launch.yaml}\n- include: {file: $(dirname)/inner.launch.yaml}\n"
        "- node: {exec: e, name: n, param: [{from: p.yaml}, {from: later.yaml}]}\n"
        "- node: {script: run.py, name: m}\n",
        "utf-8",
    )
    found = convert(str(path), "xml", _ENVIRONMENT, output=str(other))
    assert found.text is not None
    assert found.mistake is None
    for written in (
        "../../launch/inner.launch.yaml",
        "$(dirname)/../../launch/inner.launch.yaml",
        "../../launch/p.yaml",
        "../../launch/run.py",
    ):
        assert f'"{written}"' in found.text
    assert '"later.yaml"' in found.text
    (other / "a.launch.xml").write_text(found.text, "utf-8")
    assert (
        seen(other / "a.launch.xml", _ENVIRONMENT).content["triggers"]
        == seen(path, _ENVIRONMENT).content["triggers"]
    )


def test_the_same_language_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError):
        convert(str(_file(tmp_path, "node")), "python", _ENVIRONMENT)


def test_a_file_with_faults_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.yaml"
    path.write_text("launch:\n- nose: {}\n", "utf-8")
    with pytest.raises(DescriptionError):
        convert(str(path), "xml", _ENVIRONMENT)
