"""`launch.frontend`: entities, parsers, and what they make of texts and files."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, List  # noqa: UP035 - what users' annotations have
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.compat.launch import frontend
from orchestra.compat.launch.actions import ExecuteProcess, IncludeLaunchDescription, TimerAction
from orchestra.compat.launch.frontend import Entity, InvalidFrontendLaunchFileError, Parser
from orchestra.compat.launch.frontend.calls import CALLS, class_of_call
from orchestra.compat.launch.frontend.parse_substitution import parse_if_substitutions, parse_substitution
from orchestra.compat.launch.frontend.tags import TAGS, class_of_tag
from orchestra.compat.launch.frontend.type_utils import check_is_list_entity, get_data_type_from_identifier
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.launch_description_sources import AnyLaunchDescriptionSource
from orchestra.compat.launch.substitutions import (
    EnvironmentVariable,
    ForLoopIndex,
    LaunchConfiguration,
    PythonExpression,
    TextSubstitution,
    ThisLaunchFileDir,
)
from orchestra.compat.launch.utilities import perform_substitutions
from orchestra.compat.launch_ros.utilities import evaluate_parameters
from orchestra.compat.launch_xml import Entity as XmlEntity
from orchestra.compat.launch_xml import Parser as XmlParser
from orchestra.compat.launch_yaml import Entity as YamlEntity
from orchestra.compat.launch_yaml import Parser as YamlParser
from orchestra.description.actions import ACTIONS
from orchestra.description.substitutions import SIGNATURES
from orchestra.description.written import called, escaped
from tests.compat.contexts import loading
from tests.load.written import WRITERS

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_ENVIRONMENT = {"PATH": "/usr/bin:/bin", "SET": "value"}
_ENTITIES = List[Entity]  # noqa: UP006 - what users write
_LANGUAGES = pytest.mark.parametrize("language", ["xml", "yaml"])


@pytest.fixture(autouse=True)
def _loading() -> Iterator[None]:
    with loading(_ENVIRONMENT):
        yield


def _entities(language: str, actions: list[dict[str, Any]]) -> list[Any]:
    """Return the actions of a file in a language."""
    root, parser = Parser.load(io.StringIO(WRITERS[language](actions)))
    return list(parser.parse_description(root).entities)


def _only(language: str, action: str, /, **keys: Any) -> Any:
    (entity,) = _entities(language, [{action: keys}])
    return entity


def _text(subs: Any) -> str:
    return perform_substitutions(LaunchContext(), subs)


def _text_of(item: Any) -> str:
    assert isinstance(item, TextSubstitution)
    return item.text


def _pairs(items: Any) -> list[tuple[str, str]]:
    return [(_text(left), _text(right)) for left, right in items]


def test_every_name_of_the_language_has_a_class() -> None:
    assert CALLS.keys() == SIGNATURES.keys()
    assert TAGS.keys() == ACTIONS.keys()
    assert all(callable(class_of_call(name).parse) for name in CALLS)
    assert all(callable(class_of_tag(name).parse) for name in TAGS)


def test_the_package_has_upstreams_names() -> None:
    for name in (*frontend.__all__, "entity", "expose", "parse_substitution", "parser"):
        assert getattr(frontend, name) is not None


@_LANGUAGES
def test_a_process_has_what_is_written(language: str) -> None:
    process = _only(  # noqa: S604 - nothing is run
        language,
        "executable",
        cmd="""prog -l "$(env SET) x" 'y z'""",
        cwd="/srv",
        name="label",
        shell=True,
        emulate_tty="true",
        output="screen",
        sigterm_timeout=7,
        sigkill_timeout="$(env T 4)",
        respawn="$(env R true)",
        respawn_delay=2,
        respawn_max_retries=3,
        on_exit="shutdown",
        env=[{"name": "A", "value": "$(env SET)"}, {"name": "B", "value": 1}],
        **{"launch-prefix": "nice -n $(env N 5)"},
    )
    assert [_text(word) for word in process.cmd] == ["prog", "-l", "value x", "y z"]
    assert [_text(value) for value in (process.cwd, process.name, process.output)] == [
        "/srv",
        "label",
        "screen",
    ]
    assert (process.shell, process.emulate_tty) == (True, True)
    assert (_text(process.sigterm_timeout), _text(process.sigkill_timeout)) == ("7.0", "4")
    assert _pairs(process.additional_env) == [("A", "value"), ("B", "1")]
    assert [type(entity).__name__ for entity in process.get_sub_entities()] == ["Shutdown"]
    assert _text(process.process_description.prefix) == "nice -n 5"


@_LANGUAGES
def test_a_node_has_what_is_written(language: str) -> None:
    node = _only(
        language,
        "node",
        pkg="demo",
        exec="tool",
        name="n",
        namespace="$(env SET)",
        exec_name="label",
        args="--a 'b c'",
        ros_args="--log-level debug",
        remap=[{"from": "a", "to": "/b"}, {"from": "c", "to": "$(env SET)"}],
        param=[
            {"name": "a", "value": 1},
            {
                "name": "b",
                "param": [{"name": "c", "value": [1.5, 2.5]}, {"name": "d", "value": "7", "type": "str"}],
            },
            {"name": "e", "value": "$(env SET)"},
            {"name": "f", "value": ["x", "$(env SET)"]},
            {"from": "$(env SET).yaml", "allow_substs": True},
        ],
    )
    assert (_text(node.node_package), _text(node.node_executable)) == ("demo", "tool")
    assert [_text(word) for word in node.cmd[1:6]] == ["--a", "b c", "--ros-args", "--log-level", "debug"]
    assert _pairs(node._Node__remappings) == [("a", "/b"), ("c", "value")]
    *written, file = node._Node__parameters
    values: dict[str, Any] = {}
    for item in evaluate_parameters(LaunchContext(), written):
        assert isinstance(item, dict)
        values |= item
    assert {name: list(value) if isinstance(value, tuple) else value for name, value in values.items()} == {
        "a": 1,
        "b.c": [1.5, 2.5],
        "b.d": "7",
        "e": "value",
        "f": ["x", "value"],
    }
    assert file.allow_substs
    assert _text(file.param_file) == "value.yaml"


@_LANGUAGES
def test_a_component_has_what_is_written(language: str) -> None:
    component = {
        "pkg": "p",
        "plugin": "p::C",
        "name": "c",
        "namespace": "n",
        "if": "$(env SET_NOT true)",
        "remap": [{"from": "a", "to": "b"}],
        "param": [{"name": "x", "value": True}],
        "extra_arg": [{"name": "use_intra_process_comms", "value": "true"}],
    }
    container = _only(
        language, "node_container", pkg="p", exec="e", name="box", namespace="", composable_node=[component]
    )
    loaded = _only(language, "load_composable_node", target="/box", composable_node=[component])
    assert _text(loaded._LoadComposableNodes__target_container) == "/box"
    for action in (container, loaded):
        (found,) = getattr(action, f"_{type(action).__name__}__composable_node_descriptions")
        described = (found.package, found.node_plugin, found.node_name, found.node_namespace)
        assert [_text(item) for item in described] == ["p", "p::C", "c", "n"]
        assert _pairs(found.remappings) == [("a", "b")]
        assert evaluate_parameters(LaunchContext(), found.parameters)[0] == {"x": True}
        assert evaluate_parameters(LaunchContext(), found.extra_arguments)[0] == {
            "use_intra_process_comms": True
        }
        assert found.condition().evaluate(LaunchContext())


@_LANGUAGES
def test_what_holds_others_has_them(language: str) -> None:
    child = {"log": {"message": "$(var x)"}}
    group = _only(
        language, "group", scoped=True, forwarding=False, keep=[{"name": "x", "value": "1"}], children=[child]
    )
    kinds = [type(entity).__name__ for entity in group.execute(LaunchContext())]
    assert kinds == [
        *("PushLaunchConfigurations", "PushEnvironment", "ResetEnvironment", "ResetLaunchConfigurations"),
        *("LogInfo", "PopEnvironment", "PopLaunchConfigurations"),
    ]
    timer = _only(language, "timer", period=2, cancel_on_shutdown=False, children=[child, child])
    assert isinstance(timer, TimerAction)
    assert timer.period == 2.0
    assert len(timer.actions) == 2
    waiting = _only(language, "timer", period="$(var p 5)", children=[child]).period
    assert [type(item) for item in waiting] == [LaunchConfiguration]
    include = _only(
        language, "include", file="$(dirname)/a.launch.py", arg=[{"name": "a", "value": "$(env SET)"}]
    )
    assert isinstance(include, IncludeLaunchDescription)
    assert isinstance(include.launch_description_source, AnyLaunchDescriptionSource)
    assert _pairs(include.launch_arguments) == [("a", "value")]


@_LANGUAGES
def test_variables_are_set_where_they_are_visited(language: str) -> None:
    actions: list[dict[str, Any]] = [
        {
            "arg": {
                "name": "mode",
                "default": "$(env SET)",
                "description": "a\\$b",
                "choice": [{"value": "value"}],
            }
        },
        {"let": {"name": "x", "value": 5}},
        {"let": {"name": "y", "value": "<$(var x)>"}},
        {"set_env": {"name": "E", "value": "$(var y)"}},
        {"append_env": {"name": "E", "value": "0", "prepend": True, "separator": "|"}},
        {"unset_env": {"name": "SET"}},
        {"reset": {"keep": [{"name": "kept", "value": "$(var x)"}]}},
    ]
    entities = _entities(language, actions)
    context = LaunchContext()
    for entity in entities:
        entity.visit(context)
    assert dict(context.launch_configurations) == {"kept": "5"}
    assert context.environment["E"] == "0|<5>"
    assert "SET" not in context.environment
    declared = entities[0]
    assert (declared.name, declared.choices) == ("mode", ["value"])
    assert declared.description.startswith("a$b")


@_LANGUAGES
@pytest.mark.parametrize(
    ("name", "keys", "error", "message"),
    [
        ("log", {"message": "x", "mesage": "y"}, ValueError, "Unexpected in `log`: `mesage`"),
        ("log", {}, AttributeError, "'log' lacks 'message'"),
        ("let", {"name": "a"}, AttributeError, "'let' lacks 'value'"),
        ("lett", {"name": "a"}, RuntimeError, "there is no action 'lett'"),
        ("log", {"message": "x", "if": "1", "unless": "1"}, RuntimeError, "one of 'if' and 'unless'"),
        ("log", {"message": "$(vaar x)"}, ValueError, "there is no substitution"),
        ("executable", {"cmd": "x", "shell": "$(var s)"}, TypeError, "Attribute 'shell' of 'executable'"),
        ("executable", {"cmd": "x", "respawn_delay": -1}, ValueError, "'respawn_delay'"),
        ("executable", {"cmd": "x", "sigterm_timeout": "-2"}, ValueError, "'sigterm_timeout'"),
        ("executable", {"cmd": "x", "on_exit": "restart"}, ValueError, "'on_exit'"),
        ("executable", {"cmd": "x 'y"}, ValueError, "No closing quotation"),
        (
            "executable",
            {"cmd": "x", "env": [{"name": "a", "valu": "b"}]},
            AttributeError,
            "'env' lacks 'value'",
        ),
        ("node", {"exec": "x", "param": [{"name": "a"}]}, RuntimeError, "one of 'value', 'param' and 'from'"),
        (
            "node",
            {"exec": "x", "param": [{"name": "a", "from": "f"}]},
            RuntimeError,
            "either a 'name' or a file",
        ),
        (
            "node",
            {"exec": "x", "param": [{"name": "a", "value": 1, "type": "text"}]},
            ValueError,
            "is no type",
        ),
        (
            "node",
            {"exec": "x", "param": [{"name": "a", "type": "int", "param": [{"name": "b", "value": 1}]}]},
            RuntimeError,
            "the 'type' of a param goes with its 'value'",
        ),
        ("timer", {"children": [{"log": {"message": "x"}}]}, AttributeError, "'timer' lacks 'period'"),
    ],
)
def test_what_is_wrong_is_refused(
    language: str, name: str, keys: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error) as refused:
        _only(language, name, **keys)
    assert message in str(refused.value)


@pytest.mark.conforms("1.10 Parser")
@pytest.mark.parametrize(
    ("name", "text", "kind"),
    [
        ("a.launch.xml", "<launch/>", XmlParser),
        ("a.launch", "  <launch/>", XmlParser),
        ("a.launch.yaml", "launch: []", YamlParser),
        ("a.yml", "launch: []", YamlParser),
        ("a.launch", "launch: []", YamlParser),
    ],
)
def test_files_are_read_by_path_and_open(tmp_path: Path, name: str, text: str, kind: type[Parser]) -> None:
    path = tmp_path / name
    path.write_text(text)
    for file in (path, str(path), bytes(path), io.StringIO(text)):
        root, parser = Parser.load(file)
        assert root.type_name == "launch"
        assert isinstance(parser, kind)
    with path.open() as stream:
        assert isinstance(kind.load(stream)[1], kind)


@pytest.mark.conforms("1.10 InvalidFrontendLaunchFileError")
@pytest.mark.parametrize("text", ["<launch>", "launch: [", "a: 1\na: 2"])
def test_a_file_that_cannot_be_read_is_refused(text: str) -> None:
    with pytest.raises(InvalidFrontendLaunchFileError):
        Parser.load(io.StringIO(text))


@_LANGUAGES
def test_a_loop_makes_its_actions_once_per_turn(language: str) -> None:
    children = [{"log": {"message": "$(index i)$(for-var a b)"}}]
    loop = _only(language, "for", len="$(var n 2)", name="i", children=children)
    each = _only(language, "for_each", values="{a: 1}", children=children)
    assert (_text(loop.length), loop.name, _text(each.input_values)) == ("2", "i", "{a: 1}")
    assert [[type(made).__name__ for made in turn] for turn in (loop.function(i=0), each.function(a=1))] == [
        ["OpaqueFunction", "LogInfo", "OpaqueFunction"]
    ] * 2
    with pytest.raises(TypeError, match="ForLoopIndex takes name, found 2 arguments"):
        ForLoopIndex.parse(["i", "j"])


@pytest.mark.parametrize("text", ["<root/>", "root: []"])
def test_the_root_is_launch(text: str) -> None:
    root, parser = Parser.load(io.StringIO(text))
    with pytest.raises(RuntimeError, match="the root of a launch file is 'launch', not 'root'"):
        parser.parse_description(root)


@pytest.mark.parametrize("text", ['<launch deprecated="old"/>', "launch: {deprecated: old, children: []}"])
def test_a_file_may_be_deprecated(text: str) -> None:
    root, parser = Parser.load(io.StringIO(text))
    description = parser.parse_description(root)
    assert (description.deprecated, description.deprecated_reason) == (True, "old")


@pytest.mark.conforms("1.10 Parser")
def test_the_parsers_are_known_by_language_and_file_name() -> None:
    assert set(Parser.get_available_extensions()) >= {"xml", "yaml"}
    assert Parser.is_extension_valid("xml")
    assert Parser.get_parser_from_extension("yaml") is YamlParser
    with pytest.raises(RuntimeError, match="no parser for 'toml'"):
        Parser.get_parser_from_extension("toml")
    assert Parser.get_file_extensions_from_parsers() >= {
        "launch",
        "launch.xml",
        "launch.yaml",
        "xml",
        "yaml",
        "yml",
    }
    assert Parser.get_parsers_from_filename("a.launch.xml")[0] is XmlParser
    assert Parser.get_parsers_from_filename("a.yaml")[0] is YamlParser
    assert Parser.is_filename_valid("a.launch.yml")
    assert not Parser.is_filename_valid("a.launch.py")
    assert XmlParser.may_parse("a.xml")
    assert not XmlParser.may_parse("a.yaml")


_ELEMENT = '<tag text="x" i="7" f="2" b="yes" l="1, 2" l-sep=", " y="[1.5, 2.5]"><part name="p"/><part name="q"/></tag>'
_MAPPING = {
    "text": "x",
    "i": 7,
    "f": 2,
    "b": True,
    "l": [1, 2],
    "y": [1.5, 2.5],
    "part": [{"name": "p"}, {"name": "q"}],
}


@pytest.mark.conforms("1.10 Entity")
@pytest.mark.parametrize(
    "entity",
    [XmlEntity(ET.fromstring(_ELEMENT)), YamlEntity({"tag": _MAPPING})],  # noqa: S314 - our own text
    ids=["xml", "yaml"],
)
def test_attributes_are_read_as_the_types_that_are_asked_for(entity: Entity) -> None:
    read = entity.get_attr
    assert entity.type_name == "tag"
    assert read("text") == "x"
    assert read("i", data_type=int) == 7
    assert read("i") == "7"
    assert read("f", data_type=float) == 2.0
    assert read("b", data_type=bool, can_be_str=False) is True
    assert read("l", data_type=List[int]) == [1, 2]  # noqa: UP006 - what users write
    assert read("y", data_type=List[float]) == read("y", data_type=None) == [1.5, 2.5]  # noqa: UP006
    assert [part.get_attr("name") for part in read("part", data_type=_ENTITIES)] == ["p", "q"]
    assert read("none", optional=True) is None
    assert read("none", data_type=_ENTITIES, optional=True) is None
    with pytest.raises(AttributeError, match="'tag' lacks 'none'"):
        read("none")
    with pytest.raises(TypeError, match="Attribute 'text' of 'tag'"):
        read("text", data_type=int, can_be_str=False)
    entity.assert_entity_completely_parsed()


def test_names_are_spelled_with_hyphens_or_underscores() -> None:
    entity = XmlEntity(ET.fromstring('<a launch_prefix="x" b-c="1"><d-e/></a>'))  # noqa: S314 - our own text
    assert entity.get_attr("launch-prefix") == "x"
    assert entity.get_attr("b_c", data_type=int) == 1
    assert len(entity.get_attr("d_e", data_type=_ENTITIES)) == 1
    entity.assert_entity_completely_parsed()


@pytest.mark.conforms("1.10 type_utils")
def test_types_have_names() -> None:
    assert get_data_type_from_identifier("list_of_int") == List[int]  # noqa: UP006 - what users write
    assert get_data_type_from_identifier("yaml") is None
    assert check_is_list_entity(_ENTITIES)
    assert not check_is_list_entity(List[int])  # noqa: UP006


@pytest.mark.conforms("1.10 parse_substitution")
def test_texts_become_substitutions() -> None:
    assert [type(item) for item in parse_substitution("")] == [TextSubstitution]
    before, folder, after = parse_substitution(r"a\$ $(dirname)/b")
    assert [_text([item]) for item in (before, after)] == ["a$ ", "/b"]
    assert isinstance(folder, ThisLaunchFileDir)
    (variable,) = parse_substitution("$(env A$(env B) 'c $(var d)')")
    assert isinstance(variable, EnvironmentVariable)
    assert [type(item) for item in variable.name] == [TextSubstitution, EnvironmentVariable]
    assert variable.default_value is not None
    assert [type(item) for item in variable.default_value] == [TextSubstitution, LaunchConfiguration]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("$(eval \"'a' + 'b'\")", "ab"),
        ("$(eval 'ceil(1.2)')", "2"),
        ("$(eval 'sys.maxsize > floor(1.5)' 'sys, math')", "True"),
        ("$(any false $(not false))$(all)", "truetrue"),
        ("$(if $(equals $(env SET) value) yes)", "yes"),
        ("$(path-join a $(env SET))", "a/value"),
    ],
)
def test_parsed_substitutions_are_performed(text: str, expected: str) -> None:
    assert _text(parse_substitution(text)) == expected


def test_an_expression_without_modules_has_none() -> None:
    (expression,) = parse_substitution("$(eval 'ceil(1.2)' '')")
    assert isinstance(expression, PythonExpression)
    with pytest.raises(NameError):
        expression.perform(LaunchContext())


@pytest.mark.conforms("1.10 parse_substitution")
def test_values_are_parsed_where_they_have_substitutions() -> None:
    assert parse_if_substitutions(1) == 1
    assert parse_if_substitutions(r"a\$b") == "a$b"
    assert [type(item) for item in parse_if_substitutions("$(env A)")] == [EnvironmentVariable]
    mixed = parse_if_substitutions(["$(env A)", "b"])
    assert [type(item) for item in mixed[0]] == [EnvironmentVariable]
    assert mixed[1] == "b"
    with pytest.raises(ValueError, match="of one type"):
        parse_if_substitutions(["$(env A)", 1, 1.0])


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("prog -l 'a b' \"c d\"", ["prog", "-l", "a b", "c d"]),
        ("$(env SET)/x y$(env SET) ", ["value/x", "yvalue"]),
        ("$(env SET)$(env SET)", ["valuevalue"]),
        ("x \"$(env SET) y\" --z='$(env SET)'", ["x", "value y", "--z=value"]),
        ("x '' $(env NONE '')", ["x", "", ""]),
        ("", [""]),
    ],
)
def test_commands_are_split_around_substitutions(command: str, words: list[str]) -> None:
    assert [_text(word) for word in ExecuteProcess._parse_cmdline(command, Parser)] == words


@given(st.lists(st.text(max_size=8) | st.text("a '\"()\\$", max_size=8), min_size=1, max_size=2))
def test_any_text_can_be_written_as_an_argument(texts: list[str]) -> None:
    with loading(_ENVIRONMENT):
        (read,) = parse_substitution(called("var", map(escaped, texts)))
    assert isinstance(read, LaunchConfiguration)
    assert [[_text_of(item) for item in argument] for argument in read._arguments()] == [
        [text] for text in texts
    ]


def test_calls_are_written_as_they_are_read() -> None:
    for text in (
        "$(var a$(env B) 'c d')",
        "$(if $(equals $(var a) 1) $(var b 'no such') x)",
        "$(not 'a $(var b)')",
    ):
        (read,) = parse_substitution(text)
        assert read._raw() == text


@_LANGUAGES
def test_sources_give_the_same_objects(language: str, tmp_path: Path) -> None:
    """Keys that only Orchestra knows make actions that have no class: they are carried out all the same."""
    declared = {"arg": {"name": "a", "default": "1"}}
    upstreams: list[dict[str, Any]] = [declared, {"executable": {"cmd": "prog"}}]
    ours: list[dict[str, Any]] = [declared, {"executable": {"cmd": "prog", "required": True}}]
    path = tmp_path / f"a.launch.{language}"
    context = LaunchContext()
    path.write_text(WRITERS[language](upstreams))
    found = AnyLaunchDescriptionSource(str(path)).get_launch_description(context)
    assert [type(entity).__name__ for entity in found.entities] == ["DeclareLaunchArgument", "ExecuteProcess"]
    assert [argument.name for argument in found.get_launch_arguments()] == ["a"]
    path.write_text(WRITERS[language](ours))
    found = AnyLaunchDescriptionSource(str(path)).get_launch_description(context)
    assert [type(entity).__name__ for entity in found.entities] == ["Described", "Described"]
    for entity in found.entities:
        entity.visit(context)
    assert context.launch_configurations["a"] == "1"
