"""What the tables of the launch language say about Python and no other test asks, case by case."""

from __future__ import annotations

import asyncio
from concurrent.futures import Future
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING, Any, List  # noqa: UP035 - what launch files hand in

import pytest

from orchestra.compat import launch
from orchestra.compat.launch import actions, conditions, events, some_substitutions_type, substitutions
from orchestra.compat.launch.actions import LogInfo, OpaqueFunction, SetLaunchConfiguration
from orchestra.compat.launch.event import Event
from orchestra.compat.launch.event_handler import EventHandler
from orchestra.compat.launch.event_handlers import OnShutdown
from orchestra.compat.launch.frontend import InvalidFrontendLaunchFileError, Parser
from orchestra.compat.launch.frontend import type_utils as written_types
from orchestra.compat.launch.frontend.parse_substitution import parse_substitution
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.compat.launch.substitutions import LaunchConfiguration, TextSubstitution
from orchestra.compat.launch.utilities import perform_substitutions, typing_file_path
from orchestra.compat.launch_ros import descriptions
from orchestra.compat.launch_xml.launch_description_sources import XMLLaunchDescriptionSource
from orchestra.compat.launch_yaml.launch_description_sources import YAMLLaunchDescriptionSource
from orchestra.compat.wrong import WrongValue
from tests.compat.contexts import loading
from tests.conformance.marks import conforming

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

LC = LaunchConfiguration


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({"PATH": "/usr/bin:/bin", "HOME": "/home/robot"}):
        yield


def _context(**configurations: str) -> LaunchContext:
    context = LaunchContext()
    context.launch_configurations.update(configurations)
    return context


def _error(function: Callable[[], Any]) -> type[Exception] | None:
    """Return what a call raises."""
    try:
        function()
    except Exception as error:  # noqa: BLE001 - which one is the question
        return type(error).__mro__[2] if isinstance(error, WrongValue) else type(error)
    return None


def _is(kinds: Any, item: Any) -> bool:
    return isinstance(item, kinds)


class _Custom(Event):
    """An event of the user's."""

    name = "custom"

    def __init__(self, reason: str = "") -> None:
        self.reason = reason


def _on_custom(note: OpaqueFunction) -> EventHandler:
    return EventHandler(matcher=lambda event: isinstance(event, _Custom), entities=[note])


def _order() -> list[str]:
    """Return the handlers in the order in which they hear of an event."""
    heard: list[str] = []
    context = _context()
    for name, append in (("a", False), ("b", False), ("c", True)):
        note = OpaqueFunction(function=lambda _, name=name: heard.append(name))
        context.register_event_handler(_on_custom(note), append=append)
    context.emit_event_sync(_Custom())
    context._engine.handle_events()
    return heard


def _emitted() -> list[str]:
    """Return what has been heard of an event that a coroutine emitted."""
    heard: list[str] = []
    context = _context()
    note = OpaqueFunction(function=lambda context: heard.append(context.locals.event.reason))
    context.register_event_handler(_on_custom(note))
    asyncio.run(context.emit_event(_Custom("enough")))
    context._engine.handle_events()
    return heard


def _names() -> set[str]:
    """Return what `from launch import ...` finds, of the names in the table."""
    wanted = (
        "actions conditions descriptions events frontend logging substitutions Action Condition Event EventHandler "
        "InvalidLaunchFileError LaunchContext LaunchDescription LaunchDescriptionEntity LaunchDescriptionSource "
        "LaunchIntrospector LaunchService SomeEntitiesType SomeEntitiesType_types_tuple SomeSubstitutionsType "
        "SomeSubstitutionsType_types_tuple Substitution event_handlers launch_description_sources utilities"
    )
    return {name for name in wanted.split() if getattr(launch, name, None) is None}


def _entities() -> list[Any]:
    first, second = LogInfo(msg="a"), LogInfo(msg="b")
    given = [first]
    description = LaunchDescription(given)
    description.add_action(second)
    description.add_entity(first)
    return [description.entities == [first, second, first], given == [first], LaunchDescription().entities]


