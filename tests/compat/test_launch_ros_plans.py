"""What Python says about nodes comes to the plan of the same description in YAML."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.compat.python_plans import of_python, of_yaml
from tests.load.planning import installed

_PARAMETERS = "/**/n:\n  ros__parameters: {from_file: $(var v), other: 1}\n"

_SAME: dict[str, tuple[str, list[dict[str, Any]]]] = {
    "a node of a package": (
        "[Node(package='demo', executable='tool', name='n', namespace='a', exec_name='label', output='screen')]",
        [
            {
                "node": {
                    "pkg": "demo",
                    "exec": "tool",
                    "name": "n",
                    "namespace": "a",
                    "exec_name": "label",
                    "output": "screen",
                }
            }
        ],
    ),
    "arguments": (
        "[Node(package='demo', executable='tool', arguments=['-x', ['a', LC('v', default='b c')], ''],"
        " ros_arguments=['--log-level', 'debug'])]",
        [
            {
                "node": {
                    "pkg": "demo",
                    "exec": "tool",
                    "args": "-x a$(var v 'b c') ''",
                    "ros_args": "--log-level debug",
                }
            }
        ],
    ),
    "remappings": (
        "[SetRemap('c', 'd'), Node(package='demo', executable='tool', name='n',"
        " remappings=[('a', ['b', LC('v', default='1')]), ('/x', 'y')])]",
        [
            {"set_remap": {"from": "c", "to": "d"}},
            {
                "node": {
                    "pkg": "demo",
                    "exec": "tool",
                    "name": "n",
                    "remap": [{"from": "a", "to": "b$(var v 1)"}, {"from": "/x", "to": "y"}],
                }
            },
        ],
    ),
    "parameters": (
        "[SetLaunchConfiguration('v', '5'), Node(package='demo', executable='tool', name='n', namespace='', parameters=["
        "{'i': 1, 'f': 2.0, 'b': True, 's': '5', 'e': '', 'l': [1, 2], 'g': {'h': {'k': LC('v')}},"
        " 't': ParameterValue(LC('v'), value_type=str), 'c': ['a_', LC('v')], 'm': [[LC('v')], ['6']]},"
        " ParameterFile('parameters.yaml', allow_substs=True), 'plain.yaml'])]",
        [
            {"let": {"name": "v", "value": "5"}},
            {
                "node": {
                    "pkg": "demo",
                    "exec": "tool",
                    "name": "n",
                    "namespace": "",
                    "param": [
                        {"name": "i", "value": 1},
                        {"name": "f", "value": 2.0},
                        {"name": "b", "value": True},
                        {"name": "s", "value": "5"},
                        {"name": "e", "value": ""},
                        {"name": "l", "value": [1, 2]},
                        {"name": "g", "param": [{"name": "h", "param": [{"name": "k", "value": "$(var v)"}]}]},
                        {"name": "t", "value": "$(var v)", "type": "str"},
                        {"name": "c", "value": "a_$(var v)"},
                        {"name": "m", "value": ["$(var v)", 6]},
                        {"from": "parameters.yaml", "allow_substs": True},
                        {"from": "plain.yaml"},
                    ],
                }
            },
        ],
    ),
    "parameters of all nodes": (
        "[SetParameter('a', 5), SetParameter(name='t', value='hello world'), SetParameter('l', [1.0, 2.0]),"
        " SetParameter('g', {'h': {'k': True}}), SetParameter('p', ParameterValue(['7'], value_type=List[str])),"
        " SetParametersFromFile('plain.yaml'), Node(package='demo', executable='tool', name='n', namespace='x')]",
        [
            {"set_parameter": {"name": "a", "value": 5}},
            {"set_parameter": {"name": "t", "value": "hello world"}},
            {"set_parameter": {"name": "l", "value": [1.0, 2.0]}},
            {"set_parameter": {"name": "g", "param": [{"name": "h.k", "value": True}]}},
            {"set_parameter": {"name": "p", "value": ["7"], "type": "list_of_str"}},
            {"set_parameters_from_file": {"filename": "plain.yaml"}},
            {"node": {"pkg": "demo", "exec": "tool", "name": "n", "namespace": "x"}},
        ],
    ),
    "namespaces in groups": (
        "[GroupAction([PushROSNamespace('a'), PushRosNamespace([LC('v', default='b')]),"
        " Node(package='demo', executable='tool', name='n')]), Node(package='demo', executable='tool', name='n')]",
        [
            {
                "group": {
                    "children": [
                        {"push_ros_namespace": {"namespace": "a"}},
                        {"push_ros_namespace": {"namespace": "$(var v b)"}},
                        {"node": {"pkg": "demo", "exec": "tool", "name": "n"}},
                    ]
                }
            },
            {"node": {"pkg": "demo", "exec": "tool", "name": "n"}},
        ],
    ),
    "how a node is run": (
        "[Node(package='demo', executable='tool', respawn=True, respawn_delay=2.0,"
        " emulate_tty=True, cwd='/', additional_env={'A': LC('v', default='b')}, prefix='nice -n 5',"
        " condition=IfCondition('true'), sigterm_timeout='3')]",
        [
            {
                "node": {
                    "pkg": "demo",
                    "exec": "tool",
                    "respawn": True,
                    "respawn_delay": 2.0,
                    "emulate_tty": True,
                    "cwd": "/",
                    "env": [{"name": "A", "value": "$(var v b)"}],
                    "launch-prefix": "nice -n 5",
                    "if": True,
                    "sigterm_timeout": 3,
                }
            }
        ],
    ),
    "a node that ends the run": (
        "[Node(package='demo', executable='tool', on_exit=Shutdown())]",
        [{"node": {"pkg": "demo", "exec": "tool", "on_exit": "shutdown"}}],
    ),
    "a condition that does not hold": (
        "[Node(package='demo', executable='tool', name='n', condition=UnlessCondition(LC('v', default='true')))]",
        [{"node": {"pkg": "demo", "exec": "tool", "name": "n", "unless": "$(var v true)"}}],
    ),
    "a container": (
        "[ComposableNodeContainer(package='demo', executable='tool', name='c', namespace='a',"
        " composable_node_descriptions=["
        "ComposableNode(package='demo', plugin='demo::A', name='x', namespace='b', parameters=[{'p': 1}, 'plain.yaml'],"
        " remappings=[('a', 'b')], extra_arguments=[{'use_intra_process_comms': True}]),"
        " ComposableNode(package='demo', plugin='demo::B', condition=IfCondition('false'))]),"
        " LoadComposableNodes(target_container='/a/c', composable_node_descriptions=["
        "ComposableLifecycleNode(package='demo', plugin='demo::C', name='z', autostart=True)])]",
        [
            {
                "node_container": {
                    "pkg": "demo",
                    "exec": "tool",
                    "name": "c",
                    "namespace": "a",
                    "composable_node": [
                        {
                            "pkg": "demo",
                            "plugin": "demo::A",
                            "name": "x",
                            "namespace": "b",
                            "param": [{"name": "p", "value": 1}, {"from": "plain.yaml"}],
                            "remap": [{"from": "a", "to": "b"}],
                            "extra_arg": [{"name": "use_intra_process_comms", "value": True}],
                        },
                        {"pkg": "demo", "plugin": "demo::B", "if": False},
                    ],
                }
            },
            {
                "load_composable_node": {
                    "target": "/a/c",
                    "composable_node": [
                        {"pkg": "demo", "plugin": "demo::C", "name": "z", "autostart": True}
                    ],
                }
            },
        ],
    ),
    "a lifecycle node": (
        "[LifecycleNode(package='demo', executable='tool', name='n', namespace='a', autostart=True)]",
        [{"lifecycle_node": {"pkg": "demo", "exec": "tool", "name": "n", "namespace": "a", "autostart": True}}],
    ),
    "timers, clocks and logs": (
        "[SetROSLogDir('logs'), SetUseSimTime(True), ROSTimer(period=2.0, actions=["
        "Node(package='demo', executable='tool', name='n')]), RosTimer(period=LC('v', default='3'), actions=[])]",
        [
            {"set_ros_log_dir": {"new_log_dir": "logs"}},
            {"set_use_sim_time": {"value": True}},
            {"ros_timer": {"period": 2.0, "children": [{"node": {"pkg": "demo", "exec": "tool", "name": "n"}}]}},
            {"ros_timer": {"period": "$(var v 3)", "children": []}},
        ],
    ),
    "places of packages": (
        "[LogInfo(msg=[FindPackageShare('demo'), ' ', FindPackagePrefix(['de', 'mo']), ' ',"
        " ExecutableInPackage('tool', 'demo')])]",
        [{"log": {"message": "$(find-pkg-share demo) $(find-pkg-prefix demo) $(exec-in-pkg tool demo)"}}],
    ),
}  # fmt: skip


@pytest.mark.conforms(
    "1.12 Node",
    "1.12 SetParameter",
    "1.12 SetParametersFromFile",
    "1.12 SetRemap",
    "1.12 SetROSLogDir",
    "1.12 SetUseSimTime",
    "1.12 ROSTimer",
    "1.12 ComposableNodeContainer",
    "1.12 LoadComposableNodes",
    "1.12.1 package",
    "1.12.1 arguments",
    "1.12.1 other keywords",
    "1.13 ComposableNode",
)
@pytest.mark.parametrize(("body", "actions"), _SAME.values(), ids=_SAME)
def test_both_give_one_plan(body: str, actions: list[dict[str, Any]], tmp_path: Path) -> None:
    environment = installed(tmp_path)
    (tmp_path / "parameters.yaml").write_text(_PARAMETERS, "utf-8")
    (tmp_path / "plain.yaml").write_text("/**:\n  ros__parameters: {plain: 2}\n", "utf-8")
    python, yaml = of_python(tmp_path, body, environment), of_yaml(tmp_path, actions, environment)
    assert python.messages == yaml.messages
    assert _without_written(python.content) == _without_written(yaml.content)
    assert not [problem for problem in python.problems if problem.severity.value == "error"]


def _without_written(content: dict[str, Any]) -> dict[str, Any]:
    """Leave out what quotes the description: what is skipped says its condition as written."""
    skipped = [{**item, "expression": None} for item in content["skipped"]]
    return {**content, "skipped": skipped}


_FAULTS: dict[str, tuple[str, str]] = {
    "a package that is missing": ("Node(package='dmeo', executable='tool')", "there is no package 'dmeo'"),
    "an executable that is missing": ("Node(package='demo', executable='tol')", "has no executable 'tol'"),
    "a parameter file that is missing": (
        "Node(package='demo', executable='tool', parameters=['gone.yaml'])",
        "there is no parameter file",
    ),
    "a name that cannot be one": (
        "Node(package='demo', executable='tool', name='a b')",
        "cannot be a node's name",
    ),
    "a namespace that cannot be one": ("PushROSNamespace('a b')", "cannot be a namespace"),
    "parameters of a wrong type": (
        "Node(package='demo', executable='tool', parameters={'a': 1})",
        "'parameters' of a Node is a list",
    ),
    "a value that cannot be one": (
        "Node(package='demo', executable='tool', parameters=[{'a': None}])",
        "None is no value of a parameter",
    ),
    "a value that is not of its type": (
        "Node(package='demo', executable='tool', parameters=[{'a': ParameterValue(LC('v', default='x'), value_type=int)}])",
        "'x' is no integer",
    ),
    "a package that is asked for": ("LogInfo(msg=FindPackageShare('dmeo'))", "there is no package 'dmeo'"),
    "a ROS node": (
        "OpaqueFunction(function=__import__('launch_ros').ros_adapters.get_ros_node)",
        "there is no ROS node while a launch file is resolved",
    ),
}


@pytest.mark.conforms("D18", "4.4 invalid")
@pytest.mark.parametrize(("action", "message"), _FAULTS.values(), ids=_FAULTS)
def test_a_fault_is_told_at_the_user_s_line(action: str, message: str, tmp_path: Path) -> None:
    body = f"""
        before = LogInfo(msg='x')
        found = {action}
        return LaunchDescription([before, found])
    """
    found = of_python(tmp_path, body, installed(tmp_path))
    (problem,) = [item for item in found.problems if item.severity.value == "error"]
    assert message in problem.message
    assert problem.span is not None
    text = (tmp_path / "a.launch.py").read_text("utf-8")
    line = next(number for number, line in enumerate(text.splitlines(), 1) if "found = " in line)
    assert (Path(problem.span.file).name, problem.span.line) == ("a.launch.py", line)


def test_words_appended_to_the_command_are_ros_arguments(tmp_path: Path) -> None:
    """Upstream's command line ends with `--ros-args` until the node is visited."""
    body = """
        plain = Node(executable='/bin/true', arguments=['a'])
        plain.cmd.append([TextSubstitution(text='--log-level')])
        plain.cmd.append([TextSubstitution(text='warn')])
        with_ros = Node(executable='/bin/true', arguments=['a'], ros_arguments=['--log-level', 'info'])
        with_ros.cmd.append([TextSubstitution(text='-r'), ])
        with_ros.cmd.append([TextSubstitution(text='x:=y'), ])
        return LaunchDescription([plain, with_ros])
    """
    found = of_python(tmp_path, body)
    assert [process["command"] for process in found.content["processes"]] == [
        ["/bin/true", "a", "--ros-args", "--log-level", "warn", "--ros-args"],
        ["/bin/true", "a", "--ros-args", "--log-level", "info", "-r", "x:=y", "--ros-args"],
    ]


