"""Mistakes in launch files that take a syntax tree to be found: a short look tells whether it is worth it."""

from __future__ import annotations

import random
import warnings
from importlib import import_module
from typing import TYPE_CHECKING

import pytest

from orchestra.compat import syntax_trees
from orchestra.compat.looks import LOOKS, Compiled, has_doubled_keys, has_joined_words, tell_misused
from orchestra.compat.signs import gives_twice, is_behind
from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from tests.compat.modules import loaded

if TYPE_CHECKING:
    from pathlib import Path

# Many dictionaries with the same names, none of which is wrong.
_SOUND = "def sound(make, name):\n    return [\n" + "        make({'a': 1, 'b': 2}),\n" * 20 + "    ]\n"
_LONG = ", ".join(f"'n{number}': {number}" for number in range(20))
DOUBLED = {
    "in a function": f"{_SOUND}def other():\n    return {{'a': 1, 'a': 2}}\n",
    "beside another name": f"{_SOUND}def other(name):\n    return {{'a': 1, name: 2, 'a': 3}}\n",
    "in a long one": f"{_SOUND}def other():\n    return {{{_LONG}, 'n7': 0}}\n",
    "outside of functions": f"{_SOUND}KNOWN = {{'a': 1, 'a': 2}}\n",
    "outside of functions, on another line": f"{_SOUND}KNOWN = list(\n    {{'a': 1, 'a': 2}}\n)\n",
    "in a class": f"{_SOUND}class Known:\n    names = {{'a': 1, 'a': 2}}\n",
    "in a branch": f"{_SOUND}if sound:\n    names = {{'a': 1, 'a': 2}}\n",
}
SOUND = {
    "numbers in a list": f"{_SOUND}def other():\n    return {{'pose': [0.0, 0.0, 1.0], 'flags': [1, 1, 0]}}\n",
    "many": _SOUND,
    "a long one": f"{_SOUND}def other():\n    return {{{_LONG}}}\n",
}


@pytest.mark.parametrize("name", [*DOUBLED, *SOUND])
def test_names_that_may_stand_twice_are_looked_for(name: str) -> None:
    module, source = loaded({**DOUBLED, **SOUND}[name])
    assert has_doubled_keys(module, source) == (name in DOUBLED)
    compiled = Compiled(compile(source, "file.launch.py", "exec"), source, {})
    assert compiled.may("doubled") or name in SOUND


@pytest.mark.parametrize(
    ("source", "joined"),
    [
        ("['-topic' '-z']", True),
        ("['-topic'\n    \"-z\"]", True),
        ("['-topic'\r\n    '-z']", True),
        ("['/scan@x' '/map@y']", True),
        ("['/scan' '/map']", True),
        ("['amcl' 'map_server']", True),
        ("['xacro ' 'a']", False),
        ("['xacro', ' ', 'a']", False),
        ("'a' if ' ' in b", False),
        ("['-topic', '-z']", False),
        ("['-topic','-z']", False),
        ("f('-z') + \n '-z'", False),
        ("  '-z'", False),
        ("'-z'", False),
    ],
)
def test_words_that_may_lack_a_comma_are_looked_for(source: str, joined: bool) -> None:
    assert has_joined_words(source.encode()) is joined


@pytest.mark.parametrize(
    ("source", "behind"),
    [
        ("def f():\n    return 1\n    x = 2\n", True),
        ("def f():\n    return [\n        1,\n    ]\n    x = 2\n", True),
        ("def f():\n    return [\n        1,\n    ]\n\n    # x = 2\n\n\ndef g():\n    pass\n", False),
        ("def f():\n    if x:\n        return 1\n    return 2\n", False),
        ("def f():\n    return (\n        returned,\n        x,\n    )\n", True),
        ("def f():\n    # return\n    x = 2\n", False),
    ],
)
def test_what_may_stand_behind_a_return_is_looked_for(source: str, behind: bool) -> None:
    assert is_behind(source.encode()) is behind


def test_what_stands_behind_a_return_is_found_whatever_lines_end_with() -> None:
    rng = random.Random(1)  # noqa: S311 - nothing secret
    pieces = ("\n", "\n", "\n    ", "\n        ", "return", "    return x", "x", ")", "]", "# y", " ", "    ")
    found = 0
    for _ in range(3000):
        source = "".join(rng.choices(pieces, k=rng.randrange(30)))
        told = is_behind(source.encode())
        found += told
        assert is_behind(source.replace("\n", "\r\n").encode()) is told, source
    assert found


_WHOLE = """\
import os

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution, PythonExpression
from launch_ros.actions import Node, PushRosNamespace, SetParameter

FOLDER = os.path.dirname(__file__)
FLAGS = [True, True, False]


def node(number, *, robot):
    return Node(
        executable="true",
        name=f"node{number}",
        namespace=robot,
        arguments=["--level", str(number), "-v"],
        parameters=[{"pose": [0.0, 0.0, 0.5], "flags": FLAGS}, {"inner": {"rate": 5, "frame": [robot, "/base"]}}],
        remappings=[("scan", f"scan{number}"), ("/tf", "tf"), ("/tf_static", "tf_static")],
    )


def generate_launch_description():
    robot = LaunchConfiguration("robot")
    unread = LaunchConfiguration("robot")
    enabled = PythonExpression(["'", robot, "' != ''"])
    ld = LaunchDescription([DeclareLaunchArgument("robot", default_value="robot", description="robot: '/' or a name")])
    ld.add_action(GroupAction([PushRosNamespace("arm"), SetParameter("use", True), node(0, robot=robot)]))
    for number in range(1, 4):
        ld.add_action(node(number, robot=robot))
    last = Node(executable="true", name="last", condition=IfCondition(enabled), output={"both": "log"})
    ld.add_action(last)
    return ld
"""


