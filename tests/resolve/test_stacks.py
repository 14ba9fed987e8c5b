"""What only Python launch files say: settings that are saved, restored and unset."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.description.actions.group import Group
from orchestra.description.actions.let import Let
from orchestra.description.actions.node import Node
from orchestra.description.actions.push_ros_namespace import PushRosNamespace
from orchestra.description.actions.set_env import SetEnv
from orchestra.description.actions.set_parameter import SetParameter
from orchestra.description.actions.set_remap import SetRemap
from orchestra.description.actions.stacks import (
    PopEnvironment,
    PopLaunchConfigurations,
    PushEnvironment,
    PushLaunchConfigurations,
)
from orchestra.description.actions.unset_let import UnsetLet
from orchestra.description.text import Call, Template
from orchestra.errors import Code
from tests.resolve.made import AT, planned, text, value

if TYPE_CHECKING:
    from orchestra.description.entity import Action


def _node() -> Node:
    shown = Template((Call("var", (text("t"), text("unset")), AT),), "$(var t unset)", AT)
    return Node.at(AT, exec=text("sleep"), args=(shown,))


def _settings() -> tuple[Action, ...]:
    return (
        SetEnv.at(AT, name=text("A"), value=text("y")),
        Let.at(AT, name=text("t"), value=text("v")),
        PushRosNamespace.at(AT, namespace=text("ns")),
        SetParameter.at(AT, name=text("p"), value=value(1)),
        SetRemap.at(AT, from_=text("a"), to=text("b")),
    )


def _seen(*actions: Action) -> list[tuple[object, ...]]:
    plan, problems = planned(*actions)
    assert not problems.errors
    return [
        (node.namespace, node.arguments, node.environment, node.parameters, node.remappings)
        for node in plan.processes
    ]


_BARE: tuple[object, ...] = (None, ("unset",), {}, {}, ())
_SET = ("/ns", ("v",), {"A": "y"}, {"p": 1}, (("a", "b"),))


@pytest.mark.conforms(
    "1.3 PushEnvironment", "1.3 PopEnvironment", "1.3 PushLaunchConfigurations", "1.3 PopLaunchConfigurations"
)
def test_what_was_pushed_is_popped() -> None:
    pushes = (PushEnvironment.at(AT), PushLaunchConfigurations.at(AT))
    pops = (PopLaunchConfigurations.at(AT), PopEnvironment.at(AT))
    assert _seen(*pushes, *_settings(), _node(), *pops, _node()) == [_SET, _BARE]


def test_stacks_hold_several() -> None:
    push, pop = PushLaunchConfigurations.at(AT), PopLaunchConfigurations.at(AT)
    once = Let.at(AT, name=text("t"), value=text("1"))
    twice = Let.at(AT, name=text("t"), value=text("2"))
    seen = _seen(push, once, push, twice, _node(), pop, _node(), pop, _node())
    assert [arguments for _, arguments, *_ in seen] == [("2",), ("1",), ("unset",)]


def test_what_a_group_has_pushed_is_gone_with_it() -> None:
    group = Group.at(AT, children=(PushEnvironment.at(AT), PushLaunchConfigurations.at(AT)))
    _, problems = planned(group, PopEnvironment.at(AT), PopLaunchConfigurations.at(AT))
    assert [problem.code for problem in problems.errors] == [Code.BAD_VALUE, Code.BAD_VALUE]


def test_a_variable_can_be_unset() -> None:
    assert _seen(*_settings(), UnsetLet.at(AT, name=text("t")), _node())[0][1] == ("unset",)


@pytest.mark.conforms("1.3 PopEnvironment", "1.3 PopLaunchConfigurations")
@pytest.mark.parametrize("action", [PopEnvironment.at(AT), PopLaunchConfigurations.at(AT)], ids=type)
def test_nothing_pushed_is_an_error(action: Action) -> None:
    _, problems = planned(action)
    assert [problem.span for problem in problems.errors] == [AT]