@pytest.mark.conforms("4.7 target")
def test_a_component_is_loaded_into_the_container_of_an_action(tmp_path: Path) -> None:
    body = """
        container = ComposableNodeContainer(
            package='demo', executable='tool', name='c', namespace=LC('ns', default='a'))
        component = ComposableNode(package='demo', plugin='demo::A', name='x')
        load = LoadComposableNodes(target_container=container, composable_node_descriptions=[component])
        nothing = LoadComposableNodes(target_container=container, composable_node_descriptions=[])
        return LaunchDescription([container, load, nothing])
    """
    found = of_python(tmp_path, body, installed(tmp_path))
    assert found.messages == []
    assert [(item["id"], item["container"]) for item in found.content["components"]] == [("/x", "/a/c")]


@pytest.mark.conforms("4.6.2 Parameter")
def test_parameter_is_for_every_node_in_the_process(tmp_path: Path) -> None:
    """`Parameter` is `-p` upstream: what an exact section said before counts all the same."""
    body = "[Node(executable='/bin/true', name='n', namespace='', parameters=[{'a': 1}, Parameter('a', 2)])]"
    found = of_python(tmp_path, body)
    assert found.process["parameters"] == {"a": 2}


def test_a_subclass_of_a_node_is_a_node(tmp_path: Path) -> None:
    body = """
        class Tool(Node):
            def __init__(self, **keywords):
                super().__init__(executable='/bin/true', **keywords)

        class Loud(Tool):
            def execute(self, context):
                found = super().execute(context)
                return [LogInfo(msg='started ' + self.node_name), *(found or [])]

        return LaunchDescription([Tool(name='a', namespace=''), Loud(name='b', namespace='')])
    """
    found = of_python(tmp_path, body)
    assert found.messages == []
    assert [process["id"] for process in found.content["processes"]] == ["/a", "/b"]
    (trigger,) = found.content["triggers"]
    assert [step["message"] for step in trigger["do"]] == ["started /b"]


