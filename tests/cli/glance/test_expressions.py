"""Constant expressions of Python launch files: the ways in which real files write a path."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

    from tests.cli.glance.conftest import Look

_NAMES = """\
share = get_package_share_directory("demo")
folder: str = "launch"
twice = "a"
twice = "b"
circle = circle2
circle2 = circle
def f(argument="x"): pass
"""


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("'/a.py'", "/a.py"),
        ("['/a', '/b.py']", "/a/b.py"),
        ("('/a' '/b.py')", "/a/b.py"),
        ("'/a' + '/b.py'", "/a/b.py"),
        ("share + '/b.py'", "/s/b.py"),
        ("f'{share}/{folder}/b.py'", "/s/launch/b.py"),
        ("f'{share!r}/b.py'", None),
        ("f'{share:>10}/b.py'", None),
        ("os.path.join(share, folder, 'b.py')", "/s/launch/b.py"),
        ("join(share, 'b.py')", "/s/b.py"),
        ("'/'.join([share, 'b.py'])", None),
        ("get_package_share_path('demo') / 'b.py'", "/s/b.py"),
        ("str(Path(share) / 'b.py')", "/s/b.py"),
        ("(Path(share) / 'b.py').as_posix()", "/s/b.py"),
        ("[FindPackageShare('demo'), '/b.py']", "/s/b.py"),
        ("FindPackageShare(package='demo').find('demo') + '/b.py'", "/s/b.py"),
        ("PathJoinSubstitution([FindPackageShare('demo'), folder, 'b.py'])", "/s/launch/b.py"),
        ("PathSubstitution(FindPackageShare('demo')) / 'b.py'", "/s/b.py"),
        ("[get_package_prefix('demo'), '/b.py']", "/p/b.py"),
        ("[ThisLaunchFileDir(), '/b.py']", "{here}/b.py"),
        ("os.path.join(os.path.dirname(os.path.abspath(__file__)), 'b.py')", "{here}/b.py"),
        ("Path(__file__).resolve().parent / 'b.py'", "{here}/b.py"),
        ("launch.substitutions.TextSubstitution(text='/b.py')", "/b.py"),
        ("get_package_share_directory('absent') + '/b.py'", None),
        ("[LaunchConfiguration('x'), '/b.py']", None),
        ("PathJoinSubstitution(parts)", None),
        ("twice + '/b.py'", None),
        ("argument + '/b.py'", None),
        ("circle", None),
        ("unknown()", None),
        ("None", None),
    ],
)
def test_path_of_an_include(look: Look, tmp_path: Path, expression: str, expected: str | None) -> None:
    text = f"{_NAMES}\nIncludeLaunchDescription(AnyLaunchDescriptionSource({expression}))\n"
    found = [include.path for include in look("a.launch.py", text).includes]
    assert found == ([] if expected is None else [expected.format(here=tmp_path)])


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("{'a': x, 'b': y}.items()", {"a", "b"}),
        ("{'a': x, name: y}", {"a"}),
        ("[('a', x), ['b', y], z]", {"a"}),
        ("dict(a=x, **more).items()", {"a"}),
        ("given", {"c"}),
        ("unknown", set()),
        ("None", set()),
    ],
)
def test_arguments_that_an_include_gives(look: Look, expression: str, expected: set[str]) -> None:
    text = f"given = {{'c': 1}}.items()\nIncludeLaunchDescription('/x', launch_arguments={expression})\n"
    (include,) = look("a.launch.py", text).includes
    assert include.given == expected


@pytest.mark.parametrize(
    ("expression", "default", "constant"),
    [
        ("'x'", "x", True),
        ("1.5", "1.5", True),
        ("True", "True", True),
        ("['a', 'b']", "ab", True),
        ("None", None, False),
        ("share", "/s", True),
        ("LaunchConfiguration('y')", "LaunchConfiguration('y')", False),
    ],
)
def test_default_of_an_argument(look: Look, expression: str, default: str | None, constant: bool) -> None:
    text = f"{_NAMES}\nDeclareLaunchArgument('x', default_value={expression})\n"
    (argument,) = look("a.launch.py", text).arguments
    assert (argument.default, argument.constant) == (default, constant)


@pytest.mark.parametrize(
    ("text", "conditional"),
    [
        ("DeclareLaunchArgument('x')", False),
        ("def f():\n    return [DeclareLaunchArgument('x')]", False),
        ("DeclareLaunchArgument('x', condition=c)", True),
        ("GroupAction([DeclareLaunchArgument('x')], condition=c)", True),
        ("if c:\n    DeclareLaunchArgument('x')", True),
        ("a = DeclareLaunchArgument('x') if c else None", True),
    ],
)
def test_what_is_conditional(look: Look, text: str, conditional: bool) -> None:
    (argument,) = look("a.launch.py", text).arguments
    assert argument.conditional is conditional


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "for n, d in (('a', '1'), ('b', f'{d}')):\n    add(DeclareLaunchArgument(n, default_value=d))",
            ["a=1", "b=d"],
        ),
        ("x = [DeclareLaunchArgument(n) for n in ['a', 'b']]", ["a", "b"]),
        ("names = ['a', 'b']\nx = [DeclareLaunchArgument(n) for n in names]", ["a", "b"]),
        (
            "f(DeclareLaunchArgument(n, default_value=d) for n, d in {'a': '1', 'b': '2'}.items())",
            ["a=1", "b=2"],
        ),
        (
            "table = [{'name': 'a', 'default': '1'}, {'name': 'b'}, x]\n"
            "y = [DeclareLaunchArgument(p['name'], default_value=p['default']) for p in table]",
            ["a=1", "b=p['default']"],
        ),
        ("for n, d in ['ab', ('c',)]:\n    DeclareLaunchArgument(n)", ["c"]),
        ("for n in names():\n    DeclareLaunchArgument(n)\n    DeclareLaunchArgument('z')", ["z"]),
        ("for n in []:\n    DeclareLaunchArgument('z')", ["z"]),
        ("for x.y in ['a']:\n    DeclareLaunchArgument('z')", ["z"]),
        ("for n in ['a']:\n    for m in ['b']:\n        DeclareLaunchArgument(n + m)", ["ab"]),
        ("x = {'k': 'a'}\nDeclareLaunchArgument(x['k'])\nDeclareLaunchArgument(x['l'])", ["a"]),
        ("x = {'k': x['k']}\nDeclareLaunchArgument(x['k'])", []),
    ],
)
def test_loops_over_what_is_written_out(look: Look, text: str, expected: list[str]) -> None:
    found = look("a.launch.py", text).arguments
    assert [f"{item.name}={item.default}" if item.default else item.name for item in found] == expected