def _globals() -> list[Any]:
    context = _context()
    context.extend_globals({"a": 1, "b": 1})
    context.extend_locals({"b": 2})
    known = context.get_locals_as_dict()
    return [known["a"], known["b"], context.locals.a, _error(lambda: setattr(context.locals, "a", 2))]


# Row -> what is asked, and the answer.
FACTS: dict[str, tuple[Callable[[], Any], Any]] = {
    "1.1 SomeSubstitutionsType_types_tuple": (
        lambda: [_is(launch.SomeSubstitutionsType_types_tuple, item) for item in ("a", LC("a"), ["a"], 1, None)],
        [True, True, True, False, False],
    ),
    "1.1 SomeSubstitutionsType_types_tuple, its module": (
        lambda: some_substitutions_type.SomeSubstitutionsType is launch.SomeSubstitutionsType, True,
    ),
    "1.1 SomeSubstitutionsType, iterables": (
        lambda: [
            perform_substitutions(_context(x="X"), LogInfo(msg=value).msg)
            for value in ("a", LC("x"), ["a", LC("x")], ("a", "b"), iter(["a", "b"]), {"k": 1}.keys())
        ],
        ["a", "X", "aX", "ab", "ab", "k"],
    ),
    "1.1 SomeSubstitutionsType, other types": (
        lambda: {
            _error(partial(SetLaunchConfiguration, "a", value))
            for value in (1, 1.5, True, None, [["a"]], [1], b"a")
        },
        {TypeError},
    ),
    "1.1 SomeEntitiesType": (
        lambda: [_error(partial(OnShutdown, on_shutdown=value)) for value in (LogInfo(msg="a"), [LogInfo(msg="a")], ())],
        [None, None, None],
    ),
    "1.1 SomeEntitiesType_types_tuple": (
        lambda: list(map(partial(_is, launch.SomeEntitiesType_types_tuple), (LogInfo(msg="a"), [], 1))),
        [True, True, False],
    ),
    "1.1 FilePath": (lambda: typing_file_path.FilePath is not None, True),
    "1.1 texts are literal": (lambda: perform_substitutions(_context(x="X"), LogInfo(msg="$(var x)").msg), "$(var x)"),
    "1.2 exported names": (_names, set()),
    "1.2 LaunchDescriptionEntity, by itself": (
        lambda: [
            launch.LaunchDescriptionEntity().visit(_context()),
            launch.LaunchDescriptionEntity().describe_sub_entities(),
            launch.LaunchDescriptionEntity().describe_conditional_sub_entities(),
            launch.LaunchDescriptionEntity().get_asyncio_future(),
        ],
        [None, [], [], None],
    ),
    "1.2 Action constructor, other keywords": (
        lambda: _error(partial(launch.Action, name="a")),
        TypeError,
    ),
    "1.2 Action.condition": (
        lambda: [
            LogInfo(msg="a").condition,
            LogInfo(msg="a", condition=conditions.IfCondition("1")).condition.describe(),
        ],
        [None, "IfCondition('1')"],
    ),
    "1.2 Action.visit, of a condition that does not hold": (
        lambda: launch.Action(condition=conditions.IfCondition("false")).visit(_context()), None,
    ),
    "1.2 LaunchDescription.entities": (_entities, [True, True, []]),
    "1.2 LaunchDescription.add_action": (_entities, [True, True, []]),
    "1.2 LaunchDescription.visit": (
        lambda: [type(item).__name__ for item in LaunchDescription([LogInfo(msg="a")]).visit(_context()) or ()],
        ["LogInfo"],
    ),
    "1.2 LaunchDescription.deprecated": (
        lambda: [
            (description.deprecated, description.deprecated_reason)
            for description in (LaunchDescription(), LaunchDescription(deprecated_reason="old"))
        ],
        [(False, None), (True, "old")],
    ),
    "1.2 LaunchContext.argv": (
        lambda: [LaunchContext(argv=["a:=b"], noninteractive=True).argv, LaunchContext(noninteractive=True).noninteractive,
                 LaunchContext().is_shutdown, LaunchContext().asyncio_loop, LaunchContext().argv],
        [["a:=b"], True, False, None, []],
    ),
    "1.2 LaunchContext.environment": (lambda: _context().environment["HOME"], "/home/robot"),
    "1.2 LaunchContext.launch_configurations": (
        lambda: [
            dict(_context(a="b").launch_configurations), "a" in _context(a="b").launch_configurations,
            _error(lambda: _context().launch_configurations["a"]), _context().launch_configurations.get("a", 7),
        ],
        [{"a": "b"}, True, KeyError, 7],
    ),
    "1.2 LaunchContext.extend_locals": (_globals, [1, 2, 1, AttributeError]),
    "1.2 LaunchContext.perform_substitution": (lambda: _context(x="X").perform_substitution(LC("x")), "X"),
    "1.2 LaunchContext.register_event_handler, order": (_order, ["b", "a", "c"]),
    "1.2 LaunchContext.unregister_event_handler": (
        lambda: _error(lambda: _context().unregister_event_handler(OnShutdown(on_shutdown=[]))), ValueError,
    ),
    "1.2 LaunchContext.emit_event": (_emitted, ["enough"]),
    "1.2 LaunchContext.add_completion_future": (lambda: _error(lambda: _context().add_completion_future(object())), None),
    "1.4 properties": (
        lambda: [
            _described(LC("a").variable_name),
            _described(substitutions.EnvironmentVariable("a", default_value="b").name),
            _described(substitutions.EnvironmentVariable("a", default_value="b").default_value),
            [_described(item) for item in substitutions.PathJoinSubstitution(["a", ["b", "c"]]).substitutions],
            _described(substitutions.PythonExpression("1", ["sys"]).expression),
            [_described(item) for item in substitutions.PythonExpression("1", ["sys"]).python_modules],
            (substitutions.LocalSubstitution("a", "b").expression, substitutions.LocalSubstitution("a", "b").description),
            _described(substitutions.FindExecutable(name="a").name),
            (_described(substitutions.Command("a").command), _described(substitutions.Command("a").on_stderr)),
            _described(substitutions.FileContent("a").path),
            _described(substitutions.AnonName("a").name),
            _described(substitutions.NotSubstitution("a").value),
            (_described(substitutions.AndSubstitution("a", "b").left), _described(substitutions.OrSubstitution("a", "b").right)),
            [_described(item) for item in substitutions.AnySubstitution("a", "b").args],
            _described(substitutions.EqualsSubstitution("a", 1).right),
            _described(substitutions.IfElseSubstitution("a", "b").condition),
            _described(substitutions.IfElseSubstitution("a", "b").if_value),
            _described(substitutions.IfElseSubstitution("a", "b").else_value),
            TextSubstitution(text="a").text,
        ],
        [
            "'a'", "'a'", "'b'", ["'a'", "'b' + 'c'"], "'1'", ["'sys'"], ("a", "b"), "'a'", ("'a'", "'fail'"), "'a'", "'a'",
            "'a'", ("'a'", "'b'"), ["'a'", "'b'"], "'1'", "'a'", "'b'", "''", "a",
        ],
    ),
    "1.8 errors": (
        lambda: [
            issubclass(InvalidFrontendLaunchFileError, launch.InvalidLaunchFileError),
            _error(lambda: Parser.load("absent.launch.xml")) is not None,
        ],
        [True, True],
    ),
    "1.10 parse_substitution": (
        lambda: [
            [item.describe() for item in parse_substitution(text)]
            for text in ("", "a", "a$(var b c)", r"\$(var b)", "$(dirname)")
        ],
        [["''"], ["'a'"], ["'a'", "LaunchConfig('b')"], ["'$(var b)'"], ["ThisLaunchFileDir()"]],
    ),
    "1.10 type_utils": (
        lambda: [
            *(written_types.get_data_type_from_identifier(word) for word in ("str", "bool", "int", "float", "yaml")),
            written_types.get_data_type_from_identifier("list_of_int") == List[int],  # noqa: UP006
            written_types.check_is_list_entity(List[launch.frontend.Entity]),  # noqa: UP006
            written_types.check_is_list_entity(List[int]),  # noqa: UP006
        ],
        [str, bool, int, float, None, True, True, False],
    ),
    "1.10 InvalidFrontendLaunchFileError": (
        lambda: import_module("orchestra.compat.launch.frontend").InvalidFrontendLaunchFileError.__name__,
        "InvalidFrontendLaunchFileError",
    ),
    "1.13 exported names": (
        lambda: {"ComposableNode", "Parameter", "ParameterFile", "ParameterValue"} - set(descriptions.__all__), set(),
    ),
    "4.12 name clashes": (
        lambda: [
            issubclass(actions.Shutdown, launch.Action), issubclass(events.Shutdown, launch.Event),
            issubclass(actions.IncludeLaunchDescription, launch.Action),
            issubclass(events.IncludeLaunchDescription, launch.Event),
        ],
        [True] * 4,
    ),
}  # fmt: skip


