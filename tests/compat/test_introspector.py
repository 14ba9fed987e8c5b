from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch import InvalidLaunchFileError, LaunchDescription, LaunchIntrospector
from orchestra.compat.launch.action import Action
from orchestra.compat.launch.actions import (
    DeclareLaunchArgument,
    EmitEvent,
    ExecuteProcess,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
)
from orchestra.compat.launch.event_handlers import OnProcessExit
from orchestra.compat.launch.events import Shutdown
from orchestra.compat.launch.some_actions_type import SomeActionsType_types_tuple
from orchestra.compat.launch.substitutions import LaunchConfiguration

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext


def make_nodes(_context: LaunchContext) -> None:
    """A function of a launch file."""


class Own(Action):
    """An action of a user."""


@pytest.mark.conforms("1.2 LaunchIntrospector", "5.4 -p")
def test_a_description_is_drawn_as_a_tree() -> None:
    words = ["ls", [LaunchConfiguration("a"), "b"]]
    process = ExecuteProcess(cmd=words, cwd="c", env={"N": "v"}, shell=True)  # noqa: S604 - a text of the test
    own = Own()
    description = LaunchDescription([
        DeclareLaunchArgument("a", default_value=["1", LaunchConfiguration("b")], description="what"),
        DeclareLaunchArgument("b"),
        process,
        RegisterEventHandler(OnProcessExit(target_action=process, on_exit=[LogInfo(msg="x"), own])),
        EmitEvent(event=Shutdown(reason="done")),
        OpaqueFunction(function=make_nodes),
    ])  # fmt: skip
    head, *lines = LaunchIntrospector().format_launch_description(description).splitlines()
    handler = lines.pop(4)
    assert head == "LaunchDescription(6 entities)"
    assert handler.startswith("│   └── OnProcessExit(")
    assert " at 0x" not in handler
    assert lines == [
        "├── DeclareLaunchArgument('a', default='1' + LaunchConfig('b'), description='what')",
        "├── DeclareLaunchArgument('b', description='no description given')",
        "├── ExecuteProcess(cmd=['ls', LaunchConfig('a') + 'b'], cwd='c', env={'N': 'v'}, shell=True)",
        "├── RegisterEventHandler('OnProcessExit'):",
        "│       ├── LogInfo('x')",
        f"│       └── Action('Own at {own._place.span}')",
        "├── EmitEvent(event='launch.events.Shutdown')",
        "└── OpaqueFunction(function=make_nodes)",
    ]


def test_an_empty_description_is_a_line() -> None:
    assert (
        LaunchIntrospector().format_launch_description(LaunchDescription()) == "LaunchDescription(0 entities)"
    )
    one = LaunchIntrospector().format_launch_description(LaunchDescription([LogInfo(msg="a")]))
    assert one == "LaunchDescription(1 entity)\n└── LogInfo('a')"


def test_a_place_is_a_line_of_the_users() -> None:
    assert Path(Own()._place.span.file).name == Path(__file__).name


@pytest.mark.conforms("1.2 InvalidLaunchFileError")
@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ({}, "the file cannot be read as a launch file"),
        (
            {
                "extension": ".py",
                "likely_errors": [KeyError("a"), ValueError("b")],
                "launch_file_path": "x.py",
            },
            "x.py cannot be read as a launch file (.py)\n - KeyError: 'a'\n - ValueError: b",
        ),
    ],
)
def test_what_readers_say_is_in_the_message(arguments: dict[str, Any], expected: str) -> None:
    error = InvalidLaunchFileError(**arguments)
    assert str(error) == expected
    assert error.__cause__ is next(iter(arguments.get("likely_errors", ())), None)


def test_some_actions_are_actions_or_iterables() -> None:
    assert isinstance(Own(), SomeActionsType_types_tuple)
    assert isinstance([Own()], SomeActionsType_types_tuple)
