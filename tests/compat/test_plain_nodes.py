"""Nodes that are made in one walk through their arguments are what the constructor makes of them."""

from __future__ import annotations

import copy
import re
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from orchestra.compat import refusing
from orchestra.compat.building import model_of
from orchestra.compat.launch import Substitution
from orchestra.compat.launch.actions import ExecuteProcess, Shutdown
from orchestra.compat.launch.conditions import IfCondition, UnlessCondition
from orchestra.compat.launch.substitutions import (
    EnvironmentVariable,
    LaunchConfiguration,
    PathJoinSubstitution,
    TextSubstitution,
    ThisLaunchFileDir,
)
from orchestra.compat.launch_ros.actions import LifecycleNode, Node
from orchestra.compat.launch_ros.descriptions import ComposableNode, ParameterFile, ParameterValue
from orchestra.compat.launch_ros.substitutions import FindPackageShare
from orchestra.compat.refusing import collecting
from orchestra.description.entity import Entity
from orchestra.errors import Problems
from orchestra.location import Span
from orchestra.pipeline import collect, inputs_from
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path


class _Own(Substitution):
    def perform(self, context: Any) -> str:
        del context
        return "own"


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({"PATH": "/usr/bin:/bin"}):
        yield


def _made(keywords: dict[str, Any], kind: type[Any] = Node, *, plainly: bool = True) -> Any:
    """Return a node or a component that code of a launch file makes, at the same place each time."""
    with pytest.MonkeyPatch.context() as patch, collecting(Problems(), ()):
        if not plainly:
            patch.setattr(kind, "_taken", lambda *_: False)
            patch.delitem(refusing._keeping, kind)
        return kind(**keywords)


def _model(made: Any) -> Any:
    return made._to_model() if isinstance(made, ComposableNode) else model_of(made)


def _is_plain(made: Any) -> bool:
    return "_plain" in vars(made)


def _told(made: Any) -> tuple[str, dict[str, Span]]:
    """Return all that is said of the model of a node, and where each part of it stands."""
    model = _model(made)
    spans: dict[str, Span] = {}

    def walk(value: Any, way: str) -> None:
        span = value if isinstance(value, Span) else getattr(value, "span", None)
        if span is not None:
            spans[way] = span
        if isinstance(value, Entity):
            for name, item in vars(value).items():
                walk(item, f"{way}.{name}")
        elif isinstance(value, tuple):
            for index, item in enumerate(value):
                walk(item, f"{way}[{index}]")
        for name in ("parts", "arguments"):
            if hasattr(value, name):
                walk(getattr(value, name), f"{way}.{name}")

    walk(model, "")
    fields = sorted((name, repr(value)) for name, value in vars(model).items())
    return repr((type(model), fields, model.faults, model.faulty, model.origin is made)), spans


_BY_NAME: dict[str, Callable[[], Any]] = {
    "LaunchConfiguration": lambda: LaunchConfiguration("x"),
    "with a default": lambda: LaunchConfiguration("y", default=["a", LaunchConfiguration("x")]),
    "joined": lambda: PathJoinSubstitution([FindPackageShare("demo"), "config", "a b.yaml"]),
    "of the environment": lambda: EnvironmentVariable("HOME", default_value=""),
    "folder": ThisLaunchFileDir,
    "text": lambda: TextSubstitution(text="$(t)"),
    "own": _Own,
}
_WORDS = st.sampled_from(["", "a", "a b", "$(var x)", "it's", "\\", "ü", "/ns", "screen", "true", "1.5"])
_SUBS = st.sampled_from(sorted(_BY_NAME)).map(lambda name: _BY_NAME[name]())
_MIXED = st.lists(st.one_of(_WORDS, _SUBS), max_size=3)
_TEXTS = st.one_of(_WORDS, _WORDS, _SUBS, _MIXED, _MIXED.map(tuple))
_SCALARS = st.one_of(_WORDS, st.booleans(), st.integers(-2, 2), st.floats(allow_nan=False))
_TYPES = st.sampled_from([None, str, int, float, bool, list[int], list[str]])


