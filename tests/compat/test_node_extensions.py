"""Packages that add to the command line of every node; nodes and components that user code prepares by hand."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest
import yaml

from orchestra.compat.launch.conditions.if_condition import IfCondition
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch_ros.actions.load_composable_nodes import get_composable_node_load_request
from orchestra.compat.launch_ros.actions.node import Node
from orchestra.compat.launch_ros.actions.push_ros_namespace import PushROSNamespace
from orchestra.compat.launch_ros.actions.set_parameter import SetParameter
from orchestra.compat.launch_ros.actions.set_parameters_from_file import SetParametersFromFile
from orchestra.compat.launch_ros.actions.set_remap import SetRemap
from orchestra.compat.launch_ros.descriptions.composable_node import ComposableNode
from orchestra.compat.launch_ros.parameter_descriptions import Parameter, ParameterFile
from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from tests.compat import plans
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Iterator

# As public packages have them: a level of logging for all nodes; an enclave, which is also told to the command line.
_EXTENSIONS = """
import launch
from launch.substitutions import LocalSubstitution, TextSubstitution
from launch.utilities import normalize_to_list_of_substitutions
from launch_ros.actions.node import Node, NodeActionExtension
from launch_ros.utilities import plugin_support

class Level(NodeActionExtension):
    def __init__(self):
        super(NodeActionExtension, self).__init__()
        plugin_support.satisfies_version(self.EXTENSION_POINT_VERSION, '^0.1')
    def prepare_for_execute(self, context, ros_specific_arguments, node_action):
        level = context.launch_configurations.get('level', None)
        words = ['--log-level', level] if level is not None else []
        return [[TextSubstitution(text=word)] for word in words], ros_specific_arguments

class Enclave(NodeActionExtension):
    def prepare_for_execute(self, context, ros_specific_arguments, node_action):
        assert isinstance(node_action, Node) and self.NAME == 'enclave'
        if node_action.is_node_name_fully_specified():
            ros_specific_arguments['enclave'] = node_action.node_name
            words = ['--enclave', LocalSubstitution("ros_specific_arguments['enclave']")]
            return [normalize_to_list_of_substitutions(word) for word in words], ros_specific_arguments
        return [], ros_specific_arguments

class Renaming(NodeActionExtension):
    def prepare_for_execute(self, context, ros_specific_arguments, node_action):
        return [], {**ros_specific_arguments, 'name': '__node:=other', 'ns': '__ns:=/there'}

class Newer(NodeActionExtension):
    EXTENSION_POINT_VERSION = '0.2'

class Failing(NodeActionExtension):
    def prepare_for_execute(self, context, ros_specific_arguments, node_action):
        raise ValueError('no')
"""


def _install(folder: Path, **extensions: str) -> dict[str, str]:
    """Install extensions below a prefix; return the environment to find them in."""
    library = folder / "prefix/lib/python3.11/site-packages"
    metadata = library / "extending-1.0.dist-info"
    metadata.mkdir(parents=True)
    (library / "extending.py").write_text(_EXTENSIONS, "utf-8")
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: extending\nVersion: 1.0\n", "utf-8")
    lines = [f"{name} = extending:{kind}\n" for name, kind in extensions.items()]
    (metadata / "entry_points.txt").write_text("[launch_ros.node_action]\n" + "".join(lines), "utf-8")
    return {"PATH": "/bin", "AMENT_PREFIX_PATH": str(folder / "prefix")}


def _commands(path: Path, environment: dict[str, str], *arguments: str) -> tuple[list[list[str]], list[str]]:
    problems = Problems()
    plan = collect(str(path), inputs_from(list(arguments), environment=environment), problems)
    assert plan is not None
    return [list(process.command) for process in plan.processes], [item.message for item in problems]


_YAML = """
launch:
- arg: {name: level, default: warn}
- node: {exec: /bin/true, name: a, namespace: n, ros_args: -r x:=y}
- node_container: {exec: /bin/true, name: c, namespace: ""}
- node: {exec: /bin/true}
- executable: {cmd: /bin/true}
"""
_PYTHON = """
from launch import LaunchDescription
from launch.actions import *
from launch_ros.actions import *
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('level', default_value='warn'),
        Node(executable='/bin/true', name='a', namespace='n', ros_arguments=['-r', 'x:=y']),
        ComposableNodeContainer(executable='/bin/true', name='c', namespace=''),
        Node(executable='/bin/true'),
        ExecuteProcess(cmd=['/bin/true']),
    ])
