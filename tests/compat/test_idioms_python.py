"""What public launch files do, each idiom in a file of our own: they resolve as upstream resolves them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from tests.compat.idioms import planned

if TYPE_CHECKING:
    from pathlib import Path

INNER = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("x_pose", default_value="a"),
        DeclareLaunchArgument("y_pose", default_value="b"),
        Node(package="demo", executable="talker", arguments=[LaunchConfiguration("x_pose")]),
    ])
"""

# What is unusual: the file, its command lines.
COMMANDS: dict[str, tuple[str, list[str]]] = {
    "a share folder is found while the file is loaded": (
        "return LaunchDescription([Node(package='demo', executable='talker', "
        "arguments=[FindPackageShare(package='demo').find('demo').rpartition('/')[2]])])",
        ["talker demo --ros-args"],
    ),
    "a prefix is a script of a shell": (
        """[Node(package="demo", executable="talker", prefix='bash -c "sleep 5; $0 $@"')]""",
        ["bash -c sleep 5; $0 $@ {demo}/talker --ros-args"],
    ),
    "remappings are a set, or the items of a mapping": (
        "[Node(package='demo', executable='talker', remappings={('a', 'b')}),"
        "Node(package='demo', executable='talker', remappings={'c': 'd'}.items())]",
        ["talker --ros-args -r a:=b", "talker --ros-args -r c:=d"],
    ),
    "choices are one text that lists them": (
        """[DeclareLaunchArgument("rover", default_value="f120", choices="'mega3', 'f120'"),
            DeclareLaunchArgument("option", default_value="", choices="'', '_lrf'"),
            Node(package="demo", executable="talker", arguments=[LC("rover"), [LC("option"), "."]])]""",
        ["talker f120 . --ros-args"],
    ),
    "arguments come out of a generator": (
        "[Node(package='demo', executable='talker', arguments=(str(item) for item in range(2)))]",
        ["talker 0 1 --ros-args"],
    ),
    "expressions use all of Python": (
        """[DeclareLaunchArgument("x", default_value="1.5"), Node(package="demo", executable="talker", arguments=[
            PythonExpression(["__import__('os').path.basename('/a/b')"]),
            PythonExpression(["(lambda value: value * 2)(", LC("x"), ")"]),
            PythonExpression(["os.path.basename('/a/c')"], ["os"]),
            PythonExpression(["f'{", LC("x"), ":.3f}'"]),
        ])]""",
        ["talker b 3.0 c 1.500 --ros-args"],
    ),
    "a context of one's own performs substitutions while the file is loaded": (
        """
        context = LaunchContext()
        context.launch_configurations["q"] = "w"
        known = [Command(["echo ", "hello"]).perform(context), LC("q").perform(context)]
        return LaunchDescription([Node(package="demo", executable="talker", arguments=known)])
        """,
        ["talker hello w --ros-args"],
    ),
    "a function yields actions": (
        """
        def made(context):
            yield Node(package="demo", executable="talker", name=LC("n").perform(context))
            yield LaunchDescription([Node(package="demo", executable="listener")])
        return LaunchDescription([DeclareLaunchArgument("n", default_value="m"), OpaqueFunction(function=made)])
        """,
        ["talker --ros-args -r __node:=m", "listener --ros-args"],
    ),
    "the list of entities is edited": (
        """
        ld = LaunchDescription()
        ld.entities.append(Node(package="demo", executable="talker"))
        ld.entities.insert(0, Node(package="demo", executable="listener"))
        return ld
        """,
        ["listener --ros-args", "talker --ros-args"],
    ),
    "an included file is given more than it takes, with names like those that it has": (
        """[IncludeLaunchDescription(PythonLaunchDescriptionSource([ThisLaunchFileDir(), "/inner.launch.py"]),
            launch_arguments={"x_pose": "1", "z_pose": "2", "rviz": "no"}.items())]""",
        ["talker 1 --ros-args"],
    ),
    "two nodes have one name": (
        "[Node(package='demo', executable='talker', name='n'), Node(package='demo', executable='listener', name='n')]",
        ["talker --ros-args -r __node:=n", "listener --ros-args -r __node:=n"],
    ),
    "a substitution cannot describe itself": (
        """
        class Odd(Substitution):
            def describe(self):
                return "".join(item.describe() for item in ["text"])
            def perform(self, context):
                return "performed"
        return LaunchDescription([Node(package="demo", executable="talker", arguments=[Odd()])])
        """,
        ["talker performed --ros-args"],
    ),
    "a condition cannot describe itself": (
        """
        class Odd(launch.Condition):
            def describe(self):
                raise RuntimeError("no words")
        holds = Odd(predicate=lambda context: context.launch_configurations["x"] == "y")
        return LaunchDescription([DeclareLaunchArgument("x", default_value="y"),
                                  Node(package="demo", executable="talker", condition=holds)])
        """,
        ["talker --ros-args"],
    ),
    "a word comes out of an iterator": (
        """
        import itertools
        rule = itertools.chain.from_iterable((("-r ", LC("c", default="c"), ":"), ("a:=b",)))
        return LaunchDescription([Node(package="demo", executable="talker", arguments=["--args", rule])])
        """,
        ["talker --args -r c:a:=b --ros-args"],
    ),
    "a source changes what is in the file that it reads": (
        """
        from launch.utilities import normalize_to_list_of_substitutions as normalized
        class Changed(PythonLaunchDescriptionSource):
            def _get_launch_description(self, location):
                description = super()._get_launch_description(location)
                for node in description.entities:
                    if isinstance(node, Node) and node.node_executable == "talker":
                        rules = list(node._Node__remappings or [])
                        node._Node__remappings = [*rules, (normalized("/tf"), normalized("tf"))]
                return LaunchDescription([GroupAction(description.entities)])
        return LaunchDescription([IncludeLaunchDescription(Changed([ThisLaunchFileDir(), "/inner.launch.py"]))])
        """,
        ["talker a --ros-args -r /tf:=tf"],
    ),
    "a description is asked for its arguments before it is included": (
        """
        source = PythonLaunchDescriptionSource(str(Path(__file__).parent / "inner.launch.py"))
        known = source.get_launch_description(LaunchContext()).get_launch_arguments()
        mine = [argument for argument in known if argument.name != "y_pose"]
        given = [(argument.name, [LC(argument.name), "+"]) for argument in mine]
        return LaunchDescription([*mine, IncludeLaunchDescription(source, launch_arguments=given)])
        """,
        ["talker a+ --ros-args"],
    ),
    "an include of one's own has a scope": (
        """
        class Scoped(IncludeLaunchDescription):
            def execute(self, context):
                assert self._try_get_arguments_names_without_context() == ["x_pose"]
                inner = self.launch_description_source.get_launch_description(context)
                assert self._get_launch_file() == self._get_launch_file_directory() + "/inner.launch.py"
                settings = [SetLaunchConfiguration(name, value) for name, value in self.launch_arguments]
                return [PushLaunchConfigurations(), *settings, inner, PopLaunchConfigurations()]
        source = PythonLaunchDescriptionSource([ThisLaunchFileDir(), "/inner.launch.py"])
        after = Node(package="demo", executable="listener", arguments=[LC("x_pose", default="unset")])
        return LaunchDescription([Scoped(source, launch_arguments={"x_pose": "1"}.items()), after])
        """,
        ["talker 1 --ros-args", "listener unset --ros-args"],
    ),
    "rules for all nodes are appended to upstream's list": (
        """
        def rules(context):
            known = context.launch_configurations.get("ros_remaps", [])
            known.append(("a", "b"))
            context.launch_configurations["ros_remaps"] = known
        return LaunchDescription([SetRemap("x", "y"), OpaqueFunction(function=rules),
                                  Node(package="demo", executable="talker")])
        """,
        ["talker --ros-args -r x:=y -r a:=b"],
    ),
    "defaults are decided while the context is at hand": (
        """
        class Either(Substitution):
            def __init__(self, chosen, other, holds):
                self.texts = chosen, other
                self.holds = holds
            def perform(self, context):
                return self.texts[0] if self.holds else self.texts[1]
        def setup(context):
            stereo = IfCondition(PythonExpression(["'", LC("mode"), "' == 'stereo'"]))._predicate_func(context)
            return [DeclareLaunchArgument("depth", default_value=Either("false", "true", stereo)),
                    DeclareLaunchArgument("rgb", default_value=LC("depth")),
                    Node(package="demo", executable="talker", arguments=[["--rgb=", LC("rgb")], LC("none", default="")])]
        return LaunchDescription([DeclareLaunchArgument("mode", default_value="mono"), OpaqueFunction(function=setup)])
        """,
        ["talker --rgb=true  --ros-args"],
    ),
    "what is missing is done without": (
        """
        from ament_index_python.packages import PackageNotFoundError
        try:
            get_package_share_directory("no_such_package")
        except PackageNotFoundError:
            found = []
        def known(context):
            try:
                return [Node(package="demo", executable="listener", name=LC("unset").perform(context))]
            except Exception:
                return [Node(package="demo", executable="talker")]
        return LaunchDescription([*found, OpaqueFunction(function=known)])
        """,
        ["talker --ros-args"],
    ),
    "conditions of one's own are made of upstream's": (
        """
        from launch.conditions import evaluate_condition_expression
        from launch.utilities import normalize_to_list_of_substitutions
        class All(launch.Condition):
            def __init__(self, conditions):
                self.__all = [normalize_to_list_of_substitutions(item) for item in conditions]
                super().__init__(predicate=self._predicate_func)
            def _predicate_func(self, context):
                return all(evaluate_condition_expression(context, item) for item in self.__all)
        return LaunchDescription([
            DeclareLaunchArgument("a", default_value="True"),
            Node(package="demo", executable="talker", condition=All([LC("a"), "1"])),
            Node(package="demo", executable="listener", condition=All([LC("a"), "0"])),
        ])
        """,
        ["talker --ros-args"],
    ),
    "modules have the names that upstream's import, and submodules their place": (
        """
        from launch_ros.actions.node import ParameterFile as File, SomeRemapRules
        from launch.actions.execute_process import ExecuteProcess as Process
        made: launch.some_substitutions_type.SomeSubstitutionsType = ["a", "b"]
        assert launch.launch_context.LaunchContext is LaunchContext
        assert launch_ros.parameter_descriptions.ParameterFile is File
        from launch_ros.parameters_type import ParameterDescription, ParameterValueDescription
        assert ParameterDescription is launch_ros.parameter_descriptions.Parameter
        assert ParameterValueDescription is launch_ros.parameter_descriptions.ParameterValue
        return LaunchDescription([Process(cmd=["ls", made])])
        """,
        ["ls ab"],
    ),
}