def _typed(value: Any, kind: Any) -> Any:
    """Return a value that says its type, as long as it may be of that."""
    try:
        return ParameterValue(value, value_type=kind)
    except TypeError:
        return ParameterValue(value)


_VALUES = st.one_of(
    *(_SCALARS, _SUBS, _MIXED, st.lists(_SCALARS, max_size=3), st.lists(st.floats(0, 1) | st.integers(0, 2))),
    *(st.builds(_typed, _SCALARS | _SUBS | _MIXED | st.lists(st.integers()), _TYPES), st.none()),
    st.lists(st.lists(_WORDS, max_size=2), max_size=2).map(tuple),
)
_NAMES = st.one_of(st.sampled_from(["a", "b.c", "", "$x"]), st.sampled_from(["d", "e"]))
_DICTIONARIES = st.recursive(
    st.dictionaries(_NAMES, _VALUES, max_size=3),
    lambda inner: st.dictionaries(_NAMES, _VALUES | inner, max_size=2),
    max_leaves=3,
)
_PARAMETERS = st.none() | st.lists(_DICTIONARIES | _TEXTS | st.just("p.yaml").map(ParameterFile), max_size=3)
_REMAPPINGS = st.none() | st.lists(st.tuples(_TEXTS, _TEXTS), max_size=3)
_CONDITIONS = st.sampled_from(
    [None, IfCondition(LaunchConfiguration("c")), UnlessCondition("false"), IfCondition("perhaps"), "x"]
)
_END = Shutdown()
_PLACES = {"stdout": "screen", "stderr": "log"}
_OF_PROCESSES = st.fixed_dictionaries(
    {},
    optional={
        **dict.fromkeys(("name", "prefix", "cwd"), st.none() | _TEXTS),
        "output": st.sampled_from(
            [
                None,
                "screen",
                "log",
                "both",
                "scren",
                ["screen"],
                LaunchConfiguration("o"),
                _PLACES,
                {"both": ["log"]},
                {},
            ]
        ),
        "emulate_tty": st.sampled_from([None, True, False, "true"]),
        "respawn": st.sampled_from([True, False, "true"]) | _SUBS | _MIXED | _MIXED.map(tuple),
        "respawn_delay": st.sampled_from([None, 0, 2, 1.5, -1.0, float("inf"), "2"]),
        **dict.fromkeys(("env", "additional_env"), st.none() | st.dictionaries(_WORDS, _TEXTS, max_size=2)),
        "condition": _CONDITIONS,
        "shell": st.booleans(),
        "respawn_max_retries": st.sampled_from([-1, 0, 2, True, "2", -2]),
        **dict.fromkeys(
            ("sigterm_timeout", "sigkill_timeout"), st.sampled_from([None, "3", 3, "", "-1", "x", "²"])
        ),
        "on_exit": st.sampled_from([None, _END, [_END], [_END, _END], Shutdown(reason="why"), (_END,), []]),
    },
)
_COMMANDS = st.tuples(
    st.fixed_dictionaries({"cmd": st.lists(_TEXTS, max_size=3) | _TEXTS}), _OF_PROCESSES
).map(lambda both: both[0] | both[1])
_OF_NODES = st.fixed_dictionaries(
    {"executable": _TEXTS},
    optional={
        **dict.fromkeys(("package", "namespace", "exec_name"), st.none() | _TEXTS),
        "parameters": _PARAMETERS,
        "remappings": _REMAPPINGS,
        "arguments": st.none() | st.lists(_TEXTS, max_size=3),
        "ros_arguments": st.none() | st.lists(_TEXTS, max_size=3),
    },
)
_ARGUMENTS = st.tuples(_OF_NODES, _OF_PROCESSES).map(lambda both: both[0] | both[1])
_OF_LIFECYCLE_NODES = st.tuples(
    _ARGUMENTS,
    st.fixed_dictionaries(
        {"name": _TEXTS, "namespace": st.none() | _TEXTS},
        optional={"autostart": st.sampled_from([True, False, None, "true", LaunchConfiguration("auto")])},
    ),
).map(lambda both: both[0] | both[1])


