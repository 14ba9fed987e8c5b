"""What Python goes through once, or not to its end: generators, lists of other lengths, lists that calls share."""

from __future__ import annotations

import ast
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.compat.kept_on_purpose import is_kept_on_purpose
from orchestra.compat.left_out import MADE
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.scopes import Function, of_scope
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code
from orchestra.location import Location

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problem, Problems
    from orchestra.location import Span

_ONCE: Final = frozenset({"filter", "map", "zip"})
_TO_THE_END: Final = frozenset({"LaunchDescription", "list", "set", "sorted", "sum", "tuple"})
_CHANGING: Final = frozenset({"append", "extend", "insert", "setdefault", "update"})
_TWO: Final = 2
_SHARED: Final = " is one for all calls, which add to it"
_MOST: Final = 100  # characters: what is longer is read better in the message alone


def tell(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of what a file goes through a second time, leaves out or shares."""
    tree = tree_of(path)
    for node, message, meant in (
        () if tree is None else (*_spent(tree), *_shorter(tree), *_shared(tree), *_set_again(tree))
    ):
        code = Rewritten(meant) if meant is not None and len(meant) <= _MOST else None
        at = Location(node_span(path, node, quotes=True), chain)
        problems.warning(Code.USER_CODE, message, at, suggestion=code)


def without_shared(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out problems of what calls share, in a file where that is told."""
    told = {
        (item.span.file, item.message.split("'")[1])
        for item in problems
        if item.span and _SHARED in item.message
    }

    def kept(problem: Problem) -> Problem | None:
        span = problem.span
        if not told or span is None or _SHARED in problem.message:
            return problem
        written = text_at(str(Path(span.file).absolute()), span)
        return None if (span.file, written) in told else problem

    return kept


def _spent(tree: Tree) -> Iterator[tuple[ast.expr, str, str | None]]:
    """Yield the generators that have names by which they are gone through twice."""
    scopes = [node for node in tree.nodes if isinstance(node, Function)]
    for scope in (tree.module, *scopes):
        once = list(_set_to_generators(scope, tree))
        nodes = list(of_scope(scope)) if once else []
        every = Counter(node.id for node in nodes if isinstance(node, ast.Name))
        through: dict[str, list[ast.Name]] = {}
        for use in (use for node in nodes for use in _gone_through(node)):
            through.setdefault(use.id, []).append(use)
        branched = _in_branches(nodes)
        for name, value in once:
            uses = through.get(name, [])
            if len(uses) == _TWO and every[name] == _TWO + 1 and name not in branched:
                kind = "generator" if isinstance(value, ast.GeneratorExp) else called_by(value)
                written = (
                    f"[{ast.unparse(value)[1:-1]}]" if kind == "generator" else f"list({ast.unparse(value)})"
                )
                message = (
                    f"'{name}' has nothing left here: a {kind} is gone through once, in line {uses[0].lineno}"
                )
                yield uses[1], f"{message}; {written} can be gone through again", None


def _set_to_generators(scope: Function | ast.Module, tree: Tree) -> Iterator[tuple[str, ast.expr]]:
    for name, setting in tree.set_in(scope).items():
        match setting:
            case [ast.Assign(targets=[ast.Name()], value=value)] if _is_once(value):
                yield name, value


def _is_once(value: ast.expr) -> bool:
    is_call = isinstance(value, ast.Call) and isinstance(value.func, ast.Name)
    return isinstance(value, ast.GeneratorExp) or (is_call and called_by(value) in _ONCE)


def _gone_through(node: ast.AST) -> Iterator[ast.Name]:
    """Yield the names that something goes through to the end."""
    found: list[ast.expr] = []
    match node:
        case ast.For(iter=through, body=body) if not any(
            isinstance(item, ast.Break | ast.Return) for part in body for item in ast.walk(part)
        ):
            found = [through]
        case (
            ast.ListComp(generators=[part]) | ast.SetComp(generators=[part]) | ast.DictComp(generators=[part])
        ):
            found = [part.iter]
        case ast.Starred(value=value):
            found = [value]
        case ast.Call(args=[given]) if called_by(node) in _TO_THE_END or called_by(node) == "extend":
            found = [given]
    yield from (item for item in found if isinstance(item, ast.Name))


def _in_branches(nodes: list[ast.AST]) -> set[str]:
    """Return the names that are used in what may not be run, or is run again."""
    around = (ast.If, ast.IfExp, ast.For, ast.While, ast.Try)
    inside = ((node.body, getattr(node, "orelse", [])) for node in nodes if isinstance(node, around))
    parts = [part for body, others in inside for part in (body, others)]
    flat = [item for part in parts for item in (part if isinstance(part, list) else [part])]
    return {item.id for part in flat for item in ast.walk(part) if isinstance(item, ast.Name)}


def _shorter(tree: Tree) -> Iterator[tuple[ast.expr, str, str | None]]:
    """Yield the lists that end before others that they are gone through with."""
    for node in tree.nodes:
        match node:
            case ast.Call(func=ast.Name(id="zip"), args=[_, _, *_] as given, keywords=[]):
                known = [tree.meaning(item) for item in given]
            case _:
                continue
        lists = [item for item in known if isinstance(item, ast.List | ast.Tuple) and tree.is_apart(item)]
        lengths = [len(item.elts) for item in lists]
        if len(lists) == len(given) and min(lengths) < max(lengths) and not _follow(lists):
            shortest = lengths.index(min(lengths))
            left = lists[lengths.index(max(lengths))].elts[min(lengths)]
            yield given[shortest], f"zip ends with the shortest list: {ast.unparse(left)} is left out", None


def _follow(lists: Iterable[ast.List | ast.Tuple]) -> bool:
    """Return whether lists are one of them and what comes after its first items: each with the one behind it."""
    written = [[ast.unparse(item) for item in each.elts] for each in lists]
    longest = max(written, key=len)
    return all(each and longest[-len(each) :] == each for each in written)


def _shared(tree: Tree) -> Iterator[tuple[ast.expr, str, str | None]]:
    """Yield the lists and dictionaries by default that a function adds to: its calls have one between them."""
    functions = [node for node in tree.nodes if isinstance(node, Function)]
    found = [(function.name, *item) for function in functions for item in _added_to(function)]
    again = _called_again(tree) if found else frozenset()
    for name, item, default in found:
        if name in again:
            message = f"'{item}'{_SHARED}: None by default, and a new one in the function, is not"
            yield default, message, None


def _added_to(function: Function) -> Iterator[tuple[str, ast.expr]]:
    """Yield the parameters of a function that it adds to where they are empty by default, and what they are then."""
    given = function.args.args[len(function.args.args) - len(function.args.defaults) :]
    for item, default in zip(given, function.args.defaults, strict=True):
        is_empty = ast.unparse(default) in ("[]", "{}", "dict()", "list()")
        changes = [node for node in ast.walk(function) if _changes(node, item.arg)] if is_empty else []
        is_plain = changes and not _is_set(function, item.arg)
        if is_plain and not is_kept_on_purpose(function, item.arg, changes):
            yield item.arg, default


def _changes(node: ast.AST, name: str) -> bool:
    match node:
        case ast.Call(func=ast.Attribute(value=ast.Name(id=found), attr=attr)):
            return found == name and attr in _CHANGING
        case ast.Assign(targets=[ast.Subscript(value=ast.Name(id=found))]):
            return found == name
        case ast.AugAssign(target=ast.Name(id=found)):
            return found == name
    return False


def _is_set(function: Function, name: str) -> bool:
    """Return whether a function sets the name of a parameter to something else."""
    targets = (
        target for node in ast.walk(function) if isinstance(node, ast.Assign) for target in node.targets
    )
    return any(isinstance(target, ast.Name) and target.id == name for target in targets)


def _called_again(tree: Tree) -> frozenset[str | None]:
    """Return the names of what is called more than once, or in a loop."""
    calls = Counter(called_by(node) for node in tree.nodes)
    loops = (node for node in tree.nodes if isinstance(node, ast.For | ast.ListComp | ast.GeneratorExp))
    in_loops = {called_by(item) for loop in loops for item in ast.walk(loop)}
    return frozenset({name for name, times in calls.items() if times >= _TWO} | in_loops)


def _set_again(tree: Tree) -> Iterator[tuple[ast.expr, str, str | None]]:
    """Yield the names of actions that are set to other ones before anything reads them, in one block."""
    for block in tree.nodes:
        if not isinstance(block, Function | ast.If | ast.For | ast.With):
            continue
        waiting: dict[str, ast.Name] = {}
        for statement in block.body:
            read = {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}
            match statement:
                case ast.Assign(targets=[ast.Name() as name], value=value) if called_by(value) in MADE:
                    read = {node.id for node in ast.walk(value) if isinstance(node, ast.Name)}
                    if name.id in waiting and name.id not in read:
                        message = f"'{name.id}' is part of no launch description: it has no effect, for it is set again"
                        yield waiting[name.id], message, None
                    _forget(waiting, read)
                    waiting[name.id] = name
                case _:
                    _forget(waiting, read)


def _forget(waiting: dict[str, ast.Name], read: set[str]) -> None:
    for name in read:
        waiting.pop(name, None)
