"""Texts with names in braces that have no `f` before them: `'camera_{side}'` stays as it is written."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING, Final

from orchestra.compat.rewritten import Rewritten
from orchestra.compat.scopes import parameters
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span
from orchestra.errors import Code, Severity
from orchestra.fields import replace
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from orchestra.compat.scopes import Function
    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problem, Problems
    from orchestra.location import Span

_NAMES: Final = re.compile(r"(?<!\$)\{([A-Za-z_]\w*)\}")
_BRACES: Final = re.compile(r"[{}]")
_LACKS: Final = "an f is missing before "
# What takes texts, and makes no others of them.
_TAKING: Final = frozenset(
    {
        *("AppendEnvironmentVariable", "ComposableNode", "ComposableNodeContainer", "DeclareLaunchArgument"),
        *(
            "ExecuteLocal",
            "ExecuteProcess",
            "FindPackageShare",
            "IncludeLaunchDescription",
            "LaunchConfiguration",
        ),
        *("LifecycleNode", "LogInfo", "Node", "ParameterFile", "ParameterValue", "PathJoinSubstitution"),
        *("PushROSNamespace", "PushRosNamespace", "PythonLaunchDescriptionSource", "SetEnvironmentVariable"),
        *("SetLaunchConfiguration", "SetParameter", "SetRemap", "TextSubstitution", "open"),
        "get_package_share_directory",
    }
)
_FOR_PEOPLE: Final = frozenset({"description"})


def tell_without_f(path: str, tree: Tree, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of such texts where a launch file hands them over, and the names stand for something there."""
    done: set[int] = set()
    filled = _filled(tree)
    for node in _texts(tree):
        text = str(node.value)
        names = _NAMES.findall(text)
        is_plain = names and len(_BRACES.findall(text)) == 2 * len(names)
        if (
            id(node) in done
            or not is_plain
            or filled.issuperset(names)
            or not all(_is_known(name, node, tree) for name in names)
        ):
            continue
        done.add(id(node))
        span = node_span(path, node, quotes=True)
        written = text_at(path, span)
        meant = Rewritten(f"f{written}") if written[:1] in "'\"" and "\n" not in written else None
        message = f"{_LACKS}'{text}': {{{names[0]}}} stays as it is written"
        problems.warning(Code.USER_CODE, message, Location(span, chain), suggestion=meant)


def without_what_braces_cause(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out problems of texts that lack their f; what is told instead is as grave."""
    lacking = {
        problem.message.split("'")[1]: problem for problem in problems if problem.message.startswith(_LACKS)
    }
    caused = {
        id(problem): text
        for problem in (problems if lacking else ())
        for text in lacking
        if problem is not lacking[text] and text in problem.message
    }
    grave = {
        id(lacking[caused[id(item)]])
        for item in problems
        if id(item) in caused and item.severity is Severity.ERROR
    }

    def kept(problem: Problem) -> Problem | None:
        if id(problem) in caused:
            return None
        return replace(problem, severity=Severity.ERROR) if id(problem) in grave else problem

    return kept


def _filled(tree: Tree) -> set[str]:
    """Return the names that code puts something else in the place of: by `format`, or `replace('{name}', ...)`."""
    found: set[str] = set()
    for node in tree.nodes:
        match node:
            case ast.Call(func=ast.Attribute(attr="format"), keywords=words):
                found.update(word.arg for word in words if word.arg is not None)
            case ast.Call(func=ast.Attribute(attr="replace"), args=[ast.Constant(value=str(text)), _]):
                found.update(_NAMES.findall(text))
    return found


def _texts(tree: Tree) -> Iterator[ast.Constant]:
    for node in tree.nodes:
        if isinstance(node, ast.Call):
            is_join = isinstance(node.func, ast.Attribute) and node.func.attr == "join"
            if is_join or called_by(node) in _TAKING:
                words = (word.value for word in node.keywords if word.arg not in _FOR_PEOPLE)
                yield from (text for item in (*node.args, *words) for text in _held(item, tree))


def _held(node: ast.expr, tree: Tree) -> Iterator[ast.Constant]:
    waiting = [node]
    while waiting:
        known = tree.meaning(waiting.pop())
        match known:
            case ast.Constant(value=str()):
                yield known
            case ast.List(elts=items) | ast.Tuple(elts=items) | ast.Dict(values=items):
                waiting += reversed(items)
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                waiting += (right, left)


def _is_known(name: str, node: ast.AST, tree: Tree) -> bool:
    """Return whether a name is set where a node stands."""
    for function in tree.functions_around(node):
        if name in parameters(function) or _is_set_in(function, name, tree):
            return True
    return not name[:1].isupper() and _is_set_in(tree.module, name, tree)


def _is_set_in(scope: Function | ast.Module, name: str, tree: Tree) -> bool:
    return any(not isinstance(node, _IMPORTS) for node in tree.set_in(scope).get(name, ()))


_IMPORTS: Final = (ast.Import, ast.ImportFrom, ast.ClassDef)