_OF_COMPONENTS = st.fixed_dictionaries(
    {"package": _TEXTS, "plugin": _TEXTS},
    optional={
        **dict.fromkeys(("name", "namespace", "params_schema"), st.none() | _TEXTS),
        "parameters": _PARAMETERS,
        "remappings": _REMAPPINGS,
        "extra_arguments": _PARAMETERS,
        "condition": _CONDITIONS,
    },
)


@given(
    _ARGUMENTS.map(lambda words: (Node, words))
    | _OF_LIFECYCLE_NODES.map(lambda words: (LifecycleNode, words))
    | _OF_COMPONENTS.map(lambda words: (ComposableNode, words))
    | _COMMANDS.map(lambda words: (ExecuteProcess, words))
)
@settings(max_examples=500, deadline=None)
def test_the_model_is_the_one_of_the_constructor(made: tuple[type[Any], dict[str, Any]]) -> None:
    kind, keywords = made
    try:
        ordinary = _made(keywords, kind, plainly=False)
    except TypeError as error:
        with pytest.raises(type(error), match=re.escape(str(error))):
            _made(keywords, kind)
        return
    plain = _made(keywords, kind)
    assert not _is_plain(ordinary)
    if not _is_plain(plain):
        return
    try:
        expected = _told(ordinary)
    except Exception as error:  # noqa: BLE001 - whatever a value is refused with
        with pytest.raises(type(error)):
            _told(plain)
        return
    assert _told(plain) == expected
    assert _is_plain(plain) or kind is ComposableNode  # whose condition may take a closer look
    # When somebody has looked at it, it still is.
    if issubclass(kind, ExecuteProcess):
        assert [*map(str, plain.cmd[0])] == [*map(str, ordinary.cmd[0])]
    else:
        assert [*map(str, plain.package)] == [*map(str, ordinary.package)]
    assert not _is_plain(plain)
    assert _told(plain) == expected


_USUAL: dict[str, Any] = {
    "package": "demo",
    "executable": "talker",
    "name": ["a", LaunchConfiguration("x")],
    "namespace": LaunchConfiguration("x"),
    "parameters": ["p.yaml", {"a": {"b": [1, 2.5]}, "c": [LaunchConfiguration("x"), "/d"]}],
    "remappings": [("a", ["/", LaunchConfiguration("x")])],
    "arguments": ["--x", LaunchConfiguration("x")],
    "output": "screen",
    "emulate_tty": True,
    "additional_env": {"A": "1"},
    "condition": IfCondition(LaunchConfiguration("c")),
}


def test_usual_nodes_are_made_so() -> None:
    node = _made(_USUAL)
    assert _is_plain(node)
    assert _model(node).if_ is not None
    assert _is_plain(node)


_COMPONENT: dict[str, Any] = {
    "package": "demo",
    "plugin": "demo::Talker",
    "extra_arguments": [{"use_intra_process_comms": True}],
    **{name: _USUAL[name] for name in ("name", "namespace", "parameters", "remappings", "condition")},
}


def test_usual_lifecycle_nodes_are_made_so() -> None:
    node = _made({**_USUAL, "autostart": True, "on_exit": Shutdown(), "sigterm_timeout": "3"}, LifecycleNode)
    assert _is_plain(node)
    assert (_model(node).autostart.raw, _model(node).on_exit.raw) == ("true", "shutdown")
    assert _is_plain(node)
    assert node.node_autostart is True
    assert not _is_plain(node)
    assert not _is_plain(_made({**_USUAL, "on_exit": Shutdown(reason="why")}))