"""


@pytest.mark.conforms("1.12.1 extensions")
@pytest.mark.parametrize(("ending", "text"), [("yaml", _YAML), ("py", _PYTHON)])
def test_extensions_add_words_to_every_node(tmp_path: Path, ending: str, text: str) -> None:
    environment = _install(tmp_path, level="Level", enclave="Enclave")
    path = tmp_path / f"a.launch.{ending}"
    path.write_text(text, "utf-8")
    commands, problems = _commands(path, environment, "level:=info")
    assert problems == []
    level = "--log-level info"
    assert [" ".join(words) for words in commands] == [
        f"/bin/true --ros-args -r x:=y {level} --enclave /n/a --ros-args -r __node:=a -r __ns:=/n",
        f"/bin/true --ros-args {level} --enclave /c --ros-args -r __node:=c -r __ns:=/",
        f"/bin/true --ros-args {level} --ros-args",
        "/bin/true",
    ]


def test_an_extension_may_change_names(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.yaml"
    path.write_text(
        "launch: [node: {exec: /bin/true, name: a, namespace: n}, node: {exec: /bin/true}]", "utf-8"
    )
    commands, _ = _commands(path, _install(tmp_path, renaming="Renaming"))
    assert commands[0][-4:] == ["-r", "__node:=other", "-r", "__ns:=/there"]
    assert commands[1] == ["/bin/true", "--ros-args"]


def test_an_extension_that_cannot_be_made_is_left_out_with_a_warning(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.yaml"
    path.write_text("launch: [node: {exec: /bin/true, name: a}]", "utf-8")
    environment = _install(tmp_path, newer="Newer", none="None", level="Level")
    commands, problems = _commands(path, environment)
    assert commands == [["/bin/true", "--ros-args", "-r", "__node:=a"]]
    assert problems == [
        "the extension 'newer' of nodes is left out: PluginException: Extension point is newer (0.2), "
        "than what the extension supports '^0.1'",
        "the extension 'none' of nodes is left out: AttributeError: module 'extending' has no attribute 'None'",
    ]


def test_what_an_extension_raises_is_told(tmp_path: Path) -> None:
    path = tmp_path / "a.launch.yaml"
    path.write_text("launch: [node: {exec: /bin/true, name: a}]", "utf-8")
    _, problems = _commands(path, _install(tmp_path, failing="Failing"))
    assert problems == ["ValueError: no"]


@pytest.fixture
def _loading(tmp_path: Path) -> Iterator[None]:
    with loading({"PATH": "/bin", "AMENT_PREFIX_PATH": str(tmp_path)}):
        yield


@pytest.mark.usefixtures("_loading")
def test_a_node_that_is_prepared_by_hand_knows_its_whole_command(tmp_path: Path) -> None:

    common, own = tmp_path / "common.yaml", tmp_path / "own.yaml"
    for path in (common, own):
        path.write_text("{}", "utf-8")
    context = LaunchContext()
    SetParameter("g", 1).visit(context)
    SetParametersFromFile(str(common)).visit(context)
    SetRemap("s", "t").visit(context)
    node = Node(
        executable="/bin/true",
        name="a",
        namespace="n",
        arguments=["x"],
        ros_arguments=["--log-level", "info"],
        parameters=[
            {"p": [1, 2], "q": {"r": "5"}},
            ParameterFile(own),
            Parameter("d", 2.5),
            str(tmp_path / "no"),
        ],
        remappings=[("u", "v")],
    )
    assert node.process_details is None
    node.prepare(context)
    cmd = node.cmd
    assert node.process_details is not None
    assert node.process_details["cmd"] == cmd
    written = cmd[cmd.index("g:=1") + 4]
    assert cmd == [
        *(
            "/bin/true",
            "x",
            "--ros-args",
            "--log-level",
            "info",
            "--ros-args",
            "-r",
            "__node:=a",
            "-r",
            "__ns:=/n",
        ),
        *("-p", "g:=1", "--params-file", str(common), "--params-file", written, "--params-file", str(own)),
        *("-p", "d:=2.5", "-r", "s:=t", "-r", "u:=v"),
    ]
    values = yaml.safe_load(Path(written).read_text("utf-8"))
    assert values == {"/n/a": {"ros__parameters": {"p": [1, 2], "q.r": "5"}}}
    Path(written).unlink()


@pytest.mark.usefixtures("_loading")
def test_a_request_for_a_component_has_what_is_set_for_all_nodes() -> None:

    context = LaunchContext()
    PushROSNamespace("m").visit(context)
    SetParameter("g", 1).visit(context)
    SetRemap("s", "t").visit(context)
    component = ComposableNode(
        package="p",
        plugin="P",
        name="c",
        namespace="n",
        parameters=[{"rate": 2.5}],
        remappings=[("u", "v")],
        extra_arguments=[{"use_intra_process_comms": True}],
    )
    request = get_composable_node_load_request(component, context)
    names = (request.package_name, request.plugin_name, request.node_name, request.node_namespace)
    assert names == ("p", "P", "c", "/m/n")
    assert request.remap_rules == ["s:=t", "u:=v"]
    assert [(item.name, item.value.type) for item in request.parameters] == [("g", 2), ("rate", 3)]
    assert [(item.name, item.value.bool_value) for item in request.extra_arguments] == [
        ("use_intra_process_comms", True)
    ]
    bare = get_composable_node_load_request(ComposableNode(package="p", plugin="P"), LaunchContext())
    assert (bare.node_name, bare.node_namespace, bare.parameters) == ("", "", [])
    left_out = ComposableNode(package="p", plugin="P", condition=IfCondition("false"))
    assert get_composable_node_load_request(left_out, context) is None


def test_rules_that_a_node_tells_begin_with_those_of_its_scope(tmp_path: Path) -> None:
    before = """
from launch_ros.actions import *
n = Node(executable='/bin/true', remappings=[('u', 'v')])
m = Node(executable='/bin/true')
"""
    told = "OpaqueFunction(function=lambda _: [LogInfo(msg=str(n.expanded_remapping_rules)), "
    told += "LogInfo(msg=str(m.expanded_remapping_rules))])"
    plan = plans.python(tmp_path, f"m, SetRemap('s', 't'), n, {told}", before)
    assert plan.problems == []
    assert plan.messages == ["[('s', 't'), ('u', 'v')]", "None"]