@pytest.mark.parametrize(
    ("listed", "twice"),
    [
        ("{'rate': 1}, {'frame': 'map'}", False),
        ("{'rate': 1}, {'rate': 2}", True),
        ("{'rate': 1, 'text': '['}, {  # not this one]\n'other': [{}], 'rate': 2}", True),
        ("{'limits': {'lower': 1}}, {'limits.lower': 2}", True),
        ("{'rate': 1}, {\"rate\": 2}", True),
        ("{'rate': 1}, {'ra' 'te': 2}", True),
        ("{'rate': 1}, {'r\\x61te': 2}", True),
        ("{'lower': 1, 'limits': {'lower': 1}}, {'upper': 2}", False),
        ("{'rate': 1}, {'frame': 'map'}], remappings=[('rate', 'rate')], more=[{'rate': 1}", False),
    ],
)
def test_parameters_that_may_be_given_twice_are_looked_for(listed: str, *, twice: bool) -> None:
    assert gives_twice(f"Node(parameters=[{listed}])\n".encode()) == twice


def test_a_sound_file_takes_no_syntax_tree(tmp_path: Path) -> None:
    path = tmp_path / "sound.launch.py"
    path.write_text(_WHOLE, "utf-8")
    before, problems = syntax_trees._tree.cache_info().misses, Problems()
    plan = collect(str(path), inputs_from([], environment={"PATH": "/usr/bin:/bin"}), problems)
    assert plan is not None
    assert not [*problems]
    assert len(plan.processes) == 5
    assert syntax_trees._tree.cache_info().misses == before


_PERFORMED = "def setup(context):\n    mode = LaunchConfiguration('mode').perform(context)\n    if {test}:\n        return []\n"
_DECLARED = "DeclareLaunchArgument('mode', default_value={default}{choices})\n"


@pytest.mark.parametrize(
    ("test", "default", "choices", "may"),
    [
        ("mode == 'real'", "'sim'", ", choices=['sim', 'real']", False),
        ('mode != "real"', "'sim'", ", choices=[\n    'sim',\n    'real',\n]", False),
        ("mode == 'rael'", "'sim'", ", choices=['sim', 'real']", True),
        ("'rael' == mode", "'sim'", ", choices=['sim', 'real']", True),
        ("mode == ('rael')", "'sim'", ", choices=['sim', 'real']", True),
        ("mode is 'rael'", "'sim'", ", choices=['sim', 'real']", True),
        ("mode == r'rael'", "'sim'", ", choices=['sim', 'real']", True),
        ("mode == 'sim' 'real'", "'sim'", ", choices=['sim', 'real']", True),
        ("mode == 'sim'", "'sim'", ", choices=('real',), description=''.join(['sim'])", True),
        ("mode", "'true'", ", choices=['true', 'false']", True),
        ("mode", "'true'", "", True),
        ("mode == 'true'", "'true'", "", False),
        ("mode == 'True'", "'true'", "", True),
        ("mode == True", "'true'", "", True),
        ("mode == 'rael'", "'sim'", "", False),
    ],
)
def test_texts_that_code_compares_are_looked_for(test: str, default: str, choices: str, may: bool) -> None:
    text = _PERFORMED.format(test=test) + _DECLARED.format(default=default, choices=choices)
    with warnings.catch_warnings(action="ignore"):  # `is` with a text
        compiled = Compiled(compile(text, "file.launch.py", "exec"), text.encode(), {})
    assert compiled.may("misused") is may


@pytest.mark.parametrize("other", ["", "texts = ['a']\nwords = ['b', texts]\n"])
def test_only_what_there_is_a_sign_of_is_looked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, other: str
) -> None:
    """A file that is asked for its texts is not looked through for what else people do."""
    asked: list[str] = []
    for module in ("texts_as_truths", "left_out", "nested_words", "uncalled"):
        told = import_module(f"orchestra.compat.{module}")
        name = "tell_truths" if module == "texts_as_truths" else f"tell_{module}"
        monkeypatch.setattr(told, name, lambda *_, module=module: asked.append(module))
    text = _PERFORMED.format(test="mode") + other
    file = tmp_path / "file.launch.py"
    file.write_text(text)
    tell_misused(Compiled(compile(text, str(file), "exec"), text.encode(), {}), str(file), Problems(), ())
    assert asked == ["texts_as_truths", *(["left_out", "nested_words"] if other else [])]


def test_a_file_is_sound_when_every_look_has_found_nothing() -> None:
    compiled = Compiled(compile("x = 1\n", "file.launch.py", "exec"), b"x = 1\n", {})
    assert not compiled.is_sound
    assert [look for look in LOOKS if compiled.may(look)] == ["harmless"]
    assert compiled.is_sound
    compiled.told["harmless"] = False
    assert compiled.is_sound
    compiled.told["idle"] = True
    assert not compiled.is_sound


def test_dictionaries_with_lists_in_them_are_side_by_side_as_well() -> None:
    assert gives_twice(b"parameters=[{'odom': 1, 'b': [1, 2]}, {'odom': False}]")
    assert not gives_twice(b"parameters=[{'odom': 1, 'b': [1, 2]}, {'other': False}]")