def test_usual_processes_are_made_so_until_somebody_asks() -> None:
    given = {name: _USUAL[name] for name in ("name", "output", "additional_env", "condition")}
    process = _made({"cmd": ["echo", LaunchConfiguration("x")], "env": {"B": "2"}, **given}, ExecuteProcess)
    assert _is_plain(process)
    model = _model(process)
    assert ([word.raw for word in model.cmd], model.env_only[0].name.raw) == (["echo", "$(var x)"], "B")
    assert _is_plain(process)
    process.cmd.append([TextSubstitution(text="-v")])
    assert [word.raw for word in _model(process).cmd] == ["echo", "$(var x)", "-v"]
    process = _made({"cmd": ["echo"]}, ExecuteProcess)
    process._prepared_by(lambda: ("echo-1", ["echo"], None, {"A": "1"}))
    assert (process.name, process.cmd, process.env) == ("echo-1", ["echo"], {"A": "1"})

    class Mine(ExecuteProcess):
        pass

    for kind, more in ((Mine, {}), (ExecuteProcess, {"cached_output": True})):
        assert not _is_plain(_made({"cmd": ["echo"], **more}, kind))


def test_usual_components_are_made_so_until_somebody_asks_or_changes_something() -> None:
    component = _made(_COMPONENT, ComposableNode)
    assert _model(component).if_ is not None
    assert _is_plain(component)
    copied = copy.copy(component)
    copied._ComposableNode__package = [TextSubstitution(text="other")]  # what some files do
    assert [_model(item).pkg.raw for item in (component, copied)] == ["demo", "other"]
    assert (_is_plain(component), _is_plain(copied)) == (True, False)

    class Mine(ComposableNode):
        pass

    assert not _is_plain(_made(_COMPONENT, Mine))


@pytest.mark.parametrize("name", ["parameters", "remappings", "arguments", "additional_env"])
def test_what_happens_to_arguments_later_is_not_seen(name: str) -> None:
    keywords = copy.deepcopy(_USUAL)
    node = _made(keywords)
    expected = _told(node)
    for held in keywords["parameters"][1:], keywords["parameters"][1]["a"]["b"], keywords["remappings"][0][1]:
        held.clear()
    keywords[name].clear()
    assert _told(node) == expected
    assert node.cmd  # whose words are made now
    assert _told(node) == expected


def test_what_is_changed_in_a_substitution_counts() -> None:
    with collecting(Problems(), ()):
        again, log, path = (LaunchConfiguration(name) for name in ("again", "log", "path"))
        late, home = LaunchConfiguration("late", default="x"), EnvironmentVariable("HOME")
        file = ParameterFile([path], allow_substs=True)
    given = {"respawn": again, "output": [log], "prefix": late, "cwd": home, "parameters": [file]}
    for part, field, changed in (
        (again.variable_name, "respawn", "$(var other)"),
        (log.variable_name, "output", "$(var other)"),
        (late.variable_name, "launch_prefix", "$(var other x)"),
        (home.name, "cwd", "$(env other)"),
    ):
        node = _made({**_USUAL, **given})
        assert _is_plain(node)
        part[:] = [TextSubstitution(text="other")]
        assert getattr(_model(node), field).raw == changed
    node = _made({**_USUAL, "parameters": [file]})
    assert _is_plain(node)
    file.param_file[0] = TextSubstitution(text="p.yaml")
    assert [part.from_.raw for part in _model(node).param] == ["p.yaml"]


def test_values_that_say_their_type_are_usual() -> None:
    with collecting(Problems(), ()):
        path = LaunchConfiguration("path")
        held = ParameterValue(["cat ", path], value_type=str)
    node = _made({**_USUAL, "parameters": [{"a": {"b": held}}]})
    assert _is_plain(node)
    told = [(param.name.raw, param.value.raw, param.type.raw) for param in _model(node).param]
    assert told == [("a.b", "cat $(var path)", "str")]
    node = _made({**_USUAL, "parameters": [{"a": held}]})
    assert _is_plain(node)
    held.value[0] = TextSubstitution(text="less ")
    assert [param.value.raw for param in _model(node).param] == ["less $(var path)"]


