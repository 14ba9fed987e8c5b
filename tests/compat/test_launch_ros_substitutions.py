"""Substitutions of launch_ros, performed by user code; classes that read entities of XML and YAML files."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, List  # noqa: UP035 - as launch files write it

import pytest

from orchestra.compat.ament_index_python.packages import PackageNotFoundError
from orchestra.compat.launch.actions import PopLaunchConfigurations, PushLaunchConfigurations
from orchestra.compat.launch.frontend import Entity, Parser
from orchestra.compat.launch.launch_context import LaunchContext
from orchestra.compat.launch.substitutions import LaunchConfiguration, SubstitutionFailure
from orchestra.compat.launch.utilities import perform_substitutions
from orchestra.compat.launch_ros.actions import Node, SetParameter
from orchestra.compat.launch_ros.descriptions import ComposableNode
from orchestra.compat.launch_ros.substitutions import (
    ExecutableInPackage,
    FindPackage,
    FindPackagePrefix,
    FindPackageShare,
    Parameter,
)
from orchestra.compat.launch_ros.utilities import evaluate_parameters, normalize_parameters
from orchestra.description.text import Call, Opaque
from orchestra.location import point
from tests.compat.contexts import loading
from tests.load.planning import installed

if TYPE_CHECKING:
    from collections.abc import Iterator

LC = LaunchConfiguration


@pytest.fixture(autouse=True, scope="module")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The prefix of the package `demo`."""
    environment = installed(tmp_path_factory.mktemp("installed"))
    with loading(environment):
        yield environment["AMENT_PREFIX_PATH"]


def _context(**configurations: str) -> LaunchContext:
    context = LaunchContext()
    context.launch_configurations.update(configurations)
    return context


@pytest.mark.conforms("1.14 FindPackagePrefix", "1.14 FindPackageShare", "1.14 ExecutableInPackage")
def test_places_of_packages_are_found(prefix: str) -> None:
    context = _context(p="demo", e="tool")
    assert FindPackagePrefix("demo").perform(context) == prefix
    assert FindPackageShare([LC("p")]).perform(context) == f"{prefix}/share/demo"
    assert (FindPackageShare("demo") / "launch").perform(context) == f"{prefix}/share/demo/launch"
    assert ExecutableInPackage(LC("e"), "demo").perform(context) == f"{prefix}/lib/demo/tool"
    assert FindPackagePrefix("x").find("demo") == prefix
    assert FindPackageShare("x").find("demo") == f"{prefix}/share/demo"


@pytest.mark.conforms(
    "1.14 FindPackage", "1.14 FindPackagePrefix", "1.14 FindPackageShare", "1.14 ExecutableInPackage"
)
def test_what_is_not_there_is_told_as_upstream_does() -> None:
    context = _context()
    for finder in (FindPackagePrefix("gone"), FindPackageShare("gone")):
        with pytest.raises(PackageNotFoundError, match="gone"):
            finder.perform(context)
        with pytest.raises(PackageNotFoundError, match="gone"):
            finder.find("gone")
    with pytest.raises(SubstitutionFailure, match="gone"):
        ExecutableInPackage("gone", "demo").perform(context)
    with pytest.raises(PackageNotFoundError, match="gone"):
        ExecutableInPackage("tool", "gone").perform(context)
    with pytest.raises(SubstitutionFailure, match="unset"):
        FindPackageShare(LC("unset")).perform(context)
    with pytest.raises(NotImplementedError):
        FindPackage("demo").perform(context)


_DESCRIBED: dict[str, tuple[Any, str]] = {
    "prefix": (FindPackagePrefix(["a", LC("b")]), "FindPackagePrefix(pkg='a' + LaunchConfig('b'))"),
    "share": (FindPackageShare("a"), "FindPackageShare(pkg='a')"),
    "executable": (ExecutableInPackage("e", "p"), "ExecInPkg(pkg='p', exec='e')"),
    "parameter": (Parameter("n", default=5), "Parameter(name='n')"),
}


