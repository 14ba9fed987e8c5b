from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat.launch import launch_description_sources as names
from orchestra.compat.launch.actions import IncludeLaunchDescription, LogInfo
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.compat.launch.launch_description_source import LaunchDescriptionSource
from orchestra.compat.launch.launch_description_sources import (
    AnyLaunchDescriptionSource,
    FrontendLaunchDescriptionSource,
    InvalidPythonLaunchFileError,
    PythonLaunchDescriptionSource,
    get_launch_description_from_any_launch_file,
    get_launch_description_from_frontend_launch_file,
    get_launch_description_from_python_launch_file,
    load_python_launch_file_as_module,
)
from orchestra.compat.launch.substitutions import LaunchConfiguration
from tests.compat import plans
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

_YAML = "launch: [{log: {message: x}}, {log: {message: y}}]"


@pytest.fixture(autouse=True, scope="module")
def _loading() -> Iterator[None]:
    with loading({"PATH": "/usr/bin:/bin"}):
        yield


@pytest.fixture
def python_file(tmp_path: Path) -> str:
    return str(plans.write(tmp_path / "inner.launch.py", "LogInfo(msg='x')", "here = 1"))


@pytest.fixture
def yaml_file(tmp_path: Path) -> str:
    path = tmp_path / "inner.launch.yaml"
    path.write_text(_YAML, "utf-8")
    return str(path)


def test_all_names_are_there() -> None:
    assert all(callable(getattr(names, name)) for name in names.__all__)


@pytest.mark.conforms("1.2 LaunchDescriptionSource")
@pytest.mark.parametrize(
    ("source", "method"),
    [
        (LaunchDescriptionSource(LaunchDescription()), "unspecified mechanism from a script"),
        (PythonLaunchDescriptionSource("a"), "interpreted python launch file"),
        (FrontendLaunchDescriptionSource("a"), "interpreted frontend launch file"),
        (FrontendLaunchDescriptionSource("a", method="mine"), "mine"),
    ],
)
def test_a_source_says_how_it_is_read(source: LaunchDescriptionSource, method: str) -> None:
    assert source.method == method


@pytest.mark.conforms("1.8 paths")
def test_a_location_is_known_when_the_description_is(python_file: str) -> None:
    context = LaunchContext()
    context.launch_configurations["file"] = python_file
    source = PythonLaunchDescriptionSource([LaunchConfiguration("file")])
    assert source.location == "LaunchConfig('file')"
    description = source.get_launch_description(context)
    assert source.location == python_file
    assert source.get_launch_description(context) is description


@pytest.mark.conforms("1.2 LaunchDescriptionSource")
def test_a_source_without_a_description_says_so() -> None:
    with pytest.raises(RuntimeError, match="no launch description"):
        LaunchDescriptionSource().get_launch_description(LaunchContext())


@pytest.mark.conforms("1.8 PythonLaunchDescriptionSource", "1.8 AnyLaunchDescriptionSource")
@pytest.mark.parametrize("kind", [PythonLaunchDescriptionSource, AnyLaunchDescriptionSource])
def test_a_python_file_is_read(kind: Callable[[str], Any], python_file: str) -> None:
    (entity,) = kind(python_file).get_launch_description(LaunchContext()).entities
    assert isinstance(entity, LogInfo)


@pytest.mark.conforms("1.8 FrontendLaunchDescriptionSource", "1.8 AnyLaunchDescriptionSource")
@pytest.mark.parametrize("kind", [FrontendLaunchDescriptionSource, AnyLaunchDescriptionSource])
def test_a_file_of_a_front_end_is_read(kind: Callable[[str], Any], yaml_file: str) -> None:
    assert len(kind(yaml_file).get_launch_description(LaunchContext()).entities) == 2


@pytest.mark.conforms(
    "1.8 get_launch_description_from_any_launch_file", "1.8 load_python_launch_file_as_module"
)
def test_functions_read_files_too(python_file: str, yaml_file: str) -> None:
    assert len(get_launch_description_from_any_launch_file(python_file).entities) == 1
    assert len(get_launch_description_from_any_launch_file(yaml_file).entities) == 2
    assert len(get_launch_description_from_frontend_launch_file(yaml_file).entities) == 2
    assert len(get_launch_description_from_python_launch_file(python_file).entities) == 1
    assert load_python_launch_file_as_module(python_file).here == 1


@pytest.mark.conforms("1.8 PythonLaunchDescriptionSource", "1.8 errors")
def test_a_python_file_without_the_function_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "other.py"
    path.write_text("x = 1\n", "utf-8")
    with pytest.raises(InvalidPythonLaunchFileError, match="generate_launch_description"):
        get_launch_description_from_python_launch_file(str(path))


def test_what_depends_on_a_visit_is_not_known_without_one(python_file: str, tmp_path: Path) -> None:
    known = PythonLaunchDescriptionSource(python_file)
    assert known.try_get_launch_description_without_context() is not None
    for unknown in (LaunchConfiguration("file"), str(tmp_path / "absent.launch.py")):
        source = PythonLaunchDescriptionSource([unknown])
        assert source.try_get_launch_description_without_context() is None


_SOURCES = """
class Mine(LaunchDescriptionSource):
    def get_launch_description(self, context):
        return LaunchDescription([LogInfo(msg=LC('a'))])

class Written(PythonLaunchDescriptionSource):
    def _get_launch_description(self, location):
        return LaunchDescription([LogInfo(msg=location)])

memory = LaunchDescription([LogInfo(msg=[LC('a'), '!'])])
"""


@pytest.mark.conforms("1.3 IncludeLaunchDescription", "1.2 LaunchDescriptionSource")
@pytest.mark.parametrize(
    ("source", "messages"),
    [
        ("LaunchDescriptionSource(memory)", ["1!"]),
        ("Mine()", ["1"]),
        ("Written('anywhere.py')", ["anywhere.py"]),
        ("PythonLaunchDescriptionSource('inner.launch.py')", ["in python 1"]),
        ("LaunchDescriptionSource(memory, location='somewhere')", ["1!"]),
        ("AnyLaunchDescriptionSource('inner.launch.yaml')", ["x", "y"]),
        ("FrontendLaunchDescriptionSource(['inner', '.launch.yaml'])", ["x", "y"]),
        ("'inner.launch.yaml'", ["x", "y"]),
        ("[ThisLaunchFileDir(), '/inner.launch.yaml']", ["x", "y"]),
    ],
)
def test_includes_take_their_description_from_any_source(
    source: str, messages: list[str], tmp_path: Path
) -> None:
    plans.write(tmp_path / "inner.launch.py", "LogInfo(msg=['in python ', LC('a')])")
    (tmp_path / "inner.launch.yaml").write_text(_YAML, "utf-8")
    actions = f"IncludeLaunchDescription({source}, launch_arguments=[('a', '1')])"
    found = plans.python(tmp_path, actions, _SOURCES)
    assert found.messages == messages


def test_an_include_describes_where_it_comes_from(python_file: str) -> None:
    include = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(python_file), launch_arguments={"a": "b"}.items()
    )
    assert include.describe() == f"IncludeLaunchDescription('{python_file}')"
    assert include.launch_arguments == (("a", "b"),)
    assert len(include.get_sub_entities()) == 1
