"""What functions of event handlers do with an event that it has not, or not so: they run long after the check.

What a process writes is bytes, how it has ended is a number.
"""

from __future__ import annotations

import ast
from importlib import import_module
from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.compat.asked_before import asks_of, tried
from orchestra.compat.borrowed import ROOM
from orchestra.compat.idle_names import ACTIONS
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.scopes import Function
from orchestra.compat.source_text import text_at
from orchestra.compat.syntax_trees import called_by, node_span, tree_of
from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.location import Location
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.syntax_trees import Tree
    from orchestra.errors import Problems
    from orchestra.location import Span

_PROCESS: Final = "launch.events.process"
# What functions of these are given.
_EVENTS: Final = {
    "OnExecutionComplete": ("launch.events", "ExecutionComplete"),
    "OnProcessExit": (_PROCESS, "ProcessExited"),
    "OnProcessIO": (_PROCESS, "ProcessIO"),
    "OnProcessStart": (_PROCESS, "ProcessStarted"),
    "OnShutdown": ("launch.events", "Shutdown"),
}
# Other words for what events have.
_WORDS: Final = {
    **dict.fromkeys(("code", "exit_code", "exitcode", "exit_status", "return_code", "status"), "returncode"),
    **dict.fromkeys(("data", "line", "message", "msg", "output", "stdout", "stderr"), "text"),
    **dict.fromkeys(("name", "node_name", "process"), "process_name"),
    **dict.fromkeys(("node", "source", "target_action"), "action"),
    **dict.fromkeys(("command", "args"), "cmd"),
}
_NUMBERS: Final = frozenset({"pid", "returncode"})
_MADE: Final = ACTIONS | {"EmitEvent", "LogInfo", "SetLaunchConfiguration", "Shutdown"}
# Methods of bytes that give bytes, and those that are given some.
_KEEPING: Final = frozenset({"lower", "lstrip", "removeprefix", "rstrip", "strip", "upper"})
_TAKING: Final = frozenset(
    {
        *("count", "endswith", "find", "index", "partition", "removeprefix", "replace", "rfind", "rindex"),
        *("rpartition", "rsplit", "split", "startswith"),
    }
)
_SEARCHING: Final = frozenset({"findall", "finditer", "fullmatch", "match", "search", "split"})


class _Use(NamedTuple):
    """What uses an event: the function, the name that the event has in it, and what it is an event of."""

    body: list[ast.AST]
    name: str
    kind: str


class _Fault(NamedTuple):
    """What is wrong with an expression, or with the name of an attribute."""

    node: ast.expr
    message: str
    meant: str | None
    is_name: bool = False


def tell(path: str, problems: Problems, chain: tuple[Span, ...]) -> None:
    """Warn of what fails, or is never so, when an event comes."""
    tree = tree_of(path)
    done: set[int] = set()
    for use in () if tree is None else _uses(tree):
        for fault in (*_faults(use, tree, path), *_unreturned(use)) if tree is not None else ():
            if id(fault.node) not in done:
                done.add(id(fault.node))
                span = _place(path, fault)
                meant = None if fault.meant is None else Rewritten(fault.meant)
                problems.warning(Code.USER_CODE, fault.message, Location(span, chain), suggestion=meant)


def _place(path: str, fault: _Fault) -> Span:
    span = node_span(path, fault.node, quotes=True)
    if not isinstance(fault.node, ast.Attribute) or not fault.is_name:
        return span
    return replace(span, line=span.end_line, column=span.end_column - len(fault.node.attr))


def _uses(tree: Tree) -> Iterator[_Use]:
    functions: dict[str, list[Function]] = {}
    for node in tree.nodes:
        if isinstance(node, Function):
            functions.setdefault(node.name, []).append(node)
    for call in tree.nodes:
        kind = called_by(call)
        for word in call.keywords if isinstance(call, ast.Call) and kind in _EVENTS else ():
            match word.value:
                case ast.Lambda(args=ast.arguments(args=[first, *_]), body=body):
                    yield _Use(list(ast.walk(body)), first.arg, str(kind))
                case ast.Name(id=name) | ast.Attribute(attr=name) if len(functions.get(name, ())) == 1:
                    function = functions[name][0]
                    given = [item.arg for item in function.args.args if item.arg != "self"]
                    if given and (word.arg or "").startswith("on_"):
                        yield _Use([n for item in function.body for n in ast.walk(item)], given[0], str(kind))


def _faults(use: _Use, tree: Tree, path: str) -> Iterator[_Fault]:
    if any(isinstance(node, ast.Name) and node.id == use.name and _is_set(node) for node in use.body):
        return  # it may be anything by then
    module, name = _EVENTS[use.kind]
    known = {item for item in dir(getattr(import_module(f"{ROOM}.{module}"), name)) if item[:1] != "_"}
    is_asked, dealt_with = asks_of(use.body, use.name), tried(use.body)
    for node in use.body:
        if _is_of(node, use) and isinstance(node, ast.Attribute) and node.attr not in known:
            if node.attr[:1] != "_" and not (_is_set(node) or is_asked or id(node) in dealt_with):
                word = _WORDS.get(node.attr)
                meant = word if word in known else nearest(node.attr, known)
                yield _Fault(node, f"the event of {use.kind} has no '{node.attr}'", meant, is_name=True)
        elif use.kind == "OnProcessIO" and not asks_of(use.body, f"{use.name}.text"):
            yield from _of_bytes(node, _Bytes(use, tree, path))
        yield from _of_numbers(node, use, path)