@pytest.mark.conforms("1.4 describe")
@pytest.mark.parametrize(("substitution", "text"), _DESCRIBED.values(), ids=_DESCRIBED)
def test_substitutions_are_described_as_upstream_does(substitution: Any, text: str) -> None:
    assert substitution.describe() == text


_WRITTEN: dict[str, tuple[Any, str]] = {
    "prefix": (FindPackagePrefix(["a", LC("b")]), "$(find-pkg-prefix a$(var b))"),
    "share": (FindPackageShare("a"), "$(find-pkg-share a)"),
    "executable": (ExecutableInPackage("e", "p"), "$(exec-in-pkg e p)"),
    "parameter": (Parameter("n"), "$(param n)"),
    "a parameter with a default": (Parameter("n", default=True), "$(param n True)"),
}


@pytest.mark.parametrize(("substitution", "text"), _WRITTEN.values(), ids=_WRITTEN)
def test_the_launch_language_says_the_same(substitution: Any, text: str) -> None:
    (part,) = substitution._parts(point("here"))
    assert isinstance(part, Call)
    assert substitution._raw() == text


def test_a_finder_of_a_user_is_only_known_to_its_code() -> None:
    class FindSource(FindPackageShare):
        def find(self, package_name: str) -> str:
            return f"/src/{package_name}"

    finder = FindSource(["de", LC("b")])
    (part,) = finder._parts(point("here"))
    assert isinstance(part, Opaque)
    assert [argument.raw for argument in part.inside] == ["de$(var b)"]
    assert finder.perform(_context(b="mo")) == "/src/demo"


@pytest.mark.conforms("1.14 Parameter", "1.12 SetParameter", "D25", "D59")
def test_parameters_of_all_nodes_are_read_as_text() -> None:
    context = _context()
    PushLaunchConfigurations().execute(context)
    SetParameter("rate", 5).execute(context)
    SetParameter("deep", {"on": True}).execute(context)
    SetParameter("rate", 6).execute(context)
    assert Parameter(["ra", "te"]).perform(context) == "6"
    assert Parameter("deep.on").perform(context) == "True"
    assert Parameter("gone", default=["d", LC("x", default="e")]).perform(context) == "de"
    PopLaunchConfigurations().execute(context)
    with pytest.raises(SubstitutionFailure, match="rate"):
        Parameter("rate").perform(context)


_FILE = """
launch:
- custom:
    param:
    - {name: a, value: 5}
    - {name: g, param: [{name: b, value: $(var v)}, {name: t, value: '7', type: str}]}
    - {from: /p.yaml}
    composable_node:
    - {pkg: demo, plugin: 'demo::A', name: x, if: 'false', remap: [{from: a, to: b}], extra_arg: [{name: c, value: 'true'}]}
"""


@pytest.mark.conforms("1.10 Entity", "1.10 Parser")
def test_classes_read_entities_for_actions_of_third_parties() -> None:
    root, parser = Parser.load(io.StringIO(_FILE))
    (entity,) = root.children
    params = entity.get_attr("param", data_type=List[Entity])  # noqa: UP006
    parameters = normalize_parameters(Node.parse_nested_parameters(params, parser))
    context = _context(v="[1, 2]")
    *values, path = evaluate_parameters(context, parameters)
    assert values == [{"a": 5}, {"g.b": [1, 2], "g.t": "7"}]
    assert str(path) == "/p.yaml"
    (component,) = entity.get_attr("composable_node", data_type=List[Entity])  # noqa: UP006
    kind, keywords = ComposableNode.parse(parser, component)
    made = kind(**keywords)
    condition = made.condition()
    assert condition is not None
    assert condition.evaluate(context) is False
    assert perform_substitutions(context, made.node_plugin) == "demo::A"
    assert evaluate_parameters(context, made.extra_arguments) == ({"c": True},)