def _described(value: Any) -> str:
    """Return the descriptions of substitutions, a text as one."""
    items = value if isinstance(value, list | tuple) else [value]
    return " ".join(f"{item!r}" if isinstance(item, str) else item.describe() for item in items)


@pytest.mark.conforms("D73")
def test_a_future_is_taken_and_not_waited_for() -> None:
    context = _context()
    context.add_completion_future(Future())
    assert not context.is_shutdown


@pytest.mark.parametrize("case", conforming(FACTS))
def test_a_row_of_the_language_holds(case: str) -> None:
    ask, answer = FACTS[case]
    assert ask() == answer


@pytest.mark.parametrize(
    ("kind", "name", "text", "wrong"),
    [
        pytest.param(
            XMLLaunchDescriptionSource, "a.launch.xml", "<launch><log message='a'/></launch>", "launch: []",
            marks=pytest.mark.conforms("1.8 XMLLaunchDescriptionSource"),
        ),
        pytest.param(
            YAMLLaunchDescriptionSource, "a.launch.yaml", "launch: [log: {message: a}]", "<launch/>",
            marks=pytest.mark.conforms("1.8 YAMLLaunchDescriptionSource"),
        ),
    ],
)  # fmt: skip
def test_a_source_of_one_format_reads_that_alone(
    kind: Callable[[str], Any], name: str, text: str, wrong: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_text(text)
    (entity,) = kind(str(path)).get_launch_description(_context()).entities
    assert isinstance(entity, LogInfo)
    path.write_text(wrong)
    assert _error(lambda: kind(str(path)).get_launch_description(_context())) is not None


@pytest.mark.conforms("1.10 Parser")
def test_a_parser_knows_the_ends_of_file_names() -> None:
    assert set(Parser.get_available_extensions()) >= {"xml", "yaml"}
    assert Parser.get_file_extensions_from_parsers() >= {
        "launch.xml",
        "xml",
        "launch.yaml",
        "launch.yml",
        "yaml",
        "yml",
    }
    assert [Parser.is_filename_valid(name) for name in ("a.launch.xml", "a.yml", "a.py")] == [
        True,
        True,
        False,
    ]
    for name, parser in (("a.launch.yaml", "launch_yaml"), ("a.launch.xml", "launch_xml")):
        assert parser in Parser.get_parsers_from_filename(name)[0].__module__
    assert Parser.escape_characters(r"a\$\(b") == "a$(b"
    assert [item.describe() for item in Parser.parse_substitution("$(var a)b")] == [
        "LaunchConfig('a')",
        "'b'",
    ]
    assert Parser.parse_if_substitutions("plain") == "plain"