def _unreturned(use: _Use) -> Iterator[_Fault]:
    """Yield the actions that a function makes by a statement alone, where it returns nothing."""
    returned = [node.value for node in use.body if isinstance(node, ast.Return) and node.value is not None]
    for node in () if returned else use.body:
        if isinstance(node, ast.Expr) and called_by(node.value) in _MADE and isinstance(node.value, ast.Call):
            name = node.value.func
            message = f"this {ast.unparse(name)} is thrown away: the function returns nothing, its `return` is missing"
            yield _Fault(name, message, f"return {ast.unparse(name)}")


def _is_set(node: ast.Name | ast.Attribute) -> bool:
    return not isinstance(node.ctx, ast.Load)


def _is_of(node: ast.AST, use: _Use) -> bool:
    return isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == use.name


class _Bytes:
    """Which expressions are bytes, and which are texts that are put beside them."""

    def __init__(self, use: _Use, tree: Tree, path: str) -> None:
        self.use, self.tree, self.path = use, tree, path

    def are(self, node: ast.expr) -> bool:
        """Return whether an expression is what a process has written."""
        match self.tree.meaning(node):
            case ast.Call(func=ast.Attribute(value=value, attr=attr)):
                return attr in _KEEPING and self.are(value)
            case ast.Attribute(attr="text") as known:
                return _is_of(known, self.use)
        return False

    def texts(self, node: ast.expr) -> list[ast.Constant]:
        """Return the texts that an expression is, or may be one of."""
        match self.tree.meaning(node):
            case ast.Constant(value=str()) as known:
                return [known]
            case ast.Tuple(elts=items) | ast.List(elts=items) | ast.Set(elts=items):
                return [text for item in items for text in self.texts(item)]
            case ast.Name(id=name):
                parts = [item for item in self.use.body if isinstance(item, ast.comprehension | ast.For)]
                lists = [
                    part.iter
                    for part in parts
                    if isinstance(part.target, ast.Name) and part.target.id == name
                ]
                return self.texts(lists[0]) if len(lists) == 1 and lists[0] is not node else []
        return []

    def fault(self, text: ast.Constant) -> _Fault:
        """Return that a text stands where bytes are meant."""
        written = text_at(self.path, node_span(self.path, text, quotes=True))
        is_plain = written[:1] in "'\"" and written.isascii()
        message = f"{self.use.name}.text is bytes, {written} is a text: "
        return _Fault(
            text,
            f"{message}b before it makes bytes of it, or {self.use.name}.text.decode() is a text",
            f"b{written}" if is_plain else None,
        )

    def decoded(self, node: ast.expr) -> _Fault:
        """Return that bytes stand where a text is meant."""
        written = ast.unparse(node)
        return _Fault(node, f"{written} is bytes, no text", f"{written}.decode()")


def _of_bytes(node: ast.AST, known: _Bytes) -> Iterator[_Fault]:
    texts: list[ast.Constant] = []
    match node:
        case ast.Compare(left=left, comparators=[right]):
            if known.are(right):
                texts = known.texts(left)
            elif known.are(left):
                texts = known.texts(right)
        case ast.Call(func=ast.Attribute(value=value, attr=attr), args=given):
            if attr in _TAKING and known.are(value):
                texts = [text for item in given for text in known.texts(item)]
            elif attr in _SEARCHING and given[1:] and known.are(given[1]):
                texts = known.texts(given[0])
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            sides = [(left, right), (right, left)]
            yield from (known.decoded(one) for one, other in sides if known.are(one) and known.texts(other))
    yield from map(known.fault, texts)
    if called_by(node) == "LogInfo" and isinstance(node, ast.Call):
        yield from (known.decoded(item) for item in _written(node) if known.are(item))


def _of_numbers(node: ast.AST, use: _Use, path: str) -> Iterator[_Fault]:
    match node:
        case ast.Compare(
            left=left, ops=[ast.Eq() | ast.NotEq()], comparators=[ast.Constant(value=str(text)) as given]
        ) if _is_number(left, use):
            is_number = text.removeprefix("-").isdecimal()
            message = f"{ast.unparse(left)} is a number, never the text {text!r}"
            yield _Fault(given, message, text if is_number else None)
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            for one, other in ((left, right), (right, left)):
                is_text = isinstance(other, ast.Constant | ast.BinOp | ast.JoinedStr)
                if _is_number(one, use) and is_text and not _counts(other):
                    yield _number_told(one, path)
        case ast.Call() if called_by(node) == "LogInfo":
            yield from (_number_told(item, path) for item in _written(node) if _is_number(item, use))


def _counts(node: ast.expr) -> bool:
    """Return whether an expression may be a number."""
    if isinstance(node, ast.Constant):
        return not isinstance(node.value, str)
    texts = (
        item for item in ast.walk(node) if isinstance(item, ast.Constant) and isinstance(item.value, str)
    )
    return isinstance(node, ast.BinOp) and not any(texts)


def _is_number(node: ast.expr, use: _Use) -> bool:
    return _is_of(node, use) and isinstance(node, ast.Attribute) and node.attr in _NUMBERS


def _number_told(node: ast.expr, path: str) -> _Fault:
    written = text_at(path, node_span(path, node))
    return _Fault(node, f"{written} is a number, no text", f"str({written})")


def _written(call: ast.Call) -> Iterator[ast.expr]:
    """Yield what a message is put together of."""
    for item in (*call.args, *(word.value for word in call.keywords if word.arg == "msg")):
        yield from item.elts if isinstance(item, ast.List | ast.Tuple) else (item,)