@pytest.mark.conforms("1.12.1 node_name")
def test_user_code_that_comes_later_knows_the_names(tmp_path: Path) -> None:
    body = """
        node = Node(executable='/bin/true', name='n', remappings=[('a', 'b')])

        def tell(context):
            return [LogInfo(msg=' '.join([node.node_name, node.expanded_node_namespace, *node.expanded_remapping_rules[-1]]))]

        return LaunchDescription([PushROSNamespace('x'), node, OpaqueFunction(function=tell)])
    """
    found = of_python(tmp_path, body)
    assert found.messages == []
    (trigger,) = found.content["triggers"]
    assert [step["message"] for step in trigger["do"]] == ["/x/n /x a b"]


def test_a_package_finder_of_a_user_finds_its_own_places(tmp_path: Path) -> None:
    body = """
        from launch_ros.substitutions import FindPackage

        class FindPackageConfig(FindPackage):
            def find(self, package_name):
                return '/etc/' + package_name

        finder = FindPackageConfig(LC('p', default='demo'))
        share = FindPackageShare('demo').find('demo')
        return LaunchDescription([LogInfo(msg=finder), LogInfo(msg=finder.perform(LaunchContext())), LogInfo(msg=share)])
    """
    environment = installed(tmp_path)
    found = of_python(tmp_path, body, environment)
    assert found.messages == []
    messages = [step["message"] for trigger in found.content["triggers"] for step in trigger["do"]]
    assert messages == ["/etc/demo", "/etc/demo", f"{environment['AMENT_PREFIX_PATH']}/share/demo"]


def test_user_code_may_go_on_without_a_package(tmp_path: Path) -> None:
    body = """
        from ament_index_python.packages import PackageNotFoundError

        context = LaunchContext()
        missing = []
        for finder in (FindPackageShare('gone'), FindPackagePrefix('gone')):
            try:
                finder.perform(context)
            except PackageNotFoundError as error:
                missing.append(type(error).__name__)
        return LaunchDescription([LogInfo(msg=' '.join(missing))])
    """
    found = of_python(tmp_path, body)
    assert found.messages == []
    (trigger,) = found.content["triggers"]
    assert trigger["do"][0]["message"] == "PackageNotFoundError PackageNotFoundError"