@pytest.mark.parametrize(("code", "commands"), COMMANDS.values(), ids=list(COMMANDS))
def test_files_resolve_that_upstream_resolves(tmp_path: Path, code: str, commands: list[str]) -> None:
    plan = planned(tmp_path, code, files={"inner.launch.py": INNER})
    assert plan.errors == []
    assert plan.commands == [
        command.replace("{demo}", f"{tmp_path}/install/lib/demo") for command in commands
    ]


def test_what_is_launched_may_depend_on_the_words_of_the_command_line(tmp_path: Path) -> None:
    code = """
    given = dict(word.split(":=") for word in sys.argv if ":=" in word)
    return LaunchDescription([DeclareLaunchArgument("n"), Node(package="demo", executable="talker", name=given["n"])])
    """
    assert planned(tmp_path, code, "n:=there").commands == ["talker --ros-args -r __node:=there"]


def test_what_upstream_lets_pass_is_told(tmp_path: Path) -> None:
    given = """[IncludeLaunchDescription(PythonLaunchDescriptionSource([ThisLaunchFileDir(), "/inner.launch.py"]),
        launch_arguments={"x_pose": "1", "z_pose": "2"}.items())]"""
    (told,) = planned(tmp_path, given, files={"inner.launch.py": INNER}).warnings
    assert "'z_pose'" in told
    twice = "[Node(package='demo', executable='talker', name='n')] * 1 + [Node(executable='ls', name='n')]"
    assert planned(tmp_path, twice).warnings == ["two nodes are called '/n'"]


