"""Substitutions that are plain texts: those of YAML and XML, as `$(var x)`, and those of Python in quotes."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING, Final

from orchestra.compat.as_texts import AS_WRITTEN
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problems
    from orchestra.location import Span

_CALL: Final = re.compile(r"\$\((var|env|find-pkg-share|find-pkg-prefix|dirname)(?: +([^\s()$]+))?\)")
_CODE: Final = re.compile(r"(?:LaunchConfiguration|EnvironmentVariable|FindPackageShare)\(.+\)")
_CLASSES: Final = {
    "var": "LaunchConfiguration",
    "env": "EnvironmentVariable",
    "find-pkg-share": "FindPackageShare",
    "find-pkg-prefix": "FindPackagePrefix",
    "dirname": "ThisLaunchFileDir",
}
# What takes texts, and makes no others of them.
_TAKING: Final = frozenset(
    {
        *("AppendEnvironmentVariable", "ComposableNode", "ComposableNodeContainer", "DeclareLaunchArgument"),
        *("ExecuteLocal", "ExecuteProcess", "IfCondition", "IncludeLaunchDescription", "LifecycleNode"),
        *(
            "LoadComposableNodes",
            "LogInfo",
            "Node",
            "ParameterFile",
            "ParameterValue",
            "PathJoinSubstitution",
        ),
        *("PushROSNamespace", "PushRosNamespace", "PythonExpression", "PythonLaunchDescriptionSource"),
        *("SetEnvironmentVariable", "SetLaunchConfiguration", "SetParameter", "SetRemap", "UnlessCondition"),
        *("AnyLaunchDescriptionSource", "XMLLaunchDescriptionSource", "YAMLLaunchDescriptionSource"),
    }
)
_FOR_PEOPLE: Final = frozenset({"description", "msg"})
_HOLDING: Final = (ast.List, ast.Tuple, ast.Dict)


def tell(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of such texts where a launch file hands them over."""
    tree = tree_of(path)
    for node in () if tree is None else _texts(tree):
        text = str(node.value)
        if _CODE.fullmatch(text):
            told = f"the quotes make a text of {text}: {AS_WRITTEN}{text}'"
            at = Location(node_span(path, node, quotes=True), chain)
            problems.warning(Code.SUBSTITUTION_SYNTAX, told, at, suggestion=Rewritten(text))
        found = _CALL.search(text)
        if found is not None and (found[1] == "dirname") == (found[2] is None):
            told = (
                f"{found[0]} is for launch files in YAML and XML, a text of Python stays as it is: "
                f"{AS_WRITTEN}{found[0]}'"
            )
            span = node_span(path, node, quotes=True)
            problems.warning(Code.SUBSTITUTION_SYNTAX, told, Location(span, chain), suggestion=_meant(text))


def _texts(tree: Tree) -> Iterator[ast.Constant]:
    """Yield the texts that calls of the launch language are given, or lists and dictionaries for them."""
    for node in tree.nodes:
        if isinstance(node, ast.Call) and called_by(node) in _TAKING:
            words = (word.value for word in node.keywords if word.arg not in _FOR_PEOPLE)
            yield from (text for item in (*node.args, *words) for text in _held(item, tree))


def _held(node: ast.expr, tree: Tree) -> Iterator[ast.Constant]:
    known = tree.meaning(node)
    if isinstance(known, ast.Constant) and isinstance(known.value, str):
        yield known
    elif isinstance(known, _HOLDING):
        held = known.values if isinstance(known, ast.Dict) else known.elts
        for item in held:
            yield from _held(item, tree)


def _meant(text: str) -> Rewritten:
    """Return the substitutions of Python, in a list with the texts around them."""
    pieces, done = [], 0
    for found in _CALL.finditer(text):
        pieces += [repr(text[done : found.start()])] * (found.start() > done)
        name = "" if found[2] is None else repr(found[2])
        pieces.append(f"{_CLASSES[found[1]]}({name})")
        done = found.end()
    pieces += [repr(text[done:])] * (done < len(text))
    return Rewritten(pieces[0] if len(pieces) == 1 else f"[{', '.join(pieces)}]")
