"""A call that is taken apart by a form that was learned of another one is what it is without."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from orchestra.compat.launch.conditions import IfCondition
from orchestra.compat.launch.substitutions import (
    LaunchConfiguration,
    PathJoinSubstitution,
)
from orchestra.compat.launch_ros import plain_components, plain_nodes
from orchestra.compat.launch_ros.actions import Node
from orchestra.compat.launch_ros.call_forms import form_of
from orchestra.compat.launch_ros.descriptions import ComposableNode
from orchestra.compat.place import Arguments, Place
from orchestra.description.text import Constant, Template
from tests.compat.contexts import loading
from tests.compat.python_plans import of_python
from tests.compat.test_plain_nodes import _ARGUMENTS, _BY_NAME, _OF_COMPONENTS, _made, _told

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from orchestra.compat.launch_ros.made_later import Usual

_TEXTS = ("a", "b c", "", "$x", "\\", "/ns/n", "ü")


class _Text(str):
    __slots__ = ()


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({"PATH": "/usr/bin:/bin"}):
        yield


def _usual(kind: type[Any]) -> Usual:
    return plain_nodes.USUAL if kind is Node else plain_components.USUAL


def _with_form(keywords: dict[str, Any], like: dict[str, Any], kind: type[Any]) -> tuple[Any, bool]:
    """Return what a call makes where the form of another one is known, and whether it is of that form."""
    usual = _usual(kind)
    form = form_of(like, usual.readers, usual._series, usual.unwritten)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(usual, "_forms", {tuple(like): [form]})
        made = _made(keywords, kind)
    plain = vars(made).get("_plain")
    return made, plain is not None and plain._form is not None


def _without(keywords: dict[str, Any], kind: type[Any]) -> Any:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(_usual(kind), "_forms", {})
        return _made(keywords, kind)


def _other(draw: Any, value: Any) -> Any:
    """Return something like a value, or now and then something else."""
    kind = type(value)
    if draw(st.integers(0, 30)) == 0:
        return draw(st.sampled_from((*_TEXTS, _Text("a"), 1, 2.5, True, None, ["a"], [], {})))
    if kind is dict:
        named = str if draw(st.integers(0, 20)) else _Text
        return {named(name): _other(draw, item) for name, item in value.items()}
    if kind is list or kind is tuple:
        items = [_other(draw, item) for item in value]
        if draw(st.integers(0, 20)) == 0:
            items = items[1:] if draw(st.booleans()) else [*items, "a"]
        return kind(items)
    if kind is LaunchConfiguration:
        return draw(
            st.sampled_from([LaunchConfiguration("z"), LaunchConfiguration("z"), value, _BY_NAME["own"]()])
        )
    if kind is str:
        return draw(st.sampled_from((value, *_TEXTS)))
    return draw(st.sampled_from([value, 3, 0.5])) if kind in (int, float) else value


@given(
    st.data(),
    _ARGUMENTS.map(lambda words: (Node, words)) | _OF_COMPONENTS.map(lambda words: (ComposableNode, words)),
)
@settings(max_examples=600, deadline=None)
def test_calls_of_a_form_are_what_they_are_without(data: st.DataObject, first: tuple[type[Any], Any]) -> None:
    kind, like = first
    try:
        is_usual = "_plain" in vars(_without(like, kind))
    except TypeError:
        return
    if not is_usual:
        return
    keywords = {name: _other(data.draw, value) for name, value in like.items()}
    try:
        expected = _without(keywords, kind)
    except TypeError:
        with pytest.raises(TypeError):
            _with_form(keywords, like, kind)
        return
    made, _ = _with_form(keywords, like, kind)
    _is_the_same(made, expected)


def _is_the_same(made: Any, expected: Any) -> None:
    assert ("_plain" in vars(made)) == ("_plain" in vars(expected))
    if "_plain" in vars(made):
        assert vars(made)["_plain"].given == vars(copy.copy(expected))["_plain"].given
    try:
        told = _told(expected)
    except Exception as error:  # noqa: BLE001 - whatever a value is refused with
        with pytest.raises(type(error)):
            _told(made)
        return
    assert _told(made) == told
    assert _told(made) == told  # now it is read again
    asked = "cmd" if type(made) is Node else "package"
    assert (
        repr(getattr(made, asked)).partition(" at ")[0] == repr(getattr(expected, asked)).partition(" at ")[0]
    )
    assert _told(made) == told


_LIKE: dict[str, Any] = {
    "package": "demo",
    "executable": "talker",
    "name": ["a", LaunchConfiguration("x")],
    "namespace": LaunchConfiguration("x"),
    "parameters": [
        PathJoinSubstitution(["a", "p.yaml"]),
        {"a": 1, "b": [1, 2.5], "c": [LaunchConfiguration("x"), "/d"], "d": "t"},
        {"e": {"f": LaunchConfiguration("x")}},
        {},
    ],
    "remappings": [("a", "b"), ("c", ["/", LaunchConfiguration("x"), LaunchConfiguration("y")])],
    "arguments": ["--x", LaunchConfiguration("x")],
    "output": "screen",
    "respawn": True,
    "respawn_delay": 2.0,
    "additional_env": {"A": "1"},
    "condition": IfCondition(LaunchConfiguration("c")),
}


def _changed(**changes: Any) -> dict[str, Any]:
    return {name: changes.get(name, value) for name, value in _LIKE.items()}


@pytest.mark.parametrize(
    ("keywords", "is_alike"),
    [
        (_changed(name=["b", LaunchConfiguration("y")]), True),
        (_changed(namespace=LaunchConfiguration("z")), True),
        (_changed(namespace=LaunchConfiguration(["z"])), True),
        (_changed(respawn=False, respawn_delay=1, output="log", additional_env={}, condition=None), True),
        (_changed(namespace=LaunchConfiguration("z", default="z")), False),
        (_changed(namespace="z"), False),
        (_changed(name=["", LaunchConfiguration("y")]), False),
        (_changed(name=["$", LaunchConfiguration("y")]), False),
        (_changed(package="$demo"), False),
        (_changed(package=_Text("demo")), False),
        (_changed(output="scren"), False),
        (_changed(remappings=_LIKE["remappings"][:1]), False),
        (_changed(parameters=_LIKE["parameters"][:1]), False),
        (_changed(parameters=[*_LIKE["parameters"][:-1], {_Text("x"): 1}]), False),
    ],
)
def test_what_is_alike_is_taken_apart(keywords: dict[str, Any], is_alike: bool) -> None:
    made, was_alike = _with_form(keywords, _LIKE, Node)
    assert was_alike == is_alike
    _is_the_same(made, _without(keywords, Node))


def test_a_form_is_learned_of_the_calls_of_a_file() -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(plain_nodes.USUAL, "_forms", {})
        patch.setattr(plain_nodes.USUAL, "_seen", {})
        nodes = [_made(_changed(package=f"demo{number}")) for number in range(30)]
    by_form = [vars(node)["_plain"]._form is not None for node in nodes]
    assert by_form == [False] * 24 + [True] * 6
    assert [node._to_model({"origin": node}).pkg.raw for node in nodes] == [f"demo{n}" for n in range(30)]


def test_a_variable_of_which_code_has_had_the_name_may_become_another_one() -> None:
    variable = LaunchConfiguration("x")
    keywords = _changed(namespace=variable)
    assert _with_form(keywords, _LIKE, Node)[1]
    variable.variable_name[:] = LaunchConfiguration("other").variable_name
    made, was_alike = _with_form(keywords, _LIKE, Node)
    assert not was_alike
    assert made._to_model({"origin": made}).namespace.raw == "$(var other)"


def test_code_that_performs_variables_in_another_way_is_heard(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(LaunchConfiguration, "perform", lambda *_: "other")
    assert not _with_form(_LIKE, _LIKE, Node)[1]


def test_a_copy_of_a_variable_is_a_variable() -> None:
    variable = LaunchConfiguration("z")
    like = {"package": "a", "executable": "b", "parameters": [{"frame": [variable, "/base"]}]}
    model, taken = _with_form(like, like, Node)
    copied, is_taken = _with_form(
        {**like, "parameters": [{"frame": [copy.deepcopy(variable), "/base"]}]}, like, Node
    )
    assert taken
    assert is_taken
    assert _told(copied) == _told(model)


_VALUES = (
    *("(default, 'b')", "[default, 'b']", "default", "[x, 'b']", "x", "('a',)", "['a', 'b']", "[]", "[1, 2]"),
    *("[1, 2.5]", "'a'", "'5'", "5", "True", "{'c': 1}", "[TextSubstitution(text='5')]", "[default]"),
    *("TextSubstitution(text='5')", "ParameterValue('5', value_type=str)", "PathJoinSubstitution([x, 'a'])"),
)


@pytest.mark.parametrize("like", _VALUES)
def test_values_of_another_kind_are_what_they_are(
    like: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A list of texts is a list, and one with a substitution among them one text, whatever has been learned."""
    body = f"""
        from launch_ros.parameter_descriptions import ParameterValue
        x, default = LaunchConfiguration('x', default='1'), LaunchConfiguration('x', default='1')
        values = [lambda: {like}] * 40 + [{", ".join(f"lambda: {value}" for value in _VALUES)}]
        return LaunchDescription(
            [Node(executable='/bin/true', parameters=[{{'p': value()}}]) for value in values]
        )
    """
    monkeypatch.setattr(plain_nodes.USUAL, "_forms", {})
    monkeypatch.setattr(plain_nodes.USUAL, "_seen", {})
    with_forms = of_python(tmp_path, body)
    monkeypatch.setattr(plain_nodes.USUAL, "_forms", {})
    monkeypatch.setattr(type(plain_nodes.USUAL), "_learn", lambda *_: None)
    assert with_forms.content == of_python(tmp_path, body).content


def test_all_of_it_stands_where_it_is_written() -> None:
    usual = plain_nodes.USUAL
    form = form_of(_LIKE, usual.readers, usual._series, usual.unwritten)
    call = Arguments(Place(_changed.__code__, 0))
    leaves = form.take(_LIKE, call)
    assert leaves is not None
    fields = form.make(leaves, call)
    assert fields is not None
    assert fields["param"][1].value == Constant(1, call.place.at("parameters", 1, "a"))
    assert isinstance(fields["name"], Template)
    assert fields["name"].span == call.place.at("name")
