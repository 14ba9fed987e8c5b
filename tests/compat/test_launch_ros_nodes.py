"""Nodes, components and their actions as Python makes them: what they take, what they tell, where they were made."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.building import model_of
from orchestra.compat.launch.conditions import IfCondition
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.substitutions import LaunchConfiguration, TextSubstitution
from orchestra.compat.launch.utilities import perform_substitutions
from orchestra.compat.launch_ros import actions as names
from orchestra.compat.launch_ros.actions import (
    ComposableNodeContainer,
    LifecycleNode,
    LifecycleTransition,
    LoadComposableNodes,
    Node,
    PushROSNamespace,
    ROSTimer,
    SetParameter,
    SetParametersFromFile,
    SetRemap,
    SetROSLogDir,
    SetUseSimTime,
)
from orchestra.compat.launch_ros.default_launch_description import get_default_launch_description
from orchestra.compat.launch_ros.descriptions import ComposableLifecycleNode, ComposableNode
from orchestra.compat.launch_ros.ros_adapters import ROSAdapter, get_ros_adapter, get_ros_node
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

LC = LaunchConfiguration


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({"PATH": "/usr/bin:/bin"}):
        yield


@pytest.mark.conforms("1.12 exported names")
def test_every_exported_name_is_there() -> None:
    assert len(names.__all__) == 14
    assert all(getattr(names, name).__module__.startswith("orchestra.compat.") for name in names.__all__)
    assert names.PushRosNamespace is PushROSNamespace
    assert names.RosTimer is ROSTimer


def _node(**keywords: Any) -> Node:
    return Node(executable="tool", **keywords)


def _component(**keywords: Any) -> ComposableNode:
    return ComposableNode(package="demo", plugin="demo::Camera", **keywords)


_WRONG: dict[str, Callable[[], Any]] = {
    "no executable": lambda: Node(package="demo"),
    "a former keyword": lambda: _node(node_name="n"),
    "a command": lambda: _node(cmd=["x"]),
    "an unknown keyword": lambda: _node(colour="red"),
    "parameters that are a dictionary": lambda: _node(parameters={"a": 1}),
    "parameters that are a tuple": lambda: _node(parameters=({"a": 1},)),
    "parameters that are a path": lambda: _node(parameters="/a.yaml"),
    "a number for parameters": lambda: _node(parameters=[5.0]),
    "None for a value": lambda: _node(parameters=[{"a": None}]),
    "a set for a value": lambda: _node(parameters=[{"a": {1}}]),
    "an object for a value": lambda: _node(parameters=[{"a": {"b": object()}}]),
    "a path for a value": lambda: _node(parameters=[{"a": Path("/x")}]),
    "a number for a name": lambda: _node(parameters=[{5: 1}]),
    "a list in a list": lambda: _node(parameters=[{"a": [1, 2, [3, 4]]}]),
    "remappings that are a dictionary": lambda: _node(remappings={"a": "b"}),
    "a remapping that is a list": lambda: _node(remappings=[["a", "b"]]),
    "a remapping of three": lambda: _node(remappings=[("a", "b", "c")]),
    "a number in a remapping": lambda: _node(remappings=[("a", 1)]),
    "ROS arguments that are a tuple": lambda: _node(ros_arguments=("--log-level", "info")),
    "arguments that are a text": lambda: _node(arguments="--verbose"),
    "a number for an argument": lambda: _node(arguments=[1]),
    "a number for a node's name": lambda: _node(name=1),
    "a number for a namespace": lambda: _node(namespace=1),
    "a lifecycle node without a namespace": lambda: LifecycleNode(executable="tool", name="n"),
    "a container without a name": lambda: ComposableNodeContainer(executable="tool", namespace=""),
    "a container with no name": lambda: ComposableNodeContainer(executable="c", name=None, namespace=""),
    "a component without a class": lambda: ComposableNode(package="demo"),
    "a component's parameters": lambda: _component(parameters="/a.yaml"),
    "a component's remappings": lambda: _component(remappings=[["a", "b"]]),
    "a target that is a number": lambda: LoadComposableNodes(
        composable_node_descriptions=[], target_container=1
    ),
    "a target that is None": lambda: LoadComposableNodes(
        composable_node_descriptions=[], target_container=None
    ),
    "a parameter that is None": lambda: SetParameter("a", None),
    "a parameter of mixed things": lambda: SetParameter("a", [1, {2: 3}]),
    "a namespace that is a number": lambda: PushROSNamespace(1),
    "a remapping to a number": lambda: SetRemap("a", 1),
    "a file that is a number": lambda: SetParametersFromFile(1),
    "a folder that is a number": lambda: SetROSLogDir(1),
    "time that is a number": lambda: SetUseSimTime(1),
}


@pytest.mark.conforms(
    "1.12 Node",
    "1.12 LifecycleNode",
    "1.12 ComposableNodeContainer",
    "1.12 LoadComposableNodes",
    "1.12.1 parameters",
    "1.12.1 remappings",
    "1.12.1 ros_arguments",
    "1.1 SomeRemapRules",
    "1.1 SomeParameters",
    "4.6.1 None",
)
@pytest.mark.parametrize("make", _WRONG.values(), ids=_WRONG)
def test_what_is_of_a_wrong_type_is_refused_where_it_is_made(make: Callable[[], Any]) -> None:
    with pytest.raises(TypeError):
        make()


@pytest.mark.conforms("1.12 LifecycleTransition")
@pytest.mark.parametrize(
    ("names", "ids"), [([], [1]), (["n"], [])], ids=["without a node", "without a transition"]
)
def test_a_transition_is_of_some_node(names: list[str], ids: list[int]) -> None:
    with pytest.raises(ValueError, match="LifecycleTransition names no"):
        LifecycleTransition(lifecycle_node_names=names, transition_ids=ids)


def test_a_lifecycle_node_has_a_name() -> None:
    with pytest.raises(RuntimeError, match="needs a name"):
        LifecycleNode(executable="tool", name=None, namespace="")


@pytest.mark.conforms("1.12.1 executable", "1.12.1 exec_name")
def test_a_node_tells_what_it_was_given() -> None:
    package, executable = ["de", LC("x")], LC("y")
    node = Node(package=package, executable=executable, exec_name="label", arguments=["a"])
    assert node.node_package is package
    assert node.node_executable is executable
    assert perform_substitutions(LaunchContext(), node.name) == "label"
    assert node.cmd[0][0].describe() == "ExecInPkg(pkg='de' + LaunchConfig('x'), exec=LaunchConfig('y'))"
    assert [word[0].text for word in node.cmd[1:]] == ["a", "--ros-args"]


_NAMES: dict[str, tuple[list[str], dict[str, Any], str, str]] = {
    "nothing said": (
        [],
        {},
        Node.UNSPECIFIED_NODE_NAMESPACE,
        "<node_namespace_unspecified>/<node_name_unspecified>",
    ),
    "a name": ([], {"name": "n"}, Node.UNSPECIFIED_NODE_NAMESPACE, "<node_namespace_unspecified>/n"),
    "a namespace": ([], {"namespace": "a"}, "/a", "/a/<node_name_unspecified>"),
    "both": ([], {"name": "n", "namespace": "a/"}, "/a", "/a/n"),
    "the root": ([], {"name": "n", "namespace": ""}, "/", "/n"),
    "a slash before the name": ([], {"name": "/n", "namespace": "/"}, "/", "/n"),
    "a pushed namespace": (["a"], {"name": "n"}, "/a", "/a/n"),
    "a namespace in a pushed one": (["a"], {"name": "n", "namespace": "b"}, "/a/b", "/a/b/n"),
    "pushed twice": (["a", "b"], {"name": "n", "namespace": "c"}, "/a/b/c", "/a/b/c/n"),
    "an absolute one is pushed": (["a", "/b"], {"name": "n", "namespace": "c"}, "/b/c", "/b/c/n"),
    "an absolute one": (["a"], {"name": "n", "namespace": "/c"}, "/c", "/c/n"),
    "the root in a pushed one": (["a"], {"name": "n", "namespace": "/"}, "/", "/n"),
    "nothing in a pushed one": (["a"], {"name": "n", "namespace": ""}, "/a", "/a/n"),
    "nothing pushed": ([""], {"name": "n"}, "/", "/n"),
    "the root pushed": (["/"], {"name": "n", "namespace": "c"}, "/c", "/c/n"),
    "substitutions": ([], {"name": ["n", TextSubstitution(text="1")], "namespace": "a"}, "/a", "/a/n1"),
}


@pytest.mark.conforms(
    "1.12.1 node_name",
    "4.4 relative",
    "4.4 absolute",
    "4.4 no namespace",
    "4.4 empty",
    "4.4 made absolute",
    "4.4 root",
    "4.4 full name",
    "1.12 PushROSNamespace",
    "D49",
)
@pytest.mark.parametrize(("pushed", "keywords", "namespace", "full"), _NAMES.values(), ids=_NAMES)
def test_a_node_that_was_executed_knows_its_name(
    pushed: list[str], keywords: dict[str, Any], namespace: str, full: str
) -> None:
    node = Node(executable="/bin/true", remappings=[("a", [TextSubstitution(text="b"), "c"])], **keywords)
    with pytest.raises(RuntimeError, match="before the node has been visited"):
        _ = node.node_name
    with pytest.raises(RuntimeError):
        node.is_node_name_fully_specified()
    assert node.expanded_remapping_rules is None
    assert node.expanded_node_namespace == Node.UNSPECIFIED_NODE_NAMESPACE
    context = LaunchContext()
    SetRemap("x", "y").execute(context)
    for one in pushed:
        PushROSNamespace(one).execute(context)
    node._perform_substitutions(context)  # as users' subclasses call it; `execute` begins with it
    assert node.node_name == full
    assert node.expanded_node_namespace == namespace
    assert node.is_node_name_fully_specified() == ("<" not in full)
    assert node.expanded_remapping_rules == [("x", "y"), ("a", "bc")]


@pytest.mark.conforms("1.13 ComposableNode")
def test_a_component_tells_what_it_was_given() -> None:
    condition = IfCondition("true")
    component = _component(
        name="camera",
        parameters=[{"rate": 5}],
        remappings=[("image", "raw")],
        extra_arguments=[{"use_intra_process_comms": True}],
        condition=condition,
    )
    context = LaunchContext()
    assert perform_substitutions(context, component.package) == "demo"
    assert perform_substitutions(context, component.node_plugin) == "demo::Camera"
    assert component.node_name is not None
    assert perform_substitutions(context, component.node_name) == "camera"
    assert component.node_namespace is None
    assert list(component.parameters[0].values()) == [5]
    ((source, target),) = component.remappings
    assert (source[0].text, target[0].text) == ("image", "raw")
    assert list(component.extra_arguments[0].values()) == [True]
    assert component.condition() is condition
    bare = _component(remappings=[], extra_arguments=[])
    assert (bare.parameters, bare.remappings, bare.extra_arguments, bare.condition()) == (None,) * 4


def test_what_a_component_tells_makes_another_one() -> None:
    """Users copy descriptions: what is normalised is taken again."""
    first = _component(parameters=[{"a": "5", "b": {"c": [1.0]}, "d": [[LC("x")], "y"]}, "/f.yaml"])
    again = _component(parameters=list(first.parameters))
    one, other = first._to_model(), again._to_model()
    assert [(item.name, item.value) for item in one.param[:2]] != []
    assert [_without_span(item.value) for item in one.param] == [
        _without_span(item.value) for item in other.param
    ]


def _without_span(value: Any) -> Any:
    if isinstance(value, tuple):
        return [_without_span(item) for item in value]
    return getattr(value, "raw", None) or getattr(value, "value", None)


@pytest.mark.conforms("1.12.1 later names", "4.11 autostart", "D40")
def test_newer_releases_start_lifecycle_nodes_by_themselves() -> None:
    component = ComposableLifecycleNode(package="demo", plugin="demo::Arm", autostart=True)
    node = LifecycleNode(executable="tool", name="n", namespace="", autostart=True)
    assert component.node_autostart is node.node_autostart is True
    assert node.is_lifecycle_node
    assert component._to_model().autostart is not None
    assert LifecycleNode(executable="tool", name="n", namespace="").node_autostart is False


@pytest.mark.conforms(
    "1.12 PushROSNamespace",
    "1.12 SetRemap",
    "1.12 SetParameter",
    "1.12 SetROSLogDir",
    "1.12 SetUseSimTime",
    "1.12 ROSTimer",
)
def test_actions_tell_what_they_were_given() -> None:
    name = PushROSNamespace(LC("robot")).namespace
    assert name[0].describe() == "LaunchConfig('robot')"
    remap = SetRemap("a", LC("b"))
    assert (remap.src[0].describe(), remap.dst[0].describe()) == ("'a'", "LaunchConfig('b')")
    parameter = SetParameter("rate", [1, 2])
    assert (parameter.name[0].describe(), parameter.value) == ("'rate'", [1, 2])
    assert SetROSLogDir("logs").log_dir[0].describe() == "'logs'"
    assert SetUseSimTime(True).value is True
    assert [item.describe() for item in SetUseSimTime(LC("s")).value] == ["LaunchConfig('s')"]
    timer = ROSTimer(period=2.0, actions=[remap])
    assert timer.actions == [remap]


def test_a_model_stands_where_the_user_s_line_made_the_object() -> None:
    node = _node(parameters=[{"a": LC("b")}])
    model: Any = model_of(node)
    line = test_a_model_stands_where_the_user_s_line_made_the_object.__code__.co_firstlineno + 1
    source = '    node = _node(parameters=[{"a": LC("b")}])'
    assert Path(model.span.file).name == Path(__file__).name
    (param,) = model.param
    assert model.span.line == _line_of("return Node(")
    for span in (param.value.span, param.value.parts[0].span):
        assert (span.line, span.column) == (line, source.index("LC") + 1)


def _line_of(text: str) -> int:
    lines = Path(__file__).read_text("utf-8").splitlines()
    return next(number for number, line in enumerate(lines, 1) if text in line)


def test_there_is_no_ros_node_while_a_file_is_resolved() -> None:
    for ask in (get_ros_node, get_ros_adapter):
        with pytest.raises(RuntimeError, match="there is no ROS node while a launch file is resolved"):
            ask(LaunchContext())
    with pytest.raises(RuntimeError, match="depends_on"):
        ROSAdapter(autostart=False)


def test_the_default_description_of_older_releases_is_empty() -> None:
    assert get_default_launch_description(prefix_output_with_name=True).entities == []