def test_parameters_for_all_nodes_are_appended_to_upstreams_list(tmp_path: Path) -> None:
    code = """
    class Everywhere(launch.Action):
        def execute(self, context):
            known = context.launch_configurations.get("global_params", [])
            known += [("b", 2), str(Path(__file__).parent / "some.yaml")]
            context.launch_configurations["global_params"] = known
    return LaunchDescription([SetParameter("a", 1), Everywhere(), Node(package="demo", executable="talker", name="n")])
    """
    plan = planned(tmp_path, code, files={"some.yaml": "/**: {ros__parameters: {c: 3}}\n"})
    assert plan.errors == []
    assert plan.parameters == [{"a": 1, "b": 2, "c": 3}]


def test_a_parameter_file_is_optional_where_its_path_may_be_empty(tmp_path: Path) -> None:
    code = """[DeclareLaunchArgument("f", default_value=""),
        Node(package="demo", executable="talker", name="n", parameters=[LC("f"), {"a": 1}])]"""
    plan = planned(tmp_path, code)
    assert plan.errors == []
    assert plan.parameters == [{"a": 1}]
    assert plan.warnings == []
    fixed = '[Node(package="demo", executable="talker", name="n", parameters=[""])]'
    assert planned(tmp_path, fixed).warnings == ["the path of the parameter file is empty"]