def test_what_is_wrong_with_a_value_is_all_that_is_told(tmp_path: Path) -> None:
    file = tmp_path / "typed.launch.py"
    file.write_text(
        "from launch import LaunchDescription\n"
        "from launch_ros.actions import ComposableNodeContainer\n"
        "from launch_ros.descriptions import ComposableNode, ParameterValue\n"
        "def generate_launch_description():\n"
        "    value = ParameterValue('12', value_type=int)\n"
        "    part = ComposableNode(package='p', plugin='p::P', parameters=[{'a': {'b': value}}])\n"
        "    return LaunchDescription([ComposableNodeContainer(name='c', namespace='', executable='/bin/true',\n"
        "        composable_node_descriptions=[part])])\n"
    )
    collect(str(file), inputs_from((), environment={"PATH": "/usr/bin:/bin"}), problems := Problems())
    assert [problem.span and problem.span.line for problem in problems] == [5]


def test_what_is_changed_in_a_node_counts() -> None:
    node = _made(_USUAL)
    node.cmd.append([TextSubstitution(text="-v")])
    assert [word.raw for word in _model(node).ros_args] == ["-v"]
    node = _made(_USUAL)
    node._Node__node_executable = "listener"  # what some files do
    assert _model(node).exec.raw == "listener"
    assert node.node_package == "demo"


def test_what_a_visit_comes_to_is_kept_until_somebody_asks() -> None:
    node = _made(_USUAL)
    node._resolved_by(lambda: ("a1", "/x", iter([("a", "/b")])))
    node._prepared_by(lambda: ("talker-1", ["talker"], None, {"A": "1"}))
    assert _is_plain(node)
    assert (node.node_name, node.expanded_remapping_rules) == ("/x/a1", [("a", "/b")])
    assert (node.name, node.cmd, node.env) == ("talker-1", ["talker"], {"A": "1"})
    assert node.process_details is not None


def test_a_copy_is_a_node_of_its_own() -> None:
    node = _made(_USUAL)
    copied = copy.copy(node)
    copied._Node__node_executable = "listener"
    assert (_model(node).exec.raw, _model(copied).exec.raw) == ("talker", "listener")
    assert copy.deepcopy(node).node_package == "demo"


def test_other_kinds_of_nodes_are_constructed(monkeypatch: pytest.MonkeyPatch) -> None:
    class Mine(Node):
        pass

    with collecting(Problems(), ()):
        assert not _is_plain(Mine(executable="talker"))
        monkeypatch.setenv("OVERRIDE_LAUNCH_PROCESS_OUTPUT", "log")
        assert _model(Node(executable="talker", output="screen")).output.raw == "log"
    assert not _is_plain(Node(executable="talker"))  # nobody collects what is wrong


def test_parameter_files_stand_where_they_are_written() -> None:
    node = _made(_USUAL)
    expected = _told(node)
    assert node.node_package == "demo"
    file = vars(node)["_Node__parameters"][0]
    assert str(file._place.span) == str(node._place.span)
    assert _told(node) == expected


def test_a_condition_that_is_no_text_is_refused_as_ever() -> None:
    node = _made({"executable": "talker", "condition": IfCondition("perhaps")})
    with pytest.raises(Exception, match="expected true or false"):
        _model(node)


@pytest.mark.parametrize(
    ("prefix", "words"),
    [
        ("LaunchConfiguration('tool')", ("nice", "-n")),
        ("[LaunchConfiguration('tool'), ' 5']", ("nice", "-n", "5")),
        ("['time -p ', LaunchConfiguration('tool'), '5']", ("time", "-p", "nice", "-n5")),
    ],
)
def test_a_prefix_with_variables_is_taken_apart(prefix: str, words: tuple[str, ...], tmp_path: Path) -> None:
    file = tmp_path / "prefix.launch.py"
    file.write_text(
        "from launch import LaunchDescription\n"
        "from launch.actions import DeclareLaunchArgument\n"
        "from launch.substitutions import LaunchConfiguration\n"
        "from launch_ros.actions import Node\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([DeclareLaunchArgument('tool', default_value='nice -n'),\n"
        f"        Node(executable='true', prefix={prefix})])\n"
    )
    plan = collect(str(file), inputs_from((), environment={"PATH": "/usr/bin:/bin"}), problems := Problems())
    assert plan is not None
    assert not problems.errors
    assert plan.processes[0].prefix == words