def test_a_source_without_a_file_is_told(tmp_path: Path) -> None:
    code = """
    def read(context):
        return [PythonLaunchDescriptionSource("gone.launch.py").get_launch_description(context)]
    return LaunchDescription([OpaqueFunction(function=read)])
    """
    assert planned(tmp_path, code).errors == ["FileNotFoundError: there is no launch file gone.launch.py"]


def test_standard_output_is_kept_clean_of_what_code_and_its_programs_write(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    code = """
    import subprocess
    print("printed")
    os.system("echo by a shell")
    subprocess.run(["echo", "by a program"], check=True)
    return LaunchDescription([])
    """
    assert planned(tmp_path, code).errors == []
    written = capfd.readouterr()
    assert written.out == ""
    assert all(text in written.err for text in ("printed", "by a shell", "by a program"))


MISSING = {
    "beside the launch file": "Path(__file__).parent / 'gone.yaml'",
    "by a relative path": "'config/gone.yaml'",
    "in a package": "PathJoinSubstitution([FindPackageShare('demo'), 'config', 'gone.yaml'])",
    "read by a substitution": "ParameterFile('/etc/robot/gone.yaml', allow_substs=True)",
}


@pytest.mark.conforms("D18", "4.6.3 files given by path")
@pytest.mark.parametrize("path", MISSING.values(), ids=list(MISSING))
def test_a_parameter_file_of_the_description_must_be_there(tmp_path: Path, path: str) -> None:
    (told,) = planned(tmp_path, f"[Node(package='demo', executable='talker', parameters=[{path}])]").errors
    assert told.startswith("there is no parameter file")


@pytest.mark.conforms("D18", "4.6.3 files given by path")
def test_a_parameter_file_of_the_machine_may_come_later(tmp_path: Path) -> None:
    code = (
        "[Node(package='demo', executable='talker', name='n', parameters=['/etc/robot/gone.yaml', {'a': 1}])]"
    )
    plan = planned(tmp_path, code)
    assert plan.errors == []
    assert plan.parameters == [{"a": 1}]
    assert plan.warnings == [
        "there is no parameter file /etc/robot/gone.yaml: the node is started without it"
    ]


@pytest.mark.parametrize(
    "path", ["'/etc/robot/gone.yaml'", "ParameterFile('/etc/robot/gone.yaml', allow_substs=True)"]
)
def test_where_nothing_is_started_a_parameter_file_may_be_on_another_machine(
    tmp_path: Path, path: str
) -> None:
    file = tmp_path / "a.launch.py"
    file.write_text(
        "from launch import LaunchDescription\n"
        "from launch_ros.actions import Node\n"
        "from launch_ros.descriptions import ParameterFile\n"
        "def generate_launch_description():\n"
        f"    return LaunchDescription([Node(executable='true', parameters=[{path}])])\n",
        "utf-8",
    )
    problems = Problems()
    inputs = inputs_from([], environment={"PATH": "/usr/bin:/bin"})
    collect(str(file), replace(inputs, launching=False), problems)
    assert list(problems) == []
